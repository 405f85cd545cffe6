"""Key `time_history` of a load case: the structure in time, as its base moves or forces act on it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, TypeAlias

from pydantic import Field

from mbla.deck.quantities import Name, Point, PositiveLength, RealNumber, Switch, Time
from mbla.deck.section import ByShape, Section, given, rule
from mbla.deck.sections.motion import ForceHistorySection, MotionSection
from mbla.deck.sections.selectors import GROUND, Selector
from mbla.errors import Finding

MOST_STEPS = 10_000_000
"""of a time history: more than any computer follows"""
STEP = 0.002
"""s, unless the deck gives another: Housner's loss at an impact comes out within 1 % with it"""
OF_PULSE = 100
"""steps in a pulse, at least"""

Motions: TypeAlias = Annotated[
    MotionSection | Annotated[list[MotionSection], Field(min_length=1, max_length=100)], ByShape("mapping")
]
"""One motion of the base, or several that add up."""


class RecordedPointSection(Section):
    """A point whose motion is kept."""

    on: Selector = Field(description="the block that it moves with")
    at: Point | None = Field(None, description="the point as built; default: the centroid of the block")


class RecordedInterfaceSection(Section):
    """An interface whose opening, slip and forces are kept."""

    between: tuple[Selector, Selector] = Field(
        description="the two blocks; `ground` stands for ground planes and surfaces"
    )


class RecordSection(Section):
    """What is kept of a time history."""

    every: Time | None = Field(
        None, description="time between states that are kept, s; default: 0.01, or more: a 400th of the duration"
    )
    points: dict[Name, RecordedPointSection] = Field(
        default_factory=dict, description="points by name: displacement, velocity, acceleration at every step"
    )
    interfaces: dict[Name, RecordedInterfaceSection] = Field(
        default_factory=dict,
        description="interfaces by name: opening, slip, and the force on the second body at every step",
    )


class StopSection(Section):
    """What ends a time history before its duration."""

    displacement: PositiveLength | None = Field(None, description="of a block, relative to the base")
    collapse: Switch = Field(True, description="as soon as a block has fallen; off: to see how all comes down")
    rest: Switch = Field(False, description="after the motion: as soon as nothing moves any more")


class TimeHistorySection(Section):
    """The structure in time, from rest under its dead loads: its base moves, forces act on it."""

    motion: Motions | None = Field(
        None, description="motion of the base: one, or a list of several that add up, as of two directions"
    )
    forces: list[ForceHistorySection] = Field(default_factory=list, description="forces over time, besides dead loads")
    step: Time | None = Field(
        None,
        description=f"time step, s; default: {STEP:g}, or less: the step of a record, a hundredth of a pulse",
    )
    duration: Time | None = Field(None, description="s; default: to the end of the last motion or force")
    damping: Annotated[float, RealNumber("number", ge=0, lt=1)] = Field(
        0.0,
        description="of joints, as a share of critical damping at the first period; faster motions are damped by more",
    )
    contact_damping: Annotated[float, RealNumber("number", ge=0, lt=1)] = Field(
        0.3, description="of each contact point by itself, as a share of critical damping: takes out rattling of joints"
    )
    record: RecordSection = Field(default_factory=RecordSection, description="what is kept")
    stop: StopSection = Field(default_factory=StopSection, description="what ends it before its duration")
    rigid: list[Selector] = Field(
        default_factory=list,
        description="kinematic blocks: the blocks of each selector move as one, as if they were glued; from "
        "macro-blocks of an earlier result, or an engineer's eye",
    )
    check: Switch = Field(
        False, description="follow it once more with half of the step, and tell how much the peak depends on it"
    )


@rule(TimeHistorySection)
def something_moves(section: TimeHistorySection) -> Iterator[Finding]:
    """A motion, or a force."""
    if section.motion is None and not section.forces:
        yield Finding("missing-key", "needs motion or forces: nothing acts but the dead loads")
    if section.step is not None and section.duration is not None and section.step > section.duration:
        yield Finding("out-of-bounds", f"must be <= {section.duration:g}, the duration", "step")


@rule(RecordedInterfaceSection)
def not_ground_twice(section: RecordedInterfaceSection) -> Iterator[Finding]:
    """Ground has no interface with ground."""
    if section.between == (GROUND, GROUND):
        yield Finding("wrong-text", "ground and ground have no interface: name a block", "between", 1)


def motions_of(section: TimeHistorySection) -> list[MotionSection]:
    """The motions of its base."""
    if section.motion is None:
        return []
    return section.motion if isinstance(section.motion, list) else [section.motion]


IN_TIME = ("time_history", "modes")
"""keys of a load case whose structure vibrates or moves in time, without a load factor"""
BESIDE = {
    "live": "has no load factor: give loads that act at all times as dead, others as forces of a time_history",
    "settlement": "has supports that move with the base: make another load case of it",
    "objective": "has no forces to choose from: make another load case of it",
    "at": "has no load factor: leave it out",
    "pushover": "has no load factor to follow: make another load case of it",
    "assessment": "has no load factor to be held against a code: make another load case of it",
}
"""what does not stand beside them, and why and what to do"""


def alone_in_time(case: Any) -> Iterator[Finding]:
    """A load case in time asks nothing else."""
    asked = next(iter(given_in_time(case)))
    for key in given(case, tuple(BESIDE)):
        yield Finding("time-history-not-possible", f"cannot stand beside {asked}, which {BESIDE[key]}", key)


def given_in_time(case: Any) -> list[str]:
    """Those of the keys that ask a load case its question: modes may stand beside another one."""
    others = any(getattr(case, key) for key in ("live", "settlement", "objective", "time_history"))
    return [key for key in IN_TIME if getattr(case, key) and not (key == "modes" and others)]
