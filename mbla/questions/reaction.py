"""The reaction at which a structure follows a settling support.

reaction = reaction at rest − λ × unit, so that the kinematic bound of λ gives its lower bound, the static one the upper
(:mod:`mbla.model.settlement`).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import ClassVar, Self

from mbla.arrays import FloatArray, IntArray
from mbla.deck.units import Units
from mbla.questions.figures import significant
from mbla.questions.question import ZERO, Question, interval

NOTHING = 1e-9
"""share of its unit below which a reaction is written as zero: rounding of the load factor"""


@dataclass(frozen=True)
class Settlement:
    """Fixed blocks that give way together in one motion, and the reaction of their support against it.

    The dead load of the case holds the reaction ``reference`` against the motion, the live load takes ``unit`` from it:
    reaction = sense (reference − load factor × unit). What acts on these blocks themselves goes straight into their
    support and does not count.

    blocks    : (m,)
    motions   : (m, 6) velocity and angular velocity about the centroid of each block; a unit velocity along the
                direction of the settlement, less for supports that go less far than another, or a unit rotation
    turns     : the motion is a rotation, the reaction a moment
    words     : in words, for the listing
    reference : reaction of the structure at rest on the support that has not moved yet, nan where not known yet
    unit      : weight of the free blocks; times their mean distance from the axis where the support turns
    sense     : 1; -1 where the greatest value of an objective is sought, whose negative is as small as it can be
    """

    blocks: IntArray
    motions: FloatArray
    turns: bool
    words: str
    reference: float
    unit: float
    sense: float = 1.0

    def reaction(self, load_factor: float) -> float:
        """Of the support, in the deck's unit of force, or force times length where it turns."""
        return self.sense * (self.reference - load_factor * self.unit)


@dataclass(frozen=True)
class Reaction(Question):
    """The reaction of the support against its motion: a force, or a moment where it turns."""

    settlement: Settlement
    name: ClassVar[str] = "reaction"
    multiplies: ClassVar[bool] = False
    group: ClassVar[str] = "reaction"
    paths: ClassVar[tuple[str, str, str]] = ("reaction.value", "reaction.lower_bound", "reaction.upper_bound")
    title: ClassVar[str] = "reaction"
    applied: ClassVar[str] = "gives way"
    factors: ClassVar[str] = "reactions"
    control: ClassVar[str] = "support"
    powers: ClassVar[tuple[str, str]] = ("loss of reaction", "dead load and reaction at rest")
    no_target: ClassVar[str] = "its answer is a force, which is no target; choose another load case, or mbla sweep"
    no_safety: ClassVar[str] = "a support gives way"
    no_sensitivity = "of a settling support the load factor counts from a reference that changes as well"

    def on_bodies(self, body: IntArray, loads: Callable[[FloatArray], FloatArray], always: FloatArray | float) -> Self:
        """With bodies for its blocks, none of which is glued."""
        return replace(self, settlement=replace(self.settlement, blocks=body[self.settlement.blocks]))

    @property
    def kind(self) -> str:
        """A moment where the support turns."""
        return "moment" if self.settlement.turns else "force"

    @property
    def column(self) -> str:
        """One for forces, one for moments."""
        return f"reaction_{self.kind}"

    @property
    def giving_way(self) -> IntArray:
        """Those of the support."""
        return self.settlement.blocks

    @property
    def ways(self) -> FloatArray:
        """The motion of the settlement."""
        return self.settlement.motions

    @property
    def scale(self) -> float:
        """What λ = 1 takes from it."""
        return self.settlement.unit

    @property
    def unlimited(self) -> float:
        """Below all, where λ takes ever more from it; of the greatest force above all."""
        return -self.settlement.sense * math.inf

    def value(self, load_factor: float) -> float:
        """Of the support, against its motion."""
        return self.settlement.reaction(load_factor)

    def shown(self, value: float) -> float:
        """Zero where the rounding of the load factor made it."""
        return 0.0 if abs(value) <= NOTHING * self.scale else value

    def bounds(self, static: float, kinematic: float, mechanism: FloatArray | None) -> tuple[float, float]:
        """By the kinematic bound the lower, by the static one the upper."""
        return self.value(kinematic), self.value(static)

    def by_proof(self, bounds: tuple[float, float]) -> tuple[float, float]:
        """The upper one first, which the static bound gives."""
        low, high = bounds
        return self.shown(high), self.shown(low)

    def compared(self, load_factor: float) -> float:
        """The reaction, which is zero at a λ of any size."""
        return self.value(load_factor)

    def least_factor(self, ratio: float) -> float:
        """A share of its unit, in which λ counts."""
        return ZERO

    def told(self, value: float, units: Units) -> str:
        """``a reaction of 5232 N``, ``a force of 8753.85 N``."""
        return f"a {self.title} of {significant(value)} {self.unit(units)}"

    def moves(self, *, by_path: bool) -> str:
        """It stays on its support."""
        return "follows its support"

    @property
    def what(self) -> str:
        """Whose it is."""
        return "reaction of the support"

    @property
    def unbounded(self) -> str:
        """Of a support that the structure does not let go."""
        return "no least reaction: the structure holds the support back however hard that pulls away from it"

    @property
    def forces_drawn(self) -> str:
        """Those with which the structure follows."""
        return "contact forces under dead load as the support gives way"

    def limited(self, words: str) -> str:
        """A lower bound, as λ is the loss of reaction."""
        return f"its support gives way at no less than {words} (valid for every flow rule)"

    def entries(self, value: float, bounds: tuple[float, float], units: Units) -> tuple[tuple[str, str], ...]:
        """The reaction, its bounds, and what it falls from."""
        unit, settlement = self.unit(units), self.settlement
        pushed = "; negative: the support must be pushed the way it gives" if value < 0.0 else ""
        own = () if math.isnan(value) else ((self.what, f"{significant(value)} {unit}{pushed}"),)
        of = "the dead load of the free blocks" + " times its mean distance from the axis" * settlement.turns
        return (
            *own,
            ("associative, its bounds", f"{interval(bounds)} {unit}"),
            ("one at rest", f"{significant(settlement.reference)} {unit}   (many may be possible)"),
            ("load factor", f"loss of reaction over {significant(settlement.unit)} {unit}, {of}"),
        )
