"""Load `line`: a force per length q along a straight line of length L, carried by the blocks under it.

Each part of the line acts on the block under it: of a part of length l about its middle m, the force q l at m. The sum
of forces is q L and their moment that of q L at the middle of the line, whatever the blocks. Where the line runs along
the joint of two blocks each carries half.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.sections.loads import LineLoad, Load
from mbla.deck.text.tree import KeyPath
from mbla.errors import Finding
from mbla.model.loads.blocks_under import Below
from mbla.model.loads.load_kind import AppliedLoad, LoadSite, sum_on_blocks, wrenches_of
from mbla.model.wording import counted, vector


def line_load(load: Load, blocks: IntArray | None, path: KeyPath, site: LoadSite) -> AppliedLoad | None:
    """A line load on all blocks under it, or on those of them that are selected, (n,)."""
    assert load.line is not None  # what makes it this kind
    line, chosen = load.line, np.arange(len(site.blocks)) if blocks is None else blocks
    begin, end = np.array(line.from_), np.array(line.to)
    ends, carriers = _parts(begin, end, np.array(line.towards), chosen, site)
    bare = np.asarray((carriers < 0).all(axis=0))
    if bare.any() and site.roster.partial:  # what could not be built may well lie there
        return None
    if bare.any():
        _refuse_bare(line, ends, bare, path, site)
        return None
    shares = np.where(carriers >= 0, 1.0, 0.0)
    shares *= np.diff(ends) / shares.sum(axis=0)
    side, part = np.nonzero(shares > 0.0)
    loaded = carriers[side, part]
    length = float(np.linalg.norm(end - begin))
    forces = (length * shares[side, part])[:, None] * np.array(line.force_per_length)
    points = begin + ((ends[:-1] + ends[1:]) / 2)[part, None] * (end - begin)
    words = (
        f"line load {vector(line.force_per_length)} {site.units.force}/{site.units.length} "
        f"from {vector(line.from_)} to {vector(line.to)} {site.units.length}"
    )
    wrenches = wrenches_of(forces, points, site.blocks.centroids[loaded])
    unique, total = sum_on_blocks(loaded, wrenches)
    return AppliedLoad(unique, total, f"{words} on {counted(len(unique), 'block')}")


def _parts(
    begin: FloatArray, end: FloatArray, towards: FloatArray, chosen: IntArray, site: LoadSite
) -> tuple[FloatArray, IntArray]:
    """Ends of the parts of a line, (n + 1,), and the blocks under them left and right of it, (2, n).

    Bare parts that are narrower than the tolerance of contacts are joints that are not quite closed: they count to the
    part before them, or after them at the beginning.
    """
    ends, carriers = Below(site.blocks, towards, chosen).parts(begin, end)
    bare = np.asarray((carriers < 0).all(axis=0))
    narrow = site.tolerance * float(site.blocks.sizes[chosen].min()) / float(np.linalg.norm(end - begin))
    for part in np.flatnonzero(bare & (np.diff(ends) <= narrow)):  # few: open joints
        near = next((other for other in (part - 1, part + 1) if 0 <= other < len(bare) and not bare[other]), part)
        carriers[:, part] = carriers[:, near]
    return ends, carriers


def _refuse_bare(line: LineLoad, ends: FloatArray, bare: BoolArray, path: KeyPath, site: LoadSite) -> None:
    """What lies over no block is no load at all: say how much, and where it begins."""
    begin, run = np.array(line.from_), np.array(line.to) - np.array(line.from_)
    length = float(np.linalg.norm(run))
    lost = float(np.diff(ends)[bare].sum()) * length
    first = begin + ends[:-1][bare][0] * run
    message = (
        f"{lost:.6g} of its {length:.6g} {site.units.length} lie over no block, from {vector(first)} on; "
        "shorten the line, or look for blocks in another direction with towards"
    )
    site.refuse(Finding("load-beside-structure", message, *path, "line"))
