"""Motions, small and finite."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
from scipy.linalg import expm

from mbla.arrays import FloatArray
from mbla.results.collapse.finite_motion import MOST_PARTS, closed_motion, finite_motion
from mbla.results.collapse.motion import (
    LARGEST_ROTATION,
    SHARE_OF_SIZE,
    contact_displacements,
    drawn_motion,
    motion_scale,
    movable_size,
    moved_contact_points,
    moved_vertices,
    rotation_vectors,
    screw_matrices,
    screws,
    vertex_displacements,
)
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.scene import scene_of as picture_of
from mbla.results.record.scene import scene_of
from mbla.results.results import Results
from mbla.results.vtu.vtu import write_frame_vtu
from mbla.run import RunOptions, run
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


def test_tower_turns_about_its_edge(results: Results) -> None:
    motion = drawn_motion(results.model, results.cases[0])
    moved = vertex_displacements(results.model.blocks, motion)
    vertices = results.model.blocks.vertices
    edge = (vertices[:, 0] == 1) & (vertices[:, 2] == 1)
    assert edge.sum() == 2
    assert moved[edge] == pytest.approx(0, abs=1e-12)
    top = (vertices[:, 0] == 1) & (vertices[:, 2] == 3)
    assert (moved[top][:, 0] > 0).all()


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


def test_blocks_that_move_as_one_do_not_part(results: Results) -> None:
    blocks = results.model.blocks
    turn, travel = np.array([0.2, -0.7, 1.1]), np.array([0.5, 0.0, -0.3])
    motion = np.zeros((3, 6))
    motion[1:, 3:] = turn
    motion[1:, :3] = travel + np.cross(turn, blocks.centroids[1:] - blocks.centroids[1])
    moved = moved_vertices(blocks, motion)
    both = blocks.block_of_vertex > 0
    before, after = blocks.vertices[both], moved[both]
    pairs = np.linalg.norm(before[:, None] - before[None], axis=2)
    assert np.linalg.norm(after[:, None] - after[None], axis=2) == pytest.approx(pairs)
    assert moved[~both] == pytest.approx(blocks.vertices[~both], abs=0)


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


def test_certificate_moves_where_there_is_no_equilibrium(results: Results) -> None:
    motion = drawn_motion(results.model, results.cases[1])
    assert motion[1, 2] < 0
    assert not motion[[0, 2]].any()


def test_contact_points_move_with_the_mean_of_their_bodies(results: Results) -> None:
    motion = np.zeros((3, 6))
    motion[1, 0] = 1.0
    moved = contact_displacements(results.model, results.contacts, motion)
    assert moved[:4] == pytest.approx(np.tile([0.5, 0, 0], (4, 1)))
    assert not moved[4:].any()


# --- Parts that stay together at their hinges when a mechanism is drawn with finite rotations -----------------------


DECKS = Path("decks")


@pytest.fixture(
    scope="module", params=["benchmarks/closed_forms/arch_20_voussoirs", "benchmarks/closed_forms/spreading_arch"]
)
def finite_results(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Results:
    """Four hinges under an acceleration; three under a support that gives way sideways."""
    options = RunOptions(folder=tmp_path_factory.mktemp("arch"), overrides=("output.vtu=false",))
    return run(DECKS / f"{request.param}.yaml", options)


def parts_of(finite_results: Results) -> tuple[Any, Any, Any]:
    case = finite_results.cases[0]
    return finite_results.model.of_case(case.load_case), finite_results.contacts, case


def widest_hinge(finite_results: Results, motion: FloatArray) -> float:
    """Largest distance between both sides of a contact point that does not open or slide, over the size."""
    model, contacts, case = parts_of(finite_results)
    sides = [moved_contact_points(model, contacts, motion, side) for side in (0, 1)]
    still = np.linalg.norm(case.solution.mechanics.contact_velocities, axis=1)
    still = still <= 1e-6 * still.max()
    assert still.any()
    return float(np.linalg.norm(sides[1] - sides[0], axis=1)[still].max()) / movable_size(model)


@pytest.mark.parametrize("share", [0.3, 1.0])
def test_parts_do_not_come_apart_at_their_hinges(finite_results: Results, share: float) -> None:
    model, contacts, case = parts_of(finite_results)
    alone = share * drawn_motion(model, case)
    together = finite_motion(model, contacts, case, share)
    assert widest_hinge(finite_results, alone) > 1e-3 * share
    assert widest_hinge(finite_results, together) < 1e-5
    before, after = model.blocks.vertices[:8], moved_vertices(model.blocks, together)[:8]
    sizes = [np.linalg.norm(points[:, None] - points[None], axis=2) for points in (before, after)]
    assert sizes[1] == pytest.approx(sizes[0])
    far = [np.linalg.norm(moved_vertices(model.blocks, each) - model.blocks.vertices, axis=1).max() for each in
           (alone, together)]  # fmt: skip
    assert 0.5 * far[0] < far[1] < 1.5 * far[0]


@pytest.mark.parametrize("finite_results", ["benchmarks/closed_forms/spreading_arch"], indirect=True)
def test_a_support_that_gives_way_keeps_its_direction(finite_results: Results) -> None:
    model, contacts, case = parts_of(finite_results)
    settlement = case.load_case.settlement
    assert settlement is not None
    travel = screws(finite_motion(model, contacts, case))[1][settlement.blocks]
    way = settlement.motions[:, :3] / np.linalg.norm(settlement.motions[:, :3], axis=1, keepdims=True)
    along = np.einsum("ni,ni->n", travel, way)
    assert (along > 0).all()
    assert travel == pytest.approx(along[:, None] * way, abs=1e-9)


def test_pictures_and_frames_for_paraview_move_parts_together(finite_results: Results, tmp_path: Path) -> None:
    model, contacts, case = parts_of(finite_results)
    together = finite_motion(model, contacts, case)
    assert picture_of(finite_results, case, PictureOptions(), "mechanism").motion == pytest.approx(together)
    write_frame_vtu(tmp_path / "frame.vtu", scene_of(finite_results, case), 1.0)
    moved = moved_vertices(model.blocks, together) - model.blocks.vertices
    found = meshio.read(tmp_path / "frame.vtu").point_data["displacement"]
    assert np.abs(found).max() == pytest.approx(np.abs(moved).max())


def test_a_mechanism_that_does_not_reach_so_far_is_drawn_part_by_part(finite_results: Results) -> None:
    """At ten times the usual size the arch would have to go through itself."""
    model, contacts, case = parts_of(finite_results)
    alone = 10 * drawn_motion(model, case)
    assert closed_motion(model, contacts, alone, np.zeros(0, dtype=np.int64)) is alone


def test_one_part_alone_follows_its_screw(monkeypatch: pytest.MonkeyPatch) -> None:
    finite_results = tower_results()
    model, contacts, case = parts_of(finite_results)
    assert finite_motion(model, contacts, case) == pytest.approx(drawn_motion(model, case), abs=0)
    assert finite_motion(model, contacts, None) == pytest.approx(np.zeros((3, 6)), abs=0)


def test_of_very_many_parts_each_follows_its_own(finite_results: Results, monkeypatch: pytest.MonkeyPatch) -> None:
    assert MOST_PARTS > 100
    monkeypatch.setattr("mbla.results.collapse.finite_motion.MOST_PARTS", 2)
    model, contacts, case = parts_of(finite_results)
    assert finite_motion(model, contacts, case) == pytest.approx(drawn_motion(model, case), abs=0)


def test_rotation_vectors_are_the_way_back_from_rotation_matrices() -> None:
    rng = np.random.default_rng(3)
    axes = rng.normal(size=(60, 3))
    vectors = axes / np.linalg.norm(axes, axis=1)[:, None] * np.linspace(0.0, np.pi * (1.0 - 1e-9), 60)[:, None]
    small = 1e-9 * axes
    for given in (vectors, small, np.pi * (1.0 - 1e-12) * np.eye(3)):
        assert rotation_vectors(screw_matrices(given)[0]) == pytest.approx(given, abs=1e-14, rel=1e-9)
