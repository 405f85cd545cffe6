"""How far a time history has come."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class TimeProgress:
    """Of a step of the deck.

    time, duration : s
    step           : number of steps that were made, small ones as well
    factorisations, halved, missed : so far
    residual       : of the step
    balance        : energy that is not accounted for, over the greatest of the energies so far
    pressing       : contact points that press
    seconds        : since the history began
    half           : whether it is followed once more, with half of the step
    """

    time: float
    duration: float
    step: int
    factorisations: int
    residual: float
    balance: float
    pressing: int
    halved: int
    missed: int
    seconds: float
    half: bool = False

    @property
    def share(self) -> float:
        """Of the duration that is done."""
        return self.time / self.duration

    def to_go(self, first: TimeProgress) -> float:
        """Seconds that the rest takes at the speed since another step."""
        done = self.time - first.time
        return (self.duration - self.time) * (self.seconds - first.seconds) / done if done > 0.0 else math.nan
