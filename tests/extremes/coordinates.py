"""Coordinates far from the origin: the same structures, as far as the digits of a coordinate go."""

from __future__ import annotations

from collections.abc import Iterator

from tests.extremes.decks import FACTORS, ruled, worded
from tests.extremes.outcome import Scene

SAID = ("coordinates-coarse", "so far from the origin coordinates are rounded")
FAR = range(1, 17)
FINE = 6
"""Up to 1e6 m blocks of 0.4 m have their corners to 3e-10 of their size, and nothing may be lost but these digits."""


def scenes() -> Iterator[Scene]:
    """Decades of distance; beyond those that a coordinate can tell, a remark or an error."""
    for (structure, rule), (deck, expected, tolerance) in FACTORS.items():
        for k in FAR:
            yield Scene(
                f"{structure}, {worded(rule)}, 1e{k} m away",
                "coordinates far from the origin",
                deck,
                (f"parameters.d=1.0e{k}", ruled(rule)),
                expected,
                max(tolerance, 1e-6) if k <= FINE else 1e-5,
                SAID if k > FINE else (),
                long=k not in (3, 6, 8, 14),
            )


SCENES = tuple(scenes())
