"""From the assembly of a model to the program that is solved: contact points or interfaces, and what reductions leave.

Every load case takes this way, whatever its contact model; the rigid bodies keep the way back to the blocks. Conditions
on interfaces are torsion where it is asked for, and crushing wherever it can be. Where a program has none, notices
state the known errors of the contact model for the joints of a model.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray
from mbla.assembly.assembly import Assembly
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.contacts.contacts import Contacts
from mbla.deck.sections.analysis import AnalysisSection
from mbla.errors import Notice
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
    crushing = CrushingInterfaces.of(model, contacts) if crushes_by_interfaces(analysis, model, contacts) else None
    twisting = TwistingInterfaces.of(model, contacts) if analysis.contact_model == "convex" else None
    program = assemble(model, contacts, case)
    reduced = reduce_program(model, contacts, program, allowed_reductions(analysis), associative=associative)
    steps = (glued_step(bodies, reduced.steps[0].before), *reduced.steps)
    parts = tuple(with_conditions_of(part, crushing, twisting) for part in reduced.parts)
    return CaseProgram(bodies, case, replace(reduced, parts=parts, steps=steps), crushing, twisting)


def crushable_interfaces(model: Model, contacts: Contacts) -> BoolArray:
    """Interfaces with a compressive strength, (n_interfaces,)."""
    strengths = np.array([model.joints[name].compressive_strength for name in contacts.joint_names])
    return np.asarray(np.isfinite(strengths)[contacts.joints] if len(contacts) else np.zeros(0, dtype=bool))


def has_conditions_on_interfaces(analysis: AnalysisSection, model: Model, contacts: Contacts) -> bool:
    """Whether the program has conditions on interfaces; without, joints crush at their contact points."""
    if analysis.contact_model == "convex":
        return True
    return crushes_by_interfaces(analysis, model, contacts)


def crushes_by_interfaces(analysis: AnalysisSection, model: Model, contacts: Contacts) -> bool:
    """Whether joints crush by the resultants of their interfaces."""
    return takes_stress_blocks(analysis) and bool(crushable_interfaces(model, contacts).any())


def takes_stress_blocks(analysis: AnalysisSection) -> bool:
    """Whether flow rule, scheme and solver of an analysis go with conditions on interfaces."""
    by_path = analysis.flow_rule == "dilatancy" or (
        analysis.flow_rule == "non_associative" and analysis.scheme == "auto"
    )
    by_flow = by_path or analysis.flow_rule == "associative"
    return by_flow and analysis.solver in ("auto", "clarabel")


def program_notices(model: Model, contacts: Contacts, analysis: AnalysisSection) -> tuple[Notice, ...]:
    """Warnings about joint laws in use that the contact model represents on the unsafe side."""
    crushable = crushable_interfaces(model, contacts)
    if not crushable.any() or has_conditions_on_interfaces(analysis, model, contacts):
        return ()
    names = ", ".join(contacts.joint_names[joint] for joint in np.unique(contacts.joints[crushable]))
    text = (
        f"joint law {names}: with this flow rule, scheme or solver compressive strength limits each contact point to "
        "its share of the area, which overstates an interface under eccentric load: with its corners alone it bears "
        "N (1 + 2 e/b) <= fc A, a stress block only N <= fc A (1 - 2 e/b), with eccentricity e and width b; "
        "associative and non_associative flow, and that with dilatancy, crush as stress blocks do with scheme: auto "
        "and solver: auto or clarabel; more points (contacts.points) bring the difference down"
    )
    return (Notice("warning", "eccentric-crushing-overstated", text),)
