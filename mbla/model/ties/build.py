"""The ties of a deck: where their points lie, on which blocks, and what they carry."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.deck.section import given
from mbla.deck.sections.selectors import GROUND
from mbla.deck.sections.ties import FORMS, Plate, TieSection
from mbla.deck.text.tree import KeyPath
from mbla.errors import Finding
from mbla.model.blocks.amounts import copies_of
from mbla.model.selectors import BlockSelection, select_blocks
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import unit
from mbla.model.solids.ragged import items_of_rows
from mbla.model.solids.touching import is_within, touched_blocks
from mbla.model.ties.amounts import MOST_TIES, lines_of
from mbla.model.ties.ties import NO_TIES, OUTSIDE, Ties, joined_ties, pulls_along
from mbla.model.transform import AffineMap, repetitions
from mbla.model.wording import counted, named, vector

FARTHEST = 1e6
"""distance of a point from the origin, over that of the farthest block, that is no point of a building"""
CLOSES = 1e-9
"""distance of the last point from the first, over the length of a line, at which it is closed"""
BESIDE = 0.1
"""how far beside the corner of a ring its blocks are looked for, over the size of the smallest"""
ALIKE = 1e-9
"""distance over the length of a strip that is none"""


@dataclass(frozen=True)
class Line:
    """One run of points with one force; ``bodies`` (m,), ``places`` and ``pulls`` (m, 3)."""

    bodies: IntArray
    places: FloatArray
    pulls: FloatArray
    closed: bool = False


def build_ties(sections: Sequence[TieSection], selection: BlockSelection, fixed: BoolArray, tolerance: float) -> Ties:
    """The ties of a deck; faults go to the selection.

    fixed     : (n_blocks,) blocks that do not move
    tolerance : of contacts, relative to block size
    """
    parts, counts = list[Ties](), dict[str, int]()
    if _refused_for_number(sections, selection):
        return NO_TIES
    for number, section in enumerate(sections):
        path: KeyPath = ("ties", number)
        lines = list(build_lines(section, path, selection, tolerance))
        if section.prestress is not None and section.prestress > capacity_of(section):
            words = f"must be <= {capacity_of(section):.6g}, the capacity of the tie"
            selection.refuse(Finding("out-of-bounds", words, *path, "prestress"))
        idle = sum(not can_move(line.bodies, fixed) for line in lines)
        if idle and not selection.faults:
            hold = "holds" if idle == 1 else "hold"
            words = f"{idle} of {counted(len(lines), 'tie')} {hold} nothing: no two blocks that can move apart"
            selection.refuse(Finding("tie-without-effect", words, *path))
        parts.append(_ties(section, lines, counts))
    return joined_ties(parts)


def _refused_for_number(sections: Sequence[TieSection], selection: BlockSelection) -> bool:
    """Whether ties lay out more lines than can be handled, each or together, before any of them is made."""
    most, counts = MOST_TIES, [lines_of(section) for section in sections]
    words = f"ties; at most {most:,} can be handled: check repeat, and the unit of what moves copies"
    too_many = [number for number, count in enumerate(counts) if count > most]
    for number in too_many:
        key = ("repeat",) if copies_of(sections[number].repeat) > 1 else ()
        about = f"lays out {min(counts[number], 10**300):.0e} {words}"
        selection.refuse(Finding("too-many-ties", about, "ties", number, *key))
    if not too_many and sum(counts) > most:
        selection.refuse(Finding("too-many-ties", f"lay out {sum(counts):.0e} {words}", "ties"))
    return sum(counts) > most


def can_move(bodies: IntArray, fixed: BoolArray) -> bool:
    """Whether points of a tie are on blocks, at least two or one and the ground, of which one moves."""
    still = np.append(fixed, True)[bodies]  # OUTSIDE takes the last entry
    return bool((~still).any()) and len(np.unique(np.where(still, OUTSIDE, bodies))) > 1


def _ties(section: TieSection, lines: Sequence[Line], counts: dict[str, int]) -> Ties:
    """Lines with the forces that a section allows."""
    form = {"compression": "strut", "both": "bar"}.get(section.acts, _form(section))
    n, capacity = len(lines), capacity_of(section)
    return replace(
        ties_of(form, section.name or form, lines, counts),
        least=np.full(n, 0.0 if section.acts == "tension" else -capacity),
        greatest=np.full(n, 0.0 if section.acts == "compression" else capacity),
        prestress=np.full(n, section.prestress or 0.0),
        breaks_at=np.full(n, _breaks_at(section)),
    )


def _breaks_at(section: TieSection) -> float:
    """Elongation over length at which ties break, inf: never; what is glued is brittle unless the deck says so."""
    if section.breaks_at is None:
        return 0.0 if section.strip is not None else math.inf
    return math.inf if section.breaks_at == "never" else section.breaks_at


def ties_of(form: str, name: str, lines: Sequence[Line], counts: dict[str, int]) -> Ties:
    """Lines as ties that may have any tension; names count on where several sections have the same, in ``counts``."""
    if not lines:
        return NO_TIES
    first, n = counts.get(name, 0), len(lines)
    counts[name] = first + n
    return Ties(
        names=tuple(f"{name}[{first + row}]" for row in range(n)),
        forms=(form,) * n,
        closed=np.array([line.closed for line in lines], dtype=np.int64),
        start=starts(np.array([len(line.bodies) for line in lines])),
        bodies=np.concatenate([line.bodies for line in lines]),
        places=np.concatenate([line.places for line in lines]),
        pulls=np.concatenate([line.pulls for line in lines]),
        least=np.zeros(n),
        greatest=np.full(n, math.inf),
        prestress=np.zeros(n),
        breaks_at=np.full(n, math.inf),
    )


def _form(section: TieSection) -> str:
    return {"through": "tie"}.get(given(section, FORMS)[0], given(section, FORMS)[0])


def capacity_of(section: TieSection) -> float:
    """Greatest force of a tie: what is given, or the least of its bar, its anchors and the wall behind its plates."""
    if section.capacity is not None:
        return section.capacity
    area = section.area
    if section.diameter is not None:
        area = math.pi / 4.0 * section.diameter**2
    limits = [] if area is None or section.strength is None else [area * section.strength]
    limits += [] if section.anchorage is None else [section.anchorage]
    limits += [] if section.plate is None else plate_capacities(section.plate)
    return min(limits)


def plate_capacities(plate: Plate) -> list[float]:
    """What a wall of thickness t bears of a round plate of diameter D: π t (t + D) f, by punching and by its cone."""
    surface = math.pi * plate.wall * (plate.wall + plate.diameter)
    return [surface * strength for strength in (plate.shear_strength, plate.tensile_strength) if strength is not None]


def build_lines(section: TieSection, path: KeyPath, selection: BlockSelection, tolerance: float) -> Iterator[Line]:
    """The lines of a section and of its copies; faults go to the selection."""
    for copy in repetitions(section.repeat):
        yield from _lines(section, copy, path, selection, tolerance)


def _lines(
    section: TieSection, copy: AffineMap, path: KeyPath, selection: BlockSelection, tolerance: float
) -> Iterator[Line]:
    """The lines of one copy of a tie."""
    if section.ring is not None:
        if not (np.array_equal(copy.matrix, np.eye(3)) and not copy.offset[:2].any()):
            words = "copies of a ring may be moved along z only: it goes round its blocks wherever they are"
            selection.refuse(Finding("tie-misfit", words, *path, "repeat"))
            return
        for number, z in enumerate(section.ring.z):
            yield from _ring(section, z, copy, (*path, "ring"), number, selection, tolerance)
        return
    points = section.through or section.strip
    assert points is not None  # a rule of the deck: one of the forms
    places = copy.points(np.array(points))
    key = "through" if section.through else "strip"
    far = np.abs(places).max(axis=1) > FARTHEST * np.abs(selection.blocks.vertices).max(initial=1e-300)
    if far.any() and len(selection.blocks):
        words = f"lies more than {FARTHEST:g} times as far away as the blocks"
        selection.refuse(Finding("coordinate-out-of-range", words, *path, key, int(np.argmax(far))))
        return
    lengths = np.linalg.norm(np.diff(places, axis=0), axis=1)
    if not (lengths > ALIKE * lengths.sum()).all():
        row = int(np.flatnonzero(lengths <= ALIKE * lengths.sum())[0]) + 1
        selection.refuse(Finding("degenerate-line", "must not be the point before it", *path, key, row))
    elif section.strip is not None:
        yield from _strip(places, (*path, key), selection, tolerance)
    else:
        yield from _through(section, places, path, selection, tolerance)


def _through(
    section: TieSection, places: FloatArray, path: KeyPath, selection: BlockSelection, tolerance: float
) -> Iterator[Line]:
    """A line through points: one force, or one in each stretch."""
    closed = bool(np.linalg.norm(places[-1] - places[0]) <= CLOSES * np.ptp(places, axis=0).max()) and len(places) > 3
    if closed:
        places = places[:-1]
    found = [_block_at(section, number, places, path, selection, tolerance) for number in range(len(places))]
    bodies = np.array([body for body in found if body is not None], dtype=np.int64)
    if len(bodies) < len(places):
        return
    if section.points == "passes":
        yield Line(bodies, places, pulls_along(places, closed=closed), closed)
        return
    for first in range(len(places) - (0 if closed else 1)):
        pair = np.array([first, (first + 1) % len(places)])
        yield Line(bodies[pair], places[pair], pulls_along(places[pair], closed=False))


def _block_at(
    section: TieSection, number: int, places: FloatArray, path: KeyPath, selection: BlockSelection, tolerance: float
) -> int | None:
    """The block that a point of a line is fixed to, OUTSIDE for ground; None with a fault."""
    anchor = None if section.on is None else section.on[number]
    if anchor == GROUND:
        return OUTSIDE
    blocks = selection.blocks
    chosen: IntArray | None = np.arange(len(blocks))
    if anchor is not None:
        chosen = select_blocks(anchor, (*path, "on", number), selection)
    if chosen is None or (selection.partial and anchor is None):
        return None
    found = touched_blocks(places[number], blocks, chosen, tolerance)
    if len(found) > 1 and anchor is None:
        selection.refuse(_on_joint(f"the point {vector(places[number])}", found, blocks, *path, "through", number))
        return None
    if len(found):
        return int(found[0])
    where = f"no block lies at {vector(places[number])}"
    if anchor is not None:
        where = f"none of these blocks lies at {vector(places[number])}, the point that it is for"
    key = ("through", number) if anchor is None else ("on", number)
    selection.refuse(Finding("tie-off-blocks", f"{where}: move the point, or write ground in `on`", *path, *key))
    return None


def _ring(
    section: TieSection,
    z: float,
    copy: AffineMap,
    path: KeyPath,
    number: int,
    selection: BlockSelection,
    tolerance: float,
) -> Iterator[Line]:
    """A closed line along the convex outline of the plan of some blocks at a height."""
    from scipy.spatial import ConvexHull, QhullError

    assert section.ring is not None  # who calls knows
    chosen = select_blocks(section.ring.around, (*path, "around"), selection)
    if chosen is None:
        return
    height = float(copy.points(np.array([0.0, 0.0, z]))[2])
    plan = _plan(selection.blocks, chosen, height)
    try:
        outline = plan[ConvexHull(plan).vertices]
    except (QhullError, ValueError):
        words = "these blocks have no plan at that height that a ring could go round"
        selection.refuse(Finding("tie-off-blocks", words, *path, "z", number))
        return
    places = _corners_of(np.column_stack([outline, np.full(len(outline), height)]))
    owners = list[IntArray]()
    for before, place, after in zip(np.roll(places, 1, axis=0), places, np.roll(places, -1, axis=0), strict=True):
        found = touched_blocks(place, selection.blocks, chosen, tolerance)
        held = _held_at_corner(before, place, after, selection.blocks, found, tolerance)
        if held is None:
            selection.refuse(_on_joint(f"its corner {vector(place)}", found, selection.blocks, *path, "z", number))
            return
        owners.append(held)
    places = np.repeat(places, [len(held) for held in owners], axis=0)
    yield Line(np.concatenate(owners), places, pulls_along(places, closed=True), closed=True)


def _on_joint(what: str, found: IntArray, blocks: Blocks, *key: str | int) -> Finding:
    """A point of a tie that is on several blocks."""
    words = f"{what} lies on the joint between {named(found, blocks.name)}: move it"
    return Finding("tie-on-joint", words + (", or choose one of them in `on`" if "through" in key else ""), *key)


def _held_at_corner(
    before: FloatArray, place: FloatArray, after: FloatArray, blocks: Blocks, found: IntArray, tolerance: float
) -> IntArray | None:
    """Which of the blocks at a corner of a ring it presses on: one, or the two between which the corner is.

    None where these blocks lie above each other: which of them the ring holds is undetermined.
    """
    if len(found) < 2:
        return found
    near = BESIDE * float(blocks.sizes[found].min())
    held = list[int]()
    for other in (before, after):
        step = other - place
        beside = place + min(0.5, near / float(np.linalg.norm(step))) * step
        there = touched_blocks(beside, blocks, found, tolerance)
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
    faces = items_of_rows(blocks.face_start, chosen)
    counts = np.diff(blocks.loop_start)[faces]
    corners = items_of_rows(blocks.loop_start, faces)
    ahead = corners + 1
    last = np.cumsum(counts) - 1
    ahead[last] = blocks.loop_start[faces]
    one, other = (blocks.vertices[blocks.loops[rows]] for rows in (corners, ahead))
    low, high = np.minimum(one[:, 2], other[:, 2]), np.maximum(one[:, 2], other[:, 2])
    crossing = (low <= z) & (z <= high)
    one, other = one[crossing], other[crossing]
    rise = other[:, 2] - one[:, 2]
    share = np.divide(z - one[:, 2], rise, out=np.zeros(len(rise)), where=rise != 0.0)
    return np.asarray((one + share[:, None] * (other - one))[:, :2])


def _strip(places: FloatArray, path: KeyPath, selection: BlockSelection, tolerance: float) -> Iterator[Line]:
    """A force along the strip at each place where it crosses from one block to the next."""
    if selection.partial:
        return
    blocks, everything = selection.blocks, np.arange(len(selection.blocks))
    crossings, last, came = 0, OUTSIDE, np.zeros(3)
    for number, (begin, end) in enumerate(pairwise(places)):
        along = unit(end - begin)
        cuts = cuts_of(begin, end, blocks)
        for first, then in pairwise(cuts.tolist()):
            middle = begin + 0.5 * (first + then) * (end - begin)
            under = touched_blocks(middle, blocks, everything, tolerance)
            wrong = None
            if len(under) > 1:
                wrong = _on_joint(f"its part about {vector(middle)}", under, blocks, *path, number)
            elif len(under) and is_within(middle, blocks, int(under[0]), tolerance):
                words = f"its part about {vector(middle)} is inside of {blocks.name(int(under[0]))}: a strip is glued"
                wrong = Finding("tie-misfit", f"{words} to faces; give points on them", *path, number)
            if wrong is not None:
                selection.refuse(wrong)
                return
            block = int(under[0]) if len(under) else OUTSIDE
            if OUTSIDE not in (block, last) and block != last:
                place, way = begin + first * (end - begin), came + along
                way = unit(way) if np.linalg.norm(way) > BESIDE else along
                yield Line(np.array([last, block]), np.stack([place, place]), np.stack([way, -way]))
                crossings += 1
            last, came = block, along
    if not crossings:
        selection.refuse(Finding("tie-off-blocks", "it crosses no joint between blocks that it lies on", *path))


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
