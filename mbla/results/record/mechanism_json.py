"""A mechanism as an object of the JSON record: modes, rigid parts, lines between them, where the power goes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from mbla.assembly.assembly import Assembly
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.collapse import Collapse, Failure, collapse_of, failure_of, mechanism_class
from mbla.results.collapse.cracks import Crack, YieldLine
from mbla.results.collapse.force_freedom import Enough, ForceFreedom, enough_of
from mbla.results.collapse.force_freedom import force_freedom as freedom_of
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.joint_planes import HingeLine, SlidingPlane
from mbla.results.collapse.mechanics import dissipated_by_joint, loads_by_group
from mbla.results.collapse.rigid_parts import PartMotion, moving_share
from mbla.results.collapse.rigid_parts import moving_blocks as free_blocks_that_move
from mbla.results.collapse.rigid_parts import reach as reach_of
from mbla.results.record.mechanism_lines import CRACK, HINGE_LINE, PART, SLIDING_PLANE, YIELD_LINE, Part
from mbla.results.record.objects import Object
from mbla.solution.solution import ContactMode, Mechanics

MOST = 100
"""objects of each kind that the record holds, those that move most"""


@dataclass(frozen=True)
class Mechanism:
    """A mechanism with what follows from it; ``dimension``: in which the case was solved."""

    assembly: Assembly
    load_case: LoadCase
    mechanics: Mechanics
    dimension: int

    @cached_property
    def model(self) -> Model:
        """As it may move under the load case."""
        return self.assembly.model.of_case(self.load_case)

    @property
    def contacts(self) -> Contacts:
        """As found."""
        return self.assembly.contacts

    @property
    def collapse(self) -> Collapse:
        """What follows from it."""
        return collapse_of(self.assembly, self.load_case, self.mechanics)

    @property
    def failure(self) -> Failure:
        """Clusters and the lines between them."""
        return failure_of(self.model, self.contacts, self.collapse, self.mechanics)

    @property
    def share(self) -> float:
        """Of the weight of the free blocks that moves."""
        return moving_share(self.model, self.collapse.parts)

    def parts(self, motions: tuple[PartMotion, ...]) -> list[Part]:
        """The heaviest of them."""
        return [Part(self.model, motion) for motion in motions[:MOST]]

    def count(self, mode: ContactMode) -> int:
        """Contact points of a mode."""
        return int((self.mechanics.modes == mode).sum())


MECHANISM = Object[Mechanism](on_demand=True)
"""values take as long as to verify a small model"""
FREEDOM, ENOUGH, WORK, GROUP = (
    Object[ForceFreedom](),
    Object[Enough](),
    Object[Mechanism](),
    Object[tuple[float, float]](),
)


@MECHANISM.key(name="class")
def failure_class(of: Mechanism) -> str:
    """In a word: sliding, twisting, overturning (parts turn on the stationary blocks), hinging (they hinge on each
    other), sliding and hinging, opening.
    """
    return mechanism_class(of.failure).value


@MECHANISM.key(name="open")
def opens(of: Mechanism) -> int:
    """Contact points that open."""
    return of.count(ContactMode.OPEN)


@MECHANISM.key()
def slide(of: Mechanism) -> int:
    """Contact points that slide."""
    return of.count(ContactMode.SLIDE)


@MECHANISM.key()
def crush(of: Mechanism) -> int:
    """Contact points that crush."""
    return of.count(ContactMode.CRUSH)


@MECHANISM.key()
def stick(of: Mechanism) -> int:
    """Contact points that do none of these."""
    return of.count(ContactMode.STICK)


@MECHANISM.key("interfaces that stick, slide, open, hinge, twist, crush")
def interfaces(of: Mechanism) -> dict[str, int]:
    """Interfaces by mode."""
    return {mode.name.lower(): of.collapse.interfaces.count(mode) for mode in InterfaceMode}


@MECHANISM.key()
def hinges(of: Mechanism) -> int:
    """Interfaces that hinge."""
    return of.collapse.interfaces.count(InterfaceMode.HINGE)


@MECHANISM.key()
def reach(of: Mechanism) -> str:
    """Local, partial or global."""
    return reach_of(of.share)


@MECHANISM.key()
def moving_blocks(of: Mechanism) -> int:
    """Free blocks that move."""
    return free_blocks_that_move(of.model, of.collapse.parts)


@MECHANISM.key()
def moving_weight_share(of: Mechanism) -> float:
    """Their share of the weight of the free blocks."""
    return of.share


@MECHANISM.key()
def moving_parts(of: Mechanism) -> int:
    """Rigid parts that move."""
    return len(of.collapse.motions)


@MECHANISM.key("one of them", inside=PART)
def parts(of: Mechanism) -> list[Part]:
    """The heaviest of them, at most 100."""
    return of.parts(of.collapse.motions)


@MECHANISM.key()
def clusters_merged(of: Mechanism) -> float:
    """Share of the motion, as volume-weighted square, neglected by merging rigid parts; 0: none merged."""
    return 1.0 - of.failure.explained


@MECHANISM.key("one of them", inside=PART)
def clusters(of: Mechanism) -> list[Part]:
    """Rigid parts as they are listed, those that move, at most 100."""
    return of.parts(of.failure.motions)


@MECHANISM.key("one of them", inside=HINGE_LINE)
def hinge_lines(of: Mechanism) -> list[HingeLine]:
    """Axes about which one cluster turns relative to another, that which moves most first."""
    return list(of.failure.hinge_lines[:MOST])


@MECHANISM.key("one of them", inside=SLIDING_PLANE)
def sliding_planes(of: Mechanism) -> list[SlidingPlane]:
    """Planes on which one cluster slides over another, that which dissipates most first."""
    return list(of.failure.sliding_planes[:MOST])


@MECHANISM.key("one of them", inside=CRACK)
def cracks(of: Mechanism) -> list[Crack]:
    """Open joints between two clusters, those that open most first."""
    return list(of.failure.cracks[:MOST])


@MECHANISM.key("one of them", inside=PART)
def main_parts(of: Mechanism) -> list[Part]:
    """The few rigid parts that approximate the mechanism: the clusters."""
    return of.parts(of.failure.motions)


@MECHANISM.key()
def main_parts_explain(of: Mechanism) -> float:
    """Share of the motion, as volume-weighted square, that they reproduce."""
    return of.failure.explained


@MECHANISM.key("one of them", inside=YIELD_LINE)
def yield_lines(of: Mechanism) -> list[YieldLine]:
    """Lines along which clusters break off, the longest first."""
    return list(of.failure.yield_lines[:MOST])


@MECHANISM.key(inside=FREEDOM)
def force_freedom(of: Mechanism) -> ForceFreedom | None:
    """How unique the forces are; null where that was not determined."""
    found = freedom_of(of.assembly.glued(of.load_case), of.mechanics, of.dimension)
    return None if isinstance(found, str) else found


@MECHANISM.key(inside=ENOUGH)
def enough(of: Mechanism) -> Enough:
    """The part of the structure relevant to this load factor."""
    return enough_of(of.model, of.contacts, of.collapse.parts)


@MECHANISM.key(inside=WORK)
def work(of: Mechanism) -> Mechanism:
    """Powers, with unit power of the live load."""
    return of


# --- Forces and powers ------------------------------------------------------------------------------------------------


@FREEDOM.key()
def ways(freedom: ForceFreedom) -> int:
    """Degree of static indeterminacy of the contact forces; 0: unique."""
    return freedom.degree


@FREEDOM.key()
def determined(freedom: ForceFreedom) -> int:
    """Interfaces whose resultant is unique."""
    return int(freedom.determined.sum())


@ENOUGH.key(name="moving_blocks")
def blocks_that_move(enough: Enough) -> int:
    """Blocks that move."""
    return len(enough.moving)


@ENOUGH.key(name="interfaces")
def interfaces_on_them(enough: Enough) -> int:
    """Interfaces on them."""
    return len(enough.interfaces)


@ENOUGH.key()
def bearing_blocks(enough: Enough) -> int:
    """Free blocks at rest that these touch."""
    return len(enough.bearing)


@ENOUGH.key()
def left_out_blocks(enough: Enough) -> int:
    """Free blocks at rest that touch nothing that moves."""
    return len(enough.left_out)


@WORK.key()
def live(of: Mechanism) -> float:
    """Load factor times the power of the live load."""
    return of.collapse.work.live


@WORK.key()
def dead(of: Mechanism) -> float:
    """Of the dead load, negative where weights are lifted."""
    return of.collapse.work.dead


@WORK.key()
def friction(of: Mechanism) -> float:
    """Dissipated by sliding under friction."""
    return float(of.collapse.work.friction.sum())


@WORK.key()
def cohesion(of: Mechanism) -> float:
    """Dissipated by sliding against cohesion."""
    return float(of.collapse.work.cohesion.sum())


@WORK.key()
def normal(of: Mechanism) -> float:
    """Dissipated by normal forces."""
    return float(of.collapse.work.normal.sum())


@WORK.key("in the interfaces of a joint law")
def joints(of: Mechanism) -> dict[str, float]:
    """Dissipated by joint law."""
    return {name: sum(powers) for name, powers in dissipated_by_joint(of.contacts, of.collapse.work).items()}


@WORK.key("of a group", name="groups", inside=GROUP)
def loads_of_groups(of: Mechanism) -> dict[str, tuple[float, float]]:
    """Of the loads by group."""
    return loads_by_group(of.model, of.load_case, of.mechanics)


@GROUP.key(name="live")
def live_of_group(powers: tuple[float, float]) -> float:
    """Of the live load on it."""
    return powers[0]


@GROUP.key(name="dead")
def dead_of_group(powers: tuple[float, float]) -> float:
    """Of the dead load on it."""
    return powers[1]
