"""Common surfaces that can crush, in pieces whose stress blocks have a closed form: parallelograms and triangles.

A joint with a compressive strength bears what a field of stress between nothing and that strength bears. The resultants
of such fields over a surface are the sums of those over its pieces, so that nothing is lost by dividing it.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, IntArray, starts
from mbla.contacts.corners import Corners
from mbla.contacts.polygons import polygons_from_rings, triangles
from mbla.contacts.refine import parallelograms

FLAT = 1e-9
"""Area of a triangle, over that of its surface, up to which it is no piece but rounding of corners on one line."""


def in_pieces(corners: Corners, chosen: BoolArray) -> tuple[Corners, IntArray]:
    """The polygons chosen, (n_polygons,), in triangles unless they are parallelograms or triangles; the others whole.

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
    # rings of the pieces behind those of the polygons left whole, then all in the order of their polygons
    points = np.concatenate([left.points, spots.reshape(-1, 2)])
    counts = np.concatenate([np.diff(left.ring_start), np.full(len(row), 3)])
    polygon_of_ring = np.concatenate([left.polygon_of_ring, rows[row]])
    order = np.argsort(polygon_of_ring, kind="stable")
    begin = starts(counts)[:-1]
    corner = np.concatenate([begin[ring] + np.arange(counts[ring]) for ring in order.tolist()])
    new_piece = (np.diff(polygon_of_ring[order], prepend=-1) != 0) | divided[polygon_of_ring[order]]
    piece = np.cumsum(new_piece) - 1
    return Corners(points[corner], starts(counts[order]), piece), polygon_of_ring[order][new_piece]
