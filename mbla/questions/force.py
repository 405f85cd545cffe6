"""The least or the greatest value of a force through a structure, as the reaction of a load cell in a cut.

The forces of the static bound reach it, a mechanism in which the cut opens shows that none go beyond
(:mod:`mbla.model.objective`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.units import Units
from mbla.questions.figures import significant
from mbla.questions.question import interval
from mbla.questions.reaction import Reaction


@dataclass(frozen=True)
class Objective:
    """A force whose least or greatest value is sought: through a cut, or of ties. Its ``Settlement`` has no blocks.

    series    : name of the load case in the deck, which became one for each end
    end       : least or greatest
    at        : load factor of the live loads of the deck, which are among the dead loads here
    sides     : (n_bodies,) 1: the force acts on this body, -1: it comes from it, 0: neither
    ties      : (k,) whose forces are added up; none: the force through the joints between the sides
    direction : (3,) unit, along which the force counts; of ties any in which one pulls, as tension counts
    """

    series: str
    end: str
    at: float
    sides: IntArray
    ties: IntArray
    direction: FloatArray

    def crossed(self, bodies: IntArray) -> IntArray:
        """Of interfaces between bodies a and b, (n, 2): 1 where their force on b counts, -1 for that on a, else 0."""
        first, second = self.sides[bodies].T
        return np.asarray(np.where(first * second < 0, second, 0))


@dataclass(frozen=True)
class Force(Reaction):
    """The force along its direction: the reaction of the load cell that measures it."""

    objective: Objective
    name: ClassVar[str] = "force"
    title: ClassVar[str] = "force"
    collapses: ClassVar[bool] = False
    unbounded_answers: ClassVar[bool] = True
    applied: ClassVar[str] = "sought"
    powers: ClassVar[tuple[str, str]] = ("force through the cut", "dead load")
    no_equilibrium: ClassVar[str] = "no equilibrium: the structure does not carry these loads"

    @property
    def series(self) -> str:
        """Load case that asks for both ends."""
        return self.objective.series

    @property
    def measured(self) -> tuple[bytes | float, ...]:
        """The cut or the ties, and the direction."""
        arrays = self.objective.sides, self.objective.ties, self.objective.direction
        return self.settlement.sense, self.scale, *(array.tobytes() for array in arrays)

    @property
    def what(self) -> str:
        """Which end it is."""
        return f"{self.objective.end} force"

    def bounds(self, static: float, kinematic: float, mechanism: FloatArray | None) -> tuple[float, float]:
        """By forces that balance the loads and by a mechanism; of the greatest force the other way round."""
        low, high = super().bounds(static, kinematic, mechanism)
        return (low, high) if self.settlement.sense > 0 else (high, low)

    def by_proof(self, bounds: tuple[float, float]) -> tuple[float, float]:
        """The lower one first, of both ends."""
        return bounds

    @property
    def unbounded(self) -> str:
        """Of a structure that locks."""
        return f"no {self.what}: joints lock, and forces of any size fit the loads"

    def limited(self, words: str) -> str:
        """By a mechanism in which the cut opens."""
        beyond = "no less" if self.settlement.sense > 0 else "no more"
        return f"{beyond} than {words} (a mechanism proves it, whatever the forces)"

    @property
    def forces_drawn(self) -> str:
        """Those that reach the end."""
        return f"contact forces of the {self.what}"

    def entries(self, value: float, bounds: tuple[float, float], units: Units) -> tuple[tuple[str, str], ...]:
        """The end, its bounds, and what its load factor counts."""
        unit, settlement = self.unit(units), self.settlement
        away = "below" if settlement.sense > 0 else "above"
        start, size = (significant(x) for x in (settlement.sense * settlement.reference, settlement.unit))
        return (
            (self.what, f"{significant(value)} {unit}"),
            ("its bounds", f"{interval(bounds)} {unit}"),
            ("load factor", f"distance of the force {away} {start} {unit} over {size} {unit}, the loads"),
        )
