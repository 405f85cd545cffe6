"""The angle at which a structure collapses on a tilting table.

λ is the tangent of the angle where only the direction of the loads counts. Else the live load leads from the level
table to the angle, and λ is 1 there: the angle is found by a sequence of analyses, and other λ stand for none.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from mbla.arrays import FloatArray, IntArray
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
    tilts: ClassVar[bool] = True
    title: ClassVar[str] = "angle"
    decided_by: ClassVar[tuple[str, ...]] = ("associative",)
    kind = "degree"
    unlimited = math.nan
    unbounded = "no angle of collapse: it bears gravity turned by every angle up to 180 degrees"
    no_target: ClassVar[str] = (
        "a tilting table has an angle for its answer, no load factor; mbla sweep gives that for values"
    )

    def on_bodies(self, body: IntArray, loads: Callable[[FloatArray], FloatArray], always: FloatArray | float) -> Self:
        """Its loads on them; what always acts does not turn."""
        there = self.tilt.with_loads(loads)
        return replace(self, tilt=replace(there, fixed=there.fixed + always))

    def value(self, load_factor: float) -> float:
        """The angle of which λ is the tangent, or to which the loads lead where λ is 1."""
        if self.by_steps and self.tilt.angle != 0.0 and not abs(load_factor - 1.0) <= AT_COLLAPSE:
            return math.nan
        return self.stated(load_factor)

    def stated(self, load_factor: float) -> float:
        """That to which the loads lead also where λ is 1 only approximately."""
        return math.degrees(math.atan(load_factor)) if self.tilt.tangent else self.tilt.angle

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

    def loads_at(self, dead: FloatArray, live: FloatArray, followed: float) -> tuple[FloatArray, ...]:
        """At an angle t: fixed + cos t turning, (sin t / t) across; they change by −sin t turning + cos t across."""
        tilt, cos, sin = self.tilt, np.cos(followed), np.sin(followed)
        live = np.sinc(followed / np.pi) * tilt.across
        return tilt.fixed + cos * tilt.turning, live, cos * tilt.across - sin * tilt.turning

    @property
    def by_steps(self) -> bool:
        """Where the load factor is not the tangent of the angle."""
        return not self.tilt.tangent

    @property
    def no_sensitivity(self) -> str:
        """An angle by steps."""
        return "the angle of the tilting table is not the arc tangent of the load factor" * self.by_steps

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
