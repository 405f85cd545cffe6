"""The shapes and places of a picture, as arrays: edges, ground slabs, hinge axes, arrow, direction of view."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import plane_axes
from mbla.model.solids.polygons import connected_parts, convex_polygons, triangles

THIN = 0.35
"""extent over the next larger one below which a structure is seen from the front"""
EDGE, DEPTH = 0.04, 0.02
"""of the size of the structure: how far a slab of ground reaches past what stands on it, and its thickness"""


@dataclass(frozen=True)
class Slab:
    """A convex prism that stands for ground.

    points : (2 n, 3) corners of the face that carries, counter-clockwise seen from the structure, then those below them
    """

    points: FloatArray

    @property
    def faces(self) -> list[IntArray]:
        """Rows of points of each face, outwards."""
        n = len(self.points) // 2
        top, after = np.arange(n), np.roll(np.arange(n), -1)
        return [top, n + top[::-1], *np.column_stack([top, n + top, n + after, after])]

    @property
    def triangles(self) -> IntArray:
        """Rows of points, (n, 3), outwards."""
        fans = [[[face[0], face[k], face[k + 1]] for k in range(1, len(face) - 1)] for face in self.faces]
        return np.concatenate([np.array(fan) for fan in fans])


def block_edges(blocks: Blocks) -> IntArray:
    """Edges as pairs of vertices, (n_edges, 2), each once; those that only divide a plane facet are left out."""
    following = np.empty_like(blocks.loops)
    following[:-1] = blocks.loops[1:]
    following[blocks.loop_start[1:] - 1] = blocks.loops[blocks.loop_start[:-1]]
    facets = blocks.facet_of_face[blocks.face_of_corner]
    low, high = np.minimum(blocks.loops, following), np.maximum(blocks.loops, following)
    sides, times = np.unique(np.column_stack([facets, low, high]), axis=0, return_counts=True)
    return np.unique(sides[times == 1][:, 1:], axis=0)


def edges_of_blocks(blocks: Blocks, edges: IntArray, chosen: BoolArray) -> IntArray:
    """Edges, (n, 2) vertices, of the chosen blocks, (n_blocks,), only."""
    return edges[chosen[blocks.block_of_vertex[edges[:, 0]]]]


def ground_slabs(model: Model, contacts: Contacts, ground: int, size: float) -> list[Slab]:
    """Slabs behind a ground, as wide as what stands on it and a little more, and no wider than its outline.

    One, or several where the outline is not convex; none where nothing stands on it. ``size`` of the structure, m.
    """
    import shapely

    touching = (contacts.bodies == len(model.blocks) + ground).any(axis=1)[contacts.interface_of_point]
    if not touching.any():
        return []
    plane = model.grounds[ground]
    axes = plane_axes(plane.normal[None])[0]
    places = (contacts.points[touching] - plane.point) @ axes.T
    shape: Any = shapely.box(*(places.min(axis=0) - EDGE * size), *(places.max(axis=0) + EDGE * size))
    if plane.outline is not None:
        outline = shapely.make_valid(shapely.Polygon((plane.outline - plane.point) @ axes.T))
        shape = shapely.intersection(shape, outline)
    parts = connected_parts(np.array([shape], dtype=object))[0]
    convex = convex_polygons(parts)
    loops = [shapely.get_coordinates(shapely.orient_polygons(part))[:-1] for part in parts[convex]]
    loops += list(triangles(parts[~convex])[0]) if not convex.all() else []
    tops = [loop @ axes + plane.point for loop in loops]
    return [Slab(np.vstack([top, top - DEPTH * size * plane.normal])) for top in tops]


def front_axis(extents: FloatArray, travel: FloatArray) -> int | None:
    """Horizontal axis along which to look: the thin one, unless the mechanism moves along it; None for a slanted view.

    extents : (3,) of the structure
    travel  : (3,) largest displacement along each axis
    """
    axis = int(np.argmin(extents[:2]))
    across = float(np.delete(extents, axis).min())
    hidden = travel[axis] > 0.5 * float(np.max(travel)) > 0
    return None if hidden or extents[axis] > THIN * across else axis
