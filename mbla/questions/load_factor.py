"""By which multiple of the live load a structure collapses: λ itself."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from mbla.arrays import FloatArray
from mbla.deck.units import Units
from mbla.questions.figures import significant
from mbla.questions.question import Question


@dataclass(frozen=True)
class LoadFactor(Question):
    """The load factor, without a unit; its bounds are those that are proved."""

    name: ClassVar[str] = "load_factor"
    title: ClassVar[str] = "load factor"
    rounding_told: ClassVar[bool] = True

    def value(self, load_factor: float) -> float:
        """λ."""
        return load_factor

    def bounds(self, static: float, kinematic: float, mechanism: FloatArray | None) -> tuple[float, float]:
        """The static and the kinematic bound."""
        return static, kinematic

    def told(self, value: float, units: Units) -> str:
        """``0.643 times the live load``."""
        return f"{significant(value)} times the live load"


LOAD_FACTOR = LoadFactor()
"""what is asked where nothing else is"""
