"""Load `line`: a force per length q along a straight line of length L, carried by the blocks under it.

Each part of the line acts on the block under it: of a part of length l about its middle m, the force q l at m. The sum
of forces is q L and their moment that of q L at the middle of the line, whatever the blocks. Where the line runs along
the joint of two blocks each carries half. On fill it spreads to both sides (:mod:`mbla.model.fill.dispersal`).
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from pydantic import Field

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.kinds.load_key import register_load
from mbla.deck.quantities import Direction, ForcePerLength, Point
from mbla.deck.section import Section, rule
from mbla.errors import Finding, KeyPath
from mbla.model.applied_load import AppliedLoad, sum_on_blocks, wrenches_of
from mbla.model.fill.dispersal import Spread
from mbla.model.loads.blocks_under import Below
from mbla.model.loads.load_footprint import PARALLEL, LoadFootprint
from mbla.model.loads.load_kind import Entry, LoadKind, LoadSite
from mbla.model.loads.on_soil import LAY, refuse_within_soil, refuse_without_length
from mbla.model.loads.tread import Tread, level
from mbla.model.soil.names import carriers_in_words
from mbla.model.wording import vector


class LineLoad(Section):
    """A load along a straight line, carried by the blocks that lie under it."""

    from_: Point = Field(alias="from", description="beginning of the line")
    to: Point = Field(description="end of the line")
    force_per_length: tuple[ForcePerLength, ForcePerLength, ForcePerLength] = Field(
        description="force per length of the line; it acts where the line is drawn, with its moment"
    )
    towards: Direction = Field((0.0, 0.0, -1.0), description="direction in which the blocks under the line are sought")


@rule(LineLoad)
def sound_line(line: LineLoad) -> Iterator[Finding]:
    """A line has a length, and its blocks lie aside of it."""
    run = [end - begin for begin, end in zip(line.from_, line.to, strict=True)]
    if not any(run):
        yield Finding("degenerate-line", "must not be the point from: the line has no length", "to")
    elif _parallel(run, line.towards):
        yield Finding(
            "degenerate-line", "must not run along the line: give the direction in which its blocks lie", "towards"
        )


def _parallel(a: list[float], b: tuple[float, ...]) -> bool:
    """Whether two vectors have one direction, or opposite ones; free of overflow."""
    u, v = ([each / max(map(abs, vector)) for each in vector] for vector in (a, b))
    cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    return sum(each**2 for each in cross) <= PARALLEL**2 * sum(each**2 for each in u) * sum(each**2 for each in v)


def line_load(entry: Entry, blocks: IntArray | None, site: LoadSite) -> AppliedLoad | None:
    """A line load on all blocks under it, or on those of them that are selected, (n,)."""
    line: LineLoad = entry.value
    name, chosen = entry.load.through, np.arange(len(site.blocks)) if blocks is None else blocks
    if name is not None and name not in site.fill:
        return None  # its blocks could not be built
    begin, end = np.array(line.from_), np.array(line.to)
    through = None if name is None else site.fill[name]
    footprint = LoadFootprint(Below(site.blocks, np.array(line.towards), chosen), through, (*entry.path, "line"), site)
    words = (
        f"line load {vector(line.force_per_length)} {site.units.force}/{site.units.length} "
        f"from {vector(line.from_)} to {vector(line.to)} {site.units.length}"
    )
    found = _landed(footprint, line, begin, end, words)
    if found is None:
        return None
    length = float(np.linalg.norm(end - begin))
    forces = (length * found.shares)[:, None] * np.array(line.force_per_length)
    wrenches = wrenches_of(forces, found.points, site.blocks.centroids[found.blocks])
    unique, total = sum_on_blocks(found.blocks, wrenches)
    spread = "" if through is None else f" through fill {through.name}"
    return AppliedLoad(unique, total, f"{words}{spread} on {carriers_in_words(unique, site.blocks)}")


def _landed(footprint: LoadFootprint, line: LineLoad, begin: FloatArray, end: FloatArray, words: str) -> Spread | None:
    """Where it lands; None, and a fault, where part of it lies over no block, or, on fill, all of it goes beyond."""
    site = footprint.site
    if footprint.through is None:
        ends, carriers = footprint.parts_of_line(begin, end)
        bare = np.asarray((carriers < 0).all(axis=0))
        if bare.any() and not site.selection.partial:  # what could not be built may well lie there
            _refuse_bare(line, ends, bare, footprint.path, site)
        found = None if bare.any() else footprint.of_line(begin, end)
        if found is None or refuse_without_length(found.blocks, (end - begin)[None], LAY, footprint.path, site):
            return None
        if refuse_within_soil(footprint.below, found.blocks, found.points, footprint.path, site):
            return None
        return found
    across = end - begin
    if not footprint.sound(np.array([line.force_per_length]), across, Tread()):
        return None
    along, width = level([across[1], -across[0]]), float(np.hypot(across[0], across[1]))
    found = footprint.of((begin + end) / 2, along, width)
    if found is not None and not len(found.blocks):
        message = f"all of it goes beyond the blocks under the fill {footprint.through.name}: move it"
        site.refuse(Finding("load-beside-structure", message, *footprint.path))
        return None
    if found is not None:
        force = np.array([line.force_per_length])
        footprint.remark_beyond(words, force, [found])
        footprint.remark_met(words, force, [found])
    return found


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
    site.refuse(Finding("load-beside-structure", message, *path))


register_load(
    LoadKind(
        name="line",
        section=LineLoad,
        description="load along a line",
        after="moment",
        takes=("through", "follows"),
        build=line_load,
        mirrored=True,
    )
)
