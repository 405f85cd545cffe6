"""A flat surface with an end: rigid ground on the side where blocks lie on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.solids.plane import unit
from mbla.model.wording import vector


@dataclass(frozen=True)
class GroundSurface:
    """A flat surface of no thickness.

    outline : (n, 3) corners in order, either way round, in one plane
    name    : of the object of a file that it is of, empty where it has none
    """

    outline: FloatArray
    name: str = ""

    @property
    def label(self) -> str:
        """How messages call it: ``surface ground``, or by the middle of its corners."""
        return f"surface {self.name}" if self.name else f"surface at {vector(self.outline.mean(axis=0))}"

    @property
    def normal(self) -> FloatArray:
        """Unit, (3,), about which the corners run counter-clockwise."""
        arms = self.outline - self.outline.mean(axis=0)
        return unit(np.cross(arms, np.roll(arms, -1, axis=0)).sum(axis=0))
