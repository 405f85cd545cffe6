"""The angle at which a structure collapses on a tilting table.

λ is the tangent of the angle where only the direction of the loads counts. Else the live load leads from the level
table to the angle, and λ is 1 there: the angle is found by a sequence of analyses, and other λ stand for none.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from mbla.arrays import FloatArray
from mbla.deck.units import Units
from mbla.questions.figures import significant
from mbla.questions.question import Question, interval
from mbla.questions.tilt import Tilt, angle_above, line_of

AT_COLLAPSE = 1e-6
"""distance of a load factor from 1 within which it belongs to the angle of the table"""


@dataclass(frozen=True)
class Angle(Question):
    """The angle of collapse in degrees."""

    tilt: Tilt
    name: ClassVar[str] = "angle"
    group: ClassVar[str] = "angle"
    paths: ClassVar[tuple[str, str, str]] = ("angle", "angle_bounds.0", "angle_bounds.1")
    entries_first: ClassVar[bool] = False
    title: ClassVar[str] = "angle"
    decided_by: ClassVar[tuple[str, ...]] = ("associative",)
    no_target: ClassVar[str] = (
        "a tilting table has an angle for its answer, no load factor; mbla sweep gives that for values"
    )

    @property
    def kind(self) -> str:
        """Degrees, in every system of units."""
        return "degree"

    @property
    def unlimited(self) -> float:
        """None."""
        return math.nan

    def value(self, load_factor: float) -> float:
        """The angle of which λ is the tangent, or to which the loads lead where λ is 1."""
        if not self.tilt.tangent and self.tilt.angle != 0.0 and not abs(load_factor - 1.0) <= AT_COLLAPSE:
            return math.nan
        return self.stated(load_factor)

    def stated(self, load_factor: float) -> float:
        """That to which the loads lead also where λ is 1 only approximately."""
        return math.degrees(math.atan(load_factor)) if self.tilt.tangent else self.tilt.angle

    @property
    def unbounded(self) -> str:
        """Of a table turned over."""
        return "no angle of collapse: it bears gravity turned by every angle up to 180 degrees"

    def bounds(self, static: float, kinematic: float, mechanism: FloatArray | None) -> tuple[float, float]:
        """Angle that is certainly borne and angle that is certainly not, in degrees."""
        tilt = self.tilt
        if mechanism is None:
            return math.nan, math.nan
        if tilt.tangent:
            return math.degrees(math.atan(static)), math.degrees(math.atan(kinematic))
        if math.isnan(tilt.angle) or math.isnan(kinematic):
            return math.nan, math.nan
        highest = line_of(tilt, mechanism, kinematic).first_crossing()
        lowest = angle_above(tilt.upright, static, math.radians(tilt.angle))
        return math.degrees(lowest), math.degrees(highest) if math.isfinite(highest) else math.nan

    def pushed(self, live_load: FloatArray) -> FloatArray:
        """Gravity across the level table, whatever line of loads led to the angle."""
        return self.tilt.across

    def followed(self, load_factor: float) -> float:
        """The angle in radians."""
        return math.atan(load_factor) if self.tilt.tangent else math.radians(self.tilt.angle)

    def value_at(self, followed: float) -> float:
        """In degrees."""
        return math.degrees(followed)

    @property
    def no_sensitivity(self) -> str:
        """An angle by steps."""
        return "" if self.tilt.tangent else "the angle of the tilting table is not the arc tangent of the load factor"

    def least(self, ratio: float) -> float:
        """None: angles are compared as they are."""
        return 0.0

    def told(self, value: float, units: Units) -> str:
        """``31.2 degrees of tilt``."""
        return f"{significant(value)} degrees of tilt"

    def factor_words(self, load_factor: float, units: Units) -> str:
        """A λ that stands for no angle as a share of the way to it."""
        angle = self.value(load_factor)
        if math.isnan(angle):
            return f"{significant(load_factor)} times the change of the loads by the tilt"
        return self.told(angle, units)

    def entries(self, value: float, bounds: tuple[float, float], units: Units) -> tuple[tuple[str, str], ...]:
        """The angle, and those between which it is proved to lie."""
        return (
            ("angle", f"{significant(value, 8)} degrees"),
            ("angle, associative bounds", f"{interval(bounds)} degrees"),
        )
