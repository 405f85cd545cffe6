"""Blocks swept through a chain of polygons: prisms, frusta, and blocks bent along a curve.

Between two neighbouring polygons lies one face for each of their edges, so that faces are planar where each edge and
its image on the next polygon lie in a plane: parallel edges (prisms and frusta), or edges that meet in a point.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.solids.polyhedra import Polyhedra, polyhedra_from_cells


def chains(stations: FloatArray) -> Polyhedra:
    """One block for each chain of polygons; stations (n, n_polygons, n_corners, 3).

    Corners are counter-clockwise as seen from the far end of the chain, looking back.
    """
    count, n_polygons, n_corners = stations.shape[:3]
    return polyhedra_from_cells(stations.reshape(count, n_polygons * n_corners, 3), _faces(n_polygons, n_corners))


def _faces(n_polygons: int, n_corners: int) -> list[list[int]]:
    """Outward faces by corner numbers: both ends, then the sides from polygon to polygon."""
    last = (n_polygons - 1) * n_corners
    faces = [list(range(n_corners))[::-1], list(range(last, last + n_corners))]
    for first in range(0, last, n_corners):
        for corner in range(n_corners):
            here, after = first + corner, first + (corner + 1) % n_corners
            faces.append([here, after, after + n_corners, here + n_corners])
    return faces


def prisms(outlines: FloatArray, along: FloatArray) -> Polyhedra:
    """Prisms from outlines (n, n_corners, 3), moved by ``along``, (3,) or (n, 3).

    Corners are counter-clockwise as seen against the displacement.
    """
    far = outlines + np.broadcast_to(along, (len(outlines), 3))[:, None, :]
    return chains(np.stack([outlines, far], axis=1))
