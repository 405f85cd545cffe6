"""How a structure vibrates about its state of rest: its first period."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from mbla.deck.units import Units
from mbla.questions.figures import significant
from mbla.questions.in_time import InTime

NO_FACTOR = "it vibrates, without a load factor"


@dataclass(frozen=True)
class FirstPeriod(InTime):
    """The longest period, which modes say and no load factor."""

    name: ClassVar[str] = "modes"
    group: ClassVar[str] = "modes"
    paths: ClassVar[tuple[str, str, str]] = ("modes.period", "modes.period", "modes.period")
    figure: ClassVar[str] = "first_period"
    title: ClassVar[str] = "first period"
    applied: ClassVar[str] = "vibrates"
    factors: ClassVar[str] = "first periods"
    powers: ClassVar[tuple[str, str]] = ("vibration", "dead load")
    no_target: ClassVar[str] = f"{NO_FACTOR}; choose another load case, or mbla sweep"
    no_safety: ClassVar[str] = NO_FACTOR
    kind = "s"

    def told(self, value: float, units: Units) -> str:
        """``a first period of 0.21 s``."""
        return f"a {self.title} of {significant(value)} s"

    def moves(self, *, by_path: bool) -> str:
        """About its state of rest."""
        return "vibrates"

    @property
    def unbounded(self) -> str:
        """Of a structure that no joint holds back."""
        return "no first period: a block moves without any force"

    @property
    def forces_drawn(self) -> str:
        """Those at rest."""
        return "contact forces at rest under dead load"
