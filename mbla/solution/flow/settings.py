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
