"""Which parts of faces are free, and which lie against another block or on the ground.

Each face is a polygon in coordinates of its own plane. The faces of other blocks that lie against it are taken away
from it; what is left is told by its rings, holes among them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.model.model import Ground
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import meeting_boxes, plane_axes, signed_areas
from mbla.model.solids.ragged import items_of_rows, row_maxima

FACING = 0.99
"""cosine of the greatest angle between two faces that lie against each other"""


@dataclass(frozen=True)
class FaceParts:
    """Loops whose signed integrals add up to what is loaded.

    loops : (n, k, 3) corners on the planes of their faces, the last one repeated where there are fewer
    signs : (n,) that make areas of outlines positive as the face is seen from outside, and those of holes negative
    faces : (n,) position of the face in the list asked for
    areas : (n_faces,) area of each face; covered : (n_faces,) the part of it that other blocks and grounds cover
    """

    loops: FloatArray
    signs: FloatArray
    faces: IntArray
    areas: FloatArray
    covered: FloatArray


@dataclass(frozen=True)
class _Frames:
    """Plane coordinates on faces: ``origins`` (n, 3), ``axes`` (n, 2, 3), right-handed with the outward normal."""

    origins: FloatArray
    axes: FloatArray

    def polygons(self, rows: IntArray, faces: IntArray, blocks: Blocks) -> Any:
        """Faces (n,) as polygons, (n,), each in the plane of one of the frames."""
        import shapely

        ring = np.repeat(np.arange(len(faces)), np.diff(blocks.loop_start)[faces])
        points = blocks.vertices[blocks.loops[items_of_rows(blocks.loop_start, faces)]]
        flat = np.einsum("nj,nij->ni", points - self.origins[rows][ring], self.axes[rows][ring])
        found = np.atleast_1d(shapely.polygons(shapely.linearrings(flat, indices=ring)))
        return np.where(shapely.is_valid(found), found, shapely.make_valid(found))

    def loops(self, polygons: Any) -> tuple[FloatArray, FloatArray, IntArray]:
        """Rings of polygons (n,), one for each frame: corners (m, k, 3), signs (m,), and their polygons (m,)."""
        import shapely

        parts, owner = shapely.get_parts(polygons, return_index=True)
        rings, part = shapely.get_rings(parts, return_index=True)
        points, ring = shapely.get_coordinates(rings, return_index=True)
        if not len(rings):
            return np.zeros((0, 3, 3)), np.zeros(0), np.zeros(0, dtype=np.int64)
        start = starts(np.bincount(ring, minlength=len(rings)))
        width = np.arange(np.diff(start).max())
        flat = points[np.minimum(start[:-1, None] + width, start[1:, None] - 1)]
        turns = np.sign(signed_areas(flat))
        rows = owner[part].astype(np.int64)
        corners = np.einsum("nki,nij->nkj", flat, self.axes[rows]) + self.origins[rows, None]
        return corners, np.where(np.diff(part, prepend=-1) != 0, turns, -turns), rows


def face_parts(
    faces: IntArray, blocks: Blocks, grounds: tuple[Ground, ...], tolerance: float, free_only: bool
) -> FaceParts:
    """The faces (n,), or what of them is free; ``tolerance`` relative to block size, as that of contacts."""
    import shapely

    frames = _Frames(blocks.vertices[blocks.loops[blocks.loop_start[faces]]], plane_axes(blocks.face_normals[faces]))
    polygons = frames.polygons(np.arange(len(faces)), faces, blocks)
    areas = left = np.asarray(shapely.area(polygons))
    if free_only:
        mine, others = _facing_pairs(faces, blocks, tolerance)
        groups = np.split(frames.polygons(mine, others, blocks), np.flatnonzero(np.diff(mine)) + 1)
        for row, against in zip(np.unique(mine).tolist(), groups, strict=False):
            polygons[row] = shapely.difference(polygons[row], shapely.union_all(against))
        left = np.where(_on_ground(faces, blocks, grounds, tolerance), 0.0, shapely.area(polygons))
        left[left <= 2.0 * tolerance * areas] = 0.0  # what is left beside is the rounding of outlines
        polygons[left == 0.0] = shapely.Polygon()
    return FaceParts(*frames.loops(polygons), areas, areas - left)


def _on_ground(faces: IntArray, blocks: Blocks, grounds: tuple[Ground, ...], tolerance: float) -> BoolArray:
    """Faces that lie on a ground plane that carries their block."""
    found = np.zeros(len(faces), dtype=bool)
    owner = blocks.block_of_face[faces]
    corners = items_of_rows(blocks.loop_start, faces)
    start = starts(np.diff(blocks.loop_start)[faces])
    for ground in grounds:
        heights = np.abs((blocks.vertices[blocks.loops[corners]] - ground.point) @ ground.normal)
        on = row_maxima(heights, start) <= tolerance * blocks.sizes[owner]
        on &= blocks.face_normals[faces] @ ground.normal <= -FACING
        found |= on if ground.blocks is None else on & np.isin(owner, ground.blocks)
    return found


def _facing_pairs(faces: IntArray, blocks: Blocks, tolerance: float) -> tuple[IntArray, IntArray]:
    """(position in ``faces``, face of another block that may lie against it)."""
    corners = blocks.vertices[blocks.loops]
    low, high = -row_maxima(-corners, blocks.loop_start), row_maxima(corners, blocks.loop_start)
    reach = tolerance * blocks.sizes[blocks.block_of_face]
    margin = reach[faces, None]
    mine, others = meeting_boxes(low[faces] - margin, high[faces] + margin, low, high)
    face = faces[mine]
    between = blocks.vertices[blocks.loops[blocks.loop_start[others]]]
    between = between - blocks.vertices[blocks.loops[blocks.loop_start[face]]]
    normals = blocks.face_normals[face]
    kept = blocks.block_of_face[face] != blocks.block_of_face[others]
    kept &= np.abs(np.einsum("ij,ij->i", between, normals)) <= 2.0 * reach[face] + reach[others]
    kept &= np.einsum("ij,ij->i", blocks.face_normals[others], normals) <= -FACING
    return mine[kept], others[kept]
