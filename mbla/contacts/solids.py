"""Volume that two solids share: the only module that imports manifold3d (while it is needed, not before)."""

from __future__ import annotations

from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.blocks import Blocks


class Solid:
    """A block as a triangulated solid, in coordinates relative to ``origin`` over ``size``."""

    def __init__(self, blocks: Blocks, block: int, origin: FloatArray, size: float) -> None:
        vertices, triangles = _triangulated(blocks, block)
        self._solid: Any = _manifold((vertices - origin) / size, triangles)

    @property
    def sound(self) -> bool:
        """False where the faces do not form a closed solid, so that nothing can be said about overlaps."""
        return self._solid is not None

    def shared_thickness(self, other: Solid) -> float:
        """Thickness 2 V / S of what two sound solids share, V its volume and S its surface; 0 if nothing."""
        common = self._solid ^ other._solid
        surface = common.surface_area()
        return 2 * abs(common.volume()) / surface if surface > 0 else 0.0


def _triangulated(blocks: Blocks, block: int) -> tuple[FloatArray, IntArray]:
    """Vertices (n, 3) m and triangles (m, 3) of a block, outwards."""
    from manifold3d import triangulate

    start, end = blocks.vertex_start[block], blocks.vertex_start[block + 1]
    found = []
    for face in range(blocks.face_start[block], blocks.face_start[block + 1]):
        loop = blocks.loops[blocks.loop_start[face] : blocks.loop_start[face + 1]] - start
        if len(loop) == 3:
            found.append(loop[None])
            continue
        corners = blocks.vertices[loop + start]
        normal = blocks.face_normals[face]
        tangent = corners[1] - corners[0]
        tangent = tangent / np.linalg.norm(tangent)
        axes = np.stack([tangent, np.cross(normal, tangent)])
        flat = (corners - corners[0]) @ axes.T
        found.append(loop[np.asarray(triangulate([flat / np.abs(flat).max()]))])
    return blocks.vertices[start:end], np.concatenate(found)


def _manifold(vertices: FloatArray, triangles: IntArray) -> Any | None:
    from manifold3d import Error, Manifold, Mesh64

    mesh = Mesh64(vert_properties=vertices, tri_verts=triangles.astype(np.uint64))
    solid = Manifold(mesh)
    if solid.status() != Error.NoError:
        mesh.merge()  # vertices listed twice at one place
        solid = Manifold(mesh)
    return solid if solid.status() == Error.NoError and not solid.is_empty() else None
