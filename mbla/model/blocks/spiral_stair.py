"""Item `spiral_stair`: cantilevered treads.

With h the rise, d the depth of the rebate, D the angle from tread to tread and o the overlap, tread k fills the angles
from k D to (k + 1) D + o and the heights from k h to (k + 1) h, beyond k D + o from k h - d. There it meets the back
of the tread below, which ends at k D + o: on it over the overlap, and behind it over the rebate. The lowest tread has
no rebate: it lies on the ground. Between neighbouring angles a and b a sector has the area (R^2 - r^2)/2 sin(b - a).

A tread that is only laid on the one below and on a shelf in the wall would turn about the line between them but for the
treads above: each passes its twist down to the next (Heyman 1996, The mechanics of masonry stairs).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from mbla.arrays import FloatArray, IntArray
from mbla.deck.kinds.positions import TREAD
from mbla.deck.quantities import Count, Integer, Name, NonNegativeLength, PositiveLength, RealNumber
from mbla.deck.section import rule
from mbla.errors import Finding
from mbla.model.blocks.generated import Generated, ItemContext, ItemPart, level_ground
from mbla.model.blocks.item import AnyItem, ItemKind, SideGroup, register_item
from mbla.model.solids.polyhedra import Polyhedra, chains, join_polyhedra, polyhedra_from_cells


class SpiralStairItem(AnyItem):
    """A spiral stair of cantilevered treads about the z axis, rising counter-clockwise from z = 0.

    Each tread begins at the angle of its number times `angle`, rests with its front on the back of the one below, and
    reaches into a wall at its outer end. Arcs are straight between the angles at which treads begin and end. Labels:
    `tread`, of the wall too.
    """

    treads: Annotated[int, Integer(ge=2, le=100_000)] = Field(description="number of treads")
    inner_radius: PositiveLength = Field(description="radius of the well")
    outer_radius: PositiveLength = Field(description="radius of the face of the wall")
    rise: PositiveLength = Field(description="height from tread to tread")
    angle: Annotated[float, RealNumber("angle", gt=0, le=120)] = Field(description="from tread to tread, degrees")
    overlap: Annotated[float, RealNumber("angle", gt=0, lt=60)] = Field(
        description="angle over which a tread rests on the one below, degrees; less than angle"
    )
    rebate: NonNegativeLength = Field(
        0.0,
        description="how far a tread reaches down behind the one below: they meet in an upright joint of that height "
        "too; less than rise, 0 for treads that only lie on each other",
    )
    built_in: NonNegativeLength = Field(0.0, description="length of the treads beyond the face of the wall")
    wall: Literal["none", "shelf", "pocket"] = Field(
        "none",
        description="shelf: fixed blocks under the ends of the treads but the lowest, in group GROUP_wall; pocket: "
        "also on top of them, so that the ends are clamped; none: the deck's supports hold the treads",
    )
    facets: Count = Field(1, description="straight pieces of the arc between the overlaps of a tread")
    foot: Literal["none", "ground"] = Field("none", description="ground: rigid ground under the lowest tread")
    joint: Name | None = Field(None, description="joint law on ground; default: contacts.joint")


@rule(SpiralStairItem)
def stair_extents(stair: SpiralStairItem) -> Iterator[Finding]:
    """Radii in order; a tread is longer than it overlaps the next, and higher than its rebate."""
    if stair.outer_radius <= stair.inner_radius:
        yield Finding("out-of-bounds", f"must be > {stair.inner_radius:g}, the inner radius", "outer_radius")
    if stair.overlap >= stair.angle:
        yield Finding("out-of-bounds", f"must be < {stair.angle:g}, the angle from tread to tread", "overlap")
    if stair.rebate >= stair.rise:
        yield Finding("out-of-bounds", f"must be < {stair.rise:g}, the rise", "rebate")


@rule(SpiralStairItem)
def stair_supports(stair: SpiralStairItem) -> Iterator[Finding]:
    """A wall holds what is built into it."""
    if stair.wall != "none" and stair.built_in == 0:
        yield Finding("missing-key", "needs built_in: the wall holds the ends of treads that reach into it", "wall")
    if stair.joint is not None and stair.foot != "ground":
        yield Finding("key-of-another-choice", "applies with foot: ground only", "joint")


WALL = SideGroup("_wall", "wall", ("shelf", "pocket"))
"""fixed blocks that hold the ends of the treads"""


def generate(item: SpiralStairItem, context: ItemContext) -> Generated:
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
    parts = [ItemPart(join_polyhedra([lowest, others]), labels={"tread": number})]
    end = (item.outer_radius, outer)
    if item.wall != "none":
        shelf = _sectors(item, number[1:], angles[1:], end, -item.rise, -item.rebate)
        parts.append(ItemPart(chains(shelf), WALL.suffix, fixed=True, member="shelf", labels={"tread": number[1:]}))
    if item.wall == "pocket":
        free = _sectors(item, number[:-1], angles[:-1], end, item.rise, 2 * item.rise)
        last = _sectors(item, number[-1:], angles, end, item.rise, 2 * item.rise)
        heads = join_polyhedra([chains(free), chains(last)])
        parts.append(ItemPart(heads, WALL.suffix, fixed=True, member="head", labels={"tread": number}))
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
    item: SpiralStairItem, number: IntArray, angles: FloatArray, radii: tuple[float, float], low: float, high: float
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


def amount(item: SpiralStairItem) -> tuple[float, str]:
    """Facets of all treads."""
    return item.treads * (item.facets + 2), "facets"


register_item(
    ItemKind(
        "spiral_stair", SpiralStairItem, generate, amount, after="pavilion_vault", positions=(TREAD,), groups=(WALL,)
    )
)
