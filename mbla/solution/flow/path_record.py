"""What a path of elastic joints leaves behind: its curve, its greatest load factor, and why it ended."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from mbla.solution.flow.peak_step import PeakStep

RISES = 5e-3
"""Share of the load factor gained over the last half of a path, from which it still rises where it ends."""
UNENDED = 0.05
"""Such a share from which the end of the path decides the load factor."""


class Stop(StrEnum):
    """Why a path ended, or there is none: the first four are answers."""

    AT_ONCE = "moves at once"
    FALLS = "falls"
    FLAT = "flat"
    FAR = "far"
    STUCK = "stuck"
    BROKE_DOWN = "breaks down"
    BUDGET = "budget"
    LATE = "time limit"
    UNBOUNDED = "unbounded"
    UNLOADED = "no live load"
    DOES_NOT_STAND = "does not stand"
    UNDECIDED = "standing undecided"

    @property
    def answers(self) -> bool:
        """Whether the greatest load factor was seen."""
        return self in (Stop.AT_ONCE, Stop.FALLS, Stop.FLAT, Stop.FAR)


@dataclass(frozen=True)
class PathStep:
    """One step of the path, as the curve has it.

    displacement : after it, in units
    load_factor  : of the program
    counted      : whether the state is in balance well enough
    reach        : of its direction
    open, slide  : contact points that are open, and those at their friction
    """

    displacement: float
    load_factor: float
    counted: bool
    reach: float
    open: int = 0
    slide: int = 0


@dataclass(frozen=True)
class ElasticPath:
    """A path that was followed.

    peak         : step of the greatest load factor, solved as far as its misfit says; None where no step
                   counts
    half         : the same up to half of the displacement; None where the path ends before
    stop         : why it ended
    steps        : the curve
    unit         : of displacement, for a live work of 1 in units of the program
    factorizations : spent
    recentred    : times that it was blocked
    broken       : ties that broke: displacement and point of each
    """

    peak: PeakStep | None
    half: PeakStep | None
    stop: Stop
    steps: tuple[PathStep, ...]
    unit: float
    factorizations: int
    recentred: int
    broken: tuple[tuple[float, int], ...] = ()

    @property
    def load_factor(self) -> float:
        """The greatest, of the program; nan where no step counts."""
        return float("nan") if self.peak is None else self.peak.state.factor

    @property
    def displacement(self) -> float:
        """At the end, in units."""
        return self.steps[-1].displacement if self.steps else 0.0

    @property
    def gain(self) -> float:
        """Share of the greatest load factor that was gained over the last half of the path; 0 where it ends before."""
        if self.peak is None or self.half is None or self.load_factor == 0.0:
            return 0.0
        return 1.0 - self.half.state.factor / self.load_factor

    @property
    def moving(self) -> float:
        """Load factor while it moves: that of the last step that counts; nan where none does."""
        return next((step.load_factor for step in reversed(self.steps) if step.counted), float("nan"))
