"""When the load of a path has fallen, and not only lies low for some steps on its way to another state."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

ELASTIC = 1.0
"""Displacement within which no path falls."""

STEPS, FARTHER, RISES = 3, 1.02, 1.001
"""Steps in a row below the peak, displacement after them over that of the first, and load factor over the least of them
from which it is on its way back."""


@dataclass(frozen=True)
class Fall:
    """Steps in a row below the peak.

    since  : displacement of the first
    lowest : least load factor of them
    """

    steps: int = 0
    since: float = np.inf
    lowest: float = np.inf

    def after(self, below: bool, displacement: float, factor: float) -> Fall:
        """After one more step, at a displacement and load factor."""
        if not below or factor > RISES * self.lowest:
            return Fall()
        return Fall(self.steps + 1, min(self.since, displacement), min(self.lowest, factor))

    def is_over(self, displacement: float) -> bool:
        """Whether the path has fallen, and ends."""
        return self.steps >= STEPS and displacement >= FARTHER * self.since and displacement > ELASTIC
