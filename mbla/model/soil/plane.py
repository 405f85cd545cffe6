"""The plane that soil lies in: that of the sections of blocks which are prisms across one horizontal direction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from mbla.arrays import FloatArray, IntArray
from mbla.errors import Finding
from mbla.model.blocks.generated import ItemRefused
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.polygons import Polygons, polygons_from_loops, union_by_row
from mbla.model.solids.ragged import items_of_rows, row_ranges
from mbla.model.wording import named

SQUARE = 1e-4
"""cosine of the angle between two directions at a right angle that is rounding"""


@dataclass(frozen=True)
class Sections:
    """Blocks seen along the direction across a plane.

    blocks  : (n,)
    outlines : (n,) polygons, what they cover of the plane
    extents : (n, 2) across the plane, from and to
    sizes   : (n,) of the blocks, to which tolerances are relative
    """

    blocks: IntArray
    outlines: Polygons
    extents: FloatArray
    sizes: FloatArray

    def take(self, rows: IntArray) -> Sections:
        """Some of them."""
        return Sections(self.blocks[rows], self.outlines[rows], self.extents[rows], self.sizes[rows])


NO_SECTIONS = Sections(np.empty(0, np.int64), np.empty(0, object), np.empty((0, 2)), np.empty(0))


def axes_across(direction: FloatArray) -> FloatArray:
    """Axes (3, 3) of the upright plane across a horizontal unit direction: along it, level and towards +x, else +y;
    upwards; and across, as of the plane of x and z the directions x, z, y.
    """
    level = np.array([direction[1], -direction[0], 0.0]) + 0.0
    if level[np.argmax(np.abs(level) > SQUARE)] < 0.0:
        level = -level
    up = np.array([0.0, 0.0, 1.0])
    return np.stack([level, up, np.cross(up, level)]) + 0.0


def plane_of_prisms(blocks: Blocks, chosen: IntArray) -> FloatArray:
    """Axes (3, 3) of the plane across which blocks are prisms, along y if along several.

    Raises ItemRefused for other blocks.
    """
    faces = items_of_rows(blocks.face_start, chosen)
    normals = blocks.face_normals[faces]
    upright = normals[np.abs(normals[:, 2]) < SQUARE][:, :2]
    upright *= np.where(upright[:, :1] + SQUARE * upright[:, 1:] < 0.0, -1.0, 1.0)
    candidates = upright[np.unique(upright.round(6), axis=0, return_index=True)[1]]
    if not len(candidates):
        raise ItemRefused(Finding("soil-not-prismatic", f"{_PRISMS}; these have no upright face", "on"))
    candidates /= np.linalg.norm(candidates, axis=1)[:, None]
    cosines = np.abs(normals[:, :2] @ candidates.T)
    askew = (cosines > SQUARE) & (cosines < 1.0 - SQUARE**1.5)
    wrong = askew.sum(axis=0)
    best = np.lexsort((-np.abs(candidates[:, 1]), wrong))[0]
    if wrong[best]:
        which = np.unique(blocks.block_of_face[faces[askew[:, best]]])
        words = f"{_PRISMS}; of these not: {named(which, blocks.name)}"
        raise ItemRefused(Finding("soil-not-prismatic", words, "on"))
    return axes_across(np.append(candidates[best], 0.0))


_PRISMS = "the blocks under soil of cells must be prisms along one horizontal direction, as an arch or a wall is"


def sections_of(blocks: Blocks, chosen: IntArray, axes: FloatArray) -> Sections:
    """Blocks (n,) as they are seen along the direction across the plane of axes (3, 3)."""
    if not len(chosen):
        return NO_SECTIONS
    faces = items_of_rows(blocks.face_start, chosen)
    row = np.repeat(np.arange(len(chosen)), np.diff(blocks.face_start)[chosen])
    seen = blocks.face_normals[faces] @ axes[2] > SQUARE
    corners, start = blocks.corners_of(faces[seen])
    polygons = shapely.orient_polygons(polygons_from_loops(corners @ axes[:2].T, start))
    outlines = union_by_row(polygons, row[seen], len(chosen))
    vertices = items_of_rows(blocks.vertex_start, chosen)
    counts = np.diff(blocks.vertex_start)[chosen]
    across = row_ranges(blocks.vertices[vertices] @ axes[2], np.append(0, np.cumsum(counts)))
    return Sections(chosen, outlines, np.stack(across, axis=1), blocks.sizes[chosen])
