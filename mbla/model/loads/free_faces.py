"""Which parts of faces are free, and which lie against another block or on the ground.

Each face becomes a set of signed triangles, a fan from its first corner: their sum is the face, whatever its shape.
What another block covers of it are the common parts of its triangles with those of the face that lies against it, with
the product of the signs, taken away. As blocks do not overlap, nothing is taken away twice.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.model.model import Ground
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import intersections, meeting_boxes, plane_axes, signed_areas
from mbla.model.solids.ragged import items_of_rows, row_maxima

FACING = 0.99
"""cosine of the greatest angle between two faces that lie against each other"""
BARELY = 1e-9
"""share of a face below which a common part is the rounding of a shared edge"""


@dataclass(frozen=True)
class FaceParts:
    """Loops whose signed integrals add up to what is loaded.

    loops : (n, k, 3) corners on the planes of their faces; signs +1 as the face is seen from outside, -1 taken away
    signs : (n,)
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

    def flat(self, rows: IntArray, points: FloatArray) -> FloatArray:
        """Plane coordinates, (n, k, 2) from (n, k, 3)."""
        return np.asarray(np.einsum("nkj,nij->nki", points - self.origins[rows, None], self.axes[rows]))

    def back(self, rows: IntArray, flat: FloatArray) -> FloatArray:
        """Points on the planes, (n, k, 3) from (n, k, 2)."""
        return np.asarray(np.einsum("nki,nij->nkj", flat, self.axes[rows]) + self.origins[rows, None])


def face_parts(
    faces: IntArray, blocks: Blocks, grounds: tuple[Ground, ...], tolerance: float, free_only: bool
) -> FaceParts:
    """The faces (n,), or what of them is free; ``tolerance`` relative to block size, as that of contacts."""
    frames = _frames(faces, blocks)
    row, fan = _fan(faces, blocks)
    flat = frames.flat(row, fan)
    areas: FloatArray = np.bincount(row, signed_areas(flat), len(faces)).astype(np.float64)
    loops, signs, owner = frames.back(row, flat), np.ones(len(row)), row
    covered: FloatArray = np.zeros(len(faces))
    if free_only:
        grounded = _on_ground(faces, blocks, grounds, tolerance)
        taken_loops, taken_signs, taken_owner = _covers(faces, frames, row, flat, blocks, tolerance)
        lost = taken_signs * signed_areas(taken_loops)
        covered = np.bincount(taken_owner, lost, len(faces)).astype(np.float64)
        covered[grounded] = areas[grounded]
        free = covered < areas * (1.0 - 2.0 * tolerance)  # what is left beside is the rounding of outlines
        used = free[taken_owner] & (np.abs(lost) > BARELY * areas[taken_owner])
        flat_taken = frames.back(taken_owner[used], taken_loops[used])
        padded = np.concatenate([loops, np.repeat(loops[:, -1:], flat_taken.shape[1] - 3, axis=1)], axis=1)
        loops = np.concatenate([padded[free[row]], flat_taken])
        signs = np.concatenate([signs[free[row]], -taken_signs[used]])
        owner = np.concatenate([owner[free[row]], taken_owner[used]])
        covered = np.asarray(np.where(free, covered, areas), dtype=np.float64)
    return FaceParts(loops, signs, owner, areas, covered)


def _frames(faces: IntArray, blocks: Blocks) -> _Frames:
    origins = blocks.vertices[blocks.loops[blocks.loop_start[faces]]]
    return _Frames(origins, plane_axes(blocks.face_normals[faces]))


def _fan(faces: IntArray, blocks: Blocks) -> tuple[IntArray, FloatArray]:
    """Triangles from the first corner of each face: their faces, as positions in ``faces``, and corners, (n, 3, 3)."""
    corners = blocks.loop_start[faces + 1] - blocks.loop_start[faces]
    row = np.repeat(np.arange(len(faces)), corners - 2)
    position = np.arange(len(row)) - np.repeat(np.cumsum(corners - 2) - (corners - 2), corners - 2)
    first = blocks.loop_start[faces][row]
    return row, blocks.vertices[blocks.loops[np.stack([first, first + position + 1, first + position + 2], axis=1)]]


def _on_ground(faces: IntArray, blocks: Blocks, grounds: tuple[Ground, ...], tolerance: float) -> BoolArray:
    """Faces that lie on a ground plane that carries their block."""
    found = np.zeros(len(faces), dtype=bool)
    owner = blocks.block_of_face[faces]
    corners = items_of_rows(blocks.loop_start, faces)
    start = np.append(0, np.cumsum(blocks.loop_start[faces + 1] - blocks.loop_start[faces]))
    for ground in grounds:
        heights = np.abs((blocks.vertices[blocks.loops[corners]] - ground.point) @ ground.normal)
        on = row_maxima(heights, start) <= tolerance * blocks.sizes[owner]
        on &= blocks.face_normals[faces] @ ground.normal <= -FACING
        found |= on if ground.blocks is None else on & np.isin(owner, ground.blocks)
    return found


def _covers(
    faces: IntArray, frames: _Frames, row: IntArray, flat: FloatArray, blocks: Blocks, tolerance: float
) -> tuple[FloatArray, FloatArray, IntArray]:
    """Common parts with faces of other blocks: loops on the plane of the covered face, signs, covered faces."""
    mine, others = _facing_pairs(faces, blocks, tolerance)
    partners, other_row = np.unique(others, return_inverse=True)
    fan_row, fan = _fan(partners, blocks)
    # every triangle of the one face with every triangle of the other
    counts, fan_counts = np.bincount(row, minlength=len(faces)), np.bincount(fan_row, minlength=len(partners))
    of_mine = items_of_rows(np.append(0, np.cumsum(counts)), mine)
    pair = np.repeat(np.arange(len(mine)), counts[mine])
    of_other = items_of_rows(np.append(0, np.cumsum(fan_counts)), other_row[pair])
    repeat = np.repeat(np.arange(len(pair)), fan_counts[other_row[pair]])
    own = mine[pair[repeat]]
    a, b = flat[of_mine[repeat]], frames.flat(own, fan[of_other])
    turn_b = np.sign(signed_areas(b))
    b = np.where((turn_b < 0)[:, None, None], b[:, ::-1], b)
    # the other face is seen from behind: a fan triangle that adds to it turns clockwise here
    loops = intersections(a, b)
    return loops, -turn_b, own


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
