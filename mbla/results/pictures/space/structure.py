"""The structure in a spatial picture: blocks and their edges, ghost of what moves, ground."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.results.pictures.geometry import block_edges, edges_of_blocks
from mbla.results.pictures.palette import GHOST, INK
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.space.shapes import Faces, Lines, painted, together

MANY = 400
"""blocks from which edges are drawn thinner, and of the ghost only the outline"""
SLAB = "#C4C4C4"
SLAB_FACES = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
"""of a box whose corners are ordered with the first coordinate fastest"""


def block_faces(scene: Scene, points: FloatArray, colours: FloatArray, lit: bool = True) -> Faces:
    """Blocks at given places of their vertices, (n_vertices, 3) m, with the colour of each block, (n_blocks, 3)."""
    blocks = scene.model.blocks
    return Faces(points, blocks.loop_start, blocks.loops, colours[blocks.block_of_face], lit=lit)


def edge_lines(scene: Scene, points: FloatArray, colour: str = INK, opacity: float = 1.0) -> Lines:
    """Edges of all blocks."""
    width = 1.5 if len(scene.model.blocks) < MANY else 1.0
    return Lines(points, block_edges(scene.model.blocks), colour, width, opacity)


def ghost_lines(scene: Scene, moving: BoolArray) -> Lines:
    """Edges of the blocks that move where they were; of many only those that bound them together."""
    blocks = scene.model.blocks
    edges = edges_of_blocks(blocks, block_edges(blocks), moving)
    if int(moving.sum()) > MANY:
        edges = _single(blocks.vertices, edges, 1e-6 * scene.size)
    return Lines(blocks.vertices, edges, GHOST, 1.1, 0.55)


def _single(points: FloatArray, edges: IntArray, size: float) -> IntArray:
    """Edges whose middle is that of no other edge: joints between blocks have at least two each."""
    middle = np.round((points[edges[:, 0]] + points[edges[:, 1]]) / 2 / size).astype(np.int64)
    _, row, count = np.unique(middle, axis=0, return_inverse=True, return_counts=True)
    return np.asarray(edges[count[row.ravel()] == 1])


def grounds(scene: Scene) -> tuple[Faces | Lines, ...]:
    """Slabs of ground with their edges."""
    if not scene.slabs:
        return ()
    faces = [painted(corners, 4 * np.arange(7), SLAB_FACES.ravel(), SLAB) for corners in scene.slabs]
    pairs = np.unique(np.sort(np.stack([SLAB_FACES, np.roll(SLAB_FACES, -1, axis=1)], axis=2).reshape(-1, 2)), axis=0)
    every = np.vstack([pairs + 8 * row for row in range(len(scene.slabs))])
    return replace(together(faces), ground=True), Lines(np.vstack(scene.slabs), every, GHOST, 1.0)


def interface_faces(
    contacts: Contacts, points: FloatArray, chosen: IntArray, shift: FloatArray
) -> tuple[FloatArray, IntArray, IntArray]:
    """Outlines of interfaces as polygons: points (n, 3) m, start and loops as in ``Faces``.

    points : (n_points, 3) contact points as moved; shift : (n_chosen, 3) m, added to keep faces off those of blocks
    """
    counts = contacts.outline[chosen]
    start = np.concatenate([[0], np.cumsum(counts)])
    place = np.arange(start[-1]) - np.repeat(start[:-1], counts)
    rows = np.repeat(contacts.point_start[chosen], counts) + place
    return points[rows] + np.repeat(shift, counts, axis=0), start, np.arange(start[-1])
