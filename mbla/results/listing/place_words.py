"""Where blocks are, in words: which side of the structure, which courses, which coordinates."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.model import Model
from mbla.results.listing.block_names import MOST_STRETCHES, block_names, stretches
from mbla.results.listing.text import counted, vector

AT_END = 0.05
"""share of an extent within which blocks reach to an end of it"""
FLAT = 1 / 3
"""thickness over length, both in plan, up to which a structure has a left and a right side as a wall has"""
FILLED = 0.6
"""share of the box around a structure that its blocks fill from which it has corners"""
NOTHING = 1e-6
"""coordinates below this share of the largest are written as zero: axes are known to the residual of the solution"""
NAMED_POSITIONS = ("segment", "course")
"""positions that say where blocks of a wall are; segments where it has several"""
MOST_GROUPS = 2
"""groups that are named; the others are counted"""


def region_words(model: Model, blocks: IntArray) -> str:
    """``upper right corner``, ``lower part``, ``part at the +y end``; ``part`` where no side of it is meant.

    Left and right are those of a wall along x seen along +y; in other structures the ends of the axes say it.
    """
    low, high = _box(model, blocks)
    size = _extents(model)[1] - _extents(model)[0]
    flat = size[1] <= FLAT * size[0]
    sides = [_side(low[axis], high[axis]) for axis in range(3)]
    height = {-1: "lower ", 0: "", 1: "upper ", 2: "middle "}[sides[2]]
    if flat:
        across = {-1: "left", 0: "", 1: "right", 2: ""}[sides[0]]
        if height in ("lower ", "upper ") and across:
            return f"{height}{across} {'corner' if _filled(model) else 'part'}"
        return f"{height}part" if not across else f"{height}{across} part"
    ends = [f"{'+' if sides[axis] > 0 else '-'}{'xyz'[axis]}" for axis in (0, 1) if sides[axis] in (-1, 1)]
    if len(ends) == 2:
        return f"{height}part at the {ends[0]}, {ends[1]} corner"
    return f"{height}part at the {ends[0]} end" if ends else f"{height}part"


def _filled(model: Model) -> bool:
    """Whether the blocks fill the box around them as a wall does, and an arch does not."""
    least, greatest = _extents(model)
    return float(model.blocks.volumes[model.free].sum()) >= FILLED * float(np.prod(greatest - least))


def _side(low: float, high: float) -> int:
    """-1 and 1 for an end of the extent, 0 for both, 2 for neither."""
    to_low, to_high = low <= AT_END, high >= 1.0 - AT_END
    return 0 if to_low and to_high else -1 if to_low else 1 if to_high else 2


def _box(model: Model, blocks: IntArray) -> tuple[FloatArray, FloatArray]:
    """Ends of the blocks over the extents of the structure, 0 to 1, (3,) each."""
    low, high = extents_of(model, blocks)
    least, greatest = _extents(model)
    size = np.where(greatest > least, greatest - least, 1.0)
    return (low - least) / size, (high - least) / size


def _extents(model: Model) -> tuple[FloatArray, FloatArray]:
    """Of the blocks that can move: supports that are modelled as blocks are no part of what is told."""
    return extents_of(model, model.free)


def extents_of(model: Model, blocks: IntArray) -> tuple[FloatArray, FloatArray]:
    """Least and greatest coordinates of some blocks, (3,) each."""
    vertices = model.blocks.vertices[np.isin(model.blocks.block_of_vertex, blocks)]
    return vertices.min(axis=0), vertices.max(axis=0)


def group_words(model: Model, blocks: IntArray) -> str:
    """``arch[3..9]``, ``12 blocks of wall``, ``40 blocks of pier, wall and 2 more groups``."""
    if stretches(model, blocks) <= MOST_STRETCHES:
        return block_names(model, blocks)
    names = list(dict.fromkeys(model.blocks.groups[block] for block in blocks.tolist()))
    more = len(names) - MOST_GROUPS
    listed = f"{', '.join(names[:MOST_GROUPS])} and {counted(more, 'more group')}" if more > 0 else " and ".join(names)
    return f"{counted(len(blocks), 'block')} of {listed}"


def range_words(model: Model, blocks: IntArray) -> list[str]:
    """``courses 1 to 6``, ``x 2.1 .. 3.2 m``: positions in one group, and coordinates that the structure exceeds."""
    words = []
    groups = np.array(model.blocks.groups)
    if len(set(groups[blocks].tolist())) == 1:
        own = np.flatnonzero(groups == groups[blocks[0]])
        for label in NAMED_POSITIONS:
            all_of_group = model.blocks.labels.position(label)[own]
            found = model.blocks.labels.position(label)[blocks]
            found = found[found >= 0]
            if len(found) and (label == "course" or len(np.unique(all_of_group)) > 1):
                least, most = int(found.min()), int(found.max())
                words.append(f"{label} {least}" if least == most else f"{label}s {least} to {most}")
    low, high = extents_of(model, blocks)
    share_low, share_high = _box(model, blocks)
    size = float(np.abs(model.blocks.vertices).max(initial=0.0))
    spans = [
        f"{'xyz'[axis]} {_figure(low[axis], size)} .. {_figure(high[axis], size)}"
        for axis in range(3)
        if share_low[axis] > AT_END or share_high[axis] < 1.0 - AT_END
    ]
    return [*words, f"{', '.join(spans)} {model.units.length}"] if spans else words


def _figure(value: float, size: float) -> str:
    return f"{0.0 if abs(value) <= 1e-9 * size else value + 0.0:.4g}"


def point_words(model: Model, point: FloatArray) -> str:
    """``(3.2, 0.125, 0.2)``; components that are nothing against the coordinates of the model are zero."""
    size = float(np.abs(model.blocks.vertices).max(initial=0.0))
    return vector(np.where(np.abs(point) <= NOTHING * size, 0.0, point))
