"""A mechanism as an object of the JSON record: modes, rigid parts, lines between them, where the power goes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from mbla.results.collapse.collapse import Collapse, Failure, mechanism_class
from mbla.results.collapse.force_freedom import Enough, ForceFreedom, enough_of
from mbla.results.collapse.force_freedom import force_freedom as freedom_of
from mbla.results.collapse.interface_modes import InterfaceMode, InterfaceMotion
from mbla.results.collapse.mechanics import Work, dissipated_by_joint, loads_by_group
from mbla.results.collapse.rigid_parts import moving_cells as cells_that_move
from mbla.results.collapse.rigid_parts import moving_share
from mbla.results.collapse.rigid_parts import reach as reach_of
from mbla.results.outcome import dimension_of
from mbla.results.quantities.group import Field, count, total
from mbla.results.quantities.registry import COLUMN
from mbla.results.record.mechanism_lines import CRACK, HINGE_LINE, PART, SLIDING_PLANE, SLIP_LINE, YIELD_LINE, Part
from mbla.results.record.objects import Object
from mbla.results.record.scene import Scene
from mbla.solution.solution import ContactMode, Mechanics

MOST = 100
"""objects of each kind that the record holds, those that move most"""
MECHANISM = Object[Scene](owner=lambda scene: None if scene.result is None else scene, on_demand=True)
"""values take as long as to verify a small model"""
_MECHANICS, _FAILURE = MECHANISM.of(lambda scene: scene.result), MECHANISM.of(lambda scene: scene.failure)
_INTERFACES, _COLLAPSE = MECHANISM.of(lambda scene: scene.interfaces), MECHANISM.of(lambda scene: scene.collapse)
FREEDOM, ENOUGH, GROUP = Object[ForceFreedom](), Object[Enough](), Object[tuple[float, float]]()
WORK = Object[Scene]()
_WORK = WORK.of(lambda scene: scene.collapse.work)


@_FAILURE.key(name="class")
def failure_class(failure: Failure) -> str:
    """In a word: sliding, twisting, overturning (parts turn on the stationary blocks), hinging (they hinge on each
    other), sliding and hinging, opening.
    """
    return mechanism_class(failure).value


def _declare_points(mode: ContactMode, words: str) -> None:
    @_MECHANICS.key(name=mode.name.lower(), words=words)
    def points(mechanics: Mechanics) -> int:
        """Contact points of a mode."""
        return int((mechanics.modes == mode).sum())


_declare_points(ContactMode.OPEN, "contact points that open")
_declare_points(ContactMode.SLIDE, "contact points that slide")
_declare_points(ContactMode.CRUSH, "contact points that crush")
_declare_points(ContactMode.STICK, "contact points that do none of these")


@_INTERFACES.key("interfaces that stick, slide, open, hinge, twist, crush; none of cells of soil", name="interfaces")
def interfaces_by_mode(motion: InterfaceMotion) -> dict[str, int]:
    """Interfaces by mode."""
    return {mode.name.lower(): motion.count(mode) for mode in InterfaceMode}


@_INTERFACES.key()
def hinges(motion: InterfaceMotion) -> int:
    """Interfaces that hinge."""
    return motion.count(InterfaceMode.HINGE)


@MECHANISM.key()
def reach(scene: Scene) -> str:
    """Local, partial or global."""
    return reach_of(moving_share(scene.model, scene.parts))


MECHANISM.quantities += [
    COLUMN["moving_blocks"],
    replace(COLUMN["moving_weight_share"], words="their share of the weight of the free blocks"),
    COLUMN["moving_parts"],
]


@MECHANISM.key()
def moving_cells(scene: Scene) -> int:
    """Cells of soil that move."""
    return cells_that_move(scene.model, scene.parts)


def most(items: Sequence[Any]) -> list[Any]:
    """The first of them."""
    return list(items[:MOST])


def _parts(scene: Scene, found: Collapse | Failure | None) -> list[Part]:
    return [] if found is None else [Part(scene.model, motion) for motion in most(found.motions)]


@MECHANISM.key("one of them", inside=PART)
def parts(scene: Scene) -> list[Part]:
    """The heaviest of them, at most 100."""
    return _parts(scene, scene.collapse)


@_FAILURE.key()
def clusters_merged(failure: Failure) -> float:
    """Share of the motion, as volume-weighted square, neglected by merging rigid parts; 0: none merged."""
    return 1.0 - failure.explained


@MECHANISM.key("one of them", inside=PART)
def clusters(scene: Scene) -> list[Part]:
    """Rigid parts as they are listed, those that move, at most 100."""
    return _parts(scene, scene.failure)


ONE = ("one of them",)
_FAILURE.fields(
    Failure,
    hinge_lines=Field(
        "axes about which one cluster turns relative to another, that which moves most first",
        items=ONE,
        inside=HINGE_LINE,
        by=most,
    ),
    sliding_planes=Field(
        "planes on which one cluster slides over another, that which dissipates most first",
        items=ONE,
        inside=SLIDING_PLANE,
        by=most,
    ),
    cracks=Field("open joints between two clusters, those that open most first", items=ONE, inside=CRACK, by=most),
)
MECHANISM.key(
    *ONE, inside=PART, name="main_parts", words="the few rigid parts that approximate the mechanism: the clusters"
)(clusters)
_FAILURE.fields(
    Failure,
    main_parts_explain=Field(
        "share of the motion, as volume-weighted square, that they reproduce", attribute="explained"
    ),
    yield_lines=Field("lines along which clusters break off, the longest first", items=ONE, inside=YIELD_LINE, by=most),
    slip_lines=Field(
        "joints of cells of soil between two clusters, those that move most first", items=ONE, inside=SLIP_LINE, by=most
    ),
)


@MECHANISM.key(inside=FREEDOM)
def force_freedom(scene: Scene) -> ForceFreedom | None:
    """How unique the forces are; null where that was not determined."""
    mechanics = scene.result
    found = "" if mechanics is None else freedom_of(scene.bodies, mechanics, dimension_of((scene.solved,)))
    return None if isinstance(found, str) else found


@MECHANISM.key(inside=ENOUGH)
def enough(scene: Scene) -> Enough:
    """The part of the structure relevant to this load factor."""
    return enough_of(scene.model, scene.contacts, scene.parts)


MECHANISM.holds("work", WORK, "powers, with unit power of the live load")


# --- Forces and powers ------------------------------------------------------------------------------------------------


FREEDOM.fields(
    ForceFreedom, ways=Field("degree of static indeterminacy of the contact forces; 0: unique", attribute="degree")
)


@FREEDOM.key()
def determined(freedom: ForceFreedom) -> int:
    """Interfaces whose resultant is unique."""
    return int(freedom.determined.sum())


ENOUGH.fields(
    Enough,
    moving_blocks=Field("blocks that move", attribute="moving", by=count),
    interfaces=Field("interfaces on them", by=count),
    bearing_blocks=Field("free blocks at rest that these touch", attribute="bearing", by=count),
    left_out_blocks=Field("free blocks at rest that touch nothing that moves", attribute="left_out", by=count),
)
_WORK.fields(
    Work,
    live=Field("load factor times the power of the live load"),
    dead=Field("of the dead load, negative where weights are lifted"),
    friction=Field("dissipated by sliding under friction", by=total),
    cohesion=Field("dissipated by sliding against cohesion", by=total),
    normal=Field("dissipated by normal forces", by=total),
)


@WORK.key("in the interfaces of a joint law")
def joints(scene: Scene) -> dict[str, float]:
    """Dissipated by joint law."""
    found = {} if scene.collapse is None else dissipated_by_joint(scene.contacts, scene.collapse.work)
    return {name: sum(powers) for name, powers in found.items()}


@WORK.key("of a group", name="groups", inside=GROUP)
def loads_of_groups(scene: Scene) -> dict[str, tuple[float, float]]:
    """Of the loads by group."""
    found = scene.result
    return {} if found is None else loads_by_group(scene.model, scene.solved.load_case, found)


@GROUP.key(name="live")
def live_of_group(powers: tuple[float, float]) -> float:
    """Of the live load on it."""
    return powers[0]


@GROUP.key(name="dead")
def dead_of_group(powers: tuple[float, float]) -> float:
    """Of the dead load on it."""
    return powers[1]
