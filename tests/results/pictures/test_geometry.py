from dataclasses import replace

import numpy as np
import pytest

from mbla.model.model import Model
from mbla.results.pictures.geometry import (
    block_edges,
    edges_of_blocks,
    front_axis,
    ground_slab,
    hinge_axes,
    interface_sides,
    live_load_arrow,
)
from tests.results.shapes import BRICK, TETRA, WEDGE, blocks_of
from tests.results.synthetic import tower_contacts, tower_model


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
    slab = ground_slab(model, tower_contacts(), 0, 10.0)
    assert slab is not None
    assert slab[:, 2].max() == pytest.approx(0)
    assert slab[:, 2].min() == pytest.approx(-0.2)
    assert slab[:, 0].min() < 4 < 5 < slab[:, 0].max()
    assert ground_slab(model, tower_contacts(), 1, 10.0) is None


def test_hinge_axis_joins_the_closed_corners() -> None:
    chosen = np.array([False, True, True, False, False, False, False, True])
    assert hinge_axes(tower_contacts(), chosen).tolist() == [[1, 2]]


def test_sides_of_an_interface_close() -> None:
    assert interface_sides(tower_contacts(), np.array([False, True])).tolist() == [[4, 5], [5, 6], [6, 7], [7, 4]]


def test_arrow_points_where_the_load_pushes(model: Model) -> None:
    low, high = np.zeros(3), np.array([5.0, 1, 3])
    start, tip = live_load_arrow(model, model.load_cases[0], low, high, 0.5)
    assert tip - start == pytest.approx([0.5, 0, 0])
    assert start[2] > 3


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


@pytest.mark.parametrize("pushes", [(0.0, 0.0), (1.0, -1.0)])
def test_a_load_without_a_resultant_has_no_arrow(model: Model, pushes: tuple[float, float]) -> None:
    """Start and tip are one point, above the middle of the box."""
    live = np.zeros((3, 6))
    live[1:, 0] = pushes
    start, tip = live_load_arrow(
        model, replace(model.load_cases[0], live_load=live), np.zeros(3), np.array([5.0, 1, 3]), 0.5
    )
    assert (start == tip).all()
    assert start == pytest.approx([2.5, 0.5, 3.175])
