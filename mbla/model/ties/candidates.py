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
from mbla.deck.text.tree import KeyPath
from mbla.errors import Finding
from mbla.model.model import Ground
from mbla.model.selectors import BlockSelection, select_blocks
from mbla.model.solids.plane import plane_axes, unit
from mbla.model.solids.ragged import items_of_rows
from mbla.model.solids.touching import touched_blocks
from mbla.model.surfaces import lies_on
from mbla.model.ties.build import Line, build_lines, can_move, cuts_of, ties_of
from mbla.model.ties.ties import OUTSIDE, Ties, joined_ties, pulls_along

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
    parts, counts = list[Ties](), dict[str, int]()
    costs, most = [np.zeros(0)], [np.zeros(0)]
    stays = _Stays(fixed, grounds)
    for number, section in enumerate(sections):
        path: KeyPath = ("strengthen", "candidates", number)
        lines = [line for line in _lines(section, path, selection, stays, tolerance) if can_move(line.bodies, fixed)]
        if not lines and not selection.faults:
            words = "lays out no tie: none of its lines meets blocks that can move apart"
            if section.vertical is not None:
                words += ", or ends on a fixed block or on ground"
            selection.refuse(Finding("tie-without-effect", words, *path))
        made = ties_of("tie", section.name or given(section, PATTERNS)[0], lines, counts)
        parts.append(made)
        costs.append(section.cost * made.lengths)
        most.append(np.full(len(made), np.inf if section.most is None else section.most))
    return Candidates(joined_ties(parts), np.concatenate(costs), np.concatenate(most))


@dataclass(frozen=True)
class _Stays:
    """What does not move: ``fixed`` blocks, (n_blocks,), and grounds."""

    fixed: BoolArray
    grounds: Sequence[Ground]

    def bears(self, place: FloatArray, block: int, near: float) -> bool:
        """Whether a block that a line leaves at a place, (3,), is fixed, or on ground within a distance."""
        return bool(self.fixed[block]) or any(lies_on(place[None], ground, near).all() for ground in self.grounds)


def _lines(
    section: Candidate, path: KeyPath, selection: BlockSelection, stays: _Stays, tolerance: float
) -> Iterator[Line]:
    if section.across is not None:
        yield from _across(section.across, (*path, "across"), selection, tolerance)
    elif section.vertical is not None:
        yield from _vertical(section.vertical, (*path, "vertical"), selection, stays, tolerance)
    else:
        keys = section.model_dump(include={"ring", "through", "on"}, exclude_none=True, by_alias=True)
        yield from build_lines(TieSection.model_validate({**keys, "capacity": 1.0}), path, selection, tolerance)


@dataclass(frozen=True)
class _Wall:
    """Blocks of a wall that lines may meet; ``low`` and ``high`` corners of their box."""

    selection: BlockSelection
    chosen: IntArray
    tolerance: float
    low: FloatArray
    high: FloatArray

    @staticmethod
    def of(selection: BlockSelection, chosen: IntArray, tolerance: float) -> _Wall:
        blocks = selection.blocks
        vertices = blocks.vertices[items_of_rows(blocks.vertex_start, chosen)]
        return _Wall(selection, chosen, tolerance, vertices.min(axis=0), vertices.max(axis=0))

    def met_by(self, begin: FloatArray, end: FloatArray) -> tuple[FloatArray, int] | None:
        """Where a line first comes to the wall, (3,) m, and the block there; None where it misses it."""
        cuts = cuts_of(begin, end, self.selection.blocks)
        for first, last in pairwise(cuts):
            middle = begin + 0.5 * (first + last) * (end - begin)
            found = touched_blocks(middle, self.selection.blocks, self.chosen, self.tolerance)
            if len(found):
                return begin + first * (end - begin), int(found[0])
        return None


def _across(section: Across, path: KeyPath, selection: BlockSelection, tolerance: float) -> Iterator[Line]:
    """Lines from the outer face of one wall to that of the other."""
    chosen = [select_blocks(each, (*path, "between", side), selection) for side, each in enumerate(section.between)]
    if any(each is None for each in chosen):
        return
    one, other = (_Wall.of(selection, each, tolerance) for each in chosen if each is not None)
    apart = (other.low + other.high - one.low - one.high) / 2.0
    along = np.eye(3)[np.abs(apart[:2]).argmax()] if section.along is None else unit(np.array(section.along))
    along = along * (1.0 if along @ apart >= 0.0 else -1.0)
    aside = unit(np.cross(UP, along)) if abs(along @ UP) < 1.0 else plane_axes(along[None])[0][0]
    reach = np.array([_reach(wall, along) for wall in (one, other)])
    margin = 0.01 * float(np.ptp(reach))
    begins, ends = (reach.min() - margin) * along, (reach.max() + margin) * along
    places = _places(one, other, aside, section.every)
    if not len(places):
        low, high = _shared(one, other, aside)
        if high > low:
            words = f"must be <= {high - low:.6g}, the length along which the walls face each other"
            selection.refuse(Finding("out-of-bounds", words, *path, "every"))
        else:
            words = "the walls do not face each other: give another way with `along`"
            selection.refuse(Finding("tie-without-effect", words, *path))
        return
    count = len(section.z) * len(places) ** (1 if section.pairs == "opposite" else 2)
    if count > MOST_LINES:
        selection.refuse(_too_many(count, *path))
        return
    for z in section.z:
        across = [s * aside + (z - s * aside[2]) * UP for s in places]
        across = [each - (each @ along) * along for each in across]
        starts_at = [one.met_by(each + begins, each + ends) for each in across]
        stops_at = [other.met_by(each + ends, each + begins) for each in across]
        pairs = zip(starts_at, stops_at, strict=True) if section.pairs == "opposite" else product(starts_at, stops_at)
        for start, stop in pairs:
            if start is not None and stop is not None:
                line = np.stack([start[0], stop[0]])
                yield Line(np.array([start[1], stop[1]]), line, pulls_along(line, closed=False))


def _reach(wall: _Wall, way: FloatArray) -> tuple[float, float]:
    """Least and greatest coordinate of the box of a wall along a unit vector."""
    ends = np.where(way > 0.0, wall.low, wall.high), np.where(way > 0.0, wall.high, wall.low)
    return float(ends[0] @ way), float(ends[1] @ way)


def _places(one: _Wall, other: _Wall, aside: FloatArray, every: float) -> FloatArray:
    """Coordinates along two walls where they lie across from each other, evenly from their middle."""
    low, high = _shared(one, other, aside)
    count = min(max(int((high - low) // every), 0), MOST_LINES + 1)
    return np.asarray((low + high) / 2.0 + every * (np.arange(count) - (count - 1) / 2.0))


def _shared(one: _Wall, other: _Wall, aside: FloatArray) -> tuple[float, float]:
    """Least and greatest coordinate of what two walls have in common along a unit vector."""
    ends = np.array([_reach(one, aside), _reach(other, aside)])
    return float(ends[:, 0].max()), float(ends[:, 1].min())


def _too_many(count: int, *key: str | int) -> Finding:
    return Finding("too-many-candidates", f"lays out {count} ties, at most {MOST_LINES} can be handled", *key)


def _vertical(
    section: Vertical, path: KeyPath, selection: BlockSelection, stays: _Stays, tolerance: float
) -> Iterator[Line]:
    """Lines from the highest block at each place of a grid down to where the lowest one there is fixed or on ground."""
    chosen = select_blocks(section.down, (*path, "down"), selection)
    if chosen is None:
        return
    wall = _Wall.of(selection, chosen, tolerance)
    everything = _Wall.of(selection, np.arange(len(selection.blocks)), tolerance)
    counts = [max((wall.high[axis] - wall.low[axis]) // section.every, 1.0) for axis in (0, 1)]
    if counts[0] * counts[1] > MOST_LINES:
        selection.refuse(_too_many(int(counts[0] * counts[1]), *path, "every"))
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
        if met is None or below is None:
            continue
        near = tolerance * float(selection.blocks.sizes[below[1]])
        if stays.bears(*below, near):
            line = np.stack([met[0], below[0]])
            yield Line(np.array([met[1], OUTSIDE]), line, pulls_along(line, closed=False))
