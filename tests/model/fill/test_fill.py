"""Fill on blocks: weights and their moments by closed forms, what of a face carries it, symmetry, units, faults."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.model import build_model
from mbla.model.model import Model

DECK = """mbla: 1
units: {{{units}}}
materials: {{stone: {{unit_weight: "24 kN/m^3"}}, earth: {{unit_weight: "18 kN/m^3"}}}}
joints: {{dry: {{friction: 0.6}}}}
blocks:
{blocks}
contacts: {{joint: dry}}
supports: {supports}
fill: {{soil: {{{fill}}}}}
load_cases: {{push: {{{loads}}}}}
"""
BOX = "box: {group: box, material: stone, min: [0, 0, 0], max: [2, 1, 1]}"
GROUND = "[{ground: {z: 0}}]"
PUSH = "live: [{acceleration: [1, 0, 0]}]"


def model(folder: Path, fill: str, *blocks: str, supports: str = GROUND, loads: str = PUSH, units: str = "") -> Model:
    path = folder / "deck.yaml"
    lines = "\n".join(f"  - {block}" for block in blocks)
    path.write_text(DECK.format(blocks=lines, supports=supports, fill=fill, loads=loads, units=units))
    return build_model(read_deck(path))


def fill_of(found: Model) -> tuple[FloatArray, FloatArray]:
    """Weights of the fill on blocks, (n,) N, and where they act, (n, 3)."""
    assert found.fill is not None
    return found.fill.masses * found.units.standard_gravity * found.units.force_per_mass_acceleration, found.fill.points


def test_a_level_column(tmp_path: Path) -> None:
    weights, points = fill_of(model(tmp_path, "on: box, material: earth, level: 1.5", BOX))
    assert weights == pytest.approx([18000 * 2 * 1 * 0.5], rel=1e-12)
    assert points[0] == pytest.approx([1, 0.5, 1.25], rel=1e-12)


def test_below_a_sloping_top(tmp_path: Path) -> None:
    """Top z = 1 + 0.3 (x − 0.5): a wedge of 1.5 m from nothing at x = 0.5 to 0.45 m at x = 2."""
    fill = "on: box, material: earth, surface: {point: [0.5, 0, 1], normal: [-0.3, 0, 1]}"
    weights, points = fill_of(model(tmp_path, fill, BOX))
    assert weights == pytest.approx([18000 * 1.5 * 0.45 / 2], rel=1e-12)
    assert points[0] == pytest.approx([1.5, 0.5, 1 + 0.15], rel=1e-12)


def semicircle(voussoirs: int, level: float) -> tuple[float, float]:
    """Area between a level and the chords of the extrados of radius 2.5 over one half, and its moment about the crown.

    Of a polygon with corners at equal angles: by trapezia.
    """
    angles = np.linspace(0.0, np.pi / 2, voussoirs // 2 + 1)
    x, h = 2.5 * np.sin(angles), level - 2.5 * np.cos(angles)
    area = np.diff(x) * (h[:-1] + h[1:]) / 2
    first = np.diff(x) * (x[:-1] * (2 * h[:-1] + h[1:]) + x[1:] * (h[:-1] + 2 * h[1:])) / 6
    return float(area.sum()), float(first.sum())


def test_over_a_semicircular_arch(tmp_path: Path) -> None:
    """Weight and moment about the crown of each half; towards the integral (1 − π/4) R² of the circle with more of
    them.
    """
    for voussoirs in (24, 96):
        arch = (
            f"arch: {{group: ring, material: stone, shape: semicircular, span: 4, thickness: 0.5, width: 3, "
            f"voussoirs: {voussoirs}, springers: ground}}"
        )
        found = model(tmp_path, "on: ring, material: earth, level: 3.1", arch, supports="[]")
        weights, points = fill_of(found)
        area, moment = semicircle(voussoirs, 3.1)
        right = points[:, 0] > 2
        assert weights[right].sum() == pytest.approx(18000 * 3 * area, rel=1e-12)
        assert weights[right] @ (points[right, 0] - 2) == pytest.approx(18000 * 3 * moment, rel=1e-12)
        load = found.load_cases[0].dead_load[right]
        centroids = found.blocks.centroids[right]
        own = 24000 * found.blocks.volumes[right]
        about_crown = (centroids[:, 0] - 2) @ -load[:, 2] + load[:, 4].sum()
        assert about_crown == pytest.approx(18000 * 3 * moment + own @ (centroids[:, 0] - 2), rel=1e-12)
    circle = 3.1 * 2.5 - np.pi / 4 * 2.5**2
    assert weights[right].sum() == pytest.approx(18000 * 3 * circle, rel=2e-3)


def test_where_other_blocks_cover_a_face(tmp_path: Path) -> None:
    """A block on the left half of the top, and one that hangs half a metre above the right quarter."""
    more = (
        "box: {group: on_it, material: stone, min: [0, 0, 1], max: [1, 1, 3]}",
        "box: {group: over_it, material: stone, min: [1.5, 0, 1.5], max: [2.5, 1, 1.8]}",
    )
    held = "[{ground: {z: 0}}, {blocks: over_it}]"
    weights, points = fill_of(model(tmp_path, "on: box, material: earth, level: 2", BOX, *more, supports=held))
    assert weights == pytest.approx([18000 * 0.5 * 1, 0, 0], rel=1e-9)
    assert points[0] == pytest.approx([1.25, 0.5, 1.5], rel=1e-9)
    weights, _ = fill_of(model(tmp_path, "on: box, material: earth, level: 1.4", BOX, *more, supports=held))
    assert weights == pytest.approx([18000 * 1 * 0.4, 0, 0], rel=1e-9)


def test_only_the_outer_ring_carries_it(tmp_path: Path) -> None:
    arch = (
        "arch: {group: ring, material: stone, shape: segmental, span: 4, rise: 1, thickness: 0.4, width: 1, "
        "voussoirs: 15, rings: 2, springers: ground}"
    )
    found = model(tmp_path, "on: ring, material: earth, level: 2", arch, supports="[]")
    weights, _ = fill_of(found)
    assert ((weights > 0) == (found.blocks.labels.position("ring") == 1)).all()


def test_it_moves_with_the_block_under_it(tmp_path: Path) -> None:
    """An acceleration acts on its mass, at the middle of the column; other masses of the deck stay."""
    found = model(tmp_path, "on: box, material: earth, level: 1.5", BOX)
    weights, _ = fill_of(found)
    live = found.load_cases[0].live_load[0]
    assert live == pytest.approx([48000 + weights[0], 0, 0, 0, weights[0] * 0.75, 0], rel=1e-12)
    assert found.total_weight == pytest.approx(48000 + weights[0])


def test_units(tmp_path: Path) -> None:
    weights, points = fill_of(
        model(tmp_path, 'on: box, material: earth, level: "1.5 m"', BOX, units="force: kN, mass: t")
    )
    assert weights == pytest.approx([18], rel=1e-12)
    box = "box: {group: box, material: stone, min: [0, 0, 0], max: [2000, 1000, 1000]}"
    weights, points = fill_of(model(tmp_path, "on: box, material: earth, level: 1500", box, units="length: mm"))
    assert weights == pytest.approx([18000], rel=1e-12)
    assert points[0] == pytest.approx([1000, 500, 1250], rel=1e-12)


def test_of_a_half_with_its_image(tmp_path: Path) -> None:
    whole = model(tmp_path, "on: box, material: earth, level: 1.5", BOX)
    path = tmp_path / "deck.yaml"
    half = path.read_text().replace("max: [2, 1, 1]", "max: [1, 1, 1]").replace("[1, 0, 0]}", "[0, 0, 1]}")
    path.write_text(half.replace("load_cases", "symmetry: [{x: 1, halves: box}]\nload_cases"))
    found = build_model(read_deck(path))
    assert found.fill is not None
    assert whole.fill is not None
    assert found.fill.masses == pytest.approx(whole.fill.masses)
    assert found.fill.points == pytest.approx(whole.fill.points)


def test_on_nothing(tmp_path: Path) -> None:
    with pytest.raises(DeckError, match="lies on nothing"):
        model(tmp_path, "on: box, material: earth, level: 0.9", BOX)
