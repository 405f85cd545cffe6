"""A tilting table: its loads, the unit circle that they go along, and the lines that bound those it can bear.

Loads fixed + a turning + b across make a plane (a, b); the table goes along the circle (cos t, sin t) from (1, 0). The
loads that can be borne are a convex set of the plane. A mechanism u with the load factor λ of the line from (1, 0) to
a point (a, b) says that p a + q b <= p + λ on that set, where p = turning · u, q = across · u and the live load, the
difference of the loads at both ends of the line, has the power 1 (limit theorems; Drucker, Prager and Greenberg 1952).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray

FULL_TURN = 2.0 * math.pi
AT_ONCE = 1e-8
"""angle within which the circle is left at its beginning; the arc cosine near 1 is no more accurate"""
CLOSE = 1e-9
"""share of the radius by which a side of the proof may cut into the circle: what STEEPEST takes off it, and rounding"""
STEEPEST = 1e6
"""multiple of the load across that stands for every multiple; a right angle to 1e-6"""


@dataclass(frozen=True)
class Tilt:
    """Loads on a tilting table, fixed + cos(angle) turning + sin(angle) across, all (n_blocks, 6).

    axis    : (3,) unit, about which the table turns by the right hand
    fixed   : dead loads that keep their direction in the structure, and what of gravity lies along the axis
    turning : gravity across the axis while the table is level
    across  : the same after a turn of 90 degrees
    angle   : of collapse in degrees; nan where it is not known, or where the load factor is its tangent
    tangent : the live load is ``across`` alone and the load factor the tangent of the angle, which is exact where only
              the direction of the load counts; else the live load leads from the level table to the angle, and the
              load factor is 1 there
    upright : proved multiple of ``across`` that the level table bears, nan where nothing is known
    """

    axis: FloatArray
    fixed: FloatArray
    turning: FloatArray
    across: FloatArray
    angle: float = np.nan
    tangent: bool = True
    upright: float = np.nan

    def loads_at(self, angle: float) -> FloatArray:
        """Loads after a turn by an angle in degrees, (n_blocks, 6)."""
        turn = np.deg2rad(angle)
        return np.asarray(self.fixed + np.cos(turn) * self.turning + np.sin(turn) * self.across)

    def with_loads(self, changed: Callable[[FloatArray], FloatArray]) -> Tilt:
        """The same table with other loads, from each of them."""
        return replace(self, fixed=changed(self.fixed), turning=changed(self.turning), across=changed(self.across))

    def borne_to(self, angle: float) -> bool:
        """Whether it is proved to bear every angle before one, in radians, that is on the limit of what it bears."""
        return self.upright >= math.tan(angle / 2.0)


@dataclass(frozen=True)
class Line:
    """p a + q b <= limit for all loads that can be borne."""

    p: float
    q: float
    limit: float

    def first_crossing(self) -> float:
        """Angle at which the circle leaves the half-plane, from 0 to 2π; inf where it never does."""
        size = math.hypot(self.p, self.q)
        if not size > self.limit:
            return math.inf
        angle = (math.atan2(self.q, self.p) - math.acos(max(-1.0, self.limit / size))) % FULL_TURN
        return 0.0 if FULL_TURN - angle < AT_ONCE else angle


def line_of(tilt: Tilt, mechanism: FloatArray, load_factor: float) -> Line:
    """The line of a mechanism, (n_blocks, 6); ``load_factor`` the one that it is good for."""
    p = float((tilt.turning * mechanism).sum())
    q = float((tilt.across * mechanism).sum())
    return Line(p, q, p + load_factor)


def chord(tilt: Tilt, angle: float) -> FloatArray:
    """Live load that leads from the level table to an angle in radians, (n_blocks, 6)."""
    # 1 - cos t without cancellation
    lowered = 2.0 * math.sin(angle / 2.0) ** 2
    return math.sin(angle) * tilt.across - lowered * tilt.turning


def never_left(upright: float, over: float) -> bool:
    """Whether every angle up to 180 degrees is proved to be borne.

    upright : multiple of the load across that the level table bears, inf for every multiple
    over    : share of the way from the level table to the one turned over, (-1, 0), that is borne

    The corners of the proof are (1, 0), (1, ``upright``) and (1 - 2 over, 0). The side between the last two must pass
    the half circle at no less than its radius.
    """
    if not (upright > 0.0 and over >= 1.0):
        return False
    top = min(upright, STEEPEST)
    return bool((2.0 * over - 1.0) * top >= (1.0 - CLOSE) * math.hypot(2.0 * over, top))


def angle_above(upright: float, share: float, angle: float) -> float:
    """Angle up to which the circle is proved to be borne, in radians; nan where nothing is.

    The corners of the proof are (1, 0), (1, ``upright``) and the point at ``share`` of the chord from (1, 0) to the
    circle at ``angle``: what lies between them is borne. The circle leaves them on the side between the last two.
    """
    top = min(upright, STEEPEST)
    if not (0.0 < angle < math.pi and top >= math.tan(angle / 2.0) and share > 0.0):
        return math.nan
    if share >= 1.0:
        return angle
    a, b = 1.0 - share * (1.0 - math.cos(angle)), share * math.sin(angle)
    # |(a, b) + s (1 - a, top - b)| = 1, the lesser s above 0
    run, rise = 1.0 - a, top - b
    square, half, rest = run**2 + rise**2, a * run + b * rise, a**2 + b**2 - 1.0
    s = (-half + math.sqrt(max(half**2 - square * rest, 0.0))) / square
    return math.atan2(b + s * rise, a + s * run)
