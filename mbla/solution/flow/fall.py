"""Whether the load of a path has fallen for good, or only dips for some steps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.solution.flow.settings import PathSettings

ELASTIC = 1.0
"""Displacement within which no path falls."""


@dataclass(frozen=True)
class Fall:
    """Successive steps below the peak.

    settings : of the path
    since  : displacement of the first
    lowest : least load factor of them
    """

    settings: PathSettings
    steps: int = 0
    since: float = np.inf
    lowest: float = np.inf

    def after(self, below: bool, displacement: float, factor: float) -> Fall:
        """After one more step, at a displacement and load factor."""
        if not below or factor > self.settings.falling[2] * self.lowest:
            return Fall(self.settings)
        return Fall(self.settings, self.steps + 1, min(self.since, displacement), min(self.lowest, factor))

    def is_over(self, displacement: float) -> bool:
        """Whether the path has fallen, and ends."""
        steps, farther, _ = self.settings.falling
        return self.steps >= steps and displacement >= farther * self.since and displacement > ELASTIC
