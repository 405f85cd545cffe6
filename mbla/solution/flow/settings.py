"""Settings of the path of elastic joints, in one record.

What each is worth was measured on whole corpora (tests/performance); ``ratio`` and ``until`` alone are keys of decks.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from mbla.solution.flow.path_record import PathStep

RATIOS = (0.4, 1.0)
"""Of shear to normal stiffness, with both of which a structure must stand; the first is that of a layer of stone,
1/(2 (1 + ν)), and of paths unless the deck says otherwise."""

BESIDE = (0.2, 1.0)
"""Such ratios that ``accuracy: reference`` follows besides: the load factors that they give say how far the figure
hangs on what nobody knows of joints. On 40 structures they lie within 2 per cent of each other."""


def ratios_beside(ratio: float) -> tuple[float, ...]:
    """Two ratios to follow beside one."""
    return tuple(sorted({*BESIDE, *((RATIOS[0],) if ratio in BESIDE else ())} - {ratio}))


def second_ratio(ratio: float) -> float:
    """The one of both with which structures must stand that differs from a ratio."""
    return next(other for other in reversed(RATIOS) if other != ratio)


@dataclass(frozen=True)
class PathSettings:
    """Displacements are over the unit: the elastic displacement of the whole structure at the associative load.

    ratio        : shear over normal stiffness of a joint
    until        : displacement at which the path ends
    first        : length of the first step
    growth       : factor on the length of a step after one that was gone whole
    longest      : length of a step over the displacement so far, at most
    smoothing    : κ at first; the products of the law are n₀²/(κ h)
    most_smoothing : κ at most
    smoothed     : share of the live power that smoothing may take, and displacement from which less of it
    dropped      : share of the peak by which the load falls where a path ends as a fall
    counted      : unbalanced force, in mean loads of a block, up to which a step counts
    short        : reach of a direction below which a step is blocked
    wandering    : steps in a row out of balance, once it was reached, after which a path is stuck
    steps        : at most
    again        : whether a path that is lost is followed once more, with less smoothing

    Where it has ended:

    settled      : displacement within which no path is flat
    back         : load factor over the least since it last rose, and over the peak, from which a path is on its way
                   back after a dip, and not flat
    passed       : displacement over that at which the load last rose, from which a blocked path has its peak behind it,
                   in its second half
    falling      : steps in a row below the peak with which a path falls, displacement after them over that of the
                   first, and load factor over the least of them from which it is on its way back

    The step of its peak:

    near         : share of the peak within which another step stands for it where its own cannot be solved, and how
                   many are tried
    level        : share of the peak by which a later step may lie below it and take its place: where the load stays
                   joints that hold no longer creep, and the motion is that of the fall
    onwards      : length of the short step after it, in units, and share of the load factor within which that stands
                   for it

    Other paths of it:

    rough        : share by which the load factor of a peak may change as its step is solved; beyond, every step is
    solved       : growth from step to step of a path with every step solved, and length over the displacement, at most
    spent        : factorisations of such a path at most, and those after which one that is not needed must be beyond
                   the elastic displacement
    lost         : shares of the peak: a path that is stuck above the one, or was brought back and lies below the other,
                   is lost
    same         : change of the load factor that counts as none
    measures     : load factors tried as a measure where associative flow has none

    What moves alone:

    steps_of_part : at most, each of which costs less
    rings        : of blocks around those that move
    few_points   : contact points up to which no part is worth a program of its own
    worthwhile   : share of them from which it is not
    grown        : times that what is followed takes in what does not carry what is passed on to it, before it is the
                   whole

    deadline     : time.monotonic() at which a path ends, or None
    watch        : called after every step
    """

    ratio: float = RATIOS[0]
    until: float = 50.0
    first: float = 0.2
    growth: float = 2.0
    longest: float = 0.25
    smoothing: float = 10.0
    most_smoothing: float = 50.0
    smoothed: tuple[float, float] = (0.05, 4.0)
    dropped: float = 0.015
    counted: float = 1e-5
    short: float = 0.03
    wandering: int = 60
    steps: int = 600
    again: bool = True
    settled: float = 16.0
    back: tuple[float, float] = (1.0005, 0.998)
    passed: float = 1.1
    falling: tuple[int, float, float] = (3, 1.02, 1.001)
    near: tuple[float, int] = (1e-3, 8)
    level: float = 1e-5
    onwards: tuple[float, float] = (0.05, 1e-3)
    rough: float = 0.02
    solved: tuple[float, float] = (1.3, 0.15)
    spent: tuple[int, int] = (2400, 500)
    lost: tuple[float, float] = (0.985, 0.9)
    same: float = 0.01
    measures: int = 6
    steps_of_part: int = 2000
    rings: int = 3
    few_points: int = 1500
    worthwhile: float = 0.8
    grown: int = 2
    deadline: float | None = None
    watch: Callable[[PathStep], None] | None = field(default=None, compare=False)

    @property
    def late(self) -> bool:
        """Whether the time limit has passed."""
        return self.deadline is not None and time.monotonic() > self.deadline

    def by_steps(self, share: float) -> PathSettings:
        """The same with steps of a share of their length."""
        return replace(self, first=share * self.first, longest=share * self.longest)

    def seen(self, step: PathStep) -> PathStep:
        """The step, once those who watch have seen it."""
        if self.watch is not None:
            self.watch(step)
        return step

    def validate(self) -> None:
        """Raise a ValueError where a path could not be followed with them."""
        if not 0.05 <= self.ratio <= 2.0:
            raise ValueError(f"ratio of stiffness {self.ratio} is not within 0.05 and 2")
        if not 5.0 <= self.until <= 1000.0:
            raise ValueError(f"end of the path {self.until} is not within 5 and 1000")
        if not 0.0 < self.first < self.until or not self.growth > 1.0 or not self.steps > 0:
            raise ValueError("steps of the path do not lead to its end")
        if not self.smoothing > 0.0 or not self.most_smoothing > 0.0:
            raise ValueError("without smoothing there is no path")
        if not self.back[0] >= 1.0 >= self.back[1] or not self.passed >= 1.0 or not self.settled > 0.0:
            raise ValueError("a path must be able to end flat, and not on its way back")
        if not self.falling[0] > 0 or not min(self.falling[1:]) >= 1.0:
            raise ValueError("a path must be able to fall")
        if not 0.0 <= self.level < self.near[0] < 1.0 or self.near[1] < 0 or not self.onwards[0] > 0.0:
            raise ValueError("steps near the peak must lie near it")
        if not self.solved[0] > 1.0 or not self.solved[1] > 0.0 or not self.spent[0] >= self.spent[1] > 0:
            raise ValueError("solved steps of the path do not lead to its end")
        if self.measures < 1 or min(self.rings, self.few_points, self.grown) < 0 or not 0.0 < self.worthwhile <= 1.0:
            raise ValueError("numbers of measures, rings, points and times must be counts, and a share within 1")
