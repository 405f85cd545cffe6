"""Vectors by azimuth and elevation in degrees, exact where they lie along an axis."""

from __future__ import annotations

import math

FULL_CIRCLE = 360.0
"""degrees"""
_QUARTER = 90.0
_HALF_ROOT = math.sqrt(0.5)


def sine_cosine(degrees: float) -> tuple[float, float]:
    """Sine and cosine: exactly 0, 1/2 and 1 where they are, and equal to each other at 45 degrees."""
    quarters = round(math.remainder(degrees, FULL_CIRCLE) / _QUARTER)
    rest = math.remainder(degrees, FULL_CIRCLE) - quarters * _QUARTER
    if abs(rest) == 45.0:
        sine, cosine = math.copysign(_HALF_ROOT, rest), _HALF_ROOT
    elif abs(rest) == 30.0:
        sine, cosine = math.copysign(0.5, rest), math.sqrt(0.75)
    else:
        sine, cosine = math.sin(math.radians(rest)), math.cos(math.radians(rest))
    turned = [(sine, cosine), (cosine, -sine), (-sine, -cosine), (-cosine, sine)][quarters % 4]
    return turned[0] + 0.0, turned[1] + 0.0  # no zero with a sign


def horizontal(azimuth: float, size: float) -> tuple[float, float]:
    """Components along x and y of a horizontal vector; azimuth in degrees from +x towards +y."""
    sine, cosine = sine_cosine(azimuth)
    return size * cosine + 0.0, size * sine + 0.0


def spatial(azimuth: float, elevation: float, size: float) -> list[float]:
    """Components of a vector; elevation in degrees above the horizon."""
    sine, cosine = sine_cosine(elevation)
    return [*horizontal(azimuth, size * cosine), size * sine + 0.0]
