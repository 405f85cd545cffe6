"""Planes about which a structure and its loads may be symmetric."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.program.reductions import reduce_program
from mbla.program.reductions.mirror import half_of, mirror_about, mirror_candidates
from mbla.program.reductions.steps import ReductionSwitches
from tests.line import BLOCK, WALL, line_of
from tests.program.reductions.scenes import scene

TURNED = WALL.replace("courses:", "transform: [{rotate: {axis: [0, 0, 1], angle: 30}}], courses:")
ALONG = np.array([np.cos(np.pi / 6), np.sin(np.pi / 6), 0.0])
ACROSS = np.array([-np.sin(np.pi / 6), np.cos(np.pi / 6), 0.0])


def push(*acceleration: float) -> str:
    return f"load_cases.push.live=[{{acceleration: [{', '.join(map(str, acceleration))}]}}]"


def test_a_plane_holds_both_resultants() -> None:
    for found in ([0.0, 1.0, 0.0], [1.0, 0.0, 0.0]):
        direction = np.cross(found, [0, 0, 1])
        candidates = list(mirror_candidates(scene(BLOCK, push(*direction))))
        assert len(candidates) == 1
        assert np.abs(candidates[0]) == pytest.approx(found, abs=1e-12)


def test_a_plane_that_all_joints_are_seen_edge_on_in_comes_first() -> None:
    """Loads along one line alone lie in many planes."""
    first, *others = mirror_candidates(scene(TURNED, push(0, 0, -1)))
    assert abs(float(first @ ACROSS)) == pytest.approx(1.0, abs=1e-12)
    assert any(abs(float(other @ ALONG)) == pytest.approx(1.0, abs=1e-12) for other in others)


def test_blocks_and_points_go_to_their_images() -> None:
    whole = scene(WALL, push(0, 1, 0))
    mirror = mirror_about(whole, np.array([1.0, 0.0, 0.0]))
    assert mirror is not None
    middle = whole.centroids[:, 0].mean()
    for places, image in ((whole.centroids, mirror.block_of), (whole.points, mirror.point_of)):
        assert places[image, 0] == pytest.approx(2 * middle - places[:, 0], abs=1e-12)
        assert places[image, 1:] == pytest.approx(places[:, 1:], abs=1e-12)
    assert mirror_about(whole, np.array([0.0, 1.0, 0.0])) is None  # the load is not symmetric about that plane


def test_motions_of_a_half_keep_their_size() -> None:
    whole = scene(WALL, push(0, 1, 0))
    mirror = mirror_about(whole, np.array([1.0, 0.0, 0.0]))
    assert mirror is not None
    half = half_of(whole, mirror)
    assert half.reduction is not None
    gram = half.reduction.velocities.T @ half.reduction.velocities
    assert gram.toarray() == pytest.approx(np.eye(gram.shape[0]), abs=1e-12)


@pytest.mark.parametrize(("offset", "planes"), [(1.0, 1), (1.5, 0)])
def test_without_dilatancy_a_half_is_left_out_about_a_given_plane_alone(offset: float, planes: int) -> None:
    line = line_of(WALL, push(0, 1, 0), "analysis.flow_rule=non_associative")
    middle = float(line.model.blocks.centroids[:, 0].mean())
    model = replace(line.model, mirrors=((1.0, 0.0, 0.0, offset * middle),))
    reduced = reduce_program(model, line.contacts, line.program, ReductionSwitches(), associative=False)
    assert reduced.size.mirror_planes == planes


def test_a_part_that_touches_nothing_has_no_plane() -> None:
    flying = BLOCK.replace(
        "supports:", "  - box: {group: flying, material: stone, min: [5, 0, 9], max: [6, 1, 10]}\nsupports:"
    )
    line = line_of(flying)
    reduced = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=True)
    assert sorted((part.n_points, part.components) for part in reduced.parts) == [(0, 3), (2, 2)]
