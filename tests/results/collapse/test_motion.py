"""Motions, small and finite."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import expm

from mbla.model.pose import screws
from mbla.results.collapse.motion import (
    LARGEST_ROTATION,
    SHARE_OF_SIZE,
    drawn_motion,
    mean_displacements,
    motion_scale,
    movable_size,
    moved_vertices,
    rigid_frames,
    vertex_displacements,
)
from mbla.results.results import Results
from tests.results.synthetic import tower_results


@pytest.fixture(scope="module")
def results() -> Results:
    return tower_results()


def test_screws_are_exponentials_of_twists() -> None:
    motions = np.random.default_rng(0).normal(size=(20, 6))
    motions[0, 3:] = 0
    motions[1, 3:] *= 1e-9
    for motion, rotation, travel in zip(motions, *screws(motions), strict=True):
        x, y, z = motion[3:]
        twist = np.zeros((4, 4))
        twist[:3, :3] = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
        twist[:3, 3] = motion[:3]
        moved = expm(twist)
        assert rotation == pytest.approx(moved[:3, :3], abs=1e-12)
        assert travel == pytest.approx(moved[:3, 3], abs=1e-12)


def test_farthest_corner_moves_by_the_stated_share(results: Results) -> None:
    motion = drawn_motion(results.model, results.cases[0])
    moved = np.linalg.norm(vertex_displacements(results.model.blocks, motion), axis=1)
    assert moved.max() == pytest.approx(SHARE_OF_SIZE * movable_size(results.model))


def test_finite_motion_keeps_distances_and_begins_as_the_linear_one(results: Results) -> None:
    blocks = results.model.blocks
    motion = np.random.default_rng(1).normal(size=(3, 6))
    moved = moved_vertices(blocks, motion)
    for b in range(3):
        before, after = blocks.vertices[8 * b : 8 * b + 8], moved[8 * b : 8 * b + 8]
        pairs = np.linalg.norm(before[:, None] - before[None], axis=2)
        assert np.linalg.norm(after[:, None] - after[None], axis=2) == pytest.approx(pairs)
    small = 1e-6 * motion
    linear = vertex_displacements(blocks, small)
    assert moved_vertices(blocks, small) - blocks.vertices == pytest.approx(linear, abs=1e-10)


def test_a_hinge_stays_in_place_however_far_the_part_turns(results: Results) -> None:
    motion = drawn_motion(results.model, results.cases[0])
    vertices = results.model.blocks.vertices
    edge = (vertices[:, 0] == 1) & (vertices[:, 2] == 1)
    assert moved_vertices(results.model.blocks, 10 * motion)[edge] == pytest.approx(vertices[edge], abs=1e-12)


def test_small_spinning_block_does_not_turn_several_times(results: Results) -> None:
    motion = np.zeros((3, 6))
    motion[2, 5] = 1.0
    motion[1, 0] = 1e-3
    scaled = motion_scale(results.model, motion) * motion
    assert np.linalg.norm(scaled[:, 3:], axis=1).max() == pytest.approx(LARGEST_ROTATION)


def test_contact_points_move_with_the_mean_of_their_bodies(results: Results) -> None:
    motion = np.zeros((3, 6))
    motion[1, 0] = 1.0
    contacts = results.contacts
    bodies = contacts.bodies[contacts.interface_of_point]
    moved = mean_displacements(results.model.blocks, motion, bodies, contacts.points)
    assert moved[:4] == pytest.approx(np.tile([0.5, 0, 0], (4, 1)))
    assert not moved[4:].any()


def test_frames_are_where_the_pictures_draw_the_blocks() -> None:
    results = tower_results()
    blocks, origin = results.model.blocks, np.array([3.0, -2.0, 1.0])
    motion = np.array([[0.0] * 6, [0.3, 0, 0.1, 0, 0.5, 0.2], [0.0, 0, 0, 0, 0, 0]])
    parts, frames = rigid_frames(blocks, motion, origin, 4)
    assert parts.tolist() == [0, 1, 0]
    own = parts[blocks.block_of_vertex]
    for frame, share in zip(frames, (0.0, 0.25, 0.5, 0.75, 1.0), strict=True):
        turned = np.einsum("vij,vj->vi", frame[own, :, :3], blocks.vertices - origin)
        expected = moved_vertices(blocks, share * motion)
        np.testing.assert_allclose(turned + frame[own, :, 3] + origin, expected, atol=1e-12)


def test_blocks_that_move_as_one_are_one_part() -> None:
    blocks = tower_results().model.blocks
    turn = np.array([0.1, 0.4, -0.2])
    motion = np.hstack([np.cross(turn, blocks.centroids), np.tile(turn, (len(blocks), 1))])
    parts, frames = rigid_frames(blocks, motion, np.zeros(3), 2)
    assert parts.tolist() == [1] * len(blocks)
    assert frames.shape == (3, 2, 3, 4)
