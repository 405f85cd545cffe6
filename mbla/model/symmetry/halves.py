"""Halves of blocks joined with their mirror images: both without their faces on the plane."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra, polyhedra_from_lists, take_polyhedra


def halves_joined(
    own: Polyhedra, image: Polyhedra, halves: BoolArray, point: FloatArray, normal: FloatArray, allowed: FloatArray
) -> Polyhedra:
    """The polyhedra, those of ``halves`` (n,) as one with their images.

    allowed : (n,) distance from the plane up to which corners lie on it; they are moved onto it
    """
    if not halves.any():
        return own
    chosen = np.flatnonzero(halves)
    vertices, faces = zip(
        *(_joined(own, image, int(block), point, normal, float(allowed[block])) for block in chosen), strict=True
    )
    everything = join_polyhedra([own, polyhedra_from_lists(vertices, faces)])
    order = np.arange(len(own))
    order[chosen] = len(own) + np.arange(len(chosen))
    return take_polyhedra(everything, order)


def _joined(
    own: Polyhedra, image: Polyhedra, block: int, point: FloatArray, normal: FloatArray, allowed: float
) -> tuple[FloatArray, list[list[int]]]:
    """Vertices and faces of one block and its image without their faces on the plane."""
    rows = slice(own.vertex_start[block], own.vertex_start[block + 1])
    vertices = own.vertices[rows]
    heights = (vertices - point) @ normal
    on_plane = np.abs(heights) <= allowed
    vertices = vertices - np.where(on_plane, heights, 0.0)[:, None] * normal
    count = len(vertices)
    number = np.where(on_plane, np.arange(count), count + np.cumsum(~on_plane) - 1)  # of images: shared on the plane
    faces = []
    for face in range(own.face_start[block], own.face_start[block + 1]):
        loop = own.loop(face) - own.vertex_start[block]
        if on_plane[loop].all():
            continue
        mirrored = image.loop(face) - own.vertex_start[block]
        faces += [loop.tolist(), number[mirrored].tolist()]
    return np.vstack([vertices, image.vertices[rows][~on_plane]]), faces
