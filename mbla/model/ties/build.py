"""The ties of a deck: their lines, and what these carry."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray, starts
from mbla.deck.section import given
from mbla.deck.sections.ties import FORMS, Plate, TieSection
from mbla.errors import Finding, KeyPath
from mbla.model.selectors import BlockSelection
from mbla.model.ties.lines import TieLine, TieSite, build_lines
from mbla.model.ties.ties import NO_TIES, Ties, joined_ties
from mbla.model.transform import copies_of
from mbla.model.wording import counted

MOST_TIES = 200_000
"""lines of ties that all ties together may lay out: as much memory as many blocks take"""


def build_ties(sections: Sequence[TieSection], selection: BlockSelection, fixed: BoolArray, tolerance: float) -> Ties:
    """The ties of a deck; faults go to the selection.

    fixed     : (n_blocks,) blocks that do not move
    tolerance : of contacts, relative to block size
    """
    parts, counts, site = list[Ties](), dict[str, int](), TieSite(selection, fixed, tolerance)
    if _refused_for_number(sections, site):
        return NO_TIES
    for number, section in enumerate(sections):
        path: KeyPath = ("ties", number)
        lines, capacity = list(build_lines(section, path, site)), capacity_of(section)
        if section.prestress is not None and section.prestress > capacity:
            site.refuse(
                Finding("out-of-bounds", f"must be <= {capacity:.6g}, the capacity of the tie", *path, "prestress")
            )
        idle = sum(not site.can_move(line.bodies) for line in lines)
        if idle and not selection.faults:
            hold = "holds" if idle == 1 else "hold"
            words = f"{idle} of {counted(len(lines), 'tie')} {hold} nothing: no two blocks that can move apart"
            site.refuse(Finding("tie-without-effect", words, *path))
        parts.append(_ties(section, lines, capacity, counts))
    return joined_ties(parts)


def _refused_for_number(sections: Sequence[TieSection], site: TieSite) -> bool:
    """Whether ties lay out more lines than can be handled, each or together, before any of them is made."""
    most, counts = MOST_TIES, [lines_of(section) for section in sections]
    words = f"ties; at most {most:,} can be handled: check repeat, and the unit of what moves copies"
    too_many = [number for number, count in enumerate(counts) if count > most]
    for number in too_many:
        key = ("repeat",) if copies_of(sections[number].repeat) > 1 else ()
        about = f"lays out {min(counts[number], 10**300):.0e} {words}"
        site.refuse(Finding("too-many-ties", about, "ties", number, *key))
    if not too_many and sum(counts) > most:
        site.refuse(Finding("too-many-ties", f"lay out {sum(counts):.0e} {words}", "ties"))
    return sum(counts) > most


def lines_of(tie: TieSection) -> int:
    """How many lines a tie and its copies lay out; a strip, which has one at each joint, at least one a stretch."""
    points = tie.through or tie.strip or []
    own = len(tie.ring.z) if tie.ring else 1 if tie.through and tie.points == "passes" else len(points)
    return copies_of(tie.repeat) * own


def _ties(section: TieSection, lines: Sequence[TieLine], capacity: float, counts: dict[str, int]) -> Ties:
    """Lines with the forces that a section allows."""
    laid_out_by = given(section, FORMS)[0]
    form = {"compression": "strut", "both": "bar"}.get(section.acts, "tie" if section.through else laid_out_by)
    n = len(lines)
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


def ties_of(form: str, name: str, lines: Sequence[TieLine], counts: dict[str, int]) -> Ties:
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


def capacity_of(section: TieSection) -> float:
    """Greatest force of a tie: what is given, or the least of its bar, its anchors and the wall behind its plates."""
    if section.capacity is not None:
        return section.capacity
    area = section.area if section.diameter is None else math.pi / 4.0 * section.diameter**2
    limits = [] if area is None or section.strength is None else [area * section.strength]
    limits += [] if section.anchorage is None else [section.anchorage]
    limits += [] if section.plate is None else plate_capacities(section.plate)
    return min(limits)


def plate_capacities(plate: Plate) -> list[float]:
    """What a wall of thickness t bears of a round plate of diameter D: π t (t + D) f, by punching and by its cone."""
    surface = math.pi * plate.wall * (plate.wall + plate.diameter)
    return [surface * strength for strength in (plate.shear_strength, plate.tensile_strength) if strength is not None]
