"""The arch under fill of decks/benchmarks/closed_forms by a thrust-line program that shares nothing with mbla.

The extrados is a polygon of chords. Weights of soil are trapezia between it and the top. Of a load on the top what goes
down between two rays, by the radial stress of Boussinesq under a line load, lands between them: on a chord that is

    K(t) = [θ + sin θ cos θ] / (2 [α + sin α cos α]),   θ = atan t within ±α,   t = (x - x₀) / depth

from one end to the other, and its moment ∫ x dK along the chord is integrated by scipy.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad

from mbla.deck import read_deck
from tests.analytic.planar import GROUND, Arch, Array, PlanarTie, arch_load_factor, polygon_arch
from tests.decks.folder import BENCHMARKS

SPAN, RISE, THICKNESS, WIDTH, FRICTION, TOP, VOUSSOIRS = 6.0, 1.5, 0.45, 2.5, 0.6, 2.5, 25
STONE, EARTH = 22.0, 18.0
ALPHA = np.pi / 6
K_P, MOBILISED = 3.0, 0.33
"""of a friction angle of 30 degrees"""
LOADS = {"quarter": [(1.5, WIDTH)], "lorry": [(2.4, 60.0), (1.2, 115.0)]}
"""places x and forces, all over the width"""


@cache
def arch() -> Arch:
    """About its centre, with the weights of its voussoirs."""
    radius = (SPAN**2 / 4 + RISE**2) / (2 * RISE)
    embrace = 2 * np.arcsin(SPAN / 2 / radius)
    drawn = polygon_arch(radius, radius + THICKNESS, float(embrace), VOUSSOIRS)
    return Arch(drawn.inner, drawn.outer, drawn.angles, drawn.weights * STONE * WIDTH, drawn.points)


def corners() -> tuple[Array, Array]:
    """Ends of the chords of the extrados, x from the left springing of the intrados and the depth below the top."""
    x = SPAN / 2 + arch().outer * np.sin(arch().angles)
    z = arch().outer * np.cos(arch().angles) - (arch().inner - RISE)
    return x, TOP - z


def with_fill() -> Array:
    """Forces and moments x Fz - z Fx of own weight and fill on each voussoir, (n, 3)."""
    x, h = corners()
    area = np.diff(x) * (h[:-1] + h[1:]) / 2
    first = np.diff(x) * (x[:-1] * (2 * h[:-1] + h[1:]) + x[1:] * (h[:-1] + 2 * h[1:])) / 6
    soil = EARTH * WIDTH * area
    arms = first / area - SPAN / 2 - arch().points[:, 0]
    none = np.zeros_like(soil)
    return np.column_stack([none, -arch().weights - soil, -soil * arms])


def up_to(slope: float) -> float:
    """K."""
    theta = np.arctan(np.clip(slope, -np.tan(ALPHA), np.tan(ALPHA)))
    return float((theta + np.sin(theta) * np.cos(theta)) / 2 / (ALPHA + np.sin(ALPHA) * np.cos(ALPHA)))


def lever(t: float, at_load: float, slope: float) -> float:
    """Density of K times the distance from the load at which a ray lands on a chord."""
    density = 1 / (1 + t**2) ** 2 / (ALPHA + np.sin(ALPHA) * np.cos(ALPHA))
    return float(density * t * at_load / (1 - slope * t))


def landed(place: float, force: float) -> Array:
    """Of a load on the top, (n, 3)."""
    x, h = corners()
    found = []
    for row in range(VOUSSOIRS):
        slope = float(np.diff(h)[row] / np.diff(x)[row])
        at_load = float(h[row] + slope * (place - x[row]))
        begin, end = (float(np.clip((x[i] - place) / h[i], -np.tan(ALPHA), np.tan(ALPHA))) for i in (row, row + 1))
        share = up_to(end) - up_to(begin)
        moment = quad(lever, begin, end, args=(at_load, slope), epsabs=1e-13)[0]
        found.append([0.0, -force * share, -force * (moment + share * (place - SPAN / 2 - arch().points[row, 0]))])
    return np.array(found)


def restraint() -> list[PlanarTie]:
    """Soil against every chord: between K_a and m_p K_p times its weight times the slope of the chord."""
    x, h = corners()
    found = []
    for row in range(VOUSSOIRS):
        drop = float(np.diff(h)[row])
        if abs(drop) > 1e-9:
            stress = EARTH * WIDTH * (h[row] + h[row + 1]) / 2 * abs(drop)
            down = (h[row] + 2 * h[row + 1]) / (h[row] + h[row + 1]) / 3  # share of the chord, of a trapezium of stress
            middle = x[row] + down * (x[row + 1] - x[row]) - SPAN / 2, TOP + arch().inner - RISE - h[row] - down * drop
            away = middle[0] + np.sign(drop), middle[1]
            found.append(PlanarTie((row, GROUND), (middle, away), -MOBILISED * K_P * stress, -stress / K_P))
    return found


def program(case: str, ties: Sequence[PlanarTie] = ()) -> float:
    """Greatest load factor."""
    live = np.sum([landed(place, force) for place, force in LOADS[case]], axis=0)
    factor = arch_load_factor(arch(), FRICTION, live, with_fill(), ties)
    assert factor is not None
    return factor


@pytest.mark.parametrize("case", LOADS)
@pytest.mark.parametrize("deck", ["filled_arch", "filled_arch_restrained"])
def test_the_deck_agrees_with_the_program(deck: str, case: str) -> None:
    expected = read_deck(BENCHMARKS[deck]).content.expected[case]
    found = program(case, restraint() if deck == "filled_arch_restrained" else ())
    assert found == pytest.approx(expected.load_factor, rel=3e-8)
