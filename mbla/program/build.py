"""From the solids of a model to the program that is solved: contact points or interfaces, and what reductions leave.

Every load case takes this way, whatever its contact model; the solids keep the way back to the blocks.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from mbla.contacts.glue import Solids
from mbla.deck.sections.analysis import AnalysisSection
from mbla.model.model import LoadCase
from mbla.process.stopwatch import timed
from mbla.program.assemble import assemble
from mbla.program.choice import has_conditions_on_interfaces
from mbla.program.reductions import Reduced, allowed_reductions, reduce_program, unreduced
from mbla.program.reductions.steps import glued_step, told_apart
from mbla.program.resultants.assemble import ConvexProgram, assemble_convex, size_of_convex


@dataclass(frozen=True)
class CaseProgram:
    """The program of one load case.

    solids  : for blocks, and the way back to these
    reduced : of the contact points: its parts, and what each reduction left out
    convex  : with conditions on interfaces, solved as a whole; None where there are none
    """

    solids: Solids
    reduced: Reduced
    convex: ConvexProgram | None = None


@timed("assemble")
def build_program(solids: Solids, load_case: LoadCase, analysis: AnalysisSection) -> CaseProgram:
    """The program of a load case on blocks by the contact model, the flow rule and the reductions of the analysis.

    solids : of the model as it may move under the load case
    """
    model, contacts, case = solids.model, solids.contacts, solids.load_case(load_case)
    if has_conditions_on_interfaces(analysis, model, contacts):
        convex = assemble_convex(model, contacts, case, analysis.contact_model)
        as_it_is = unreduced(convex.points, contacts)
        return CaseProgram(solids, replace(as_it_is, steps=(glued_step(solids, size_of_convex(convex)),)), convex)
    program, associative = assemble(model, contacts, case), analysis.flow_rule == "associative"
    reduced = reduce_program(model, contacts, program, allowed_reductions(analysis), associative=associative)
    steps = told_apart(reduced.steps, switched_on=analysis.reductions)
    return CaseProgram(solids, replace(reduced, steps=(glued_step(solids, steps[0].before), *steps)))
