"""Travelling loads: one load case for each position, on the block under it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.model import build_model
from mbla.model.model import Model
from tests.model.loads.test_line import TWO_STOREYS
from tests.model.shapes import deck

ROW = [f"box: {{group: row, material: stone, min: [{x}, 0, 0], max: [{x + 1}, 1, 1]}}" for x in range(4)]
GROUND = "[{ground: {z: 0}}]"


def model(folder: Path, travel: str, blocks: list[str], more: str = "", supports: str = GROUND) -> Model:
    return build_model(deck(folder, blocks, supports, f"live: [{{travel: {{{travel}}}{more}}}]"))


def test_a_load_case_for_each_position(tmp_path: Path) -> None:
    path = "force: [0, 0, -10], path: [[0.5, 0.5, 1], [2.5, 0.5, 1], [2.5, 0.5, 2], [3.5, 0.5, 2]], positions: 11"
    found = model(tmp_path, path, ROW).load_cases
    assert [case.name for case in found] == [f"push@{number:02d}" for number in range(1, 12)]
    places = [case.question.place for case in found]
    assert [place.distance for place in places] == pytest.approx(np.linspace(0, 4, 11))
    assert places[6].point == pytest.approx([2.5, 0.5, 1.4])
    assert [place.blocks[0] for place in places] == [0, 0, 1, 1, 2, 2, 2, 2, 2, 3, 3]
    assert found[1].live_load[0] == pytest.approx([0, 0, -10, 0, 4, 0])
    assert found[1].live_words == ("force (0, 0, -10) N at (0.9, 0.5, 1) m on row[0], position 2 of 11",)
    assert (found[1].dead_load == found[0].dead_load).all()


def test_other_live_loads_and_factors_act_at_every_position(tmp_path: Path) -> None:
    loads = (
        "live: [{acceleration: [1, 0, 0]}, {travel: {force: [0, 0, -10], path: [[0.5, 0.5, 1], [3.5, 0.5, 1]], "
        "positions: 4}, factor: 2}]"
    )
    for number, case in enumerate(build_model(deck(tmp_path, ROW, GROUND, loads)).load_cases):
        assert case.live_load[:, 0] == pytest.approx(9.81 * 2000 * np.ones(4))
        assert case.live_load[:, 2].tolist() == [-20.0 * (block == number) for block in range(4)]


def test_it_lands_on_the_floor_it_is_drawn_on(tmp_path: Path) -> None:
    for z, block in ((1, 0), (2.9, 0), (3.2, 3), (4, 3), (8, 3)):
        travel = f"force: [0, 0, -1], path: [[1.1, 0.5, {z}], [1.9, 0.5, {z}]], positions: 2"
        found = model(tmp_path, travel, TWO_STOREYS)
        assert [case.question.place.blocks[0] for case in found.load_cases] == [block, block], z
    below = "force: [0, 0, -1], path: [[1.1, 0.5, 9], [1.9, 0.5, 9]], positions: 2"
    found = model(tmp_path, below, TWO_STOREYS, ", on: lower")
    assert [case.question.place.blocks[0] for case in found.load_cases] == [0, 0]


def test_on_an_edge_and_on_a_corner(tmp_path: Path) -> None:
    """The ends of paths often lie on edges: 0 and 4 are the ends of the row, y = 0 its side, x = 1 a joint."""
    found = model(tmp_path, "force: [0, 0, -1], path: [[0, 0, 1], [4, 0, 1]], positions: 5", ROW)
    assert [case.question.place.blocks[0] for case in found.load_cases] == [0, 0, 1, 2, 3]


def test_against_gravity_and_sideways(tmp_path: Path) -> None:
    path = "force: [5, 0, 0], path: [[-1, 0.5, 0.2], [-1, 0.5, 0.8]], positions: 3, towards: [1, 0, 0]"
    assert [case.question.place.blocks[0] for case in model(tmp_path, path, ROW).load_cases] == [0, 0, 0]


def test_axles_follow_at_their_distances(tmp_path: Path) -> None:
    """From the first at the beginning to the last at the end; who is not on the path does not act."""
    axles = "axles: [{behind: 2, force: [0, 0, -3]}, {behind: 0.5, force: [0, 0, -5]}]"
    path = f"force: [0, 0, -1], path: [[0.25, 0.5, 1], [3.25, 0.5, 1]], positions: 11, {axles}"
    found = model(tmp_path, path, ROW, ", factor: 2").load_cases
    downwards = [(-case.live_load[:, 2] / 2).tolist() for case in found]
    assert downwards == [
        [1, 0, 0, 0],
        [6, 0, 0, 0],
        [5, 1, 0, 0],
        [0, 6, 0, 0],
        [3, 5, 1, 0],
        [3, 0, 6, 0],
        [0, 3, 5, 1],
        [0, 3, 0, 5],
        [0, 0, 3, 0],
        [0, 0, 3, 0],
        [0, 0, 0, 3],
    ]
    assert found[1].live_load[0] == pytest.approx([0, 0, -12, 0, 2 * (0.25 - 5 * 0.25), 0])
    places = [case.question.place for case in found]
    assert [place.distance for place in places] == pytest.approx(np.linspace(0, 5, 11))
    assert places[8].points == pytest.approx(np.array([[4.25, 0.5, 1], [2.25, 0.5, 1], [3.75, 0.5, 1]]))
    assert places[8].forces == pytest.approx(np.array([[0, 0, -2], [0, 0, -6], [0, 0, -10]]))
    assert places[8].blocks.tolist() == [-1, 2, -1]
    assert places[0].distances == pytest.approx([0, -2, -0.5])
    assert places[0].points[1] == pytest.approx([-1.75, 0.5, 1])
    assert found[8].live_words == (
        "force (0, 0, -6) N at (2.25, 0.5, 1) m on row[2], position 9 of 11, first axle 4 m along the path, "
        "2 of 3 axles off the path",
    )
    assert found[1].live_words == (
        "force (0, 0, -2) N at (0.75, 0.5, 1) m on row[0] and force (0, 0, -10) N at (0.25, 0.5, 1) m on row[0], "
        "position 2 of 11, first axle 0.5 m along the path, 1 of 3 axles off the path",
    )


def test_axles_beyond_the_path_are_told(tmp_path: Path) -> None:
    """The second axle, 1 m behind, has a third of the force and is not on the path at the first of 4 positions."""
    axles = "axles: [{behind: 1, force: [0, 0, -5]}], path: [[0.5, 0.5, 1], [3.5, 0.5, 1]], positions: 4"
    notices = model(tmp_path, f"force: [0, 0, -10], {axles}", ROW).notices
    text = next(each.message for each in notices if each.identifier == "axles-beyond-path")
    assert "at 2 of " in text or "at 1 of " in text
    assert "of the whole force" in text
    alone = model(tmp_path, "force: [0, 0, -10], path: [[0.5, 0.5, 1], [3.5, 0.5, 1]], positions: 4", ROW)
    assert not {"axles-beyond-path", "axle-upwards"} & {each.identifier for each in alone.notices}


@pytest.mark.parametrize(("force", "factor"), [(10, 1), (-10, -1)])
def test_an_axle_that_points_upwards(force: int, factor: int, tmp_path: Path) -> None:
    given = f"force: [0, 0, {force}], path: [[0.5, 0.5, 1], [3.5, 0.5, 1]], positions: 4"
    found = model(tmp_path, given, ROW, f", factor: {factor}")
    text = next(each.message for each in found.notices if each.identifier == "axle-upwards")
    assert "1 axle points upwards" in text
