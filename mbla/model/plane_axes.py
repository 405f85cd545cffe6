"""Axes in planes: two directions across a normal, for computing in the plane."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray


def plane_axes(normals: FloatArray) -> FloatArray:
    """Two unit vectors across each unit normal, (n, 2, 3), right-handed with it: normal × first = second."""
    away = np.eye(3)[np.argmin(np.abs(normals), axis=1)]
    first = np.cross(normals, away)
    first /= np.linalg.norm(first, axis=1)[:, None]
    return np.stack([first, np.cross(normals, first)], axis=1)
