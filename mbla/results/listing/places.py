"""Where things are and which way they go, in words: blocks, places of the structure, directions, labels."""

from __future__ import annotations

from collections import Counter

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.sections.selectors import POSITIONS
from mbla.model.model import LoadCase, Model
from mbla.model.solids.blocks import BlockLabels
from mbla.results.listing.text import counted, vector

MOST_STRETCHES = 2
"""stretches of blocks that are named; the others are counted"""


def block_names(model: Model, blocks: IntArray) -> str:
    """``arch[3..9], facade[2]``: blocks, (n,), that follow each other in a group as one stretch, the longest first.

    Of many stretches the longest are named and the blocks of the others counted.
    """
    groups, indices, counts = _stretches(model, blocks)
    longest = np.argsort(-counts, kind="stable")[:MOST_STRETCHES]
    words = [_stretch(groups[i], int(indices[i]), int(counts[i])) for i in longest]
    left_out = len(blocks) - int(counts[longest].sum())
    return ", ".join(words) + (f" and {left_out} more" if left_out else "")


def _stretches(model: Model, blocks: IntArray) -> tuple[list[str], IntArray, IntArray]:
    """Group, first index and length of every stretch, by group and index."""
    groups, indices = np.array(model.blocks.groups)[blocks], model.blocks.group_indices[blocks]
    order = np.lexsort((indices, groups))
    groups, indices = groups[order], indices[order]
    new = np.ones(len(order), dtype=bool)
    new[1:] = (groups[1:] != groups[:-1]) | (np.diff(indices) != 1)
    start = np.flatnonzero(new)
    counts = np.diff(np.append(start, len(order)))
    return [str(group) for group in groups[start]], indices[start], counts


def _stretch(group: str, first: int, count: int) -> str:
    return f"{group}[{first}]" if count == 1 else f"{group}[{first}..{first + count - 1}]"


# --- Where blocks are, in words: which side of the structure, which courses, which coordinates ----------------------


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

    blocks : (n,) those of the part
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
    """Of blocks, (n,): ``arch[3..9]``, ``12 blocks of wall``, ``40 blocks of pier, wall and 2 more groups``."""
    if len(_stretches(model, blocks)[0]) <= MOST_STRETCHES:
        return block_names(model, blocks)
    names = list(dict.fromkeys(model.blocks.groups[block] for block in blocks.tolist()))
    more = len(names) - MOST_GROUPS
    listed = f"{', '.join(names[:MOST_GROUPS])} and {counted(more, 'more group')}" if more > 0 else " and ".join(names)
    return f"{counted(len(blocks), 'block')} of {listed}"


def range_words(model: Model, blocks: IntArray) -> list[str]:
    """``courses 1 to 6``, ``x 2.1 .. 3.2 m``: positions in one group, and coordinates that the structure exceeds.

    blocks : (n,) those of which it is said
    """
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


# --- Where something moves, in words: with the load or against it, up or down, outwards, or along an axis -----------


ALONG_AXIS = 0.995
"""cosine from which a direction is called by the axis it follows: within 6 degrees"""
VERTICAL = 0.95
"""cosine from which a direction is plainly up or down: within 18 degrees"""
LEVEL = 0.15
"""sine up to which it is level: within 9 degrees"""
TABLE_DIGITS = 2
"""of directions in tables, whose columns are narrow: within half a degree"""
WITH = 0.8
"""cosine from which a direction in plan is that of the load, or outwards: within 37 degrees"""


def direction_words(direction: FloatArray, digits: int = 3) -> str:
    """``+y`` for what nearly follows an axis, else the components, with some digits behind the point.

    direction : (3,) unit
    """
    axis = int(np.argmax(np.abs(direction)))
    if abs(direction[axis]) >= ALONG_AXIS:
        return ("+" if direction[axis] > 0 else "-") + "xyz"[axis]
    return vector(np.round(direction, digits))


def way_words(model: Model, load_case: LoadCase, velocity: FloatArray, at: FloatArray) -> str:
    """``with the load and downwards``, ``downwards``, ``outwards``, ``towards +x``; empty for no motion.

    velocity, at : (3,) of a point, m
    """
    speed = float(np.linalg.norm(velocity))
    if speed == 0.0:
        return ""
    down = downwards(load_case)
    sinks = float(velocity @ down) / speed
    rises = "downwards" if sinks > 0 else "upwards"
    if abs(sinks) >= VERTICAL:
        return rises
    level = velocity / speed - sinks * down
    words = _level_words(model, load_case, level / float(np.linalg.norm(level)), at, down)
    return words if abs(sinks) <= LEVEL else f"{words} and {rises}"


def downwards(load_case: LoadCase) -> FloatArray:
    """Direction of the dead load, (3,), but for that of a support that gives way; -z where there is none."""
    loads = load_case.dead_load[:, :3]
    if load_case.settlement is not None:
        loads = np.delete(loads, load_case.settlement.blocks, axis=0)
    return _unit(loads.sum(axis=0), np.array([0.0, 0.0, -1.0]))


def _unit(vector: FloatArray, default: FloatArray) -> FloatArray:
    size = float(np.linalg.norm(vector))
    return np.asarray(vector / size) if size > 0 else default


def _level_words(model: Model, load_case: LoadCase, level: FloatArray, at: FloatArray, down: FloatArray) -> str:
    """A level direction: by the load where that has one in plan, by the middle of the structure, or by the axes."""
    if load_case.settlement is None:
        live = load_case.live_load[:, :3].sum(axis=0)
        pushes = live - (live @ down) * down
        if np.linalg.norm(pushes) > LEVEL * np.linalg.norm(live):
            along = float(level @ _unit(pushes, level))
            if abs(along) >= WITH:
                return "with the load" if along > 0 else "against the load"
    blocks = model.blocks
    middle = np.average(blocks.centroids, axis=0, weights=blocks.volumes)
    out = at - middle
    out = out - (out @ down) * down
    size = float(np.ptp(blocks.vertices, axis=0).max(initial=0.0))
    if np.linalg.norm(out) > LEVEL * size:
        along = float(level @ _unit(out, level))
        if abs(along) >= WITH:
            return "outwards" if along > 0 else "inwards"
    return f"towards {direction_words(level)}"


# --- What selectors can say within a group --------------------------------------------------------------------------


MOST_NAMED = 8
"""members that are named one by one"""


def label_words(labels: BlockLabels, blocks: IntArray) -> str:
    """``members key (1 block), ring (8); course 0 .. 5``; empty where the blocks have no labels."""
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
