"""Blocks as the cells that ParaView knows: tetrahedra, wedges and hexahedra where every block is one, else polyhedra.

One file cannot mix polyhedra with other cells (meshio), so one block of another shape makes all of them polyhedra.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Any

import numpy as np

from mbla.arrays import IntArray
from mbla.model.solids.blocks import Blocks
from mbla.results.collapse.collapse import kept


@dataclass(frozen=True)
class BlockCells:
    """Cells for a mesh file.

    cells : pairs of cell type and connectivity; for polyhedra a list of cells, each a list of faces
    rows  : the blocks of each of these pairs, in its order
    """

    cells: tuple[tuple[str, Any], ...]
    rows: tuple[IntArray, ...]


@dataclass(frozen=True)
class _Shape:
    """A cell type by its counts; the base face is the first with ``base`` corners, the rest stands on it.

    inward : the base is listed so that its normal points into the cell, as VTK wants it for this type
    """

    cell: str
    vertices: int
    corners: tuple[int, ...]
    base: int
    inward: bool


SHAPES = (
    _Shape("tetra", 4, (3, 3, 3, 3), 3, True),
    _Shape("wedge", 6, (3, 3, 4, 4, 4), 3, False),
    _Shape("hexahedron", 8, (4, 4, 4, 4, 4, 4), 4, True),
)


@kept
def block_cells(blocks: Blocks) -> BlockCells:
    """Cells of all blocks; connectivity counts rows of ``blocks.vertices``."""
    found = [(shape.cell, *_cells_of_shape(blocks, shape)) for shape in SHAPES]
    if sum(len(rows) for _, rows, _ in found) == len(blocks):
        used = [(cell, rows, connectivity) for cell, rows, connectivity in found if len(rows)]
        return BlockCells(tuple((cell, c) for cell, _, c in used), tuple(rows for _, rows, _ in used))
    faces = np.split(blocks.loops, blocks.loop_start[1:-1])
    bounds = blocks.face_start.tolist()
    polyhedra = [faces[first:last] for first, last in itertools.pairwise(bounds)]
    return BlockCells((("polyhedron", polyhedra),), (np.arange(len(blocks)),))


def _cells_of_shape(blocks: Blocks, shape: _Shape) -> tuple[IntArray, IntArray]:
    """Blocks of one shape and their connectivity, (n,) and (n, shape.vertices)."""
    n_faces = len(shape.corners)
    fits = (np.diff(blocks.vertex_start) == shape.vertices) & (np.diff(blocks.face_start) == n_faces) & blocks.convex
    rows = np.flatnonzero(fits)
    corners = np.diff(blocks.loop_start)[blocks.face_start[rows][:, None] + np.arange(n_faces)]
    fits_too = (np.sort(corners, axis=1) == shape.corners).all(axis=1)
    rows, corners = rows[fits_too], corners[fits_too]
    if not len(rows):
        return rows, np.zeros((0, shape.vertices), dtype=np.int64)
    base_face = blocks.face_start[rows] + np.argmax(corners == shape.base, axis=1)
    base = blocks.loops[blocks.loop_start[base_face][:, None] + np.arange(shape.base)]
    local = (base[:, ::-1] if shape.inward else base) - blocks.vertex_start[rows][:, None]
    adjacent = _adjacency(blocks, rows, shape)
    in_base = np.zeros((len(rows), shape.vertices), dtype=bool)
    np.put_along_axis(in_base, local, True, axis=1)
    above = np.take_along_axis(adjacent, local[:, :, None], axis=1) & ~in_base[:, None, :]
    regular = (above.sum(axis=2) == 1).all(axis=1) & (adjacent.sum(axis=2) == 3).all(axis=1)
    top = above.argmax(axis=2)
    if shape.vertices == shape.base + 1:
        top = top[:, :1]
    else:
        regular &= (np.diff(np.sort(top, axis=1), axis=1) > 0).all(axis=1)
    connectivity = np.hstack([local, top]) + blocks.vertex_start[rows][:, None]
    return rows[regular], connectivity[regular]


def _adjacency(blocks: Blocks, rows: IntArray, shape: _Shape) -> np.typing.NDArray[np.bool_]:
    """Which vertices of each block share an edge, (n, vertices, vertices)."""
    n_corners = sum(shape.corners)
    first = blocks.loop_start[blocks.face_start[rows]]
    positions = first[:, None] + np.arange(n_corners)
    ends = np.zeros(len(blocks.loops), dtype=np.int64)  # the corner after each corner of its loop
    ends[:-1] = blocks.loops[1:]
    ends[blocks.loop_start[1:] - 1] = blocks.loops[blocks.loop_start[:-1]]
    offset = blocks.vertex_start[rows][:, None]
    adjacent = np.zeros((len(rows), shape.vertices, shape.vertices), dtype=bool)
    which = np.repeat(np.arange(len(rows)), n_corners)
    adjacent[which, (blocks.loops[positions] - offset).ravel(), (ends[positions] - offset).ravel()] = True
    return adjacent
