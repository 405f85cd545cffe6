"""Least thickness of a hemispherical dome cut along its meridians, by lines of thrust in one slice; nothing of mbla.

Each slice leans against the keystone with a horizontal thrust H and half of that keystone's share as vertical force.
With V the weight above a joint and S its moment about the axis, the thrust passes through the joint where
H z + V x = M + S, with M the moment at the crown; at the intrados the left side is less, at the extrados more. These
are linear conditions on H and M: a linear program says whether any H and M fulfil them all.

A slice is plane between its two meridians, pi/n to both sides: its middle is at cos(pi/n) of the radius of its corners.
For a ring between the angles a > b from the crown the weight and its moment are, but for one factor,
(R2^3 - R1^3) sin(a - b) (sin a + sin b)/6 and cos(pi/n) (R2^4 - R1^4) sin(a - b) (sin^2 a + sin^2 b + sin a sin b)/12.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import linprog

from tests.decks.folder import BENCHMARKS, run_deck


def slice_stands(thickness: float, rings: int, segments: int, keystone: float) -> bool:
    """Whether a line of thrust lies within the slice; lengths relative to the mean radius."""
    inner, outer = 1 - thickness / 2, 1 + thickness / 2
    middle = np.cos(np.pi / segments)
    top = float(np.arcsin(keystone / 2 / inner))
    angles = np.linspace(top, np.pi / 2, rings + 1)
    # of the keystone: a frustum of height (R2 - R1) cos(top) between polygons with corners at both radii
    low, high = inner * np.sin(top), outer * np.sin(top)
    weight, moment = (outer - inner) * np.cos(top) * (low**2 + low * high + high**2) / 6, 0.0
    rows, limits = [], []
    for angle, after in pairwise([*angles, None]):
        for radius, side in ((inner, 1.0), (outer, -1.0)):
            x, z = middle * radius * np.sin(angle), radius * np.cos(angle)
            rows.append([side * z, -side])
            limits.append(side * (moment - weight * x))
        if after is not None:
            turn, one, other = np.sin(after - angle), np.sin(after), np.sin(angle)
            weight += (outer**3 - inner**3) * turn * (one + other) / 6
            moment += middle * (outer**4 - inner**4) * turn * (one**2 + other**2 + one * other) / 12
    found = linprog([0, 0], A_ub=rows, b_ub=limits, bounds=[(0, None), (None, None)], method="highs")
    return bool(found.status == 0)


def least_thickness(rings: int, segments: int, keystone: float) -> float:
    """By bisection, relative to the mean radius."""
    low, high = 0.01, 0.2
    for _ in range(30):
        half = (low + high) / 2
        low, high = (low, half) if slice_stands(half, rings, segments, keystone) else (half, high)
    return high


DECK = BENCHMARKS["dome_of_slices"]


def test_thin_slices_are_heymans() -> None:
    """0.042 of the radius; a little more with weights at their true centroids."""
    assert least_thickness(60, 1000, 0.01) == pytest.approx(0.042, abs=1e-3)


@pytest.mark.parametrize(("share", "status"), [(0.999, "no_equilibrium"), (1.001, "solved")])
def test_the_dome_falls_and_stands_a_thousandth_off_the_least_thickness(share: float, status: str) -> None:
    thickness = share * least_thickness(10, 8, 0.1)
    case = run_deck(DECK, "--set", f"parameters.t={thickness!r}").record["cases"][0]
    assert case["status"] == status
