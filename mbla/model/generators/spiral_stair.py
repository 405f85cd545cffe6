"""Generator of spiral stairs of cantilevered treads.

With h the rise, d the depth of the rebate, D the angle from tread to tread and o the overlap, tread k fills the angles
from k D to (k + 1) D + o and the heights from k h to (k + 1) h, beyond k D + o from k h - d. There it meets the back
of the tread below, which ends at k D + o: on it over the overlap, and behind it over the rebate. The lowest tread has
no rebate: it lies on the ground. Between neighbouring angles a and b a sector has the area (R^2 - r^2)/2 sin(b - a).

A tread that is only laid on the one below and on a shelf in the wall would turn about the line between them but for the
treads above: each passes its twist down to the next (Heyman 1996, The mechanics of masonry stairs).
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.items.spiral_stair import SpiralStairItem
from mbla.model.generators.generator import Generated, Part, Site, level_ground
from mbla.model.solids.polyhedra import Polyhedra, chains, join_polyhedra, polyhedra_from_cells


def generate_spiral_stair(item: SpiralStairItem, site: Site) -> Generated:
    """Treads from the bottom; shelves, then blocks on top of the ends of the treads."""
    angles = _angles(item)
    number = np.arange(item.treads)
    outer = item.outer_radius + item.built_in
    reach = (item.inner_radius, outer)
    lowest = chains(_sectors(item, number[:1], angles, reach, 0.0, item.rise))
    if item.rebate > 0:
        others = _rebated(item, number[1:], angles, reach)
    else:
        others = chains(_sectors(item, number[1:], angles, reach, 0.0, item.rise))
    parts = [Part(join_polyhedra([lowest, others]), labels={"tread": number})]
    end = (item.outer_radius, outer)
    if item.wall != "none":
        shelf = _sectors(item, number[1:], angles[1:], end, -item.rise, -item.rebate)
        parts.append(Part(chains(shelf), "_wall", fixed=True, member="shelf", labels={"tread": number[1:]}))
    if item.wall == "pocket":
        free = _sectors(item, number[:-1], angles[:-1], end, item.rise, 2 * item.rise)
        last = _sectors(item, number[-1:], angles, end, item.rise, 2 * item.rise)
        heads = join_polyhedra([chains(free), chains(last)])
        parts.append(Part(heads, "_wall", fixed=True, member="head", labels={"tread": number}))
    grounds = (level_ground(np.array([0]), item.joint),) if item.foot == "ground" else ()
    return Generated(tuple(parts), grounds)


def _angles(item: SpiralStairItem) -> FloatArray:
    """Corners of a tread from its front, [rad]: end of the overlap below, ..., begin of that above, back."""
    between = np.linspace(item.overlap, item.angle, item.facets + 1)
    degrees = np.concatenate([[0.0], between, [item.angle + item.overlap]])
    return np.asarray(np.radians(degrees), dtype=np.float64)


def _corners(item: SpiralStairItem, number: IntArray, angles: FloatArray, radius: float, height: float) -> FloatArray:
    """Points of treads at a radius and at a height over k h, (n, n_angles, 3)."""
    around = np.radians(item.angle) * number[:, None] + angles
    level = np.broadcast_to(item.rise * number[:, None] + height, around.shape)
    return np.stack([radius * np.cos(around), radius * np.sin(around), level], axis=-1)


def _sectors(
    item: SpiralStairItem,
    number: IntArray,
    angles: FloatArray,
    radii: tuple[float, float],
    low: float,
    high: float,
) -> FloatArray:
    """Chains of upright rectangles (n, n_angles, 4, 3), of the sectors between two radii and two heights over k h."""
    ends = ((radii[0], low), (radii[0], high), (radii[1], high), (radii[1], low))
    return np.stack([_corners(item, number, angles, radius, height) for radius, height in ends], axis=2)


def _rebated(item: SpiralStairItem, number: IntArray, angles: FloatArray, radii: tuple[float, float]) -> Polyhedra:
    """Treads with a rebate: as sectors, but lower from the second angle on, where there is a step."""
    sections = _sectors(item, number, angles, radii, 0.0, item.rise)
    below = _sectors(item, number, angles, radii, -item.rebate, item.rise)
    # corners of a section: inside low and high, outside high and low; last come the two below the step
    corners = np.concatenate([sections[:, :2], below[:, 2:]], axis=1).reshape(len(number), -1, 3)
    last = 4 * len(angles)
    step = below[:, 1][:, [0, 3]]
    faces: list[list[int]] = [[3, 2, 1, 0], [last - 4, last - 3, last - 2, last - 1], [last + 1, 7, 4, last]]
    for first in range(0, last - 4, 4):
        inside, top, outside, bottom = (
            [first + q, first + (q + 1) % 4, first + (q + 1) % 4 + 4, first + q + 4] for q in range(4)
        )
        if first == 4:  # from the step on: its own corners below, those of the overlap in between
            inside = [last, 4, 5, 9, 8]
            outside = [6, 7, last + 1, 11, 10]
            bottom = [last + 1, last, 8, 11]
        faces += [inside, top, outside, bottom]
    return polyhedra_from_cells(np.concatenate([corners, step], axis=1), faces)
