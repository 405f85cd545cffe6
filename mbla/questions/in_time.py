"""What a structure at rest does in time: how it vibrates, or moves.

Nothing is multiplied: there is no load factor λ, and nothing bounds the figure.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from mbla.arrays import FloatArray
from mbla.questions.question import Question


@dataclass(frozen=True)
class InTime(Question):
    """A figure that says itself what no load factor stands for.

    figure : its column in tables of load cases: the group of results has more than the figure
    """

    figure: ClassVar[str]
    multiplies: ClassVar[bool] = False
    collapses: ClassVar[bool] = False
    control: ClassVar[str] = "point"
    no_equilibrium: ClassVar[str] = "no equilibrium: the structure does not stand under its dead load"

    @property
    def column(self) -> str:
        """Of its own."""
        return self.figure

    def value(self, load_factor: float) -> float:
        """None."""
        return math.nan

    def bounds(self, static: float, kinematic: float, mechanism: FloatArray | None) -> tuple[float, float]:
        """None."""
        return math.nan, math.nan

    @property
    def no_sensitivity(self) -> str:
        """There is no load factor, as for a geometric factor of safety."""
        return self.no_safety
