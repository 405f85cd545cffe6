"""Lengths and densities: a block, a wall and an arch are the same structure at every size and weight."""

from __future__ import annotations

from collections.abc import Iterator

from tests.extremes.decks import FACTORS, ruled, worded
from tests.extremes.outcome import Scene

DECADES = range(-6, 7)


def scenes() -> Iterator[Scene]:
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


SCENES = tuple(scenes())
