"""Joints that meet, cracks and yield lines."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.model.model import Model
from mbla.results.collapse.clusters import ENOUGH, FEW, clusters_of
from mbla.results.collapse.cracks import touching_pairs, yield_lines
from mbla.results.listing.listing import listing
from mbla.results.listing.summary import summary_lines
from mbla.results.record.json_record import results_json
from mbla.run import RunOptions, run
from tests.results.collapse.solved_state import State, moved
from tests.results.collapse.test_invariance import TURN
from tests.results.synthetic import cuboids, horizontal_contacts, tower_mechanics, tower_model, tower_results


@pytest.mark.parametrize("turn", [np.eye(3), TURN])
def test_neighbours_touch_and_others_do_not(turn: np.ndarray) -> None:
    """Unit squares: side by side, at a corner, a tenth apart in the plane, a tenth above."""
    squares = [(0, 1, 0, 1, 0), (1, 2, 0, 1, 0), (2, 3, 1, 2, 0), (3.1, 4.1, 1, 2, 0), (0, 1, 0, 1, 0.1)]
    contacts = horizontal_contacts([[0, 1]] * 5, squares)
    load_case = tower_results().cases[0].load_case
    state = State(tower_model(), contacts, load_case, tower_mechanics(), "concave", 3)
    contacts = moved(state, turn, np.array([7.0, -3.0, 2.0])).contacts
    assert touching_pairs(contacts, np.arange(5)).tolist() == [[0, 1], [1, 2]]
    assert len(touching_pairs(contacts, np.array([0]))) == 0


# --- What falls as few parts, and the lines along which these break off ---------------------------------------------


SIDE = 12
"""cubes of 1 m along each edge of a wall"""


def wall() -> Model:
    lower = np.array([[i, 0.0, j] for j in range(SIDE) for i in range(SIDE)])
    blocks = cuboids(lower, lower + 1, ["wall"] * SIDE**2)
    return replace(tower_model(), blocks=blocks, fixed=np.zeros(SIDE**2, dtype=bool), grounds=(), load_cases=())


def turning(model: Model, point: FloatArray, axis: FloatArray) -> FloatArray:
    """Motion of every block about an axis through a point, (n_blocks, 6)."""
    spin = np.tile(axis, (len(model.blocks), 1))
    return np.hstack([np.cross(spin, model.blocks.centroids - point), spin])


def diagonal(model: Model) -> tuple[FloatArray, BoolArray]:
    """What lies above the line from the lower right corner to the upper left one turns about it; who does."""
    axis = np.array([-1.0, 0, 1]) / np.sqrt(2)
    above = model.blocks.centroids[:, [0, 2]].sum(axis=1) > SIDE + 0.1
    return np.where(above[:, None], turning(model, np.array([SIDE, 0.5, 0]), axis), 0.0), above


def every_block(motion: FloatArray) -> IntArray:
    """Number of a part for each block that moves."""
    moving = motion.any(axis=1)
    return np.asarray(np.where(moving, np.cumsum(moving), 0), dtype=np.int64)


@pytest.mark.parametrize("noise", [0.0, 0.02])
def test_many_small_parts_that_turn_about_one_line_are_one(noise: float) -> None:
    model = wall()
    motion, above = diagonal(model)
    motion[above] += noise * np.random.default_rng(3).normal(size=(int(above.sum()), 6))
    parts = every_block(motion)
    found = clusters_of(model, parts, motion)
    assert len(found.motions) == 1
    chosen = found.of_block > 0
    assert chosen[above].mean() > 0.9
    assert not chosen[~above].any()
    assert found.explained >= (1 - 1e-9 if noise == 0 else 0.98)
    assert found.motions[0].direction == pytest.approx([-(0.5**0.5), 0, 0.5**0.5], abs=2 * noise + 1e-9)


def test_two_that_turn_apart_are_two_the_heavier_first() -> None:
    """Left of the middle about a vertical line there, right of it about the foot."""
    model = wall()
    left = model.blocks.centroids[:, 0] < 5
    foot = turning(model, np.array([0.0, 0, 0]), np.array([1.0, 0, 0]))
    door = turning(model, np.array([5.0, 0, 0]), np.array([0.0, 0, 3.0]))
    motion = np.where(left[:, None], door, foot)
    parts = every_block(motion)
    found = clusters_of(model, parts, motion)
    assert found.of_block.tolist() == np.where(left, 2, 1).tolist()
    assert found.explained == pytest.approx(1.0)


def test_a_motion_that_few_parts_do_not_explain_is_told_as_it_was() -> None:
    model = wall()
    motion = np.random.default_rng(5).normal(size=(SIDE**2, 6))
    parts = every_block(motion)
    found = clusters_of(model, parts, motion)
    assert len(found.motions) == SIDE**2 > FEW
    assert found.explained == 1.0


def stepped(rises: list[int]) -> tuple[IntArray, IntArray]:
    """Blocks of the wall above a course for each column, and its horizontal joints as bodies and rectangles."""
    parts = np.array([1 if j >= rises[i] else 0 for j in range(SIDE) for i in range(SIDE)])
    return parts, np.array([(SIDE * (j - 1) + i, SIDE * j + i) for j in range(1, SIDE) for i in range(SIDE)])


@pytest.mark.parametrize(
    ("rises", "points"),
    [
        ([*range(1, SIDE), SIDE - 1], 2),
        ([3] * SIDE, 2),
        ([1, 1, 1, 1, 1, 1, 1, 3, 5, 7, 9, 11], 3),
    ],
    ids=["diagonal", "level", "level, then steep"],
)
def test_a_line_leads_through_the_joints_with_as_few_corners_as_will_do(rises: list[int], points: int) -> None:
    parts, bodies = stepped(rises)
    rectangles = [(i, i + 1, 0, 1, j) for j in range(1, SIDE) for i in range(SIDE)]
    (line,) = yield_lines(horizontal_contacts(bodies, rectangles), parts, 0)
    assert (line.parts, len(line.interfaces), len(line.points)) == ((1, 0), SIDE, points)
    at = np.interp(np.arange(SIDE) + 0.5, *line.points[np.argsort(line.points[:, 0])][:, [0, 2]].T)
    assert np.abs(at - rises).max() < 0.7
    assert line.points[:, 1] == pytest.approx(0.5)
    assert line.points[0, 2] <= line.points[-1, 2]
    if rises[0] == rises[-1]:
        assert line.inclination == pytest.approx(0, abs=1e-6)
        assert line.off == pytest.approx(0, abs=1e-9)
        assert line.length == pytest.approx(SIDE - 1)


def test_a_facade_says_what_falls_and_along_which_line(tmp_path: Path) -> None:
    results = run(
        Path("decks/regressions/facade_yield_line.yaml"), RunOptions(folder=tmp_path, overrides=("output.vtu=false",))
    )
    assert "move mainly as one rigid part" in " ".join(" ".join(summary_lines(results)).split())
    told = "breaks off the stationary blocks along (4.32, 0.31, 0) - (0.28, 0.28, 1.23) - (0.32, 0.96, 3.06),"
    assert told in " ".join(listing(results).split())
    mechanism = results_json(results)["cases"][0]["mechanism"]
    assert len(mechanism["main_parts"]) == 1
    assert mechanism["main_parts_explain"] > ENOUGH
    (line,) = mechanism["yield_lines"]
    assert line["parts"] == [1, 0]
    assert np.array(line["points"]).round(2).tolist() == [[4.32, 0.31, 0.0], [0.28, 0.28, 1.23], [0.32, 0.96, 3.06]]
