"""Arches of other shapes than the circle against a linear program of the arch drawn a second time.

Curves are drawn by their equations, lengths by many chords: nothing is shared with the generators of mbla.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from scipy.optimize import brentq

from mbla.deck import read_deck
from mbla.model import build_model
from tests.analytic.planar import GROUND, Array, PlanarJoint, load_factor
from tests.decks.folder import BENCHMARKS

FINE = 400_001
"""points on a curve; the lengths of its chords are then exact to about 1e-10"""


@dataclass(frozen=True)
class Drawn:
    """A curve from left to right by many points (m, 2), with unit normals outwards (m, 2)."""

    points: Array
    normals: Array


def drawn(curve: Callable[[Array], Array], start: float, end: float) -> Drawn:
    """A curve u -> (x, z), its normals from differences along it."""
    u = np.linspace(start, end, FINE)
    points = curve(u).T
    tangents = np.gradient(points, axis=0, edge_order=2)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    return Drawn(points, np.column_stack([-tangents[:, 1], tangents[:, 0]]))


def elliptic(span: float, rise: float) -> Drawn:
    return drawn(lambda u: np.array([span / 2 - span / 2 * np.cos(u), rise * np.sin(u)]), 0.0, np.pi)


def catenary(span: float, rise: float) -> Drawn:
    scale = float(brentq(lambda a: a * (np.cosh(span / 2 / a) - 1) - rise, span / 100, 100 * span, xtol=1e-15))
    top = rise + scale
    return drawn(lambda x: np.array([x, top - scale * np.cosh((x - span / 2) / scale)]), 0.0, span)


def pointed_half(span: float, rise: float) -> Drawn:
    """Left half, carried on beyond the apex by a little."""
    radius = (span**2 / 4 + rise**2) / span
    beyond = np.arctan2(rise, radius - span / 2) + 0.3
    return drawn(lambda u: np.array([radius - radius * np.cos(u), radius * np.sin(u)]), 0.0, float(beyond))


def basket(span: float, rise: float) -> Drawn:
    """Three arcs of 60 degrees: radii from the condition that their centres lie on the legs of a half hexagon."""

    def misfit(side: float) -> float:
        return side + 2 * (span / 2 - side) - (rise + 3**0.5 * (span / 2 - side))

    side = float(brentq(misfit, 0.0, span / 2, xtol=1e-15))
    middle = side + 2 * (span / 2 - side)

    def curve(u: Array) -> Array:
        at_left, at_right = u < np.pi / 3, u > 2 * np.pi / 3
        radius = np.where(at_left | at_right, side, middle)
        x = np.select([at_left, at_right], [side, span - side], span / 2)
        z = np.where(at_left | at_right, 0.0, rise - middle)
        return np.array([x - radius * np.cos(u), z + radius * np.sin(u)])

    return drawn(curve, 0.0, np.pi)


def joints(line: Drawn, voussoirs: int, inner: float, outer: float) -> tuple[Array, Array]:
    """Corners (n + 1, 2) of joints at both offsets, at equal lengths along the line half way between them."""
    middle = line.points + (inner + outer) / 2 * line.normals
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(middle, axis=0), axis=1))])
    at = np.linspace(0.0, lengths[-1], voussoirs + 1)
    feet, normals = (
        np.column_stack([np.interp(at, lengths, values[:, axis]) for axis in (0, 1)])
        for values in (line.points, line.normals)
    )
    return feet + inner * normals, feet + outer * normals


def pointed_joints(span: float, rise: float, voussoirs: int, thickness: float) -> tuple[Array, Array]:
    """Of a pointed arch with an even number of voussoirs: the last joint of each half lies on the axis."""
    half = pointed_half(span, rise)

    def cut(offset: float) -> tuple[Array, int]:
        points = half.points + offset * half.normals
        return points, int(np.searchsorted(points[:, 0], span / 2))

    middle, end = cut(thickness / 2)
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(middle, axis=0), axis=1))])
    whole = float(np.interp(span / 2, middle[: end + 1, 0], lengths[: end + 1]))
    at = whole * np.arange(voussoirs // 2) / (voussoirs // 2)
    sides = []
    for offset in (0.0, thickness):
        points, end = cut(offset)
        left = np.column_stack([np.interp(at, lengths, points[:, axis]) for axis in (0, 1)])
        apex = [[span / 2, float(np.interp(span / 2, points[: end + 1, 0], points[: end + 1, 1]))]]
        sides.append(np.concatenate([left, apex, left[::-1] * [-1, 1] + [span, 0]]))
    return sides[0], sides[1]


def push_factor(inner: Array, outer: Array, mu: float) -> float | None:
    """Associative load factor of straight-edged voussoirs between springings on ground, their weight pushing along +x.

    inner, outer : (n + 1, 2) corners of the joints
    """
    polygons = np.stack([inner[:-1], inner[1:], outer[1:], outer[:-1]], axis=1)
    x, z = polygons[..., 0], polygons[..., 1]
    cross = x * np.roll(z, -1, axis=1) - np.roll(x, -1, axis=1) * z
    areas = cross.sum(axis=1) / 2
    sums = polygons + np.roll(polygons, -1, axis=1)
    centroids = (cross[..., None] * sums).sum(axis=1) / (6 * areas[:, None])
    count = len(areas)
    found = []
    for i in range(count + 1):
        along = (outer[i] - inner[i]) / np.linalg.norm(outer[i] - inner[i])
        normal = np.array([along[1], -along[0]])
        found.append(PlanarJoint(i - 1 if i else GROUND, i if i < count else GROUND, inner[i], outer[i], normal, mu))
    dead = np.outer(areas, [0.0, -1.0])
    return load_factor(found, centroids, dead, np.outer(areas, [1.0, 0.0]))


MU = 0.7


def of_deck(name: str) -> tuple[Array, Array]:
    """Corners of joints at intrados and extrados."""
    if name == "arch_pointed":
        return pointed_joints(4, 3, 24, 0.4)
    if name == "arch_elliptic":
        return joints(elliptic(4, 1.4), 25, 0, 0.4)
    if name == "arch_basket":
        return joints(basket(4, 1.4), 25, 0, 0.4)
    thickness, count = (0.004, 40) if name == "arch_catenary_thin" else (0.4, 24)
    return joints(catenary(4, 2), count, -thickness / 2, thickness / 2)


NAMES = ("arch_pointed", "arch_elliptic", "arch_basket", "arch_catenary", "arch_catenary_thin")


@pytest.mark.parametrize("name", NAMES)
def test_figures_of_the_decks(name: str) -> None:
    deck = read_deck(BENCHMARKS[name])
    assert push_factor(*of_deck(name), MU) == pytest.approx(deck.content.expected["push_x"].load_factor, rel=1e-6)


@pytest.mark.parametrize("name", NAMES)
def test_voussoirs_of_the_decks(name: str) -> None:
    """Every corner of the generated arch lies where the arch drawn a second time has one."""
    inner, outer = of_deck(name)
    vertices = build_model(read_deck(BENCHMARKS[name])).blocks.vertices.reshape(-1, 8, 3)[:, 4:][..., [0, 2]]
    if name.startswith("arch_catenary"):  # springings of the centre line at the origin, in both
        assert abs(inner[0, 1] + outer[0, 1]) < 1e-9
    for corner, drawn in enumerate((inner[:-1], inner[1:], outer[1:], outer[:-1])):
        assert vertices[:, corner] == pytest.approx(drawn, abs=1e-7)


@pytest.mark.parametrize("thickness", [0.04, 0.004, 0.0004])
def test_a_catenary_stands_at_any_thickness_and_an_ellipse_does_not(thickness: float) -> None:
    half = thickness / 2
    factor = push_factor(*joints(catenary(4, 2), 40, -half, half), MU)
    assert factor is not None
    assert factor == pytest.approx(1.08 * thickness, rel=0.06)  # nearly in proportion to the thickness
    assert push_factor(*joints(elliptic(4, 2), 40, -half, half), MU) is None
