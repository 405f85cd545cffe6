"""Two planes that face each other: their mean plane, and the gap between them over it.

A surface common to bodies a and b is described in a local frame (n, t1, t2) with lengths divided by the block size L of
the pair, so that the arithmetic is the same in any unit and anywhere in space::

    X = o + L (x t1 + y t2 + z n),   n = (n_a − n_b) / |n_a − n_b|

with n_a, n_b the outward normals. Plane a is z_a = p_a·n_a/(n·n_a) − x (t1·n_a)/(n·n_a) − y (t2·n_a)/(n·n_a), p_a being
a point on it relative to o over L. The slopes of z_a and z_b are opposite, hence the mean plane is perpendicular to n;
o is put on it, so that the mean plane is z = 0 and the gap is g = z_b − z_a = g0 + gx x + gy y.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self, TypeVar

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray

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


@dataclass(frozen=True)
class Rows:
    """Arrays of as many rows each, or records of these."""

    def take(self, rows: IntArray | BoolArray) -> Self:
        """The given rows, (n,), repeated where named twice."""
        fields = vars(self).items()
        return replace(
            self, **{name: each.take(rows) if isinstance(each, Rows) else each[rows] for name, each in fields}
        )


R = TypeVar("R", bound=Rows)


def concatenate(parts: Sequence[R]) -> R:
    """One record of several."""
    found = {name: [getattr(part, name) for part in parts] for name in vars(parts[0])}
    joined = {
        name: concatenate(each) if isinstance(each[0], Rows) else np.concatenate(each) for name, each in found.items()
    }
    return replace(parts[0], **joined)


@dataclass(frozen=True)
class Overlays(Rows):
    """Mean planes of pairs of facets, or of ground and facet.

    bodies  : (n, 2)     a, b
    facets  : (n, 2)     facet of each; −1 for ground
    origins : (n, 3) m   point on the mean plane near the common surface
    frames  : (n, 3, 3)  rows: normal from a to b, tangents
    sizes   : (n,) m     block size of the pair, to which local lengths are relative
    gaps    : (n, 3)     g0, gx, gy of the gap, relative to size
    """

    bodies: IntArray
    facets: IntArray
    origins: FloatArray
    frames: FloatArray
    sizes: FloatArray
    gaps: FloatArray

    def __len__(self) -> int:
        return len(self.sizes)


@dataclass(frozen=True)
class Planes:
    """Planes by point and outward unit normal, (n, 3) each."""

    points: FloatArray
    normals: FloatArray


def build_overlays(
    bodies: IntArray,
    facets: IntArray,
    a: Planes,
    b: Planes,
    near: FloatArray,
    sizes: FloatArray,
    host: FloatArray | float = 0.0,
) -> Overlays:
    """Overlays of planes a and b.

    near  : (n, 3) m  a point near the common surface
    sizes : (n,) m    block size of the pair
    host  : (n,) 1 where the common plane is that of a, -1 where it is that of b, 0 where it is the mean
    """
    side = np.reshape(host, (-1, 1))
    mean = unit(a.normals - b.normals)
    frames = frames_from_normals(np.where(side > 0.0, a.normals, np.where(side < 0.0, -b.normals, mean)))
    height_a, slope_a = _plane_over(a, near, frames, sizes)
    height_b, slope_b = _plane_over(b, near, frames, sizes)
    middle = (1.0 + host) / 2 * height_a + (1.0 - host) / 2 * height_b
    return Overlays(
        bodies=bodies,
        facets=facets,
        origins=near + (middle * sizes)[:, None] * frames[:, 0],
        frames=frames,
        sizes=sizes,
        gaps=np.column_stack([height_b - height_a, slope_b - slope_a]),
    )


def local_maps(overlays: Overlays, origins: FloatArray, frames: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Maps from the planes of facets to the local coordinates of overlays: x -> matrix x + offset.

    origins : (n, 3) m    of the facets
    frames  : (n, 3, 3)   of the facets

    Returns
    -------
    matrices : (n, 2, 2) 1/m
    offsets  : (n, 2)
    """
    tangents = overlays.frames[:, 1:]
    scale = 1 / overlays.sizes
    matrices = np.einsum("kai,kbi->kab", tangents, frames[:, 1:]) * scale[:, None, None]
    offsets = np.einsum("kai,ki->ka", tangents, origins - overlays.origins) * scale[:, None]
    return matrices, offsets


def gap_at(overlays: Overlays, row: IntArray, points: FloatArray) -> FloatArray:
    """Gap relative to block size at local points (n, 2) of the overlays ``row``, (n,)."""
    gaps = overlays.gaps[row]
    gap: FloatArray = gaps[:, 0] + gaps[:, 1] * points[:, 0] + gaps[:, 2] * points[:, 1]
    return gap


def in_space(overlays: Overlays, row: IntArray, points: FloatArray) -> FloatArray:
    """Local points (n, 2) of the overlays ``row`` in space, (n, 3) m."""
    offsets = np.einsum("ka,kai->ki", points, overlays.frames[row, 1:])
    result: FloatArray = overlays.origins[row] + overlays.sizes[row, None] * offsets
    return result


def _plane_over(
    planes: Planes, near: FloatArray, frames: FloatArray, sizes: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Height (n,) and slopes (n, 2) of planes over the frames at the points near."""
    components = np.einsum("kai,ki->ka", frames, planes.normals)
    distance = np.einsum("ki,ki->k", planes.points - near, planes.normals) / sizes
    return distance / components[:, 0], -components[:, 1:] / components[:, :1]
