"""How far two blocks that share volume reach into each other.

Two convex blocks A and B are apart where the differences a - b of their points do not enclose the origin. The least
distance by which they must be moved apart is that of the origin from the surface of the convex hull of the differences
of their corners (penetration depth: Cameron and Culley 1986, doi:10.1109/ROBOT.1986.1087645), and the way is the normal
of the hull there. It is exact, edges across edges included.

Blocks that are not convex may interlock, so that no translation parts them. Their depth is the greatest distance of a
point on the surface of one block below the surface of the other, over points spread over the shared volume's surface.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.ragged import chunks

MOST_DIFFERENCES = 100_000
"""corners of one block times those of the other up to which the hull of their differences is made"""
PARTS = 4
"""parts into which the edges of the common surface are divided, so that some of its points lie amid it"""
MOST_DISTANCES = 20_000_000
"""points times triangles up to which distances are taken"""
_AT_ONCE = 1_000_000


def convex_penetration(blocks: Blocks, a: int, b: int) -> tuple[float, FloatArray] | None:
    """Least distance, m, by which two convex blocks must be moved apart, and the way of b, (3,); None for very many
    corners.
    """
    from scipy.spatial import ConvexHull

    one, other = (blocks.vertices[blocks.vertex_start[k] : blocks.vertex_start[k + 1]] for k in (a, b))
    if len(one) * len(other) > MOST_DIFFERENCES:
        return None
    origin = (one.mean(axis=0) + other.mean(axis=0)) / 2
    size = float(min(blocks.sizes[a], blocks.sizes[b]))
    differences = (((one - origin)[:, None] - (other - origin)[None]) / size).reshape(-1, 3)
    planes = ConvexHull(differences).equations  # normal outwards, and the height of the origin above the plane
    nearest = int(np.argmax(planes[:, 3]))
    return max(-float(planes[nearest, 3]), 0.0) * size, np.asarray(planes[nearest, :3])


def deepest_point(common: Any, one: FloatArray, other: FloatArray) -> float | None:
    """Greatest distance of a point on the surface of a solid from the farther of two surfaces; None for very many.

    common     : solid that two others share
    one, other : (n, 3, 3) triangles of the two
    """
    mesh = common.refine(PARTS).to_mesh()
    corners = np.asarray(mesh.vert_properties, dtype=np.float64)[:, :3]
    points = np.concatenate([corners, corners[np.asarray(mesh.tri_verts, dtype=np.int64)].mean(axis=1)])
    if len(points) * (len(one) + len(other)) > MOST_DISTANCES:
        return None
    return float(np.maximum(_distances(points, one), _distances(points, other)).max(initial=0.0))


def _distances(points: FloatArray, triangles: FloatArray) -> FloatArray:
    """Distance of points (n, 3) from the nearest of triangles (m, 3, 3), (n,)."""
    nearest = np.empty(len(points))
    for rows in chunks(np.full(len(points), len(triangles)), _AT_ONCE):
        nearest[rows] = _distance_to_each(points[rows], triangles).min(axis=1)
    return nearest


def _distance_to_each(points: FloatArray, triangles: FloatArray) -> FloatArray:
    """(n, m): to the plane where the foot of the perpendicular lies inside, else to the nearest edge."""
    tails, heads = triangles, np.roll(triangles, -1, axis=1)
    edges = heads - tails
    normal = np.cross(edges[:, 0], edges[:, 1])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    arms = points[:, None, None] - tails[None]
    inside = (np.einsum("nmei,mei->nme", arms, np.cross(normal[:, None], edges)) >= 0.0).all(axis=2)
    height = np.abs(np.einsum("nmi,mi->nm", arms[:, :, 0], normal))
    share = np.clip(np.einsum("nmei,mei->nme", arms, edges) / np.einsum("mei,mei->me", edges, edges), 0.0, 1.0)
    to_edge = np.linalg.norm(arms - share[..., None] * edges, axis=3).min(axis=2)
    return np.asarray(np.where(inside, height, to_edge))
