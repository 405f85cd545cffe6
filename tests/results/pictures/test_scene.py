"""What a scene knows of a case, and the shapes and places of a picture."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.model.model import Model
from mbla.results.pictures.geometry import block_edges, edges_of_blocks, front_axis, ground_slabs
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import GROUPS, SLOW
from mbla.results.pictures.scene import part_colours, scene_of
from mbla.solution.solution import Standing, StandingResult, Status
from tests.asked import settlement_of
from tests.results.shapes import BRICK, TETRA, WEDGE, blocks_of
from tests.results.synthetic import full_results, tower_contacts, tower_mechanics, tower_model, tower_results

FORCES = tower_mechanics().contact_forces


@pytest.mark.parametrize(
    ("status", "solution", "told"),
    [
        (Status.UNBOUNDED, {"lock": FORCES}, "that balance the live load alone: any multiple of it is carried"),
        (
            Status.NOT_VERIFIED,
            {"standing": StandingResult(Standing.YES, 0, "", FORCES, np.zeros((3, 6)))},
            "under the dead load alone",
        ),
    ],
)
def test_forces_without_a_load_factor_are_told_as_such(status: Status, solution: dict[str, Any], told: str) -> None:
    results = tower_results()
    case = replace(results.cases[0], status=status)
    case = replace(case, solution=replace(case.solution, mechanics=None, status=status, **solution))
    scene = scene_of(results, case, PictureOptions(), "forces")
    assert scene.forces is not None
    assert np.array_equal(scene.forces, FORCES)
    assert scene.words_of("forces")[-1] == f"contact forces {told}"


def test_forces_of_a_support_that_gives_way_are_not_those_of_a_live_load() -> None:
    results = full_results()
    scene = scene_of(results, results.cases[0], PictureOptions(), "forces")
    settlement = settlement_of(scene.case.load_case)
    assert scene.force_words == "contact forces under dead load as the support gives way; others may be possible"
    assert not scene.dead_load[settlement.blocks].any()


def test_without_forces_there_are_no_lines_of_thrust() -> None:
    results = tower_results()
    falls = scene_of(results, results.cases[1], PictureOptions(), "forces")
    assert falls.forces is None
    assert falls.thrust is None


@pytest.fixture(scope="module")
def model() -> Model:
    return tower_model()


def test_every_edge_is_drawn_once() -> None:
    blocks = blocks_of([TETRA, BRICK, WEDGE])
    edges = block_edges(blocks)
    assert len(edges) == 6 + 12 + 9
    chosen = np.array([False, True, False])
    assert len(edges_of_blocks(blocks, edges, chosen)) == 12


def test_diagonals_inside_a_plane_are_not_drawn() -> None:
    corners = BRICK[0]
    faces = [[0, 3, 2], [0, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    blocks = blocks_of([(corners, faces, 2.0)])
    assert len(block_edges(blocks)) == 13
    low = blocks.face_normals @ blocks.face_normals.T > 0.999
    facets = np.array([int(np.flatnonzero(row)[0]) for row in low])
    object.__setattr__(blocks, "facet_of_face", facets)
    assert len(block_edges(blocks)) == 12


def test_slab_lies_behind_the_ground(model: Model) -> None:
    (found,) = ground_slabs(model, tower_contacts(), 0, 10.0)
    slab = found.points
    assert slab[:, 2].max() == pytest.approx(0)
    assert slab[:, 2].min() == pytest.approx(-0.2)
    assert slab[:, 0].min() < 4 < 5 < slab[:, 0].max()
    assert not ground_slabs(model, tower_contacts(), 1, 10.0)


@pytest.mark.parametrize(
    ("extents", "travel", "axis"),
    [
        ([4, 0.2, 3], [1, 0, 0.2], 1),
        ([0.2, 4, 3], [0, 1, 0.2], 0),
        ([4, 0.2, 3], [0, 1, 0.2], None),
        ([4, 4, 3], [1, 0, 0], None),
        ([4, 0.2, 3], [0, 0, 0], 1),
    ],
)
def test_thin_structures_are_seen_from_the_front(extents: list[float], travel: list[float], axis: int | None) -> None:
    assert front_axis(np.array(extents, float), np.array(travel, float)) == axis


def test_what_moves_in_no_part_of_the_listing_is_not_drawn_at_rest() -> None:
    """Few parts stand for many: what moves less than these is of none, and moves all the same."""
    results = tower_results()
    scene = scene_of(results, results.cases[0], PictureOptions(), "mechanism")
    none = np.zeros(len(scene.model.blocks), dtype=np.int64)
    assert scene._moving is not None
    assert scene.failure is not None
    moves = scene._moving[0].parts > 0
    assert moves.any()
    assert not scene.slow.any()
    object.__setattr__(scene, "failure", replace(scene.failure, clusters=none))
    assert np.array_equal(scene.slow, moves)
    colours = np.array(part_colours(scene, GROUPS))
    assert (colours[moves] == SLOW).all()
    assert SLOW not in colours[~moves]
