"""Which blocks are cells of soil, and how blocks and soils are named together."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, IntArray
from mbla.deck.sections.soil import SOIL
from mbla.model.blocks.soil import CELL
from mbla.model.solids.blocks import Blocks
from mbla.model.wording import counted, named


def is_cell(blocks: Blocks) -> BoolArray:
    """Blocks that are cells of soil, (n_blocks,)."""
    return np.asarray(blocks.labels.position(CELL.name) >= 0)


def soil_name(name: str) -> str:
    """``soil`` where it is called that, else ``soil road``."""
    return name if name == SOIL else f"soil {name}"


def body_in_words(block: int, blocks: Blocks) -> str:
    """``wall[3]``, ``a cell of soil road``."""
    cell = bool(is_cell(blocks)[block])
    return f"a cell of {soil_name(blocks.groups[block])}" if cell else blocks.name(block)


def counted_with_soil(which: IntArray, blocks: Blocks) -> str:
    """``3 blocks and 40 cells of soil``: blocks (n,)."""
    cells = int(is_cell(blocks)[which].sum())
    soil = [f"{counted(cells, 'cell')} of soil"] if cells else []
    return " and ".join([*([counted(len(which) - cells, "block")] if cells < len(which) else []), *soil])


def carriers_in_words(which: IntArray, blocks: Blocks) -> str:
    """``ring[4]``, ``7 blocks``, ``soil road``, ``1 block and soil road``: what blocks (n,) are."""
    which = np.unique(which)
    cells = is_cell(blocks)[which]
    if len(which) == 1 and not cells.any():
        return blocks.name(int(which[0]))
    soils = [soil_name(name) for name in dict.fromkeys(blocks.groups[cell] for cell in which[cells].tolist())]
    return " and ".join([*([counted(int((~cells).sum()), "block")] if not cells.all() else []), *soils])


def named_with_soil(which: IntArray, blocks: Blocks) -> str:
    """Of blocks (n,) the names, of cells that of the soil: ``soil backfill and wall[0], wall[2]``."""
    cells = is_cell(blocks)[which]
    soils = [soil_name(name) for name in dict.fromkeys(blocks.groups[cell] for cell in which[cells].tolist())]
    return " and ".join([*soils, *([named(which[~cells], blocks.name)] if not cells.all() else [])])
