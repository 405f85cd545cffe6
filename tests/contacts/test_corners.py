"""Corners that outlines need, and facets: planar faces of one block put together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
import shapely

from mbla.arrays import IntArray
from mbla.contacts.faces.facets import Facets, build_facets
from mbla.contacts.outlines.corners import areas_and_centroids, needed_corners
from mbla.model.solids.polygons import Polygons, union_by_row
from mbla.model.solids.polyhedra import Polyhedra, polyhedra_from_lists
from tests.contacts.structures import any_rotation, blocks_of, moved

Outline = Sequence[Sequence[float]]


def polygons(*outlines: Outline, holes: Sequence[Outline] = ()) -> Polygons:
    found: Polygons = np.array([shapely.Polygon(outline, holes) for outline in outlines], dtype=object)
    return found


SQUARE: list[list[float]] = [[0, 0], [1, 0], [1, 1], [0, 1]]


def test_corners_of_a_square_stay() -> None:
    corners = needed_corners(polygons(SQUARE), 1e-3)
    assert {tuple(point) for point in corners.points} == {(0, 0), (1, 0), (1, 1), (0, 1)}


def test_collinear_and_double_corners_go() -> None:
    outline: Outline = [[0, 0], [0.5, 0], [1, 0], [1, 1e-12], [1, 1], [0.3, 1 + 1e-10], [0, 1], [0, 0.2]]
    corners = needed_corners(polygons(outline), 1e-3)
    assert len(corners.points) == 4


@pytest.mark.parametrize("mirrored", [False, True])
def test_the_tip_of_a_thin_tongue_stays(mirrored: bool) -> None:
    """It lies far beyond the corner after it, though hardly off the line to that."""
    outline: Outline = [[0, 0], [1, 0], [0.6, 1e-4], [0.6, 1], [0, 1]]
    if mirrored:
        outline = [[1 - x, y] for x, y in outline]
    corners = needed_corners(polygons(outline), 1e-3)
    assert sorted(corners.points.tolist()) == sorted([float(x), float(y)] for x, y in outline)


def test_small_steps_go_and_large_ones_stay() -> None:
    step: Outline = [[0, 0], [0.5, 0], [0.5, 9e-4], [1, 9e-4], [1, 1], [0, 1]]
    assert len(needed_corners(polygons(step), 1e-3).points) == 4
    assert len(needed_corners(polygons(step), 4e-4).points) == 6


@pytest.mark.parametrize("count", [50, 200, 1000])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3])
def test_a_round_outline_is_not_eaten_away(count: int, tolerance: float) -> None:
    angles = 2 * np.pi * np.arange(count) / count
    outline = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    corners = needed_corners(polygons(outline.tolist()), tolerance)
    kept = shapely.Polygon(corners.points)
    assert len(corners.points) < count or tolerance < 2 * np.sin(np.pi / count) ** 2
    distance = shapely.distance(kept.exterior, shapely.points(outline))
    assert distance.max() <= tolerance * (1 + 1e-9)


def test_outlines_smaller_than_the_tolerance_keep_their_shape() -> None:
    tiny = (1e-4 * np.array(SQUARE)).tolist()
    assert len(needed_corners(polygons(tiny), 1e-2).points) == 4


def test_outlines_start_at_the_same_corner_whatever_their_order() -> None:
    turned = [SQUARE[2:] + SQUARE[:2], SQUARE[::-1], SQUARE]
    corners = needed_corners(polygons(*turned), 1e-3)
    for ring in np.split(corners.points, 3):
        np.testing.assert_array_equal(ring, [[0, 0], [1, 0], [1, 1], [0, 1]])


def test_holes_follow_the_outline_and_run_the_other_way() -> None:
    hole: Outline = [[0.25, 0.25], [0.75, 0.25], [0.75, 0.75], [0.25, 0.75]]
    corners = needed_corners(polygons(SQUARE, holes=[hole]), 1e-3)
    assert np.diff(corners.ring_start).tolist() == [4, 4]
    area, centroid = areas_and_centroids(corners)
    assert area == pytest.approx([0.75])
    assert centroid == pytest.approx(np.array([[0.5, 0.5]]))


def test_holes_narrower_than_the_tolerance_are_filled() -> None:
    slit: Outline = [[0.2, 0.5], [0.8, 0.5], [0.8, 0.5005], [0.2, 0.5005]]
    corners = needed_corners(polygons(SQUARE, holes=[slit]), 1e-3)
    assert len(corners.polygon_of_ring) == 1
    wide: Outline = [[0.2, 0.5], [0.8, 0.5], [0.8, 0.502], [0.2, 0.502]]
    assert len(needed_corners(polygons(SQUARE, holes=[wide]), 1e-3).polygon_of_ring) == 2


@pytest.mark.parametrize("neck", [1e-4, 1e-7, 1e-11])
def test_outline_that_would_cross_itself_keeps_its_corners(neck: float) -> None:
    """Two squares joined by a neck at a corner: without the corners of the neck the outlines would touch."""
    outline: Outline = [[0, 0], [1, 0], [1, 1 - neck], [2, 1], [2, 2], [1, 2], [1 - neck, 1], [0, 1]]
    corners = needed_corners(polygons(outline), 1e-3)
    assert shapely.Polygon(corners.points).is_valid
    assert areas_and_centroids(corners)[0] == pytest.approx([2.0], abs=1e-3)


def test_outline_that_would_cross_itself_without_collinear_corners_keeps_even_those() -> None:
    """A tip from above reaches by a hair into a dent in the side below it."""
    tip, dent = [1, 1 - 1e-11], [1, 1 - 2e-11]
    outline: Outline = [[0, 0], [0.5, 0], [3, 0], [3, 3], [1, 3], tip, [2, 2], [2, 1], dent, [0, 1]]
    assert len(needed_corners(polygons(outline), 1e-3).points) == len(outline)
    assert len(needed_corners(polygons([*outline[:5], [1, 1.5], *outline[6:]]), 1e-3).points) == len(outline) - 2


# Facets of a block whose top is cut into faces of unequal size, near and far from the origin.


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


def test_what_uniting_faces_without_a_grid_loses_is_found_again(monkeypatch: pytest.MonkeyPatch) -> None:
    def losing(polygons: Polygons, row: IntArray, n_rows: int, grid: float | None = None) -> Polygons:
        if grid is None:
            return np.asarray(polygons[np.unique(row, return_index=True)[1]])
        return union_by_row(polygons, row, n_rows, grid)

    monkeypatch.setattr("mbla.contacts.faces.facets.union_by_row", losing)
    facets = build_facets(blocks_of(cut_top()))
    assert shapely.area(facets.polygons) == pytest.approx([2, 2, 2, 1, 2, 1])
