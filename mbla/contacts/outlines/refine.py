"""More contact points than the corners of an interface, each with its share of the area.

*Parallelograms* with m and n parts along their edges have the (m + 1)(n + 1) nodes of a grid, with the shares of the
trapezoidal rule: A/(m n) inside, half of that on an edge, a quarter at a corner.

*Other polygons* with n parts along each edge are cut into triangles (a fan about the centroid where that sees every
corner, constrained Delaunay triangles elsewhere), every triangle into n² equal ones, and each small triangle gives a
third of its area to each of its corners: n points along each edge of the outline and n − 1 rings inside.

Shares add up to the area, and their first moment about the centroid is zero.

What this does to the strength of an interface, for a rectangle b × h with n parts along h:

*Torsion.* Under associative flow more points cannot lower the torsion that the interface bears, because the program may
load its corners alone: a square of side a bears 0.7071 μWa with any number of points, against 0.3826 μWa under uniform
pressure. Without dilatancy, starting from the gravity state, normal forces spread over the points as their shares do,
and an evenly pressed square bears what the trapezoidal rule gives: 0.3826 μWa and less than 0.32 μWa/n² more.

*Crushing.* Points that bear up to f_c times their share allow all (N, M_1, M_2) whose support function is Σ A_i f_c
φ(p_i), φ(p) = max(α + β·p, 0), in place of the integral of f_c φ over the interface, which belongs to the rectangular
stress block. φ is convex, hence both rules above overestimate its integral: strength comes down to that of the stress
block from above. The trapezoidal rule errs in the one cell where φ has its kink, by at most |β| Δ²/8 for cells of
length Δ, so that a rectangle bears at most

    |M| ≤ N (h − N/(f_c b))/2 + f_c A h/(8 n²)     (stress block: without the last term; about either axis likewise)

and with eccentricity e, ν = N/(f_c A) and ξ = 1 − 2e/h, the stress block giving ν = ξ,

    ξ ≤ ν ≤ (ξ + √(ξ² + 1/n²))/2

With both eccentricities the two rules are applied one after the other: either moment exceeds that of a force point of
the exact stress block by no more than its own f_c A h/(8 n²).

On the triangles of other polygons the sum is the integral of the linear interpolant of φ, which lies above φ by at most
|β| w/4, and only in triangles that the kink crosses, w their extent along β. With h the extent of the polygon, w ≤ h/n;
with b its greatest breadth across, these triangles cover at most 2 w b: moments exceed those of the stress block by at
most f_c b h²/(2 n²).

Share of the interface area that each contact point stands for.

A third of a triangle goes to each of its corners: the shares of any triangulation add up to the area and have their
first moment about its centroid. A convex polygon is triangulated by the fan from every corner in turn and the shares
are averaged, so that no diagonal is preferred: a rectangle gives a quarter to each corner. Other polygons, and those
with holes, take their constrained Delaunay triangulation. All shares are positive.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.outlines.corners import Corners, parallelograms
from mbla.model.solids.convex import convex_loops
from mbla.model.solids.polygons import polygons_from_rings, triangles
from mbla.model.solids.ragged import next_item


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


def divided(corners: Corners, centroids: FloatArray, star: BoolArray, parts: IntArray) -> InterfacePoints:
    """Points of polygons whose edges are divided.

    centroids : (n_polygons, 2)
    star      : (n_polygons,) whether the centroid sees every corner
    parts     : (n_polygons, 2) along the first and second edge of a parallelogram, both the same elsewhere; 1: corners
    """
    n = len(centroids)
    flat = parallelograms(corners, n)
    plain = (parts == 1).all(axis=1)
    rings = np.bincount(corners.polygon_of_ring, minlength=n)
    fan = np.zeros(n, dtype=bool)
    fan[corners.polygon_of_ring] = convex_loops(corners.points, corners.ring_start)
    fan &= plain & (rings == 1)
    rest = corners.take((plain & ~fan)[corners.polygon_of_corner])
    found = [_at_corners(corners.take(fan[corners.polygon_of_corner]), n)]
    if len(rest.points):
        found.append(_triangulated_points(rest, centroids, np.zeros(n, dtype=bool), 1, n))
    kinds = [(True, int(a), int(b)) for a, b in np.unique(parts[flat & ~plain], axis=0)]
    kinds += [(False, int(a), int(a)) for a in np.unique(parts[~flat & ~plain, 0])]
    for is_flat, a, b in kinds:
        chosen = (flat == is_flat) & ~plain & (parts == (a, b)).all(axis=1)
        some = corners.take(chosen[corners.polygon_of_corner])
        found.append(_grid(some, a, b, n) if is_flat else _triangulated_points(some, centroids, star, a, n))
    polygon = np.concatenate([each.polygon for each in found])
    order = np.argsort(polygon, kind="stable")
    return InterfacePoints(
        points=np.concatenate([each.points for each in found])[order],
        polygon=polygon[order],
        outline=np.sum([each.outline for each in found], axis=0),
        areas=np.concatenate([each.areas for each in found])[order],
    )


def _outer(corners: Corners) -> BoolArray:
    """Which corners are of the outer ring of their polygon, which comes first, (n_corners,)."""
    first = np.diff(corners.polygon_of_ring, prepend=-1) != 0
    return np.repeat(first, np.diff(corners.ring_start))


def _outline(corners: Corners, n: int) -> IntArray:
    """Corners of the outer ring of each polygon, (n,); 0 for polygons that have none here."""
    return np.bincount(corners.polygon_of_corner[_outer(corners)], minlength=n)


def _at_corners(corners: Corners, n: int) -> InterfacePoints:
    """Corners of convex polygons without holes, their shares averaged over the fans from every corner."""
    shares, counts = np.zeros(len(corners.points)), np.diff(corners.ring_start)
    for count in np.unique(counts):
        rows = corners.ring_start[:-1][counts == count][:, None] + np.arange(count)
        shares[rows] = _fan_shares(corners.points[rows])
    return InterfacePoints(corners.points, corners.polygon_of_corner, _outline(corners, n), shares)


def _grid(corners: Corners, m: int, n: int, n_polygons: int) -> InterfacePoints:
    """Parallelograms with m parts along their first edge and n along the second: outline, then rows of inner nodes."""
    spots = corners.points.reshape(-1, 4, 2)
    i = np.concatenate([np.arange(m), np.full(n, m), m - np.arange(m), np.zeros(n, dtype=np.int64)])
    j = np.concatenate([np.zeros(m, dtype=np.int64), np.arange(n), np.full(m, n), n - np.arange(n)])
    inner = [axis.ravel() for axis in np.meshgrid(np.arange(1, m), np.arange(1, n), indexing="ij")]
    i, j = np.concatenate([i, inner[0]]), np.concatenate([j, inner[1]])
    weights = np.stack([(m - i) * (n - j), i * (n - j), i * j, (m - i) * j], axis=1) / (m * n)
    shares = np.where((i == 0) | (i == m), 0.5, 1.0) * np.where((j == 0) | (j == n), 0.5, 1.0) / (m * n)
    first, second = spots[:, 2] - spots[:, 0], spots[:, 3] - spots[:, 1]
    area = np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / 2
    outline = np.zeros(n_polygons, dtype=np.int64)
    outline[corners.polygon_of_ring] = 2 * (m + n)
    return InterfacePoints(
        points=np.einsum("gc,pcx->pgx", weights, spots).reshape(-1, 2),
        polygon=np.repeat(corners.polygon_of_ring, len(i)),
        outline=outline,
        areas=np.outer(area, shares).ravel(),
    )


def _triangulated_points(
    corners: Corners, centroids: FloatArray, star: BoolArray, parts: int, n_polygons: int
) -> InterfacePoints:
    """Points along the edges first, in the order of the corners, then those inside."""
    edge_points, edge_polygon = _along_edges(corners, parts), np.repeat(corners.polygon_of_corner, parts)
    triangles, row = _triangulated(corners, centroids, star)
    nodes, third = _nodes_of_triangles(triangles, parts)
    node_polygon = np.repeat(row, nodes.shape[1])
    key = places(np.concatenate([edge_polygon, node_polygon]), np.concatenate([edge_points, nodes.reshape(-1, 2)]))
    on_edge, at_node = key[: len(edge_points)], key[len(edge_points) :]
    shares = np.bincount(at_node, third.ravel())  # the last of all places is a corner, which is a node
    inside, first = np.unique(at_node, return_index=True)
    new = ~np.isin(inside, on_edge)
    inside, first = inside[new], first[new]
    # where a hole touches the outline two points share one place, and its area
    edge_areas = shares[on_edge] / np.bincount(on_edge, minlength=len(shares))[on_edge]
    # an edge that a hole touches between its corners is divided on either side of that place, by points inside
    kept = edge_areas > 0.0
    outline = np.bincount(edge_polygon[kept & np.repeat(_outer(corners), parts)], minlength=n_polygons)
    edge_points, edge_polygon, edge_areas = edge_points[kept], edge_polygon[kept], edge_areas[kept]
    polygon = np.concatenate([edge_polygon, node_polygon[first]])
    order = np.argsort(polygon, kind="stable")
    return InterfacePoints(
        points=np.concatenate([edge_points, nodes.reshape(-1, 2)[first]])[order],
        polygon=polygon[order],
        outline=outline,
        areas=np.concatenate([edge_areas, shares[inside]])[order],
    )


def _along_edges(corners: Corners, parts: int) -> FloatArray:
    """Points that divide each edge into equal parts, its first corner included, (parts n_corners, 2)."""
    here, there = corners.points, corners.points[next_item(corners.ring_start)]
    step = np.arange(parts)[:, None]
    # the same sums as in ``_nodes_of_triangles``, so that points on an edge agree bit by bit
    return np.asarray((((parts - step) * here[:, None] + step * there[:, None]) / parts).reshape(-1, 2))


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
    if not fan.all():
        rest = corners.take(~fan)
        number, dense = np.unique(rest.polygon_of_ring, return_inverse=True)
        spots, row = triangles(polygons_from_rings(rest.points, rest.ring_start, dense.astype(np.int64)))
        parts.append(spots)
        rows.append(number[row])
    return np.concatenate(parts), np.concatenate(rows)


def _nodes_of_triangles(corners: FloatArray, parts: int) -> tuple[FloatArray, FloatArray]:
    """Corners of the n² small triangles of each triangle, each once, and their shares of area.

    corners : (n_triangles, 3, 2)

    Returns
    -------
    nodes  : (n_triangles, (n + 1)(n + 2)/2, 2)
    shares : (n_triangles, (n + 1)(n + 2)/2)
    """
    i, j = (index.ravel() for index in np.meshgrid(np.arange(parts + 1), np.arange(parts + 1), indexing="ij"))
    i, j = i[i + j <= parts], j[i + j <= parts]
    k = parts - i - j
    weights = np.stack([i, j, k], axis=1)
    a, b, c = (weights[None, :, m, None] * corners[:, None, m] for m in range(3))
    on_sides = (weights == 0).sum(axis=1)
    touching = np.array([6, 3, 1])[on_sides]  # small triangles at a point inside, on a side, at a corner
    edge1, edge2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = np.abs(edge1[:, 0] * edge2[:, 1] - edge1[:, 1] * edge2[:, 0]) / 2
    return ((a + b) + c) / parts, area[:, None] / (3 * parts**2) * touching


def _fan_shares(points: FloatArray) -> FloatArray:
    """Shares (k, m) of the corners of k convex polygons, averaged over the fans from every corner.

    points : (k, m, 2) counter-clockwise
    """
    k, m, _ = points.shape
    shares = np.zeros((k, m))
    following = np.roll(points, -1, axis=1)
    for apex in range(m):
        first, second = points - points[:, apex, None], following - points[:, apex, None]
        third = (first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]) / 6
        shares[:, apex] += third.sum(axis=1)
        shares += third + np.roll(third, 1, axis=1)
    shares /= m
    return shares


def places(polygon: IntArray, points: FloatArray) -> IntArray:
    """Number of each distinct (polygon, x, y), (n,); triangles repeat the corners exactly, bit by bit."""
    order = np.lexsort((points[:, 1], points[:, 0], polygon))
    step = (np.diff(polygon[order]) != 0) | (np.diff(points[order], axis=0) != 0).any(axis=1)
    number = np.empty(len(order), dtype=np.int64)
    number[order] = np.concatenate([[0], np.cumsum(step)])
    return number
