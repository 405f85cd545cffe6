"""Blocks that are larger or smaller than stones are: mostly of a deck, or a file, in another unit of length."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.deck.units import METRES, Units
from mbla.errors import Notice
from mbla.model.soil.names import is_cell, soil_name
from mbla.model.solids.blocks import Blocks

LARGEST, LONGEST, SMALLEST = 12.0, 20.0, 1e-3
"""m: side of a cube and length beyond both of which no stone is, and hardly a part of a building that moves as one;
side of a cube below which no model at a small scale has blocks"""
LONGEST_SOIL, SHORTEST_SOIL, MOSTLY = 1e3, 0.05, 6.0
"""m, greatest extent of soil of cells: beyond what one structure reaches, below what a model at a small scale has, and
as it mostly is"""
STONE = 0.3
"""m, side of a cube that is as large as a stone mostly is"""
SMALL = 0.1
"""share of it that a brick or a cobble still has"""


def unusual_sizes(blocks: Blocks, fixed: BoolArray, units: Units) -> Iterator[Notice]:
    """A warning for each group whose blocks that may move are, by their median, of no stone's size, and for each soil
    of cells that is, as a whole, of no soil's.

    fixed : (n_blocks,) those that do not move: ground may be large
    """
    groups, sides = np.array(blocks.groups, dtype=np.str_), np.cbrt(blocks.volumes) * METRES[units.length]
    cells = is_cell(blocks)
    for group in dict.fromkeys(blocks.groups):
        rows = np.flatnonzero((groups == group) & ~fixed)
        if not len(rows):
            continue
        if cells[rows].all():
            yield from _of_soil(group, blocks.boxes[1][rows].max(axis=0) - blocks.boxes[0][rows].min(axis=0), units)
            continue
        middle = int(rows[np.argsort(sides[rows], kind="stable")[len(rows) // 2]])
        extents = blocks.boxes[1][middle] - blocks.boxes[0][middle]
        long = float(extents.max()) * METRES[units.length]
        if (sides[middle] > LARGEST and long > LONGEST) or sides[middle] < SMALLEST:
            yield Notice("warning", "block-size-unusual", _words(blocks.name(middle), extents, sides[middle], units))


def _of_soil(name: str, extents: FloatArray, units: Units) -> Iterator[Notice]:
    """A warning for soil of extents (3,) that no soil beside masonry has."""
    long = float(extents.max()) * METRES[units.length]
    if not SHORTEST_SOIL <= long <= LONGEST_SOIL:
        yield Notice("warning", "block-size-unusual", _words(soil_name(name), extents, long, units, MOSTLY, "soil"))


def _words(
    name: str, extents: FloatArray, side: float, units: Units, usual: float = STONE, what: str = "a stone"
) -> str:
    """How large something is, and the unit in which its side, in m, would be about the usual one."""
    size = " x ".join(f"{extent:.6g}" for extent in extents)
    sides = {unit: side / METRES[units.length] * METRES[unit] for unit in ("mm", "cm", "m")}
    unit = min(sides, key=lambda unit: abs(math.log(sides[unit] / usual)))
    kind = what.removeprefix("a ")
    meant = f", which would be {what} in {unit}" if SMALL < sides[unit] / usual < 1.0 / SMALL else ""
    return (
        f"{name} is {size} {units.length} large, as hardly any {kind} is{meant}: `units: {{length: ...}}` says what "
        'numbers are in, a text such as "400 mm" has its own'
    )
