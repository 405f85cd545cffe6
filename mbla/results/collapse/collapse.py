"""A mechanism as it is told: what interfaces do, which blocks move together and how, where the power goes."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.arrays import IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.interface_modes import InterfaceMotion, interface_motion
from mbla.results.collapse.kept import kept
from mbla.results.collapse.rigid_parts import PartMotion, part_motions, rigid_parts
from mbla.results.collapse.work import Work, work_of
from mbla.solution.solution import Mechanics


@dataclass(frozen=True)
class Collapse:
    """Everything that follows from forces and velocities; result files hold it for others, mbla finds it anew.

    interfaces : what each interface does
    parts      : (n_blocks,) part of each block, 0 at rest
    motions    : of the parts that move, the heaviest first
    work       : where the power goes
    """

    interfaces: InterfaceMotion
    parts: IntArray
    motions: tuple[PartMotion, ...]
    work: Work


@kept
def collapse_of(model: Model, contacts: Contacts, load_case: LoadCase, mechanics: Mechanics) -> Collapse:
    """The mechanism of one load case."""
    parts = rigid_parts(model, contacts, mechanics.mechanism)
    return Collapse(
        interfaces=interface_motion(model, contacts, mechanics),
        parts=parts,
        motions=part_motions(model, parts, mechanics.mechanism),
        work=work_of(model, contacts, load_case, mechanics),
    )
