"""The rigid parts of a mechanism in words: which blocks, how heavy, and how each part moves."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from mbla.model.model import Model
from mbla.results.collapse.rigid_parts import PartMotion
from mbla.results.listing.block_names import block_names
from mbla.results.listing.direction_words import TABLE_DIGITS, direction_words
from mbla.results.listing.place_words import point_words
from mbla.results.listing.text import MOST_ROWS, number, sentence, table

LONGEST = 40
"""characters up to which the blocks of parts are named; beyond, their groups: the sentences say more"""


def part_lines(model: Model, motions: Sequence[PartMotion]) -> list[str]:
    """A table of the parts that move, the heaviest first."""
    shown = motions[:MOST_ROWS]
    names = [f"{each.number}: {block_names(model, each.blocks)}" for each in shown]
    if max(map(len, names), default=0) > LONGEST:
        names = [f"{each.number}: {_groups(model, each)}" for each in shown]
    rows = [
        [
            name,
            motion_words(model, each),
            str(len(each.blocks)),
            number(each.weight),
        ]
        for name, each in zip(names, shown, strict=True)
    ]
    if not rows:
        return []
    head = ["part", "motion", "blocks", f"weight [{model.units.force}]"]
    more = sentence(f"and {len(motions) - MOST_ROWS} lighter ones; the result files hold them all")
    return [*table(head, rows, left=2), *(more if len(motions) > MOST_ROWS else [])]


def _groups(model: Model, part: PartMotion) -> str:
    """``junction``, ``wall and 2 more``: the groups of a part, that with most blocks first."""
    counts = Counter(model.blocks.groups[block] for block in part.blocks.tolist()).most_common()
    return str(counts[0][0]) + (f" and {len(counts) - 1} more" if len(counts) > 1 else "")


def motion_words(model: Model, part: PartMotion) -> str:
    """``turns about +y at (1, 0.5, 1)`` or ``moves along (0.8, 0, 0.6)``."""
    if not part.turns:
        return f"moves along {direction_words(part.direction, TABLE_DIGITS)}"
    return f"turns about {direction_words(part.direction, TABLE_DIGITS)} at {point_words(model, part.axis_point)}"
