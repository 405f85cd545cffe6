"""Lines of ties: where their points lie, and on which blocks."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.sections.selectors import GROUND
from mbla.deck.sections.ties import Ring, TieSection
from mbla.errors import Finding, KeyPath
from mbla.model.selectors import BlockSelection, select_blocks
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import unit
from mbla.model.solids.ragged import items_of_rows
from mbla.model.solids.touching import is_within, touched_blocks
from mbla.model.ties.ties import OUTSIDE, pulls_along
from mbla.model.transform import AffineMap, repetitions
from mbla.model.wording import named, vector

FARTHEST = 1e6
"""distance of a point from the origin, over that of the farthest block, that is no point of a building"""
CLOSES = 1e-9
"""distance of the last point from the first, over the length of a line, at which it is closed"""
BESIDE = 0.1
"""how far beside the corner of a ring its blocks are looked for, over the size of the smallest"""
ALIKE = 1e-9
"""distance over the length of a strip that is none"""


@dataclass(frozen=True)
class TieLine:
    """One run of points with one force; ``bodies`` (m,), ``places`` and ``pulls`` (m, 3)."""

    bodies: IntArray
    places: FloatArray
    pulls: FloatArray
    closed: bool = False

    @staticmethod
    def along(bodies: IntArray, places: FloatArray, *, closed: bool = False) -> TieLine:
        """Of a tension along the line."""
        return TieLine(bodies, places, pulls_along(places, closed=closed), closed)


@dataclass(frozen=True)
class TieSite:
    """What ties are laid out on: blocks, which of them do not move, (n_blocks,), and the tolerance of contacts relative
    to block size; faults go to the selection.
    """

    selection: BlockSelection
    fixed: BoolArray
    tolerance: float

    @property
    def blocks(self) -> Blocks:
        """All of them."""
        return self.selection.blocks

    def touched(self, point: FloatArray, among: IntArray | None = None) -> IntArray:
        """Blocks, of all or of some, (n,), that a point, (3,), lies in or on."""
        return touched_blocks(
            point, self.blocks, np.arange(len(self.blocks)) if among is None else among, self.tolerance
        )

    def refuse(self, finding: Finding) -> None:
        """Add a fault, once."""
        self.selection.refuse(finding)

    def on_joint(self, what: str, found: IntArray, *path: str | int) -> None:
        """A fault of a point of a tie that is on several blocks."""
        words = f"{what} lies on the joint between {named(found, self.blocks.name)}: move it"
        self.refuse(
            Finding("tie-on-joint", words + (", or choose one of them in `on`" if "through" in path else ""), *path)
        )

    def can_move(self, bodies: IntArray) -> bool:
        """Whether points of a tie are on blocks, at least two or one and the ground, of which one moves."""
        still = np.append(self.fixed, True)[bodies]  # OUTSIDE takes the last entry
        return bool((~still).any()) and len(np.unique(np.where(still, OUTSIDE, bodies))) > 1


def build_lines(section: TieSection, path: KeyPath, site: TieSite) -> Iterator[TieLine]:
    """The lines of a section and of its copies."""
    for copy in repetitions(section.repeat):
        if section.ring is not None:
            yield from _rings(section.ring, copy, path, site)
        else:
            yield from _line(section, copy, path, site)


def _rings(ring: Ring, copy: AffineMap, path: KeyPath, site: TieSite) -> Iterator[TieLine]:
    """A ring at each of its heights."""
    if not (np.array_equal(copy.matrix, np.eye(3)) and not copy.offset[:2].any()):
        words = "copies of a ring may be moved along z only: it goes round its blocks wherever they are"
        site.refuse(Finding("tie-misfit", words, *path, "repeat"))
        return
    for number, z in enumerate(ring.z):
        chosen = select_blocks(ring.around, (*path, "ring", "around"), site.selection)
        if chosen is not None:
            yield from _ring(chosen, z + float(copy.offset[2]), (*path, "ring", "z", number), site)


def _line(section: TieSection, copy: AffineMap, path: KeyPath, site: TieSite) -> Iterator[TieLine]:
    """A line through points, or along a strip."""
    points = section.through or section.strip
    assert points is not None  # a rule of the deck: one of the forms
    places = copy.points(np.array(points))
    key = "through" if section.through else "strip"
    far = np.abs(places).max(axis=1) > FARTHEST * np.abs(site.blocks.vertices).max(initial=1e-300)
    if far.any() and len(site.blocks):
        words = f"lies more than {FARTHEST:g} times as far away as the blocks"
        site.refuse(Finding("coordinate-out-of-range", words, *path, key, int(np.argmax(far))))
        return
    lengths = np.linalg.norm(np.diff(places, axis=0), axis=1)
    if not (lengths > ALIKE * lengths.sum()).all():
        row = int(np.flatnonzero(lengths <= ALIKE * lengths.sum())[0]) + 1
        site.refuse(Finding("degenerate-line", "must not be the point before it", *path, key, row))
    elif section.strip is not None:
        yield from _strip(places, (*path, key), site)
    else:
        yield from _through(section, places, path, site)


def _through(section: TieSection, places: FloatArray, path: KeyPath, site: TieSite) -> Iterator[TieLine]:
    """A line through points: one force, or one in each stretch."""
    closed = bool(np.linalg.norm(places[-1] - places[0]) <= CLOSES * np.ptp(places, axis=0).max()) and len(places) > 3
    if closed:
        places = places[:-1]
    found = [_block_at(section, number, place, path, site) for number, place in enumerate(places)]
    bodies = np.array([body for body in found if body is not None], dtype=np.int64)
    if len(bodies) < len(places):
        return
    if section.points == "passes":
        yield TieLine.along(bodies, places, closed=closed)
        return
    for first in range(len(places) - (0 if closed else 1)):
        pair = np.array([first, (first + 1) % len(places)])
        yield TieLine.along(bodies[pair], places[pair])


def _block_at(section: TieSection, number: int, place: FloatArray, path: KeyPath, site: TieSite) -> int | None:
    """The block that a point of a line is fixed to, OUTSIDE for ground; None with a fault."""
    anchor = None if section.on is None else section.on[number]
    if anchor == GROUND:
        return OUTSIDE
    chosen = None
    if anchor is not None:
        chosen = select_blocks(anchor, (*path, "on", number), site.selection)
    if (anchor is None and site.selection.partial) or (anchor is not None and chosen is None):
        return None
    found = site.touched(place, chosen)
    if len(found) > 1 and anchor is None:
        site.on_joint(f"the point {vector(place)}", found, *path, "through", number)
        return None
    if len(found):
        return int(found[0])
    where, key = f"no block lies at {vector(place)}", "through"
    if anchor is not None:
        where, key = f"none of these blocks lies at {vector(place)}, the point that it is for", "on"
    site.refuse(Finding("tie-off-blocks", f"{where}: move the point, or write ground in `on`", *path, key, number))
    return None


def _ring(chosen: IntArray, height: float, path: KeyPath, site: TieSite) -> Iterator[TieLine]:
    """A closed line along the convex outline of the plan of some blocks, (n,), at a height."""
    from scipy.spatial import ConvexHull, QhullError

    plan = _plan(site.blocks, chosen, height)
    try:
        outline = plan[ConvexHull(plan).vertices]
    except (QhullError, ValueError):
        site.refuse(
            Finding("tie-off-blocks", "these blocks have no plan at that height that a ring could go round", *path)
        )
        return
    places = _corners_of(np.column_stack([outline, np.full(len(outline), height)]))
    owners = list[IntArray]()
    for before, place, after in zip(np.roll(places, 1, axis=0), places, np.roll(places, -1, axis=0), strict=True):
        found = site.touched(place, chosen)
        held = _held_at_corner(before, place, after, found, site)
        if held is None:
            site.on_joint(f"its corner {vector(place)}", found, *path)
            return
        owners.append(held)
    places = np.repeat(places, [len(held) for held in owners], axis=0)
    yield TieLine.along(np.concatenate(owners), places, closed=True)


def _held_at_corner(
    before: FloatArray, place: FloatArray, after: FloatArray, found: IntArray, site: TieSite
) -> IntArray | None:
    """Which of the blocks at a corner of a ring it presses on: one, or the two between which the corner is.

    None where these blocks lie above each other: which of them the ring holds is undetermined.
    """
    if len(found) < 2:
        return found
    near = BESIDE * float(site.blocks.sizes[found].min())
    held = list[int]()
    for other in (before, after):
        step = other - place
        there = site.touched(place + min(0.5, near / float(np.linalg.norm(step))) * step, found)
        if len(there) > 1:
            return None
        held += [block for block in there.tolist() if block not in held]
    return np.array(held, dtype=np.int64) if held else None


def _corners_of(outline: FloatArray) -> FloatArray:
    """An outline without points at which it goes straight on: a tie does not press there."""
    pulls = np.linalg.norm(pulls_along(outline, closed=True), axis=1)
    return np.asarray(outline[pulls > np.sqrt(ALIKE)])


def _plan(blocks: Blocks, chosen: IntArray, z: float) -> FloatArray:
    """Points at which edges of blocks cross a height, (n, 2); of edges at that height their ends."""
    corners = items_of_rows(blocks.loop_start, items_of_rows(blocks.face_start, chosen))
    one, other = blocks.vertices[blocks.loops[corners]], blocks.vertices[blocks.next_loops[corners]]
    low, high = np.minimum(one[:, 2], other[:, 2]), np.maximum(one[:, 2], other[:, 2])
    crossing = (low <= z) & (z <= high)
    one, other = one[crossing], other[crossing]
    rise = other[:, 2] - one[:, 2]
    share = np.divide(z - one[:, 2], rise, out=np.zeros(len(rise)), where=rise != 0.0)
    return np.asarray((one + share[:, None] * (other - one))[:, :2])


def _strip(places: FloatArray, path: KeyPath, site: TieSite) -> Iterator[TieLine]:
    """A force along the strip at each place where it crosses from one block to the next."""
    if site.selection.partial:
        return
    crossings, last, came = 0, OUTSIDE, np.zeros(3)
    for number, (begin, end) in enumerate(pairwise(places)):
        along = unit(end - begin)
        for first, then in pairwise(cuts_of(begin, end, site.blocks).tolist()):
            middle = begin + 0.5 * (first + then) * (end - begin)
            under = site.touched(middle)
            part = f"its part about {vector(middle)}"
            if len(under) > 1:
                site.on_joint(part, under, *path, number)
                return
            if len(under) and is_within(middle, site.blocks, int(under[0]), site.tolerance):
                words = f"{part} is inside of {site.blocks.name(int(under[0]))}: a strip is glued"
                site.refuse(Finding("tie-misfit", f"{words} to faces; give points on them", *path, number))
                return
            block = int(under[0]) if len(under) else OUTSIDE
            if OUTSIDE not in (block, last) and block != last:
                place, way = begin + first * (end - begin), came + along
                way = unit(way) if np.linalg.norm(way) > BESIDE else along
                yield TieLine(np.array([last, block]), np.stack([place, place]), np.stack([way, -way]))
                crossings += 1
            last, came = block, along
    if not crossings:
        site.refuse(Finding("tie-off-blocks", "it crosses no joint between blocks that it lies on", *path))


def cuts_of(begin: FloatArray, end: FloatArray, blocks: Blocks) -> FloatArray:
    """Shares of a stretch, from 0 to 1, at which it may leave a block: where it crosses planes of faces nearby."""
    step = end - begin
    vertices = blocks.vertices[blocks.loops[blocks.loop_start[:-1]]]
    speed = blocks.face_normals @ step
    ahead = np.einsum("ij,ij->i", vertices - begin, blocks.face_normals)
    share = np.divide(ahead, speed, out=np.full(len(speed), -1.0), where=np.abs(speed) > ALIKE * np.linalg.norm(step))
    share = np.unique(np.clip(share[(share > ALIKE) & (share < 1.0 - ALIKE)], 0.0, 1.0))
    share = np.concatenate([[0.0], share[np.append(True, np.diff(share) > ALIKE)] if len(share) else share, [1.0]])
    return np.asarray(share)
