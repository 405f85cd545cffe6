"""Local frames: a normal and two tangents, the same whatever the order in which blocks come."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray

# A normal closer to the vertical than this (sine of the angle) counts as vertical: the margin keeps rounding from
# turning the tangents of a bed joint.
_VERTICAL = 1e-2


def frames_from_normals(normals: FloatArray) -> FloatArray:
    """Right-handed frames (n, 3, 3), rows: normal, tangent 1, tangent 2.

    normals : (n, 3) unit

    Tangent 1 is horizontal (z × n); for a vertical normal it is x, made perpendicular to n.
    """
    horizontal = np.stack([-normals[:, 1], normals[:, 0], np.zeros(len(normals))], axis=1)
    along_x = np.array([1.0, 0.0, 0.0]) - normals[:, :1] * normals
    vertical = np.hypot(normals[:, 0], normals[:, 1]) < _VERTICAL
    first = unit(np.where(vertical[:, None], along_x, horizontal))
    return np.stack([normals, first, np.cross(normals, first)], axis=1)


def unit(vectors: FloatArray) -> FloatArray:
    """Vectors (n, 3) divided by their lengths; zero vectors stay zero."""
    lengths = np.sqrt(np.einsum("ij,ij->i", vectors, vectors))
    result: FloatArray = vectors / np.where(lengths > 0, lengths, 1.0)[:, None]
    return result
