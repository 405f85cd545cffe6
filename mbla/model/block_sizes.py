"""Blocks that are larger or smaller than stones are: mostly of a deck, or a file, in another unit of length."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.deck.units import METRES, Units
from mbla.errors import Notice
from mbla.model.solids.blocks import Blocks

LARGEST, LONGEST, SMALLEST = 12.0, 20.0, 1e-3
"""m: side of a cube and length beyond both of which no stone is, and hardly a part of a building that moves as one;
side of a cube below which no model at a small scale has blocks"""
STONE = 0.3
"""m, side of a cube that is as large as a stone mostly is"""
SMALL = 0.1
"""share of it that a brick or a cobble still has"""


def unusual_sizes(blocks: Blocks, fixed: BoolArray, units: Units) -> Iterator[Notice]:
    """A warning for each group whose blocks that may move are, by their median, of no stone's size.

    fixed : (n_blocks,) those that do not move: ground may be large
    """
    groups, sides = np.array(blocks.groups, dtype=np.str_), np.cbrt(blocks.volumes) * METRES[units.length]
    for group in dict.fromkeys(blocks.groups):
        rows = np.flatnonzero((groups == group) & ~fixed)
        if not len(rows):
            continue
        middle = int(rows[np.argsort(sides[rows], kind="stable")[len(rows) // 2]])
        extents = blocks.boxes[1][middle] - blocks.boxes[0][middle]
        long = float(extents.max()) * METRES[units.length]
        if (sides[middle] > LARGEST and long > LONGEST) or sides[middle] < SMALLEST:
            yield Notice("warning", "block-size-unusual", _words(blocks.name(middle), extents, sides[middle], units))


def _words(name: str, extents: FloatArray, side: float, units: Units) -> str:
    """How large a block is, and the unit in which it would be a stone; side of a cube of its volume, in m."""
    size = " x ".join(f"{extent:.6g}" for extent in extents)
    sides = {unit: side / METRES[units.length] * METRES[unit] for unit in ("mm", "cm", "m")}
    unit = min(sides, key=lambda unit: abs(math.log(sides[unit] / STONE)))
    meant = f", which would be a stone in {unit}" if SMALL < sides[unit] / STONE < 1.0 / SMALL else ""
    return (
        f"{name} is {size} {units.length} large, as hardly any stone is{meant}: `units: {{length: ...}}` says what "
        'numbers are in, a text such as "400 mm" has its own'
    )
