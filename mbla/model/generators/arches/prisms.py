"""Prisms across the width of an arch from polygons in the x-z plane, straight or on a skew plan."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra, polyhedra_from_cells, take_polyhedra


def prisms(polygons: Sequence[FloatArray], across: FloatArray, shear: float = 0.0) -> Polyhedra:
    """A prism from each polygon, (k, 2), between the planes y = across[i, 0] and y = across[i, 1].

    Corners counter-clockwise as seen in the x-z plane (x to the right, z up), which is from -y.
    shear : x grows by this times y [-]
    """
    counts = np.array([len(polygon) for polygon in polygons], dtype=np.int64)
    parts, order = [], []
    for count in np.unique(counts):
        chosen = np.flatnonzero(counts == count)
        section = np.stack([polygons[i] for i in chosen.tolist()])
        near, far = (in_space(section, across[chosen, side, None]) for side in (0, 1))
        # seen from the far side the order is clockwise, so that the near face is the upper one of the template
        corners = np.concatenate([far, near], axis=1)
        corners[..., 0] += shear * corners[..., 1]
        parts.append(polyhedra_from_cells(corners, _faces(int(count))))
        order.append(chosen)
    if len(parts) == 1:
        return parts[0]
    return take_polyhedra(join_polyhedra(parts), np.argsort(np.concatenate(order)))


def in_space(points: FloatArray, y: FloatArray | float = 0.0) -> FloatArray:
    """Points (..., 2) of the x-z plane in space, (..., 3)."""
    return np.stack([points[..., 0], np.broadcast_to(y, points.shape[:-1]), points[..., 1]], axis=-1)


def _faces(count: int) -> tuple[tuple[int, ...], ...]:
    """Faces of a prism: corners 0 to count - 1 of one end counter-clockwise seen from the other, then those above."""
    ends = ((0, *range(count - 1, 0, -1)), tuple(range(count, 2 * count)))
    following = [(i + 1) % count for i in range(count)]
    return ends + tuple((i, j, j + count, i + count) for i, j in zip(range(count), following, strict=True))
