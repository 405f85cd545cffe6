"""The least and the greatest load factor of a diagram, and where they are."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.sweeps.interaction.domain import Domain
from mbla.sweeps.interaction.point import Point

SAME = 1e-5
"""relative difference up to which load factors are one: to which a solved one may be uncertain"""


@dataclass(frozen=True)
class Extreme:
    """A load factor and the angles at which it is found, degrees."""

    load_factor: float
    angles: tuple[float, ...]


def extremes(points: Sequence[Point]) -> tuple[Extreme, Extreme] | None:
    """The least and the greatest of the verified load factors; None where there is none."""
    known = [point for point in points if point.has_factor]
    if not known:
        return None
    return _extreme(known, min(point.load_factor for point in known)), _extreme(
        known, max(point.load_factor for point in known)
    )


def _extreme(points: Sequence[Point], value: float) -> Extreme:
    room = SAME * max(abs(value), 1e-300)
    return Extreme(value, tuple(point.angle for point in points if abs(point.load_factor - value) <= room))


def everywhere(domain: Domain | None, *, closed: bool) -> float | None:
    """What associative flow carries at least at every angle, those between the points among them.

    The distance of the inner polygon's nearest side from the origin; None where it does not lie around the origin, or
    where a bound is in doubt.
    """
    if domain is None or not closed or domain.crossings or len(domain.inner) < 3:
        return None
    here, there = domain.inner, np.roll(domain.inner, -1, axis=0)
    sides = there - here
    outside = (here[:, 0] * there[:, 1] - here[:, 1] * there[:, 0]) / np.linalg.norm(sides, axis=1)
    return float(outside.min()) if outside.min() > 0.0 else None
