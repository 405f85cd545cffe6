"""Contact points of interfaces as `contacts.points` asks for them: how many, and how far from the edge.

*Inset* s: points move the share s of their way to the centroid. Only where the centroid sees every corner, since the
points of other interfaces could leave the surface. Inset lowers torsion under any flow rule: 1 − 0.3826/0.7071 = 0.459
gives a square its torsion under uniform pressure. The price is paid in rocking: the edge about which a block turns
moves inwards too, and b/h becomes (1 − s) b/h.

*Rounding* d: points lie on the outline whose edges are moved inwards by d, so that a block of breadth b rocks with
(b − 2d)/h. Only on convex interfaces wide enough for every edge to be left.

Shares of area keep their sum; with rounding their first moment is zero only for outlines with a centre of symmetry.

Common surfaces that can crush, in pieces whose stress blocks have a closed form: parallelograms and triangles.

A joint with a compressive strength bears what a field of stress between nothing and that strength bears. The resultants
of such fields over a surface are the sums of those over its pieces, so that nothing is lost by dividing it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.contacts.contacts import ContactsRefused
from mbla.contacts.outlines.corners import Corners, areas_and_centroids, parallelograms
from mbla.contacts.outlines.refine import InterfacePoints, divided
from mbla.deck.sections.contacts import ContactPoints
from mbla.errors import Notice
from mbla.model.solids.convex import convex_loops
from mbla.model.solids.polygons import polygons_from_rings, triangles
from mbla.model.solids.ragged import items_of_rows, next_item

_SEEN = 1e-9
"""Area of the triangle of an edge and the centroid, over that of the interface, from which on it is seen plainly."""

_WHOLE = 1e-9
"""Relative: an edge that is a multiple of the spacing up to rounding is divided into that many parts."""

MOST_PARTS = 200
"""Of one edge: beyond, one rectangle would have 40,000 points."""


def interface_points(
    corners: Corners, centroids: FloatArray, sizes: FloatArray, asked: ContactPoints
) -> tuple[InterfacePoints, list[Notice]]:
    """Contact points of polygons, (n,), and a warning where some could not be moved inwards.

    centroids : (n_polygons, 2)
    sizes     : (n_polygons,) [m] unit of the local coordinates of each polygon

    Raises ContactsRefused where the spacing is too small.
    """
    n = len(centroids)
    left_alone = 0
    areas = areas_and_centroids(corners)[0]
    if asked.rounding > 0:
        corners, left_alone = _rounded(corners, n, asked.rounding / sizes)
        rounded_areas, centroids = areas_and_centroids(corners)
    star = _seen_from(corners, centroids)
    found = divided(corners, centroids, star, _parts(corners, sizes, asked))
    if asked.rounding > 0:
        found = replace(found, areas=found.areas * (areas / rounded_areas)[found.polygon])
        return found, _not_applied("rounding", left_alone, "not convex, or too narrow for it")
    if asked.inset == 0.0:
        return found, []
    moves, centre = star[found.polygon], centroids[found.polygon]
    points = np.where(moves[:, None], centre + (1.0 - asked.inset) * (found.points - centre), found.points)
    reason = "seen only in part from their centroid, and points that move towards it could leave the surface"
    return replace(found, points=points), _not_applied("inset", int((~star).sum()), reason)


def _not_applied(key: str, count: int, reason: str) -> list[Notice]:
    if not count:
        return []
    text = f"contacts.points.{key}: {count} interfaces keep their points where they are, for they are {reason}"
    return [Notice("warning", f"{key}-not-applied", text)]


def _parts(corners: Corners, sizes: FloatArray, asked: ContactPoints) -> IntArray:
    """Parts of the edges of each polygon as ``divided`` takes them, (n, 2)."""
    n = len(sizes)
    if asked.spacing is None:
        return np.full((n, 2), asked.per_edge or 1)
    step = corners.points[next_item(corners.ring_start)] - corners.points
    polygon = corners.polygon_of_corner
    lengths = np.linalg.norm(step, axis=1) * sizes[polygon]
    longest = np.zeros(n)
    np.maximum.at(longest, polygon, lengths)
    edges = np.stack([longest, longest], axis=1)
    flat = parallelograms(corners, n)
    edges[flat] = lengths[flat[polygon]].reshape(-1, 4)[:, :2]
    if edges.max(initial=0.0) > MOST_PARTS * asked.spacing:
        least = edges.max() / MOST_PARTS
        raise ContactsRefused(
            "too-many-points",
            f"divides the longest edge of an interface, {edges.max():.4g}, into more than {MOST_PARTS} parts: "
            f"must be >= {least:.4g}",
            ("contacts", "points", "spacing"),
        )
    return np.asarray(np.maximum(np.ceil(edges / asked.spacing * (1 - _WHOLE)), 1), dtype=np.int64)


def _seen_from(corners: Corners, centroids: FloatArray) -> BoolArray:
    """Polygons without holes whose every edge is seen from the centroid, (n_polygons,)."""
    n = len(centroids)
    thirds = _fan_areas(corners, centroids)
    total = np.bincount(corners.polygon_of_corner, thirds, n)
    hidden = thirds <= _SEEN * total[corners.polygon_of_corner]
    one_ring = np.bincount(corners.polygon_of_ring, minlength=n) == 1
    return np.asarray(one_ring & (np.bincount(corners.polygon_of_corner, hidden, n) == 0))


def _fan_areas(corners: Corners, centroids: FloatArray) -> FloatArray:
    """Signed area of the triangle of the centroid and the edge that leaves each corner, (n_corners,)."""
    centre = centroids[corners.polygon_of_corner]
    here, there = corners.points - centre, corners.points[next_item(corners.ring_start)] - centre
    return np.asarray(here[:, 0] * there[:, 1] - here[:, 1] * there[:, 0]) / 2


def _rounded(corners: Corners, n: int, distance: FloatArray) -> tuple[Corners, int]:
    """Corners of the outlines with edges moved inwards by ``distance`` (n,), and how many polygons stay as they are.

    A corner between edges with inward normals m and n moves by d (m + n)/(1 + m·n).
    """
    following = next_item(corners.ring_start)
    step = corners.points[following] - corners.points
    along = step / np.linalg.norm(step, axis=1)[:, None]
    leaving = np.stack([-along[:, 1], along[:, 0]], axis=1)
    arriving = np.empty_like(leaving)
    arriving[following] = leaving
    polygon = corners.polygon_of_corner
    # a corner that turns right back has no offset; it is not convex, and stays
    spread = np.maximum(1 + np.einsum("ij,ij->i", leaving, arriving), 1e-12)
    moved = corners.points + (distance[polygon] / spread)[:, None] * (leaving + arriving)
    left = np.einsum("ij,ij->i", moved[following] - moved, along) > 0
    rings = np.bincount(corners.polygon_of_ring, minlength=n)
    bad_ring = ~convex_loops(corners.points, corners.ring_start) | (rings[corners.polygon_of_ring] > 1)
    stays = np.bincount(corners.polygon_of_ring, bad_ring, n) + np.bincount(polygon, ~left, n) > 0
    points = np.where(stays[polygon][:, None], corners.points, moved)
    return Corners(points, corners.ring_start, corners.polygon_of_ring), int(stays.sum())


FLAT = 1e-9
"""Greatest area of a triangle, over that of its surface, that is rounding of corners on one line, and no piece."""


def in_pieces(corners: Corners, chosen: BoolArray) -> tuple[Corners, IntArray]:
    """The polygons chosen, (n_polygons,), in triangles unless they are parallelograms or triangles; others unchanged.

    Returns
    -------
    corners : of the pieces, in the order of their polygons
    row     : (n_pieces,) polygon of each piece
    """
    n = len(chosen)
    rings = np.bincount(corners.polygon_of_ring, minlength=n)
    triangular = (rings == 1) & (np.bincount(corners.polygon_of_corner, minlength=n) == 3)
    divided = chosen & ~triangular & ~parallelograms(corners, n)
    if not divided.any():
        return corners, np.arange(n)
    of_divided = divided[corners.polygon_of_corner]
    part = corners.take(of_divided)
    rows, dense = np.unique(part.polygon_of_ring, return_inverse=True)
    spots, row = triangles(polygons_from_rings(part.points, part.ring_start, dense.astype(np.int64)))
    first, second = spots[:, 1] - spots[:, 0], spots[:, 2] - spots[:, 0]
    twice = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    spots[twice < 0] = spots[twice < 0][:, ::-1]
    real = np.abs(twice) > FLAT * np.bincount(row, np.abs(twice))[row]
    spots, row = spots[real], row[real]
    left = corners.take(~of_divided)
    # rings of the pieces behind those of the polygons left unchanged, then all in the order of their polygons
    points = np.concatenate([left.points, spots.reshape(-1, 2)])
    counts = np.concatenate([np.diff(left.ring_start), np.full(len(row), 3)])
    polygon_of_ring = np.concatenate([left.polygon_of_ring, rows[row]])
    order = np.argsort(polygon_of_ring, kind="stable")
    corner = items_of_rows(starts(counts), order)
    new_piece = (np.diff(polygon_of_ring[order], prepend=-1) != 0) | divided[polygon_of_ring[order]]
    piece = np.cumsum(new_piece) - 1
    return Corners(points[corner], starts(counts[order]), piece), polygon_of_ring[order][new_piece]
