"""Angles of a diagram and their unit vectors, exact where symmetry makes them so."""

from __future__ import annotations

import math

FULL = 360.0
CLOSED = 1e-9
"""degrees by which two angles may miss a full circle and close it"""


def unit_vector(degrees: float) -> tuple[float, float]:
    """Cosine and sine; those of multiples of 90 degrees are whole, and images of an angle have the same digits."""
    quadrant = round(degrees / 90.0)
    rest = math.radians(degrees - 90.0 * quadrant)
    cosine, sine = math.cos(rest), math.sin(rest)
    turned = ((cosine, sine), (-sine, cosine), (-cosine, -sine), (sine, -cosine))[quadrant % 4]
    return turned[0] + 0.0, turned[1] + 0.0  # no zero with a sign


def angles_around(count: int) -> tuple[float, ...]:
    """Angles around the circle from 0, in degrees."""
    return tuple(FULL * number / count for number in range(count))


def angles_between(start: float, end: float, count: int, ratio: float = 1.0) -> tuple[float, ...]:
    """Angles from ``start`` to ``end``, both among them; the last one left out where it is a full circle on.

    ratio : of the sine's unit to that of the cosine: the angles are at equal distances where both axes of a diagram
            are drawn in these units
    """
    if ratio == 1.0:
        return _evenly(start, end, count)
    first, last = stretched(start, 1 / ratio), stretched(end, 1 / ratio)
    between = [stretched(angle, ratio) for angle in _evenly(first, last, count)]
    ends = {0: start} if closes(start, end) else {0: start, count - 1: end}
    return tuple(ends.get(number, angle) for number, angle in enumerate(between))


def stretched(degrees: float, ratio: float) -> float:
    """Angle of the vector (cos, ratio sin) of an angle, in the same turn; multiples of 90 degrees stay."""
    cosine, sine = unit_vector(degrees)
    angle = math.degrees(math.atan2(ratio * sine, cosine))
    return angle + FULL * round((degrees - angle) / FULL)


def _evenly(start: float, end: float, count: int) -> tuple[float, ...]:
    if closes(start, end):
        return tuple(start + FULL * number / count for number in range(count))
    return tuple(start + (end - start) * number / (count - 1) for number in range(count))


def closes(start: float, end: float) -> bool:
    """Whether a range of angles is a full circle."""
    return abs(end - start - FULL) <= CLOSED
