"""From the assembly of a model to the program that is solved: contact points or interfaces, and what reductions leave.

Every load case takes this way, whatever its contact model; the rigid bodies keep the way back to the blocks. Conditions
on interfaces are torsion where it is asked for, and crushing wherever joints have a compressive strength.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray
from mbla.assembly.assembly import Assembly
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.contacts.contacts import Contacts
from mbla.deck.sections.analysis import AnalysisSection
from mbla.model.model import LoadCase, Model
from mbla.process.stopwatch import stage
from mbla.program.assemble import assemble
from mbla.program.reductions import Reduced, allowed_reductions, reduce_program
from mbla.program.reductions.steps import glued_step
from mbla.program.resultants.conditions_of import with_conditions_of
from mbla.program.resultants.interface_motions import CrushingInterfaces
from mbla.program.resultants.twisting_interfaces import TwistingInterfaces


@dataclass(frozen=True)
class CaseProgram:
    """The program of one load case.

    bodies    : what is solved for, and the way back to the blocks
    load_case : on the bodies
    reduced   : of the contact points: its parts, and what each reduction left out
    crushing, twisting : conditions on interfaces that the programs of the parts have; None where there are none
    """

    bodies: RigidBodies
    load_case: LoadCase
    reduced: Reduced
    crushing: CrushingInterfaces | None = None
    twisting: TwistingInterfaces | None = None


@stage("assemble")
def build_program(assembly: Assembly, load_case: LoadCase, analysis: AnalysisSection) -> CaseProgram:
    """The program of a load case on blocks by the contact model, the flow rule and the reductions of the analysis."""
    bodies = assembly.of(load_case)
    model, contacts, case = bodies.model, bodies.contacts, bodies.load_case(load_case)
    associative = analysis.flow_rule == "associative"
    crushing = CrushingInterfaces.of(model, contacts) if crushable_interfaces(model, contacts).any() else None
    twisting = TwistingInterfaces.of(model, contacts) if analysis.contact_model == "convex" else None
    program = assemble(model, contacts, case)
    switches, by_interfaces = allowed_reductions(analysis), crushing is not None or twisting is not None
    reduced = reduce_program(model, contacts, program, switches, associative=associative, by_interfaces=by_interfaces)
    steps = (glued_step(bodies, reduced.steps[0].before), *reduced.steps)
    parts = tuple(with_conditions_of(part, crushing, twisting) for part in reduced.parts)
    return CaseProgram(bodies, case, replace(reduced, parts=parts, steps=steps), crushing, twisting)


def crushable_interfaces(model: Model, contacts: Contacts) -> BoolArray:
    """Interfaces with a compressive strength, (n_interfaces,)."""
    strengths = np.array([model.joints[name].compressive_strength for name in contacts.joint_names])
    return np.asarray(np.isfinite(strengths)[contacts.joints] if len(contacts) else np.zeros(0, dtype=bool))
