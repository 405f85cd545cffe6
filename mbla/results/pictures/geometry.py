"""The shapes and places of a picture, as arrays: edges, ground slabs, hinge axes, arrow, direction of view."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.model.solids.blocks import Blocks

THIN = 0.35
"""extent over the next larger one below which a structure is seen from the front"""
SLAB_FACES = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
"""of a box whose corners have the first coordinate fastest, outwards where these axes are right-handed"""


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


def ground_slab(model: Model, contacts: Contacts, ground: int, size: float) -> FloatArray | None:
    """Corners of a slab behind a ground plane, as wide as what stands on it and a little more, (8, 3) m.

    Ordered as a box from ``min`` to ``max`` with the first coordinate fastest; None where nothing stands on the plane.
    """
    touching = (contacts.bodies == len(model.blocks) + ground).any(axis=1)[contacts.interface_of_point]
    if not touching.any():
        return None
    plane = model.grounds[ground]
    frame = np.linalg.svd(plane.normal[None])[2]  # rows: normal (either sign), then two directions in the plane
    places = (contacts.points[touching] - plane.point) @ frame.T
    low, high = places.min(axis=0), places.max(axis=0)
    low[1:] -= 0.04 * size
    high[1:] += 0.04 * size
    low[0], high[0] = sorted((0.0, -float(np.sign(frame[0] @ plane.normal)) * 0.02 * size))
    corners = np.array([[x, y, z] for z in (low[2], high[2]) for y in (low[1], high[1]) for x in (low[0], high[0])])
    return np.asarray(corners @ frame + plane.point)


def front_axis(extents: FloatArray, travel: FloatArray) -> int | None:
    """Horizontal axis along which to look: the thin one, unless the mechanism moves along it; None for a slanted view.

    extents : (3,) of the structure
    travel  : (3,) largest displacement along each axis
    """
    axis = int(np.argmin(extents[:2]))
    across = float(np.delete(extents, axis).min())
    hidden = travel[axis] > 0.5 * float(np.max(travel)) > 0
    return None if hidden or extents[axis] > THIN * across else axis
