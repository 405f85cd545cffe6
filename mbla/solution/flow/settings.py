"""Settings of the path of elastic joints, in one record.

What each is worth was measured on whole corpora (tests/performance); ``ratio`` and ``until`` alone are keys of decks.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from mbla.solution.flow.path_record import PathStep
from mbla.solution.settings import SolverSettings

RATIOS = (0.4, 1.0)
"""Shear over normal stiffness: a structure must stand with both ratios. The first is that of a layer of stone,
1/(2 (1 + ν)), and the default of paths."""

BESIDE = (0.2, 1.0)
"""Ratios of further paths with ``accuracy: reference``: their load factors show how far the figure depends on the
unknown stiffness of joints."""


def ratios_beside(ratio: float) -> tuple[float, ...]:
    """Two ratios of further paths, other than that of the first."""
    return tuple(sorted({*BESIDE, *((RATIOS[0],) if ratio in BESIDE else ())} - {ratio}))


def second_ratio(ratio: float) -> float:
    """The other of the two ratios with which structures must stand."""
    return next(other for other in reversed(RATIOS) if other != ratio)


@dataclass(frozen=True)
class PathSettings:
    """Displacements are in units of the elastic displacement of the whole structure at its associative load.

    ratio        : shear over normal stiffness of a joint
    until        : displacement at the end of the path
    first        : length of the first step
    growth       : factor on the length of a step after a step of full length
    longest      : greatest length of a step, over the displacement so far
    smoothing    : initial κ; the products of the law are n₀²/(κ h)
    most_smoothing : greatest κ
    smoothed     : greatest share of the live power for smoothing, and displacement from which it must be less
    dropped      : fall of the load, over its peak, at which the path ends
    counted      : greatest unbalanced force of a step that counts, in mean loads of a block
    short        : reach of a direction below which a step is blocked
    wandering    : successive unbalanced steps, after a balanced one, with which a path is stuck
    steps        : most steps
    again        : whether a lost path is followed once more, with less smoothing

    The end of a path:

    settled      : displacement below which no path is flat
    back         : load factor over the least since it last rose, and over the peak, from which a path recovers after a
                   dip, and is not flat
    passed       : displacement over that of the last rise, from which a blocked path in its second half has passed its
                   peak
    falling      : successive steps below the peak with which a path falls, displacement after them over that of the
                   first of them, and load factor over their least from which the path recovers

    The step of the peak:

    near         : distance from the peak, relative, of other steps that may replace a step of the peak that cannot be
                   solved, and how many of them are tried
    level        : distance below the peak, relative, of a later step that replaces it: at a constant load, joints no
                   longer creep in the later step, whose motion is that of the mechanism
    onwards      : length of the short step after the peak, and greatest change of the load factor with which that step
                   replaces the step of the peak

    Further paths of a part:

    rough        : change of the load factor as the step of the peak is solved, relative, beyond which the path is
                   followed with every step solved
    solved       : of such a path, growth from step to step and greatest length over the displacement
    spent        : of such a path, most factorisations, and factorisations after which a path that is not needed must
                   have passed the elastic displacement
    lost         : a path is lost if it is stuck above the first of these shares of the peak, or was blocked and lies
                   below the second
    same         : change of the load factor that counts as none
    measures     : load factors tried as a measure where associative flow has none

    The moving part:

    steps_of_part : most steps of a path of the moving part alone, which cost less
    rings        : rings of blocks around the moving blocks
    few_points   : contact points up to which the whole structure is followed
    worthwhile   : share of the contact points from which the whole structure is followed
    grown        : times that the moving part grows by blocks that do not carry its forces, before the whole structure
                   is followed

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

    @staticmethod
    def of(settings: SolverSettings) -> PathSettings:
        """As the deck asks: keys of its section ``path`` are fields of this record."""
        asked = PathSettings(**vars(settings.analysis.path), deadline=settings.deadline)
        return replace(asked, first=settings.steps * asked.first, longest=settings.steps * asked.longest)

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
