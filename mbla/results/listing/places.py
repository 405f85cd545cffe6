"""Where blocks are and which way something points, in words: groups, sides of the structure, coordinates, labels."""

from __future__ import annotations

from collections import Counter

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.sections.selectors import POSITIONS
from mbla.deck.sections.soil import SOIL
from mbla.model.model import Model
from mbla.model.soil.names import soil_name
from mbla.model.solids.blocks import BlockLabels
from mbla.results.listing.text import counted, vector

MOST_GROUPS = 2
"""groups that are named; the others are counted"""
MOST_NAMED = 8
"""members that are named one by one"""
AT_END = 0.05
"""share of an extent within which blocks reach to an end of it"""
NOTHING = 1e-6
"""coordinates below this share of the largest are written as zero: axes are known to the residual of the solution"""
ALONG_AXIS = 0.995
"""cosine from which a direction is called by the axis it follows: within 6 degrees"""
DIGITS = 2
"""of directions: within half a degree"""


def group_words(model: Model, blocks: IntArray) -> str:
    """Of blocks, (n,): ``arch[3..9]``, ``12 blocks of wall``, ``40 blocks of pier, wall and 2 more groups``.

    Cells of soil are a wedge of it: ``strip[0] and a wedge of soil, 34 cells``.
    """
    soil = model.soil_of_block[blocks]
    others = blocks[soil < 0]
    words = [_names_of(model, others)] if len(others) else []
    if len(others) < len(blocks):
        words.append(f"a wedge of {soil_words(model, soil[soil >= 0])}, {counted(len(blocks) - len(others), 'cell')}")
    return " and ".join(words)


def soil_words(model: Model, rows: IntArray) -> str:
    """``soil`` where it is called that or there are several, else ``soil road``; rows (n,) of ``model.soils``."""
    names = {model.soils[row].name for row in rows.tolist()}
    return SOIL if len(names) > 1 else soil_name(names.pop())


def block_words(model: Model, block: int) -> str:
    """Its name; of a cell of soil where it lies: ``soil road at (1.2, 0.5, 0.8)``."""
    row = int(model.soil_of_block[block])
    if row < 0:
        return model.blocks.name(block)
    return f"{soil_words(model, np.array([row]))} at {point_words(model, model.blocks.centroids[block])}"


def counted_blocks(model: Model) -> str:
    """All blocks and soils: ``41 blocks``, or ``41 blocks, soil road of 320 cells``."""
    return ", ".join([counted(int((model.soil_of_block < 0).sum()), "block"), *counted_soils(model)])


def counted_soils(model: Model) -> list[str]:
    """``soil road of 320 cells`` and so on, one each."""
    return [
        f"{soil_words(model, np.array([row]))} of {counted(len(soil.triangles), 'cell')}"
        for row, soil in enumerate(model.soils)
    ]


def counted_of(model: Model, blocks: IntArray, word: str = "block") -> str:
    """Some blocks, (n,): ``12 free blocks and 34 cells of soil road``."""
    soil = model.soil_of_block[blocks]
    cells = soil[soil >= 0]
    own = [counted(len(blocks) - len(cells), word)] if len(cells) < len(blocks) or not len(cells) else []
    return " and ".join(
        [*own, *([f"{counted(len(cells), 'cell')} of {soil_words(model, cells)}"] if len(cells) else [])]
    )


def _names_of(model: Model, blocks: IntArray) -> str:
    groups = list(dict.fromkeys(model.blocks.groups[block] for block in blocks.tolist()))
    numbers = model.blocks.group_indices[blocks]
    first, last = int(numbers.min()), int(numbers.max())
    if len(groups) == 1 and last - first == len(blocks) - 1:
        return f"{groups[0]}[{first}]" if first == last else f"{groups[0]}[{first}..{last}]"
    more = len(groups) - MOST_GROUPS
    words = ", ".join(groups[:MOST_GROUPS]) + (f" and {counted(more, 'more group')}" if more > 0 else "")
    return f"{counted(len(blocks), 'block')} of {words}"


def span_words(model: Model, blocks: IntArray) -> str:
    """``x 2.1 .. 3.2, z 0 .. 1.4 m``: coordinates of blocks, (n,), that the structure exceeds; empty for none."""
    (low, high), (least, greatest) = extents_of(model, blocks), extents_of(model, model.free)
    margin = AT_END * (greatest - least)
    shorter = np.flatnonzero((low - least > margin) | (greatest - high > margin)).tolist()
    spans = [f"{'xyz'[axis]} {low[axis] + 0.0:.4g} .. {high[axis] + 0.0:.4g}" for axis in shorter]
    return f"{', '.join(spans)} {model.units.length}" if spans else ""


def extents_of(model: Model, blocks: IntArray) -> tuple[FloatArray, FloatArray]:
    """Least and greatest coordinates of some blocks, (3,) each; zero where they are rounding."""
    vertices = model.blocks.vertices[np.isin(model.blocks.block_of_vertex, blocks)]
    least = NOTHING * float(np.abs(model.blocks.vertices).max(initial=0.0))
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    return np.where(np.abs(low) <= least, 0.0, low), np.where(np.abs(high) <= least, 0.0, high)


def point_words(model: Model, point: FloatArray) -> str:
    """``(3.2, 0.125, 0.2)``; components that are nothing against the coordinates of the model are zero."""
    size = float(np.abs(model.blocks.vertices).max(initial=0.0))
    return vector(np.where(np.abs(point) <= NOTHING * size, 0.0, point))


def direction_words(direction: FloatArray) -> str:
    """``+y`` for what nearly follows an axis, else the components.

    direction : (3,) unit
    """
    axis = int(np.argmax(np.abs(direction)))
    if abs(direction[axis]) >= ALONG_AXIS:
        return ("+" if direction[axis] > 0 else "-") + "xyz"[axis]
    return vector(np.round(direction, DIGITS))


def label_words(labels: BlockLabels, blocks: IntArray) -> str:
    """What selectors can say within a group: ``members key (1 block), ring (8); course 0 .. 5``; empty for nothing."""
    words = []
    counts = Counter(labels.members[block] for block in blocks.tolist())
    counts.pop("", None)
    if counts:
        named = [f"{name} ({count})" for name, count in list(counts.items())[:MOST_NAMED]]
        more = f" and {len(counts) - MOST_NAMED} more" if len(counts) > MOST_NAMED else ""
        words.append(f"{'member' if len(counts) == 1 else 'members'} {', '.join(named)}{more}")
    for name in POSITIONS:
        positions = labels.position(name)[blocks]
        positions = positions[positions >= 0]
        if len(positions):
            words.append(f"{name} {positions.min()} .. {positions.max()}")
    return "; ".join(words)
