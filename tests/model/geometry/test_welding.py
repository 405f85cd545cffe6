from __future__ import annotations

import numpy as np
import pytest

from mbla.model.geometry.welding import own_vertices, weld, weld_near
from mbla.model.solids.polyhedra import Polyhedra
from tests.model.geometry.test_surfaces import soup
from tests.model.shapes import box, raw


def two_triangles(gap: float) -> Polyhedra:
    """Triangles with corners 1 and 3 so far apart."""
    vertices: list[list[float]] = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1 + gap, 0, 0], [3, 0, 0], [3, 1, 0]]
    return raw((vertices, [[0, 1, 2], [3, 4, 5]]))


@pytest.mark.parametrize(("gap", "merged"), [(0.25, 1), (0.375, 0)])
def test_corners_are_one_up_to_the_distance_and_at_it(gap: float, merged: int) -> None:
    welded = weld_near(two_triangles(gap), np.arange(6), np.full(6, 0.25))
    assert (welded.merged, welded.collapsed) == (merged, 0)
    assert welded.polyhedra.loops.tolist() == ([0, 1, 2, 1, 3, 4] if merged else [0, 1, 2, 3, 4, 5])


def test_where_nothing_is_near_nothing_is_made_anew() -> None:
    surface = two_triangles(0.5)
    for welded in (weld_near(surface, np.arange(6), np.full(6, 0.25)), weld(surface)):
        assert welded.polyhedra is surface
        assert (welded.merged, welded.collapsed) == (0, 0)


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
