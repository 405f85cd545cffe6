"""Volume that two solids share: the only module that imports manifold3d (while it is needed, not before)."""

from __future__ import annotations

from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray, starts
from mbla.contacts.frames import frames_from_normals
from mbla.contacts.ragged import rows_and_items
from mbla.model.blocks import Blocks
from mbla.model.ragged import ranges


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


def triangulate_blocks(blocks: Blocks, chosen: IntArray) -> dict[int, IntArray]:
    """Triangles (m, 3) of each block, outwards, as rows of ``blocks.vertices``."""
    faces = ranges(blocks.face_start[chosen], np.diff(blocks.face_start)[chosen])
    first, count = blocks.loop_start[faces], np.diff(blocks.loop_start)[faces]
    row, corner = rows_and_items(first, count)
    # all corners in the planes of their faces at once; one by one this takes longer than the solids
    arms = blocks.vertices[blocks.loops[corner]] - blocks.vertices[blocks.loops[first]][row]
    tangents = frames_from_normals(blocks.face_normals[faces])[:, 1:]
    flat = np.einsum("ki,kai->ka", arms, tangents[row])
    of_face = starts(count)
    triangles: dict[int, list[IntArray]] = {}
    for number, block in enumerate(blocks.block_of_face[faces].tolist()):
        loop = blocks.loops[first[number] : first[number] + count[number]]
        triangles.setdefault(block, []).append(_triangles(loop, flat[of_face[number] : of_face[number + 1]]))
    return {block: np.concatenate(found) for block, found in triangles.items()}


def _triangles(loop: IntArray, flat: FloatArray) -> IntArray:
    """A face, (n,) vertices at (n, 2) in its plane, as triangles."""
    from manifold3d import triangulate

    return loop[None] if len(loop) == 3 else loop[np.asarray(triangulate([flat]))]


def _manifold(vertices: FloatArray, triangles: IntArray) -> Any | None:
    from manifold3d import Error, Manifold, Mesh64

    mesh = Mesh64(vert_properties=vertices, tri_verts=triangles.astype(np.uint64))
    solid = Manifold(mesh)
    if solid.status() != Error.NoError:
        mesh.merge()  # vertices listed twice at one place
        solid = Manifold(mesh)
    return solid if solid.status() == Error.NoError and not solid.is_empty() else None
