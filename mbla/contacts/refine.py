"""More contact points than the corners of an interface, and points moved inwards.

*Refine* n: each interface is cut into triangles (a fan about the centroid where that sees every corner, constrained
Delaunay triangles elsewhere), every triangle into n² equal ones, and each small triangle gives a third of its area to
each of its corners. So there are n points along each edge of the outline and n − 1 rings inside, the shares add up to
the area, and their first moment about the centroid is zero.

*Inset* s: points move the share s of their way to the centroid; shares of area stay. Only where the centroid sees every
corner, since the points of other interfaces could leave the surface.

What this does to the strength of an interface. Under associative flow more points cannot lower the torsion that it
bears, because the program may load its corners alone: a square of side a bears 0.7071 μWa with any number of points,
against 0.3826 μWa under uniform pressure. Without dilatancy, starting from the gravity state, normal forces spread over
the points and more of them do lower it. Inset lowers it in both: 1 − 0.3826/0.7071 = 0.459 gives a square its torsion
under uniform pressure. The price is paid in rocking: the edge about which a block turns moves inwards too, and b/h
becomes (1 − s) b/h.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.contacts.corners import Corners
from mbla.contacts.point_areas import places, point_areas
from mbla.contacts.polygons import polygons_from_rings, triangles
from mbla.errors import Notice
from mbla.model.ragged import next_item

_SEEN = 1e-9
"""Area of the triangle of an edge and the centroid, over that of the interface, from which on it is seen plainly."""


@dataclass(frozen=True)
class InterfacePoints:
    """Contact points of polygons in local coordinates.

    points  : (n_points, 2) outline counter-clockwise, then holes clockwise, then points inside, polygon by polygon
    polygon : (n_points,)   ascending
    outline : (n_polygons,) how many points form the outer boundary
    areas   : (n_points,)   shares, in the square of the unit of the points
    """

    points: FloatArray
    polygon: IntArray
    outline: IntArray
    areas: FloatArray


def interface_points(
    corners: Corners, centroids: FloatArray, refine: int, inset: float
) -> tuple[InterfacePoints, list[Notice]]:
    """Contact points of polygons, (n,), and a warning where some could not be moved inwards.

    centroids : (n_polygons, 2)
    refine    : points along each edge, 1 for the corners alone
    inset     : share of the way to the centroid, below 1
    """
    n = len(centroids)
    star = _seen_from(corners, centroids)
    found = _at_corners(corners, n) if refine == 1 or n == 0 else _refined(corners, centroids, star, refine)
    if inset == 0.0:
        return found, []
    moves = star[found.polygon]
    centre = centroids[found.polygon]
    points = np.where(moves[:, None], centre + (1.0 - inset) * (found.points - centre), found.points)
    notices = [] if star.all() else [_left_alone(int((~star).sum()))]
    return InterfacePoints(points, found.polygon, found.outline, found.areas), notices


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


def _outline(corners: Corners, n: int) -> IntArray:
    """Corners of the outer ring of each polygon, which comes first, (n,)."""
    first_ring = np.searchsorted(corners.polygon_of_ring, np.arange(n))
    return np.diff(corners.ring_start)[first_ring]


def _at_corners(corners: Corners, n: int) -> InterfacePoints:
    return InterfacePoints(corners.points, corners.polygon_of_corner, _outline(corners, n), point_areas(corners, n))


def _refined(corners: Corners, centroids: FloatArray, star: BoolArray, refine: int) -> InterfacePoints:
    """Points along the edges first, in the order of the corners, then those inside."""
    n = len(centroids)
    edge_points, edge_polygon = _along_edges(corners, refine), np.repeat(corners.polygon_of_corner, refine)
    whole, row = _triangulated(corners, centroids, star)
    nodes, third = _nodes_of_triangles(whole, refine)
    node_polygon = np.repeat(row, nodes.shape[1])
    key = places(np.concatenate([edge_polygon, node_polygon]), np.concatenate([edge_points, nodes.reshape(-1, 2)]))
    on_edge, at_node = key[: len(edge_points)], key[len(edge_points) :]
    shares = np.bincount(at_node, third.ravel(), minlength=int(key.max(initial=-1)) + 1)
    inside, first = np.unique(at_node, return_index=True)
    new = ~np.isin(inside, on_edge)
    inside, first = inside[new], first[new]
    # where a hole touches the outline two points share one place, and its area
    edge_areas = shares[on_edge] / np.bincount(on_edge, minlength=len(shares))[on_edge]
    polygon = np.concatenate([edge_polygon, node_polygon[first]])
    order = np.argsort(polygon, kind="stable")
    return InterfacePoints(
        points=np.concatenate([edge_points, nodes.reshape(-1, 2)[first]])[order],
        polygon=polygon[order],
        outline=refine * _outline(corners, n),
        areas=np.concatenate([edge_areas, shares[inside]])[order],
    )


def _along_edges(corners: Corners, refine: int) -> FloatArray:
    """Points that divide each edge into equal parts, its first corner included, (refine n_corners, 2)."""
    here, there = corners.points, corners.points[next_item(corners.ring_start)]
    step = np.arange(refine)[:, None]
    # the same sums as in ``_nodes_of_triangles``, so that points on an edge agree bit by bit
    return np.asarray((((refine - step) * here[:, None] + step * there[:, None]) / refine).reshape(-1, 2))


def _triangulated(corners: Corners, centroids: FloatArray, star: BoolArray) -> tuple[FloatArray, IntArray]:
    """Triangles of all polygons, (n_triangles, 3, 2), and the polygon of each, ascending."""
    fan = star[corners.polygon_of_corner]
    parts = [
        np.stack(
            [centroids[corners.polygon_of_corner], corners.points, corners.points[next_item(corners.ring_start)]],
            axis=1,
        )[fan]
    ]
    rows = [corners.polygon_of_corner[fan]]
    if not star.all():
        rest = corners.take(~fan)
        number, dense = np.unique(rest.polygon_of_ring, return_inverse=True)
        spots, row = triangles(polygons_from_rings(rest.points, rest.ring_start, dense.astype(np.int64)))
        parts.append(spots)
        rows.append(number[row])
    return np.concatenate(parts), np.concatenate(rows)


def _nodes_of_triangles(corners: FloatArray, refine: int) -> tuple[FloatArray, FloatArray]:
    """Corners of the n² small triangles of each triangle, each once, and their shares of area.

    corners : (n_triangles, 3, 2)

    Returns
    -------
    nodes  : (n_triangles, (n + 1)(n + 2)/2, 2)
    shares : (n_triangles, (n + 1)(n + 2)/2)
    """
    i, j = (index.ravel() for index in np.meshgrid(np.arange(refine + 1), np.arange(refine + 1), indexing="ij"))
    i, j = i[i + j <= refine], j[i + j <= refine]
    k = refine - i - j
    weights = np.stack([i, j, k], axis=1)
    a, b, c = (weights[None, :, m, None] * corners[:, None, m] for m in range(3))
    on_sides = (weights == 0).sum(axis=1)
    touching = np.array([6, 3, 1])[on_sides]  # small triangles at a point inside, on a side, at a corner
    edge1, edge2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = np.abs(edge1[:, 0] * edge2[:, 1] - edge1[:, 1] * edge2[:, 0]) / 2
    return ((a + b) + c) / refine, area[:, None] / (3 * refine**2) * touching


def _left_alone(count: int) -> Notice:
    return Notice(
        "warning",
        "inset-not-applied",
        f"contacts.inset: {count} interfaces keep their points where they are, because their centroid does not see "
        "all of their outline and points that move towards it could leave the surface",
    )


def point_starts(points: InterfacePoints) -> IntArray:
    """Offsets of the points of each polygon, (n_polygons + 1,)."""
    return starts(np.bincount(points.polygon, minlength=len(points.outline)).astype(np.int64))
