"""Free parts of faces, what no other block and no ground covers, and parts of them that certain blocks cover.

Each face is a polygon in coordinates of its own plane. The faces of other blocks that lie against it are taken away
from it, or what it has in common with them is taken; that is divided into triangles.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, row_of_item
from mbla.model.model import Ground
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import meeting_boxes, plane_axes
from mbla.model.solids.polygons import (
    Polygons,
    connected_parts,
    polygons_from_loops,
    triangles,
    union_by_row,
)
from mbla.model.solids.ragged import row_maxima, row_ranges
from mbla.process.late import shapely

FACING = 0.99
"""cosine of the greatest angle between two faces that lie against each other"""


@dataclass(frozen=True)
class FaceParts:
    """What is loaded of faces.

    loops : (n, 3, 3) corners of triangles on the planes of their faces, counter-clockwise seen from outside
    faces : (n,) position of the face in the list asked for
    areas : (n_faces,) area of each face; covered : (n_faces,) the part of it that other blocks and grounds cover
    """

    loops: FloatArray
    faces: IntArray
    areas: FloatArray
    covered: FloatArray


@dataclass(frozen=True)
class _Frames:
    """Plane coordinates on faces: ``origins`` (n, 3), ``axes`` (n, 2, 3), right-handed with the outward normal."""

    origins: FloatArray
    axes: FloatArray

    def polygons(self, rows: IntArray, faces: IntArray, blocks: Blocks) -> Polygons:
        """Faces (n,) as polygons, (n,), each in the plane of one of the frames."""
        corners, start = blocks.corners_of(faces)
        frame = rows[row_of_item(start)]
        return polygons_from_loops(np.einsum("nj,nij->ni", corners - self.origins[frame], self.axes[frame]), start)

    def outline(self, row: int, corners: FloatArray) -> Any:
        """A surface, corners (n, 3), as a polygon in the plane of a frame."""
        return shapely.Polygon((corners - self.origins[row]) @ self.axes[row].T)

    def triangles(self, polygons: Polygons, frame: IntArray) -> tuple[FloatArray, IntArray]:
        """Triangles of polygons (n,), each in the plane of a frame: corners (m, 3, 3), outwards, and frames (m,)."""
        flat, rows = triangles(polygons)
        rows = frame[rows]
        return np.einsum("nki,nij->nkj", flat, self.axes[rows]) + self.origins[rows, None], rows


def _frames_of(faces: IntArray, blocks: Blocks) -> _Frames:
    return _Frames(blocks.vertices[blocks.loops[blocks.loop_start[faces]]], plane_axes(blocks.face_normals[faces]))


def face_parts(
    faces: IntArray,
    blocks: Blocks,
    grounds: tuple[Ground, ...],
    tolerance: float,
    free_only: bool,
    overlap: float = 0.0,
) -> FaceParts:
    """The faces (n,), or what of them is free.

    tolerance, overlap : of gaps and of overlaps, relative to block size, as those of contacts
    """
    frames = _frames_of(faces, blocks)
    polygons = frames.polygons(np.arange(len(faces)), faces, blocks)
    areas = left = np.asarray(shapely.area(polygons))
    if free_only:
        mine, others = _facing_pairs(faces, blocks, tolerance, overlap)
        groups = np.split(frames.polygons(mine, others, blocks), np.flatnonzero(np.diff(mine)) + 1)
        for row, against in zip(np.unique(mine).tolist(), groups, strict=False):
            polygons[row] = shapely.difference(polygons[row], shapely.union_all(against))
        for ground in grounds:
            on = _on_ground(faces, blocks, ground, tolerance, overlap)
            for row in np.flatnonzero(on).tolist():
                taken = polygons[row] if ground.outline is None else frames.outline(row, ground.outline)
                polygons[row] = shapely.difference(polygons[row], taken)
        left = np.asarray(shapely.area(polygons))
        left[left <= 2.0 * tolerance * areas] = 0.0  # rounding of outlines
        polygons[left == 0.0] = shapely.Polygon()
    return FaceParts(*frames.triangles(polygons, np.arange(len(faces))), areas, areas - left)


def parts_against(faces: IntArray, by: BoolArray, blocks: Blocks, tolerance: float, overlap: float) -> FaceParts:
    """What of the faces (n,) some blocks, (n_blocks,), cover, or come within the tolerance of covering.

    tolerance, overlap : as of ``face_parts``
    """
    frames = _frames_of(faces, blocks)
    polygons = frames.polygons(np.arange(len(faces)), faces, blocks)
    mine, others = _facing_pairs(faces, blocks, tolerance, overlap)
    chosen = by[blocks.block_of_face[others]]
    mine, others = mine[chosen], others[chosen]
    rows, group = np.unique(mine, return_inverse=True)
    against = union_by_row(frames.polygons(mine, others, blocks), group, len(rows))
    common, row = connected_parts(shapely.intersection(polygons[rows], against))
    covered = np.bincount(rows[row], weights=np.asarray(shapely.area(common)), minlength=len(faces)).astype(np.float64)
    return FaceParts(*frames.triangles(common, rows[row]), np.asarray(shapely.area(polygons)), covered)


def _on_ground(faces: IntArray, blocks: Blocks, ground: Ground, tolerance: float, overlap: float) -> BoolArray:
    """Faces that lie in the plane of a ground that carries their block, (n,)."""
    owner = blocks.block_of_face[faces]
    corners, start = blocks.corners_of(faces)
    heights = (corners - ground.point) @ ground.normal
    on = row_maxima(heights, start) <= tolerance * blocks.sizes[owner]
    on &= row_maxima(-heights, start) <= max(tolerance, overlap) * blocks.sizes[owner]
    on &= blocks.face_normals[faces] @ ground.normal <= -FACING
    return on if ground.blocks is None else np.asarray(on & np.isin(owner, ground.blocks))


def _facing_pairs(faces: IntArray, blocks: Blocks, tolerance: float, overlap: float) -> tuple[IntArray, IntArray]:
    """(position in ``faces``, face of another block that may lie against it)."""
    corners = blocks.vertices[blocks.loops]
    low, high = row_ranges(corners, blocks.loop_start)
    reach = tolerance * blocks.sizes[blocks.block_of_face]
    margin = reach[faces, None]
    mine, others = meeting_boxes(low[faces] - margin, high[faces] + margin, low, high)
    face = faces[mine]
    between = blocks.vertices[blocks.loops[blocks.loop_start[others]]]
    between = between - blocks.vertices[blocks.loops[blocks.loop_start[face]]]
    normals = blocks.face_normals[face]
    kept = blocks.block_of_face[face] != blocks.block_of_face[others]
    height = np.einsum("ij,ij->i", between, normals)
    near = 2.0 * reach[face] + reach[others]
    smaller = np.minimum(*(blocks.sizes[blocks.block_of_face[side]] for side in (face, others)))
    kept &= (height <= near) & (height >= -np.maximum(near, 1.001 * overlap * smaller))
    kept &= np.einsum("ij,ij->i", blocks.face_normals[others], normals) <= -FACING
    return mine[kept], others[kept]
