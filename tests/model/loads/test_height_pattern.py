"""Accelerations that grow with height: every part of a block has the factor of its own height."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.model.loads.pattern_factors import ramp_moments
from mbla.results.collapse.mechanics import live_load_in_g
from tests.model.shapes import L_OUTLINE, build, deck, prism, write_deck

DENSITY, G = 2000.0, 9.81
GROUND = "[{ground: {z: 0}}]"


def live(folder: Path, blocks: list[str], pattern: str, tail: str = "") -> FloatArray:
    loads = f"live: [{{acceleration: [1, 0, 0], pattern: {pattern}}}]"
    path = write_deck(folder, blocks, GROUND, loads)
    path.write_text(path.read_text() + tail)
    return build_model(read_deck(path)).load_cases[0].live_load


def test_one_block_as_a_triangle_of_forces(tmp_path: Path) -> None:
    """Resultant half the weight at two thirds of the height: a moment W H/12 about the centroid."""
    found = live(tmp_path, ["box: {material: stone, min: [5, 0, 0], max: [6, 1, 4]}"], "{}")
    weight = 4 * DENSITY * G
    assert found[0] == pytest.approx([weight / 2, 0, 0, 0, weight * 4 / 12, 0], rel=1e-12)


@pytest.mark.parametrize(
    "pattern",
    ["{}", "{base: 0.7, top: 3.1}", "{points: [[0.3, 2], [1.3, -1], [1.4, 3], [3.9, 0]]}", "{along: [1, 2, 3]}"],
)
def test_how_a_column_is_divided_does_not_matter(tmp_path: Path, pattern: str) -> None:
    heights = [0.0, 0.45, 1.0, 1.37, 2.6, 4.0]
    slices = [
        f"box: {{material: stone, min: [0, 0, {below}], max: [1, 2, {above}]}}" for below, above in pairwise(heights)
    ]
    one = live(tmp_path, ["box: {material: stone, min: [0, 0, 0], max: [1, 2, 4]}"], pattern)[0]
    parts = live(tmp_path, slices, pattern)
    middles = (np.array(heights[1:]) + heights[:-1]) / 2
    assert parts[:, :3].sum(axis=0) == pytest.approx(one[:3], rel=1e-12, abs=1e-9)
    moments = parts[:, 3:].sum(axis=0) + np.array([0, parts[:, 0] @ (middles - 2), 0])
    assert moments == pytest.approx(one[3:], rel=1e-11, abs=1e-7)


def test_an_added_mass_has_the_factor_of_its_place(tmp_path: Path) -> None:
    """Each of several on one block; at the middle of these it would be 3/2."""
    block = ["box: {group: pier, material: stone, min: [0, 0, 0], max: [1, 1, 4]}"]
    masses = "masses: [{mass: 500, on: pier, at: [0.5, 0.5, 3]}, {mass: 500, on: pier, at: [0.5, 0.5, 1]}]\n"
    pattern = "{points: [[1, 0], [2, 2], [3, 1]]}"
    alone, loaded = live(tmp_path, block, pattern), live(tmp_path, block, pattern, masses)
    assert (loaded - alone)[0] == pytest.approx([500 * G, 0, 0, 0, 500 * G * 1, 0], rel=1e-12, abs=1e-9)


def test_fill_has_the_factors_of_its_heights(tmp_path: Path) -> None:
    """A column from 4 to 6 m under factors z/4: its mean is 5/4, and what is above its middle has more."""
    block = ["box: {group: pier, material: stone, min: [0, 0, 0], max: [1, 1, 4]}"]
    fill = "fill: {soil: {on: pier, level: 6, material: stone}}\n"
    pattern = "{points: [[0, 0], [8, 2]]}"
    alone, loaded = live(tmp_path, block, pattern), live(tmp_path, block, pattern, fill)
    weight = 2 * DENSITY * G
    moment = weight * (5 / 4 * 3 + 2**2 / 12 / 4)
    assert (loaded - alone)[0] == pytest.approx([weight * 5 / 4, 0, 0, 0, moment, 0], rel=1e-12, abs=1e-9)


@pytest.mark.long
@pytest.mark.parametrize("level", [-0.4, 0.31, 1.0])
def test_ramps_over_blocks_that_are_not_convex_or_not_upright(level: float) -> None:
    """Against sums over many thin layers of tetrahedra's points: here a rotated grid of points inside a prism."""
    blocks = build(prism(L_OUTLINE)).blocks
    along = np.array([2.0, 1.0, 2.0]) / 3
    ramps, moments = ramp_moments(blocks, np.array([0]), along, np.array([level]))
    n = 120
    grid = (np.arange(2 * n) + 0.5) / n
    x, y, z = (each.ravel() for each in np.meshgrid(grid, grid, grid[:n], indexing="ij"))
    inside = (x < 1) | (y < 1)
    points = np.stack([x, y, z], axis=1)[inside]
    h = np.maximum(points @ along - level, 0)
    assert ramps[0] == pytest.approx(h.sum() / n**3, rel=1e-4)
    assert moments[0] == pytest.approx(h @ (points - blocks.centroids[0]) / n**3, rel=2e-3, abs=1e-4)


def test_what_is_not_uniform_is_not_told_in_g(tmp_path: Path) -> None:
    block = ["box: {material: stone, min: [0, 0, 0], max: [1, 1, 4]}"]
    plain = build_model(deck(tmp_path, block, GROUND, "live: [{acceleration: [0.5, 0, 0]}]"))
    assert live_load_in_g(plain, plain.load_cases[0]) == pytest.approx(0.5)
    grown = build_model(deck(tmp_path, block, GROUND, "live: [{acceleration: [1, 0, 0], pattern: {}}]"))
    assert live_load_in_g(grown, grown.load_cases[0]) is None
