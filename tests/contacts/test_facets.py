"""Facets of a block whose top is cut into faces of unequal size, near and far from the origin."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from mbla.arrays import IntArray
from mbla.contacts.facets import Facets, build_facets, facets_on_one_plane
from mbla.contacts.polygons import Polygons, union_by_row
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra, polyhedra_from_lists
from tests.contacts.structures import any_rotation, blocks_of, boxes, moved, profile


def cut_top(at: float = 0.25) -> Polyhedra:
    """A box 2 x 1 x 1 with a top of two faces, as long as ``2 at`` and the rest."""
    x = 2 * at
    below = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)]
    above = [(0, 0, 1), (x, 0, 1), (2, 0, 1), (2, 1, 1), (x, 1, 1), (0, 1, 1)]
    vertices = [[float(place) for place in corner] for corner in [*below, *above]]
    faces = [[0, 3, 2, 1], [4, 5, 8, 9], [5, 6, 7, 8], [0, 1, 6, 5, 4], [1, 2, 7, 6], [2, 3, 9, 8, 7], [3, 0, 4, 9]]
    return polyhedra_from_lists([vertices], [faces])


def top_of(facets: Facets, up: np.ndarray) -> int:
    (found,) = np.flatnonzero(facets.normals @ up > 0.99)
    return int(found)


@pytest.mark.parametrize("shift", [0.0, 1e6])
@pytest.mark.parametrize("turn", [np.eye(3), any_rotation(5)], ids=["along the axes", "turned"])
def test_a_facet_of_two_faces(turn: np.ndarray, shift: float) -> None:
    facets = build_facets(blocks_of(moved(cut_top(), turn=turn, shift=shift)))
    assert len(facets) == 6
    top = top_of(facets, turn @ [0, 0, 1])
    assert shapely.area(facets.polygons[top]) == pytest.approx(2.0)
    middle = turn @ [1.0, 0.5, 1.0] + shift
    assert facets.origins[top] == pytest.approx(middle, abs=1e-9)
    assert facets.radii[top] == pytest.approx(np.hypot(1.0, 0.5))
    assert facets.convex.all()
    corners = np.array([[x, y, 1] for x in (0, 2) for y in (0, 1)]) @ turn.T + shift
    assert facets.lower[top] == pytest.approx(corners.min(axis=0), abs=1e-9)
    assert facets.upper[top] == pytest.approx(corners.max(axis=0), abs=1e-9)


def test_facets_are_numbered_in_order_of_blocks() -> None:
    both = join_polyhedra([cut_top(), boxes(([5, 0, 0], [6, 1, 1])), cut_top(0.5)])
    facets = build_facets(blocks_of(both))
    assert facets.facet_start.tolist() == [0, 6, 12, 18]
    assert facets.blocks.tolist() == [0] * 6 + [1] * 6 + [2] * 6


@pytest.mark.parametrize("beside", [2.0, 1e7])
def test_the_middle_of_a_facet_does_not_hang_on_how_large_the_other_blocks_are(beside: float) -> None:
    facets = build_facets(blocks_of(join_polyhedra([cut_top(), boxes(([5, 0, 0], [5 + beside, beside, beside]))])))
    top = np.flatnonzero((facets.normals[:, 2] > 0.99) & (facets.blocks == 0))
    assert facets.origins[top] == pytest.approx(np.array([[1.0, 0.5, 1.0]]))


def test_what_uniting_faces_without_a_grid_loses_is_found_again(monkeypatch: pytest.MonkeyPatch) -> None:
    def losing(polygons: Polygons, row: IntArray, n_rows: int, grid: float | None = None) -> Polygons:
        if grid is None:
            return np.asarray(polygons[np.unique(row, return_index=True)[1]])
        return union_by_row(polygons, row, n_rows, grid)

    monkeypatch.setattr("mbla.contacts.facets.union_by_row", losing)
    facets = build_facets(blocks_of(cut_top()))
    assert shapely.area(facets.polygons) == pytest.approx([2, 2, 2, 1, 2, 1])


def bracket() -> Polyhedra:
    """A block on two feet, whose soles lie on one plane but share no edge."""
    return profile([(0, 0), (1, 0), (1, 1), (2, 1), (2, 0), (3, 0), (3, 2), (0, 2)])


def test_two_soles_on_one_plane_are_one_facet() -> None:
    blocks = blocks_of(join_polyhedra([bracket(), boxes(([5, 0, 0], [6, 1, 1]))]))
    corners = blocks.vertices[blocks.loops]
    centres = np.add.reduceat(corners, blocks.loop_start[:-1]) / np.diff(blocks.loop_start)[:, None]
    joined = facets_on_one_plane(blocks, centres)
    assert joined.max() + 1 == 9 + 6
    soles = np.flatnonzero((blocks.face_normals[:, 2] < -0.99) & (centres[:, 2] < 0.1) & (centres[:, 0] < 4))
    assert len(soles) == 2
    assert joined[soles[0]] == joined[soles[1]]
    facets = build_facets(blocks)
    down = np.flatnonzero((facets.normals[:, 2] < -0.99) & (facets.blocks == 0))
    assert sorted(shapely.area(facets.polygons[down]).round(9).tolist()) == [1.0, 2.0]
    assert facets.convex[facets.blocks == 1].all()
    alone = boxes(([0, 0, 0], [1, 1, 1]))
    assert len(build_facets(blocks_of(alone))) == 6
