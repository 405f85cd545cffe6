from __future__ import annotations

import numpy as np
import pytest

from mbla.model.geometry.gaps import FLAT, flat_faces, insert_t_junctions, lone_edge_corners, shortest_edges
from mbla.model.geometry.welding import own_vertices, weld, weld_near
from mbla.model.solids.polyhedra import Polyhedra
from tests.model.geometry.test_repair import soup
from tests.model.shapes import Shape, box, raw

TRIANGLE = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0], [9.0, 9.0, 9.0]]


def test_the_shortest_edge_at_a_vertex_leads_to_it_or_from_it() -> None:
    """Sides of 3, 5 and 4; the last vertex is of no face."""
    for corners in ([0, 1, 2], [2, 1, 0]):
        assert shortest_edges(raw((TRIANGLE, [corners]))).tolist() == [3, 3, 4, np.inf]


def test_lone_edges_are_those_of_one_face() -> None:
    vertices, faces = box()
    assert lone_edge_corners(raw((vertices, faces))).tolist() == []
    assert lone_edge_corners(raw((vertices, faces[:1]))).tolist() == [0, 1, 2, 3]
    without_top = raw((vertices, [faces[0], *faces[2:]]))
    ends = np.stack([without_top.loops, without_top.next_loops], axis=1)[lone_edge_corners(without_top)]
    assert sorted(map(sorted, ends.tolist())) == [[4, 5], [4, 7], [5, 6], [6, 7]]


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize(("width", "flat"), [(0.9 * FLAT, True), (1.1 * FLAT, False)])
def test_a_face_is_a_line_by_its_width_over_its_longest_edge(size: float, width: float, flat: bool) -> None:
    triangle = [[0.0, 0.0, 0.0], [size, 0.0, 0.0], [0.5 * size, width * size, 0.0]]
    assert flat_faces(raw((triangle, [[0, 1, 2]]))).tolist() == [flat]


def test_a_small_face_far_from_the_first_corner_of_its_block_is_not_flat() -> None:
    corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    corners += [[1.0, 1.0, 1.0], [1.0001, 1.0, 1.0], [1.0, 1.0001, 1.0]]
    assert flat_faces(raw((corners, [[0, 1, 2], [3, 4, 5]]))).tolist() == [False, False]


def test_a_face_whose_corners_all_lie_at_one_place_is_flat() -> None:
    assert flat_faces(raw(([[1.0, 2.0, 3.0]] * 3, [[0, 1, 2]]))).tolist() == [True]


def edge_and_tip(x: float, y: float = 0.0) -> Shape:
    """A triangle with an edge from (0, 0) to (1, 0), and one beyond it whose tip lies at (x, y)."""
    vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 2.0, 0.0], [x, y, 0.0], [x - 0.5, -2.0, 0.0], [x, -2.0, 0.0]]
    return vertices, [[0, 1, 2], [3, 4, 5]]


def inserted(shape: Shape, reach: float) -> list[int]:
    """Corners of the first face."""
    polyhedra, count = insert_t_junctions(raw(shape), np.full(6, reach))
    first: list[int] = polyhedra.loops[: polyhedra.loop_start[1]].tolist()
    assert len(first) == 3 + count
    return first


@pytest.mark.parametrize("reach", [0.0, 1e-3])
def test_a_vertex_on_an_edge_becomes_a_corner_of_its_face(reach: float) -> None:
    assert inserted(edge_and_tip(0.25), reach) == [0, 3, 1, 2]


def test_a_vertex_as_far_off_the_edge_as_it_reaches_lies_on_it() -> None:
    assert inserted(edge_and_tip(0.5, -0.125), 0.125) == [0, 3, 1, 2]
    assert inserted(edge_and_tip(0.5, -0.125), 0.12) == [0, 1, 2]


@pytest.mark.parametrize("x", [0.25, 0.75])
def test_a_vertex_that_reaches_an_end_of_the_edge_is_left_to_be_welded(x: float) -> None:
    assert inserted(edge_and_tip(x), 0.25) == [0, 1, 2]
    assert inserted(edge_and_tip(x), 0.24) == [0, 3, 1, 2]


def two_triangles(gap: float) -> Polyhedra:
    """Triangles with corners 1 and 3 so far apart."""
    vertices: list[list[float]] = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1 + gap, 0, 0], [3, 0, 0], [3, 1, 0]]
    return raw((vertices, [[0, 1, 2], [3, 4, 5]]))


@pytest.mark.parametrize(("gap", "merged"), [(0.25, 1), (0.375, 0)])
def test_corners_are_one_up_to_the_distance_and_at_it(gap: float, merged: int) -> None:
    welded = weld_near(two_triangles(gap), np.arange(6), np.full(6, 0.25))
    assert (welded.merged, welded.collapsed) == (merged, 0)
    assert welded.polyhedra.loops.tolist() == ([0, 1, 2, 1, 3, 4] if merged else [0, 1, 2, 3, 4, 5])


def test_equal_corners_are_one_also_where_a_zero_has_a_sign() -> None:
    surface = soup(box())
    assert weld(surface).merged == 16
    signed = np.where(surface.vertices == 0, -0.0, surface.vertices)
    signed[:3] = surface.vertices[:3]
    welded = weld(
        Polyhedra(signed, surface.vertex_start, surface.loops, surface.loop_start, surface.face_start)
    ).polyhedra
    assert len(welded.vertices) == 8


def test_one_face_over_shared_points_takes_those_it_uses() -> None:
    points = np.arange(15.0).reshape(5, 3)
    taken = own_vertices(points, np.array([4, 0, 2]), np.array([0, 3]), np.array([0]))
    assert taken.vertices.tolist() == points[[0, 2, 4]].tolist()
    assert taken.loops.tolist() == [2, 0, 1]
    assert (taken.vertex_start.tolist(), taken.face_start.tolist()) == ([0, 3], [0, 1])
