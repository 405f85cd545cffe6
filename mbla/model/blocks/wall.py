"""Item `wall`: straight, x along it, y through it, z up."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from pydantic import Field

from mbla.deck.kinds.positions import COURSE, LEAF, UNIT, VOUSSOIR
from mbla.deck.quantities import PositiveLength
from mbla.deck.section import rule
from mbla.errors import Finding, KeyPath
from mbla.model.blocks.generated import Generated, ItemContext
from mbla.model.blocks.item import ItemKind, register_item
from mbla.model.blocks.masonry.masonry import (
    MATERIALS,
    Buttress,
    Gable,
    Masonry,
    Opening,
    check_part,
    units_of_walls,
)


class WallItem(Masonry):
    """A straight wall: runs along +x from the origin, rises along +z, thickness along +y."""

    length: PositiveLength = Field(description="length of the wall; the closing units are cut to fit")
    openings: list[Opening] = Field(default_factory=list, description="rectangles left free")
    gable: Gable | None = Field(None, description="triangle on top")
    buttresses: list[Buttress] = Field(default_factory=list, description="piers against its faces")


@rule(WallItem)
def wall(item: WallItem) -> Iterator[Finding]:
    """All that a straight wall has."""
    parts: dict[KeyPath, Opening | Gable | Buttress] = {("openings", n): each for n, each in enumerate(item.openings)}
    parts |= {} if item.gable is None else {("gable",): item.gable}
    parts |= {("buttresses", n): each for n, each in enumerate(item.buttresses)}
    for path, part in parts.items():
        yield from (finding.below(*path) for finding in check_part(item, part, item.length))


def generate(item: WallItem, context: ItemContext) -> Generated:
    """Units course by course from the bottom, along +x in each, leaf by leaf; then lintels, arches, buttresses.

    Raises ItemRefused for openings off the bed joints, lintels and arches without support, buttresses across openings,
    or where nothing is left of the wall.
    """
    from mbla.model.blocks.masonry.plan import WallLine
    from mbla.model.blocks.masonry.walls import Walls, build_walls

    thickness = item.leaves * item.unit[1]
    line = WallLine(np.zeros(2), np.array([1.0, 0.0]), item.length, 0.0, 0.0, 0.0, thickness, ())
    walls = Walls(
        item,
        [line],
        [(0, opening) for opening in item.openings],
        [(0, buttress) for buttress in item.buttresses],
        {} if item.gable is None else {0: item.gable},
    )
    return build_walls(walls, item.group or "wall", context)


def amount(item: WallItem) -> tuple[float, str]:
    """Units of the wall and its buttresses."""
    return units_of_walls(item, item.length, item.gable.rise if item.gable else 0.0, item.buttresses), "length"


register_item(
    ItemKind(
        "wall",
        WallItem,
        generate,
        amount,
        after="polyhedron",
        positions=(COURSE, UNIT, LEAF, VOUSSOIR),
        materials=MATERIALS,
    )
)
