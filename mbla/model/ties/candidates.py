"""Candidates for a strengthening: ties laid out over a structure by patterns, with what they cost."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise, product

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.section import given
from mbla.deck.sections.strengthen import PATTERNS, Across, Candidate, Vertical
from mbla.deck.sections.ties import TieSection
from mbla.errors import Finding, KeyPath
from mbla.model.model import Ground
from mbla.model.selectors import BlockSelection, select_blocks
from mbla.model.solids.plane import plane_axes, unit
from mbla.model.solids.ragged import items_of_rows
from mbla.model.supports.surfaces import lies_on
from mbla.model.ties.build import ties_of
from mbla.model.ties.lines import TieLine, TieSite, build_lines, cuts_of
from mbla.model.ties.ties import OUTSIDE, Ties, joined_ties

MOST_LINES = 5000
"""candidates that one pattern lays out at most"""
UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Candidates:
    """Ties that may be added, k of them, and what they are worth.

    costs : (k,) of a unit of capacity, which is that over the length
    most  : (k,) greatest capacity, inf where it is not limited
    """

    ties: Ties
    costs: FloatArray
    most: FloatArray


def build_candidates(
    sections: Sequence[Candidate],
    selection: BlockSelection,
    fixed: BoolArray,
    grounds: Sequence[Ground],
    tolerance: float,
) -> Candidates:
    """The candidates of a deck; faults go to the selection.

    fixed     : (n_blocks,) blocks that do not move
    grounds   : planes in which bars may end
    tolerance : of contacts, relative to block size
    """
    parts, counts, site = list[Ties](), dict[str, int](), _Site(selection, fixed, tolerance, grounds)
    costs, most = [np.zeros(0)], [np.zeros(0)]
    for number, section in enumerate(sections):
        path: KeyPath = ("strengthen", "candidates", number)
        lines = [line for line in _lines(section, path, site) if site.can_move(line.bodies)]
        if not lines and not selection.faults:
            words = "lays out no tie: none of its lines meets blocks that can move apart"
            if section.vertical is not None:
                words += ", or ends on a fixed block or on ground"
            site.refuse(Finding("tie-without-effect", words, *path))
        made = ties_of("tie", section.name or given(section, PATTERNS)[0], lines, counts)
        parts.append(made)
        costs.append(section.cost * made.lengths)
        most.append(np.full(len(made), np.inf if section.most is None else section.most))
    return Candidates(joined_ties(parts), np.concatenate(costs), np.concatenate(most))


@dataclass(frozen=True)
class _Site(TieSite):
    """With the grounds in which bars may end."""

    grounds: Sequence[Ground]

    def bears(self, place: FloatArray, block: int) -> bool:
        """Whether a block that a line leaves at a place, (3,), is fixed, or on ground there."""
        near = self.tolerance * float(self.blocks.sizes[block])
        return bool(self.fixed[block]) or any(lies_on(place[None], ground, near).all() for ground in self.grounds)


def _lines(section: Candidate, path: KeyPath, site: _Site) -> Iterator[TieLine]:
    if section.across is not None:
        yield from _across(section.across, (*path, "across"), site)
    elif section.vertical is not None:
        yield from _vertical(section.vertical, (*path, "vertical"), site)
    else:
        keys = section.model_dump(include={"ring", "through", "on"}, exclude_none=True, by_alias=True)
        yield from build_lines(TieSection.model_validate({**keys, "capacity": 1.0}), path, site)


@dataclass(frozen=True)
class _MetBlocks:
    """Blocks that lines may meet; ``low`` and ``high`` corners of their box."""

    site: _Site
    chosen: IntArray
    low: FloatArray
    high: FloatArray

    @staticmethod
    def of(site: _Site, chosen: IntArray) -> _MetBlocks:
        vertices = site.blocks.vertices[items_of_rows(site.blocks.vertex_start, chosen)]
        return _MetBlocks(site, chosen, vertices.min(axis=0), vertices.max(axis=0))

    def met_by(self, begin: FloatArray, end: FloatArray) -> tuple[FloatArray, int] | None:
        """Where a line first comes to them, (3,) m, and the block there; None where it misses them."""
        for first, last in pairwise(cuts_of(begin, end, self.site.blocks)):
            found = self.site.touched(begin + 0.5 * (first + last) * (end - begin), self.chosen)
            if len(found):
                return begin + first * (end - begin), int(found[0])
        return None

    def reach(self, way: FloatArray) -> tuple[float, float]:
        """Least and greatest coordinate of their box along a unit vector."""
        ends = np.where(way > 0.0, self.low, self.high), np.where(way > 0.0, self.high, self.low)
        return float(ends[0] @ way), float(ends[1] @ way)


def _across(section: Across, path: KeyPath, site: _Site) -> Iterator[TieLine]:
    """Lines from the outer face of one wall to that of the other."""
    chosen = [
        select_blocks(each, (*path, "between", side), site.selection) for side, each in enumerate(section.between)
    ]
    if any(each is None for each in chosen):
        return
    one, other = (_MetBlocks.of(site, each) for each in chosen if each is not None)
    apart = (other.low + other.high - one.low - one.high) / 2.0
    along = np.eye(3)[np.abs(apart[:2]).argmax()] if section.along is None else unit(np.array(section.along))
    along = along * (1.0 if along @ apart >= 0.0 else -1.0)
    aside = unit(np.cross(UP, along)) if abs(along @ UP) < 1.0 else plane_axes(along[None])[0][0]
    reach = np.array([wall.reach(along) for wall in (one, other)])
    margin = 0.01 * float(np.ptp(reach))
    begins, ends = (reach.min() - margin) * along, (reach.max() + margin) * along
    sides = np.array([wall.reach(aside) for wall in (one, other)])
    low, high = float(sides[:, 0].max()), float(sides[:, 1].min())  # of what the walls have in common
    if high <= low:
        site.refuse(
            Finding("tie-without-effect", "the walls do not face each other: give another way with `along`", *path)
        )
        return
    places = _evenly(low, high, section.every)
    if not len(places):
        words = f"must be <= {high - low:.6g}, the length along which the walls face each other"
        site.refuse(Finding("out-of-bounds", words, *path, "every"))
        return
    count = len(section.z) * len(places) ** (1 if section.pairs == "opposite" else 2)
    if count > MOST_LINES:
        _refuse_number(count, site, *path)
        return
    for z in section.z:
        across = [s * aside + (z - s * aside[2]) * UP for s in places]
        across = [each - (each @ along) * along for each in across]
        starts_at = [one.met_by(each + begins, each + ends) for each in across]
        stops_at = [other.met_by(each + ends, each + begins) for each in across]
        pairs = zip(starts_at, stops_at, strict=True) if section.pairs == "opposite" else product(starts_at, stops_at)
        for start, stop in pairs:
            if start is not None and stop is not None:
                yield TieLine.along(np.array([start[1], stop[1]]), np.stack([start[0], stop[0]]))


def _evenly(low: float, high: float, every: float) -> FloatArray:
    """Coordinates between two, evenly from their middle; none where there is less than a step between them."""
    count = min(int((high - low) // every), MOST_LINES + 1)
    return np.asarray((low + high) / 2.0 + every * (np.arange(count) - (count - 1) / 2.0))


def _refuse_number(count: int, site: _Site, *path: str | int) -> None:
    site.refuse(Finding("too-many-candidates", f"lays out {count} ties, at most {MOST_LINES} can be handled", *path))


def _vertical(section: Vertical, path: KeyPath, site: _Site) -> Iterator[TieLine]:
    """Lines from the highest block at each place of a grid down to where the lowest one there is fixed or on ground."""
    chosen = select_blocks(section.down, (*path, "down"), site.selection)
    if chosen is None:
        return
    wall, everything = _MetBlocks.of(site, chosen), _MetBlocks.of(site, np.arange(len(site.blocks)))
    counts = [max((wall.high[axis] - wall.low[axis]) // section.every, 1.0) for axis in (0, 1)]
    if counts[0] * counts[1] > MOST_LINES:
        _refuse_number(int(counts[0] * counts[1]), site, *path, "every")
        return
    grid = []
    for axis in (0, 1):
        count = int(counts[axis])
        middle = (wall.low[axis] + wall.high[axis]) / 2.0
        grid.append(middle + section.every * (np.arange(count) - (count - 1) / 2.0))
    margin = 0.01 * (everything.high[2] - everything.low[2])
    for x, y in product(*grid):
        top, foot = np.array([x, y, wall.high[2] + margin]), np.array([x, y, everything.low[2] - margin])
        met, below = wall.met_by(top, foot), everything.met_by(foot, top)
        if met is not None and below is not None and site.bears(*below):
            yield TieLine.along(np.array([met[1], OUTSIDE]), np.stack([met[0], below[0]]))
