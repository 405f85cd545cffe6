"""The rigid parts of a mechanism in words: which blocks, how heavy, and how each part moves."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.model import Model
from mbla.results.collapse.rigid_parts import PartMotion, moving_share, reach
from mbla.results.words.block_names import block_names
from mbla.results.words.text import counted, number, sentence, table, vector

MOST_ROWS = 20
"""parts of a table; the result files hold all of them"""
ALONG_AXIS = 0.995
"""cosine from which a direction is called by the axis it follows: within 6 degrees"""


def part_lines(model: Model, parts: IntArray, motions: Sequence[PartMotion]) -> list[str]:
    """How much of the structure moves, and a table of the parts, the heaviest first."""
    free = ~model.fixed
    moving = int(np.sum(free & (parts > 0)))
    share = moving_share(model, parts)
    verb = "moves" if moving == 1 else "move"
    says = (
        f"The mechanism is {reach(share)}: {moving} of {counted(len(model.free), 'free block')}, "
        f"{100 * share:.3g} % of the weight, {verb} in {counted(len(motions), 'rigid part')}."
    )
    if not motions:
        return sentence("No block moves.")
    rows = [
        [
            f"{each.number}: {block_names(model, each.blocks)}",
            motion_words(model, each),
            str(len(each.blocks)),
            number(each.weight),
        ]
        for each in motions[:MOST_ROWS]
    ]
    head = ["part", "motion", "blocks", f"weight [{model.units.force}]"]
    more = sentence(f"and {len(motions) - MOST_ROWS} lighter ones; the result files hold them all")
    return [*sentence(says), *table(head, rows, left=2), *(more if len(motions) > MOST_ROWS else [])]


def motion_words(model: Model, part: PartMotion) -> str:
    """``turns about +y at (1, 0.5, 1)`` or ``moves along (0.8, 0, 0.6)``."""
    if not part.turns:
        return f"moves along {direction_words(part.direction)}"
    size = float(np.abs(model.blocks.vertices).max(initial=0.0))
    return f"turns about {direction_words(part.direction)} at {vector(part.axis_point, size)}"


def direction_words(direction: FloatArray) -> str:
    """``+y`` for what nearly follows an axis, else the components."""
    axis = int(np.argmax(np.abs(direction)))
    if abs(direction[axis]) >= ALONG_AXIS:
        return ("+" if direction[axis] > 0 else "-") + "xyz"[axis]
    return vector(np.round(direction, 3))
