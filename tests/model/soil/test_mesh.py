"""Triangles of a region: they fill it, conform to its outline, and their points know where they may go."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from mbla.arrays import FloatArray
from mbla.model.soil.mesh import CellSize, triangulate
from mbla.model.soil.plane_mesh import PlaneMesh

STEP = [(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.4, 1.0), (1.0, 1.7), (1.0, 2.0), (0.0, 2.0)]
HOLE = [(0.4, 0.3), (0.8, 0.3), (0.8, 0.7), (0.4, 0.7)]


def open_edges(mesh: PlaneMesh) -> FloatArray:
    """Edges that one triangle has alone, (n, 2, 2)."""
    sides = np.concatenate([mesh.triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    _, first, counts = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
    assert counts.max() <= 2
    return np.asarray(mesh.points[sides[first[counts == 1]]])


@pytest.mark.parametrize("size", [5.0, 0.5, 0.17, 0.05])
def test_triangles_fill_a_region_and_conform_to_its_outline(size: float) -> None:
    region = shapely.Polygon(STEP, [HOLE])
    mesh = triangulate([region], CellSize(size))
    areas = mesh.areas(mesh.points)
    assert (areas > 0).all()
    assert areas.sum() == pytest.approx(region.area, rel=1e-12)
    edges = open_edges(mesh)
    assert np.linalg.norm(edges[:, 1] - edges[:, 0], axis=1).sum() == pytest.approx(region.length, rel=1e-12)
    assert shapely.distance(region.boundary, shapely.points(edges.mean(axis=1))).max() < 1e-12


def test_points_know_where_they_may_go() -> None:
    region = shapely.Polygon(STEP)
    mesh = triangulate([region], CellSize(0.3))
    away = shapely.distance(region.boundary, shapely.points(mesh.points))
    assert np.array_equal(mesh.inside, away > 1e-12)
    assert {tuple(point) for point in mesh.points[mesh.fixed].round(12).tolist()} == set(STEP)
    on_edge = np.flatnonzero(mesh.along.any(axis=1))
    assert np.linalg.norm(mesh.along[on_edge], axis=1) == pytest.approx(1.0)
    there = shapely.points(mesh.points[on_edge] + 1e-3 * mesh.along[on_edge])
    assert shapely.distance(region.boundary, there).max() < 1e-12
    assert not mesh.along[mesh.inside].any()


def test_polygons_apart_are_meshed_each() -> None:
    """Two that touch in a corner have a point there each."""
    polygons = [shapely.box(0, 0, 1, 1), shapely.box(1, 1, 2, 2)]
    mesh = triangulate(polygons, CellSize(0.4))
    assert mesh.areas(mesh.points).sum() == pytest.approx(2.0, rel=1e-12)
    assert (np.abs(mesh.points - 1.0).max(axis=1) < 1e-12).sum() == 2


def test_of_about_the_size_and_not_too_thin() -> None:
    mesh = triangulate([shapely.box(0, 0, 3, 2)], CellSize(0.2))
    areas = mesh.areas(mesh.points)
    assert areas.mean() == pytest.approx(np.sqrt(3) / 4 * 0.2**2, rel=0.2)
    assert areas.min() > 0.2 * areas.mean()


def test_cells_are_smaller_near_what_bears_on_a_side_and_grow_away_from_it() -> None:
    bearing = np.array([[[1.4, 2.0], [1.6, 2.0]]])
    region = shapely.Polygon([(0, 0), (3, 0), (3, 2), (1.6, 2), (1.4, 2), (0, 2)])
    mesh = triangulate([region], CellSize(0.4, bearing, np.array([0.05])))
    on_top = mesh.points[mesh.points[:, 1] > 2.0 - 1e-12, 0]
    assert ((on_top > 1.4 - 1e-9) & (on_top < 1.6 + 1e-9)).sum() == 5
    sizes = np.sqrt(mesh.areas(mesh.points) / (np.sqrt(3.0) / 4.0))
    away = np.linalg.norm(mesh.points[mesh.triangles].mean(axis=1) - [1.5, 2.0], axis=1)
    assert sizes[away < 0.1].max() < 0.1
    assert sizes[away > 1.2].min() > 0.2
    assert mesh.areas(mesh.points).min() > 0.0
    assert len(mesh.triangles) < 4 * len(triangulate([region], CellSize(0.4)).triangles)
