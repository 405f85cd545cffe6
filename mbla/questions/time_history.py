"""How far a structure moves in time: the greatest displacement of a block relative to the base."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from mbla.deck.units import Units
from mbla.questions.figures import significant
from mbla.questions.in_time import InTime

NO_FACTOR = "it moves in time, without a load factor"


@dataclass(frozen=True)
class PeakDisplacement(InTime):
    """The peak displacement, which the time history says and no load factor."""

    name: ClassVar[str] = "time_history"
    group: ClassVar[str] = "time_history"
    paths: ClassVar[tuple[str, str, str]] = ("time_history.peak", "time_history.lower", "time_history.upper")
    figure: ClassVar[str] = "peak_displacement"
    title: ClassVar[str] = "peak displacement"
    applied: ClassVar[str] = "moves in time"
    factors: ClassVar[str] = "peak displacements"
    powers: ClassVar[tuple[str, str]] = ("motion of the base and forces over time", "dead load")
    no_target: ClassVar[str] = f"{NO_FACTOR}; look for the target falls or peak, or choose another load case"
    no_safety: ClassVar[str] = NO_FACTOR
    kind = "length"

    def unit(self, units: Units) -> str:
        """Of length."""
        return units.length

    def told(self, value: float, units: Units) -> str:
        """``a peak displacement of 0.034 m``."""
        return f"a {self.title} of {significant(value)} {units.length}"

    def moves(self, *, by_path: bool) -> str:
        """As its base moves it."""
        return "moves"

    @property
    def unbounded(self) -> str:
        """Of a structure that falls."""
        return "no peak: it falls"

    @property
    def forces_drawn(self) -> str:
        """Those of a state."""
        return "contact forces of the state shown"
