"""Which contact points reductions leave out, and which stand for one place."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.arrays import IntArray
from mbla.program.reductions.points import without_inner_points
from mbla.program.reductions.restrict import chosen_limits, restricted, selection
from mbla.program.reductions.scene import Scene, part_of
from tests.line import BLOCK, HEAD
from tests.program.reductions.scenes import scene

SADDLE = (
    HEAD
    + """\
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: lower, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - polyhedron:
      group: saddle
      material: stone
      vertices: [[0, 0, 1], [1, 0, 1], [1, 0, 0.5], [2, 0, 0.5], [2, 0, 2], [0, 0, 2],
                 [0, 1, 1], [1, 1, 1], [1, 1, 0.5], [2, 1, 0.5], [2, 1, 2], [0, 1, 2]]
      faces: [[0, 1, 2, 3, 4, 5], [6, 7, 8, 9, 10, 11], [0, 1, 7, 6], [1, 2, 8, 7], [2, 3, 9, 8], [3, 4, 10, 9],
              [4, 5, 11, 10], [5, 0, 6, 11]]
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0.2, 0]}]}}
analysis: {flow_rule: associative}
"""
)
"""A block that sits on another one and leans against its side: two planes between one pair of bodies."""


def points_alone(whole: Scene, points: IntArray) -> Scene:
    """The scene with some of its points."""
    n = len(whole.centroids)
    blocks = selection(np.arange(n), n, 6)
    limits = chosen_limits(whole.program.limits, points)
    program = restricted(whole.program, blocks, selection(points, whole.program.n_points, 3), limits)
    return part_of(whole, program, np.arange(n), points)


def test_corners_of_a_finer_joint_are_kept() -> None:
    kept = without_inner_points(scene(BLOCK, "contacts.points.per_edge=3"))
    assert sorted(kept.points[:, :2].tolist()) == [[0, 0], [0, 1], [1, 0], [1, 1]]
    assert kept.program.n_points == 4


def test_points_that_bear_tension_are_all_kept() -> None:
    """There the velocity inside may reach a limit that it does not reach at the corners."""
    for law in ("{friction: 0.5, cohesion: 10}", "{friction: 0.5, compressive_strength: 1.e6}"):
        whole = scene(BLOCK, "contacts.points.per_edge=3", f"joints.dry={law}")
        assert without_inner_points(whole) is whole


def test_planes_of_one_pair_of_bodies_keep_their_own_corners() -> None:
    whole = scene(SADDLE, "contacts.points.per_edge=2")
    kept = without_inner_points(whole)
    between = (kept.bodies >= 0).all(axis=1)
    seat = between & (np.abs(kept.frames[:, 0, 2]) > 0.5)
    side = between & (np.abs(kept.frames[:, 0, 0]) > 0.5)
    assert sorted(kept.points[seat].tolist()) == [[0, 0, 1], [0, 1, 1], [1, 0, 1], [1, 1, 1]]
    assert sorted(kept.points[side].tolist()) == [[1, 0, 0.5], [1, 0, 1], [1, 1, 0.5], [1, 1, 1]]


@pytest.mark.parametrize("axis", [0, 1])
def test_of_points_on_one_line_its_ends_are_kept(axis: int) -> None:
    whole = scene(BLOCK, "contacts.points.per_edge=4")
    edge = points_alone(whole, np.flatnonzero(whole.points[:, 1 - axis] == 0.0))
    assert len(edge.points) == 5
    assert sorted(without_inner_points(edge).points[:, axis].tolist()) == [0.0, 1.0]
