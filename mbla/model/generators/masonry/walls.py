"""From walls of an item, each with its openings, gable and buttresses, to blocks."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.items.masonry import Buttress, Gable, Masonry
from mbla.deck.tree import KeyPath
from mbla.errors import Finding
from mbla.model.generators.amounts import Amount
from mbla.model.generators.generator import ItemRefused, Part
from mbla.model.generators.masonry.buttresses import PlacedButtress, buttress_leg, levels_with_top
from mbla.model.generators.masonry.courses import units_of
from mbla.model.generators.masonry.leg import Leg, Slopes
from mbla.model.generators.masonry.openings import PlacedOpening, spans_of


@dataclass(frozen=True)
class Wall:
    """A straight wall with what belongs to it."""

    leg: Leg
    openings: Sequence[PlacedOpening]
    buttresses: Sequence[PlacedButtress]


def amount_of_units(
    item: Masonry, length: float, key: KeyPath, gables: Sequence[Gable], buttresses: Sequence[Buttress]
) -> Amount:
    """About how many units walls have.

    length : of all walls together
    """
    unit, width, height = item.unit
    courses = item.courses + max((gable.rise for gable in gables), default=0.0) / height
    along = item.leaves * max(length / min(unit, width if item.leaves > 1 else unit), 1.0)
    across = sum(max((buttress.depth + item.leaves * width) / unit, 1.0) for buttress in buttresses)
    return Amount(courses * (along + across), key)


def fixed_levels(openings: Iterable[PlacedOpening], buttresses: Iterable[PlacedButtress]) -> list[int]:
    """Bed joints that random heights of courses leave where they are."""
    found = [level for opening in openings for void in opening.voids for level in (void.bottom, void.top)]
    return found + [buttress.courses for buttress in buttresses]


def with_gable(leg: Leg, gable: Gable | None, shift: float = 0.0) -> Leg:
    """The wall with a triangle on top; ``shift`` is from the start of its line to that of the wall."""
    if gable is None:
        return leg
    apex = leg.length / 2 if gable.apex is None else gable.apex + shift
    slopes = Slopes(0.0, leg.length, apex, float(leg.levels[-1]), gable.rise)
    levels: FloatArray = levels_with_top(leg.levels, gable.rise, leg.item.unit[2])
    return replace(leg, slopes=slopes, levels=levels)


def parts_of(walls: Sequence[Wall], numbered: bool) -> Iterator[Part]:
    """Blocks of walls: the units of each, then what spans their openings, then the buttresses.

    numbered : whether blocks are labelled by the number of their wall

    Raises
    ------
    ItemRefused
        where openings leave nothing of the walls
    """
    parts = [(units_of(wall.leg), wall.leg) for wall in walls]
    if not any(len(part.polyhedra) for part, _ in parts):
        raise ItemRefused(Finding("wall-shape", "nothing is left of the wall", "openings"))
    parts += [(part, wall.leg) for wall in walls for part in spans_of(wall.leg, wall.openings)]
    parts += [(units_of(buttress_leg(wall.leg, placed)), wall.leg) for wall in walls for placed in wall.buttresses]
    for part, leg in parts:
        if len(part.polyhedra):
            segment = {"segment": np.full(len(part.polyhedra), leg.number)} if numbered else {}
            yield replace(part, labels={**part.labels, **segment})
