"""Volume that two solids share: the only module that imports manifold3d (while it is needed, not before)."""

from __future__ import annotations

from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.frames import frames_from_normals
from mbla.model.blocks import Blocks


class Solid:
    """A closed surface of triangles as a solid, in coordinates relative to ``origin`` over ``size``."""

    def __init__(self, vertices: FloatArray, triangles: IntArray, origin: FloatArray, size: float) -> None:
        first, last = triangles.min(), triangles.max()
        self._solid: Any = _manifold((vertices[first : last + 1] - origin) / size, triangles - first)

    @property
    def sound(self) -> bool:
        """False where the triangles do not form a closed solid, so that nothing can be said about overlaps."""
        return self._solid is not None

    def shared_thickness(self, other: Solid) -> float:
        """Thickness 2 V / S of what two sound solids share, V its volume and S its surface; 0 if nothing."""
        common = self._solid ^ other._solid
        surface = common.surface_area()
        return 2 * abs(common.volume()) / surface if surface > 0 else 0.0


def triangulate_block(blocks: Blocks, block: int) -> IntArray:
    """Triangles (m, 3) of a block, outwards, as rows of ``blocks.vertices``."""
    from manifold3d import triangulate

    faces = slice(blocks.face_start[block], blocks.face_start[block + 1])
    frames = frames_from_normals(blocks.face_normals[faces])
    starts = blocks.loop_start[blocks.face_start[block] : blocks.face_start[block + 1] + 1]
    found = []
    for tangents, first, end in zip(frames[:, 1:], starts[:-1], starts[1:], strict=True):
        loop = blocks.loops[first:end]
        if len(loop) == 3:
            found.append(loop[None])
            continue
        corners = blocks.vertices[loop]
        flat = (corners - corners[0]) @ tangents.T
        found.append(loop[np.asarray(triangulate([flat / np.abs(flat).max()]))])
    return np.concatenate(found)


def _manifold(vertices: FloatArray, triangles: IntArray) -> Any | None:
    from manifold3d import Error, Manifold, Mesh64

    mesh = Mesh64(vert_properties=vertices, tri_verts=triangles.astype(np.uint64))
    solid = Manifold(mesh)
    if solid.status() != Error.NoError:
        mesh.merge()  # vertices listed twice at one place
        solid = Manifold(mesh)
    return solid if solid.status() == Error.NoError and not solid.is_empty() else None
