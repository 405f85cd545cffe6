"""Blocks swept through a chain of polygons: prisms, frusta, and blocks bent along a curve.

Between two neighbouring polygons lies one face for each of their edges, so that faces are planar where each edge and
its image on the next polygon lie in a plane: parallel edges (prisms and frusta), or edges that meet in a point.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra, polyhedra_from_cells, take_polyhedra


def chains(stations: FloatArray) -> Polyhedra:
    """One block for each chain of polygons; stations (n, n_polygons, n_corners, 3).

    Corners are counter-clockwise as seen from the far end of the chain, looking back.
    """
    count, n_polygons, n_corners = stations.shape[:3]
    return polyhedra_from_cells(stations.reshape(count, n_polygons * n_corners, 3), _faces(n_polygons, n_corners))


def _faces(n_polygons: int, n_corners: int) -> list[list[int]]:
    """Outward faces by corner numbers: both ends, then the sides from polygon to polygon."""
    last = (n_polygons - 1) * n_corners
    faces = [[0, *range(n_corners - 1, 0, -1)], list(range(last, last + n_corners))]
    for first in range(0, last, n_corners):
        for corner in range(n_corners):
            here, after = first + corner, first + (corner + 1) % n_corners
            faces.append([here, after, after + n_corners, here + n_corners])
    return faces


def prisms(polygons: Sequence[FloatArray], across: FloatArray, shear: float = 0.0) -> Polyhedra:
    """A prism from each polygon, (k, 2), between the planes y = across[i, 0] and y = across[i, 1]; across (n, 2).

    Corners counter-clockwise as seen in the x-z plane (x to the right, z up), which is from -y.
    shear : x grows by this times y [-]
    """
    counts = np.array([len(polygon) for polygon in polygons], dtype=np.int64)
    parts, order = [], []
    for count in np.unique(counts):
        chosen = np.flatnonzero(counts == count)
        section = np.stack([polygons[i] for i in chosen.tolist()])
        # seen from the far side the order is clockwise, so that the near face is the end of the chain
        stations = np.stack([in_space(section, across[chosen, side, None]) for side in (1, 0)], axis=1)
        stations[..., 0] += shear * stations[..., 1]
        parts.append(chains(stations))
        order.append(chosen)
    if len(parts) == 1:
        return parts[0]
    return take_polyhedra(join_polyhedra(parts), np.argsort(np.concatenate(order)))


def in_space(points: FloatArray, y: FloatArray | float = 0.0) -> FloatArray:
    """Points (..., 2) of the x-z plane in space, (..., 3)."""
    return np.stack([points[..., 0], np.broadcast_to(y, points.shape[:-1]), points[..., 1]], axis=-1)
