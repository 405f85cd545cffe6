"""Soil of a deck: points that are moved, several soils, items beside walls, and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.model import build_model
from mbla.model.soil.soil_mesh import StrangeCornersError
from mbla.process.run_options import RunOptions
from mbla.results.outcome import answer_of
from mbla.run import run
from tests.model.soil.decks import ARCH, BACKFILL, FOOTING, GROUND, WALL, deck, fill, model, moved_to, refused
from tests.model.soil.test_fill_region import missing


def test_the_same_with_points_moved(tmp_path: Path) -> None:
    found = model(tmp_path, WALL, BACKFILL, supports=GROUND)
    (soil,) = found.soils
    shifts = np.where(soil.inside[:, None], [0.02, -0.01], 0.03 * soil.along)
    moved = build_model(
        deck(tmp_path, WALL, BACKFILL, supports=GROUND),
        moved_to(soil, soil.points + shifts),
    )
    (other,) = moved.soils
    assert np.array_equal(other.points, soil.points + shifts)
    assert np.array_equal(other.triangles, soil.triangles)
    volumes = moved.blocks.volumes[other.blocks]
    assert volumes == pytest.approx(other.areas(other.points), rel=1e-9)
    assert volumes.sum() == pytest.approx(1.6, rel=1e-12)
    again = build_model(deck(tmp_path, WALL, BACKFILL, supports=GROUND), {"backfill": soil.corners})
    assert np.array_equal(again.blocks.vertices, found.blocks.vertices)


def test_points_that_are_none_of_it_are_refused(tmp_path: Path) -> None:
    read = deck(tmp_path, WALL, BACKFILL, supports=GROUND)
    (soil,) = build_model(read).soils
    off = 0.01 * soil.along[:, ::-1]
    for points in (soil.points[1:], soil.points[:, ::-1], soil.points + off):
        with pytest.raises(StrangeCornersError, match=r"soil"):
            build_model(read, moved_to(soil, points))
    with pytest.raises(StrangeCornersError, match=r"clay"):
        build_model(read, {"clay": soil.corners})


def test_items_have_corners_where_blocks_beside_them_have(tmp_path: Path) -> None:
    (soil,) = model(tmp_path, BACKFILL, FOOTING, WALL, supports=GROUND).soils
    corners = np.array([[0, 0], [1.6, 0], [1.6, 1], [0, 1], [0.4, 1], [0.9, 1]])
    assert len(soil.points[soil.fixed]) == len(corners)
    assert missing(corners, soil.points[soil.fixed]) < 1e-12


def test_items_are_moved_as_others_are(tmp_path: Path) -> None:
    turned = BACKFILL[:-1] + ", transform: [{mirror: {normal: [1, 0, 0]}}, {scale: 2}]}"
    found = model(tmp_path, turned, supports=GROUND)
    (soil,) = found.soils
    low, high = found.blocks.vertices.min(axis=0), found.blocks.vertices.max(axis=0)
    assert low == pytest.approx([-3.2, 0, 0])
    assert high == pytest.approx([0, 2, 2])
    assert found.blocks.volumes.sum() == pytest.approx(12.8)
    assert len(soil.triangles) == len(found.blocks)
    assert not found.notices


def test_a_fill_beside_soil_behind_the_wall(tmp_path: Path) -> None:
    """Fill over both would lie on soil; beside it, it has a corner where the cells of the other have one."""
    wall = "box: {group: arch, material: stone, min: [0, 0, 0], max: [1, 1, 1]}"
    behind = BACKFILL.replace("[0, 0], [1.6, 0], [1.6, 1], [0, 1]", "[1, 0], [2, 0], [2, 1.5], [1, 1.5]")
    found = model(tmp_path, wall, behind, fill=fill(), supports=GROUND)
    assert [soil.name for soil in found.soils] == ["backfill", "soil"]
    backfill, above = found.soils
    shared = backfill.points[np.isclose(backfill.points[:, 0], 1.0) & (backfill.points[:, 1] > 1.0 - 1e-9)]
    assert len(shared) > 2
    assert missing(shared, above.points) < 1e-12
    assert [ground.label for ground in found.grounds] == ["ground at the left end of soil", "ground z = 0"]
    ((key, words),) = refused(tmp_path, wall, behind, fill=fill().replace("on: arch", "on: [arch, backfill]"))
    assert (key, words.split(":")[0]) == ("fill.soil.on", "is soil of cells")


def test_items_that_overlap_blocks_are_refused(tmp_path: Path) -> None:
    inside = FOOTING.replace("[0.4, 0, 1]", "[0.4, 0, 0.9]")
    ((key, words),) = refused(tmp_path, WALL, inside, BACKFILL, supports=GROUND)
    assert key == "blocks[2].soil.outline"
    assert "overlaps footing[0]" in words


def test_outlines_that_cross_are_refused(tmp_path: Path) -> None:
    crossed = BACKFILL.replace("[1.6, 1], [0, 1]", "[0, 1], [1.6, 1]")
    assert refused(tmp_path, crossed, supports=GROUND)[0][0] == "blocks[0].soil.outline"


@pytest.mark.parametrize("twice", ["[1.6, 0], [1.6, 0]", "[1.6, 0], [1.600000000001, 0]"])
def test_a_corner_that_is_given_twice(twice: str, tmp_path: Path) -> None:
    (once,) = model(tmp_path, BACKFILL, supports=GROUND).soils
    (soil,) = model(tmp_path, BACKFILL.replace("[1.6, 0]", twice), supports=GROUND).soils
    assert soil.points == pytest.approx(once.points, abs=1e-9)
    assert (soil.triangles == once.triangles).all()


def test_more_cells_than_can_be_handled_are_refused(tmp_path: Path) -> None:
    ((key, words),) = refused(tmp_path, ARCH, fill=fill(cells="size: 0.002"))
    assert key == "fill.soil.cells.size"
    assert "at most 100,000" in words


def test_one_cell_as_large_as_the_region(tmp_path: Path) -> None:
    triangle = BACKFILL.replace("[1.6, 1], [0, 1]", "[0, 1]").replace("size: 0.3", "size: 1.6")
    assert len(model(tmp_path, triangle, supports=GROUND).blocks) == 1


ACTIVE = """mbla: 1
units: {{force: kN, mass: t}}
materials: {{stone: {{unit_weight: 24}}, sand: {{unit_weight: 20}}}}
joints: {{dry: {{friction: 0.6}}}}
blocks:
  - box: {{group: wall, material: stone, min: [-0.5, 0, 0], max: [0, 1, 1]}}
  - soil:
      group: backfill
      material: sand
      outline: [[0, 0], [1.6, 0], [1.6, 1]{top}, [0, 1]]
      width: 1
      cells: {{size: {size}}}
      friction_angle: 30
      wall: {{friction_angle: 0}}
contacts: {{joint: dry}}
supports:
  - {{blocks: wall}}
  - {{ground: {{z: 0}}, blocks: backfill}}
  - {{ground: {{point: [1.6, 0, 0], normal: [-1, 0, 0]}}, blocks: backfill}}
load_cases:
  active: {{settlement: {{on: wall, direction: [-1, 0, 0]}}}}
output: {{vtu: false}}
"""
RANKINE = 20.0 / 2.0 / 3.0
"""K_a γ h²/2 with K_a = tan²(45° − φ/2) = 1/3"""


def test_soil_of_cells_flows_by_normality_unless_the_deck_says_otherwise(tmp_path: Path) -> None:
    soil = deck(tmp_path, WALL, BACKFILL, supports=GROUND)
    assert soil.analysis.flow_rule == "associative"
    assert deck(tmp_path, WALL, supports=GROUND).analysis.flow_rule == "non_associative"
    assert read_deck(soil.path, ["analysis.accuracy=draft"]).analysis.flow_rule == "non_associative"
    soil = deck(tmp_path, WALL, BACKFILL, supports=GROUND)
    assert read_deck(soil.path, ["analysis.accuracy=draft"]).analysis.flow_rule == "associative"
    assert read_deck(soil.path, ["analysis.flow_rule=non_associative"]).analysis.flow_rule == "non_associative"


def thrust(folder: Path, top: str, size: float) -> float:
    path = folder / "wall.yaml"
    path.write_text(ACTIVE.format(top=top, size=size), encoding="utf-8")
    (case,) = run(path, RunOptions(folder=folder / "out", force=True)).cases
    found = answer_of(case)
    assert found is not None
    return found


def test_active_pressure_where_cells_have_its_slip_line(tmp_path: Path) -> None:
    """A wedge at 45° + φ/2 = 60° is a cell."""
    assert thrust(tmp_path, ", [0.57735026919, 1]", 1.6) == pytest.approx(RANKINE, rel=1e-8)


def test_active_pressure_from_below_where_they_have_not(tmp_path: Path) -> None:
    """Cells restrict the ways in which soil can follow a wall: it pushes less on one that gives way."""
    assert 0.0 < thrust(tmp_path, "", 0.4) < RANKINE


def test_cells_are_smaller_under_a_footing_and_not_behind_a_wall(tmp_path: Path) -> None:
    (soil,) = model(tmp_path, BACKFILL, FOOTING, WALL, supports=GROUND).soils
    on_top = np.abs(soil.points[:, 1] - 1.0) < 1e-12
    under = on_top & (soil.points[:, 0] > 0.4 - 1e-9) & (soil.points[:, 0] < 0.9 + 1e-9)
    behind = np.abs(soil.points[:, 0]) < 1e-12
    assert (under.sum(), behind.sum()) == (5, 4)


def test_a_mass_on_cells(tmp_path: Path) -> None:
    """A fill that is a mass may lie on soil, and is told to."""
    both = fill()[: fill().rindex("}")] + ", road: {on: soil, material: earth, level: 1.6}}"
    carried = model(tmp_path, ARCH, fill=both).fill
    assert carried is not None
    (words,) = carried.words
    assert " on soil; weight" in words
    ((key, refusal),) = refused(tmp_path, ARCH, fill=both.replace("on: soil", "on: arch"))
    assert (key, refusal.split(":")[0]) == ("fill.road", "lies where the cells of soil are")


def test_a_load_that_travels_on_soil(tmp_path: Path) -> None:
    deck(tmp_path, ARCH, fill=fill())
    text = (tmp_path / "deck.yaml").read_text(encoding="utf-8")
    travels = "travel: {force: [0, 0, -1], contact: 0.4, path: [[0.5, 1, 1.5], [3.5, 1, 1.5]], positions: 3}"
    (tmp_path / "deck.yaml").write_text(text.replace("acceleration: [1, 0, 0]", travels), encoding="utf-8")
    words = [case.live_words[0] for case in build_model(read_deck(tmp_path / "deck.yaml")).load_cases]
    assert len(words) == 3
    assert all(" on soil, position " in word for word in words)
