"""Factors that bring numbers of one deck into the units of another."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.deck.units import KILOGRAMS, METRES, NEWTONS, Units


@dataclass(frozen=True)
class Factors:
    """What numbers in the units of B are multiplied with to be in those of A."""

    length: float
    force: float
    mass: float

    @property
    def stress(self) -> float:
        """Force per area."""
        return self.force / self.length**2


def factors_between(first: Units, second: Units) -> Factors:
    """From the units of ``second`` to those of ``first``."""
    return Factors(
        METRES[second.length] / METRES[first.length],
        NEWTONS[second.force] / NEWTONS[first.force],
        KILOGRAMS[second.mass] / KILOGRAMS[first.mass],
    )
