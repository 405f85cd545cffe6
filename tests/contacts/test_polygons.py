"""Polygons in the plane of a contact, and what several of them have in common."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from mbla.contacts.outlines.overlay import (
    Overlays,
    Planes,
    build_overlays,
    concatenate,
    frames_from_normals,
    gap_at,
    local_maps,
    unit,
)
from mbla.model.solids.plane import CrowdedError, meeting_boxes
from mbla.model.solids.polygons import (
    Polygons,
    connected_parts,
    intersect,
    polygons_from_loops,
    union_by_row,
    widths,
)


def array(*polygons: shapely.Geometry) -> Polygons:
    found: Polygons = np.array(polygons, dtype=object)
    return found


@settings(max_examples=40)
@given(st.integers(0, 10**6), st.integers(0, 60))
def test_box_pairs_agree_with_all_against_all(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    lower = rng.uniform(0, 5, (count, 3))
    upper = lower + rng.uniform(0, 2, (count, 3))
    i, j = meeting_boxes(lower, upper, lower, upper, 10**6)
    expected = [
        (a, b)
        for a in range(count)
        for b in range(a + 1, count)
        if (lower[a] <= upper[b]).all() and (lower[b] <= upper[a]).all()
    ]
    assert list(zip(i.tolist(), j.tolist(), strict=True)) == expected


def test_boxes_in_one_place_are_not_paired() -> None:
    rng = np.random.default_rng(1)
    lower = rng.uniform(0, 100, (3000, 3))
    assert len(meeting_boxes(lower, lower + 1, lower, lower + 1, 3000)[0]) < 3000
    lower[1000:1500] = 50
    with pytest.raises(CrowdedError) as caught:
        meeting_boxes(lower, lower + 1, lower, lower + 1, 3000)
    assert 1000 <= caught.value.box < 1500


def test_width_is_exact_for_rectangles() -> None:
    boxes = [shapely.box(0, 0, length, 0.01) for length in (0.01, 0.02, 1.0, 1e4)]
    np.testing.assert_allclose(widths(array(*boxes)), 0.01, rtol=1e-9)


def test_width_of_a_thin_triangle_is_half_its_height() -> None:
    assert widths(array(shapely.Polygon([[0, 0], [1, 0], [0.5, 1e-4]]))) == pytest.approx([0.5e-4], rel=1e-3)


def test_parts_are_the_polygons_of_collections() -> None:
    mixed = shapely.from_wkt(
        "GEOMETRYCOLLECTION (POINT (0 0), LINESTRING (0 0, 1 1), "
        "MULTIPOLYGON (((0 0, 1 0, 0 1, 0 0)), ((5 5, 6 5, 5 6, 5 5))))"
    )
    parts, row = connected_parts(array(shapely.Point(0, 0), mixed, shapely.Polygon(), shapely.box(0, 0, 1, 1)))
    assert row.tolist() == [1, 1, 3]
    assert [part.area for part in parts] == [0.5, 0.5, 1.0]


@pytest.mark.parametrize("counts", [[1, 2, 3], [5, 1, 1, 9], [4]])
def test_union_by_row(counts: list[int]) -> None:
    strips = [shapely.box(0, k, 1, k + 1) for count in counts for k in range(count)]
    united = union_by_row(array(*strips), np.repeat(np.arange(len(counts)), counts), len(counts))
    assert [shape.area for shape in united] == pytest.approx(counts)
    assert all(shape.geom_type == "Polygon" for shape in united)


def test_union_with_a_grid_closes_cracks_of_rounding() -> None:
    cracked = [shapely.box(0, 0, 1, 1), shapely.box(0, 1 + 3e-12, 1, 2)]
    rows = np.zeros(2, dtype=np.int64)
    assert union_by_row(array(*cracked), rows, 1)[0].geom_type == "MultiPolygon"
    assert union_by_row(array(*cracked), rows, 1, grid=1e-10)[0].geom_type == "Polygon"


def test_loop_with_a_bridge_to_its_hole_is_repaired() -> None:
    loop = np.array([[0, 0], [4, 0], [4, 4], [0, 4], [0, 0], [1, 1], [1, 3], [3, 3], [3, 1], [1, 1]], dtype=float)
    polygon = polygons_from_loops(loop, np.array([0, len(loop)]))
    assert polygon[0].is_valid
    assert polygon[0].area == pytest.approx(12.0)


def test_intersection_by_either_way_is_the_same() -> None:
    first = array(*(shapely.box(0, 0, 1, 1) for _ in range(3)))
    second = array(shapely.box(0.5, 0.5, 2, 2), shapely.box(1, 0, 2, 1), shapely.box(3, 3, 4, 4))
    for convex in (True, False):
        common = intersect(first, second, np.full(3, convex))
        assert [shape.area for shape in common] == pytest.approx([0.25, 0.0, 0.0])


# The mean plane of two planes, and the gap over it, beside the geometry of two planes.


ANGLE, TOWARDS = 0.1, np.array([0.6, 0.8])
"""Of the upper plane, which rises along a direction between x and y."""


def overlay(height: float, size: float = 2.0, near: tuple[float, float, float] = (1.0, 0.5, 0.25)) -> Overlays:
    """The plane z = 0 below one that rises, and is at a height above the origin."""
    tilted = np.array([[*(np.sin(ANGLE) * TOWARDS), -np.cos(ANGLE)]])
    return build_overlays(
        bodies=np.array([[3, 7]]),
        facets=np.array([[1, 2]]),
        a=Planes(np.array([[5.0, -2.0, 0.0]]), np.array([[0.0, 0.0, 1.0]])),
        b=Planes(np.array([[-8.0, 6.0, height]]), tilted),
        near=np.array([near]),
        sizes=np.array([size]),
    )


@pytest.mark.parametrize("size", [0.5, 1.0, 2.0])
@pytest.mark.parametrize("height", [-0.25, 0.0, 0.5])
def test_the_mean_plane_is_halfway_and_the_gap_is_measured_across_it(height: float, size: float) -> None:
    found = overlay(height, size)
    normal = np.array([*(-np.sin(ANGLE / 2) * TOWARDS), np.cos(ANGLE / 2)])
    assert found.frames[0, 0] == pytest.approx(normal)
    assert np.linalg.det(found.frames[0]) == pytest.approx(1.0)
    assert np.cross(found.origins[0] - (1.0, 0.5, 0.25), normal) == pytest.approx(np.zeros(3))
    for local in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (-0.5, 2.0)):
        point = found.origins[0] + size * np.array(local) @ found.frames[0, 1:]
        below = -point[2] / normal[2]  # along the normal, down to z = 0
        rises = np.tan(ANGLE)
        above = (height + point[:2] @ TOWARDS * rises - point[2]) / (normal[2] - normal[:2] @ TOWARDS * rises)
        assert above == pytest.approx(-below)
        gap = gap_at(found, np.array([0]), np.array([local]))
        assert gap == pytest.approx([(above - below) / size])


def test_bodies_facets_and_sizes_are_kept() -> None:
    found = concatenate([overlay(0.0), overlay(0.5, 1.0)])
    assert len(found) == 2
    assert found.sizes.tolist() == [2.0, 1.0]
    assert found.bodies.tolist() == [[3, 7], [3, 7]]
    assert found.facets.tolist() == [[1, 2], [1, 2]]
    twice = found.take(np.array([1, 1, 0]))
    assert twice.sizes.tolist() == [1.0, 1.0, 2.0]
    for name in ("bodies", "facets", "origins", "frames", "gaps"):
        values = getattr(found, name)
        assert np.array_equal(getattr(twice, name), values[[1, 1, 0]])
        assert np.array_equal(values[:1], getattr(overlay(0.0), name))


def test_maps_from_a_facet_to_the_mean_plane() -> None:
    """Points of a facet, written in its own frame, fall along the normal onto the mean plane."""
    found = overlay(0.5)
    origin = np.array([[0.3, -0.4, 0.7]])
    frame = frames_from_normals(np.array([[0.6, 0.0, 0.8]]))
    matrices, offsets = local_maps(found, origin, frame)
    for flat in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (2.0, -3.0)):
        point = origin[0] + np.array(flat) @ frame[0, 1:]
        expected = (point - found.origins[0]) @ found.frames[0, 1:].T / 2.0
        assert matrices[0] @ flat + offsets[0] == pytest.approx(expected)


@pytest.mark.parametrize(
    ("normal", "first", "second"),
    [
        ([0, 0, 1], [1, 0, 0], [0, 1, 0]),
        ([0, 0, -1], [1, 0, 0], [0, -1, 0]),
        ([1, 0, 0], [0, 1, 0], [0, 0, 1]),
        ([0, 1, 0], [-1, 0, 0], [0, 0, 1]),
        ([0.6, 0, 0.8], [0, 1, 0], [-0.8, 0, 0.6]),
    ],
)
def test_tangents(normal: list[float], first: list[float], second: list[float]) -> None:
    frame = frames_from_normals(np.array([normal], dtype=float))[0]
    np.testing.assert_allclose(frame, [normal, first, second], atol=1e-15)


@pytest.mark.parametrize("tilt", [1e-15, 1e-9, 1e-4])
def test_rounding_does_not_turn_the_tangents_of_a_bed_joint(tilt: float) -> None:
    tilted = unit(np.array([[tilt, 0, 1], [-tilt, tilt, 1], [0, -tilt, 1]]))
    frames = frames_from_normals(tilted)
    np.testing.assert_allclose(frames[:, 1], np.broadcast_to([1, 0, 0], (3, 3)), atol=2 * tilt)


def test_tangents_of_joints_that_are_nearly_level() -> None:
    """Tangent 1 is x, made perpendicular to the normal."""
    normals = unit(np.array([[0.009, 0, 1], [0.006, -0.005, -1], [-0.005, 0.005, 1]]))
    frames = frames_from_normals(normals)
    np.testing.assert_allclose(frames @ frames.transpose(0, 2, 1), np.broadcast_to(np.eye(3), (3, 3, 3)), atol=1e-15)
    assert (frames[:, 1, 0] > 0.9999).all()
