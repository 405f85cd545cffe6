"""Lengths, densities and places: a block, a wall and an arch are the same structure at every size, weight and place."""

from __future__ import annotations

from collections.abc import Iterator

from tests.extremes.decks import FACTORS, ruled, worded
from tests.extremes.outcome import Scene

DECADES = range(-6, 7)


def sizes() -> Iterator[Scene]:
    """Decades of length, of density, and both together, in like and in opposite direction."""
    families = {
        "lengths": [(f"lengths 1e{k} m", f"1.0e{k}", "2000") for k in DECADES],
        "densities": [(f"density 1e{k}", "1", f"1.0e{k}") for k in range(-9, 10)],
        "lengths and densities": [
            (f"lengths 1e{k} m, density 1e{sign * round(1.5 * k)}", f"1.0e{k}", f"1.0e{sign * round(1.5 * k)}")
            for k in (-6, -4, -2, 2, 4, 6)
            for sign in (1, -1)
        ],
    }
    for family, values in families.items():
        for (structure, rule), (deck, expected, tolerance) in FACTORS.items():
            for name, length, density in values:
                yield Scene(
                    f"{structure}, {worded(rule)}, {name}",
                    family,
                    deck,
                    (f"parameters.s={length}", f"parameters.rho={density}", ruled(rule)),
                    expected,
                    tolerance,
                    long=structure != "block" and name not in (values[0][0], values[-1][0]),
                )


SAID = ("coordinates-coarse", "so far from the origin coordinates are rounded")
FAR = range(1, 17)
FINE = 6
"""Up to 1e6 m blocks of 0.4 m have their corners to 3e-10 of their size, and nothing may be lost but these digits."""


def distances() -> Iterator[Scene]:
    """Decades of distance; beyond those that a coordinate can tell, a remark or an error."""
    for (structure, rule), (deck, expected, tolerance) in FACTORS.items():
        for k in FAR:
            yield Scene(
                f"{structure}, {worded(rule)}, 1e{k} m away",
                "coordinates far from the origin",
                deck,
                (f"parameters.d=1.0e{k}", ruled(rule)),
                expected,
                max(tolerance, 1e-6 if k <= FINE else 1e-5),
                SAID if k > FINE else (),
                long=k not in (3, 6, 8, 14),
            )


SCENES = (*sizes(), *distances())
