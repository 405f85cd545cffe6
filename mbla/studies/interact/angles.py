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


def angles_between(start: float, end: float, count: int) -> tuple[float, ...]:
    """Angles at equal distances, both ends among them; the last one left out where it is a full circle on."""
    if closes(start, end):
        return tuple(start + FULL * number / count for number in range(count))
    return tuple(start + (end - start) * number / (count - 1) for number in range(count))


def closes(start: float, end: float) -> bool:
    """Whether a range of angles is a full circle."""
    return abs(end - start - FULL) <= CLOSED
