"""Objective of a load case: least and greatest value of a force through a cut, posed as load factors.

The forces x in the joints that carry given loads f within the yield conditions form a convex set, A x + f = 0, x in K.
The force through a cut along a direction d is linear in them, F = Σ s d·x with s = 1 on the interfaces where the force
on the chosen side is that on body b, -1 where it is that on body a, and its values fill an interval (static theorem).
Nothing is said about how the structure moves, so that every state of a structure without dilatancy lies in it too.

Its ends are load factors. Of a load cell that measures F along d it is the reaction, and its support gives way
(:mod:`mbla.assembly.load_cell`, :mod:`mbla.model.settlement`)::

    F = R0 − λ U        greatest λ: least F;        with −d in the place of d: greatest F

The dual mechanism opens the cut by a velocity along d and closes no joint. By virtual work it bounds F from the other
side, without any state of forces: what an engineer draws as a three-hinge arch with the thrust line at its highest or
lowest (Heyman 1966, doi:10.1016/0020-7683(66)90018-7).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.sections.load_cases import LoadCaseSection
from mbla.deck.sections.objective import ForceSection, ObjectiveSection
from mbla.deck.suggestions import listed
from mbla.errors import Finding, KeyPath
from mbla.model.applied_load import without_forces
from mbla.model.loads.load_kind import LoadSite
from mbla.model.model import LoadCase
from mbla.model.selectors import select_blocks
from mbla.model.settlement import size_of_loads
from mbla.model.solids.plane import unit
from mbla.model.supports.guides import Guides, held_along
from mbla.model.ties.ties import OUTSIDE, Ties
from mbla.model.wording import counted, named, vector
from mbla.questions.force import Force, Objective
from mbla.questions.reaction import Settlement

ENDS = {"least": 1.0, "greatest": -1.0}
"""Ends of the interval, and the sense in which each is the least value."""


def build_objective(
    section: LoadCaseSection, path: KeyPath, load_case: LoadCase, site: LoadSite, guides: Guides, ties: Ties
) -> list[LoadCase]:
    """A load case for each end, its loads at the given load factor among the dead loads.

    Refuses blocks on both sides, sides without blocks that move, forces of supports where a guide takes part of them,
    ties that there are not, and a structure without loads.
    """
    assert section.objective is not None  # that is why it is built
    found = _sought(section.objective, (*path, "objective"), site, guides, ties)
    if found is None:
        return []
    at, free = section.at or 0.0, ~site.fixed
    dead = load_case.dead_load + at * load_case.live_load
    weight = size_of_loads(dead, site.blocks, free)
    if not np.isfinite(weight):
        return []  # refused as loads beyond computing
    if not weight > 0.0:
        if free.any() and not site.selection.partial:
            words = "no load acts on blocks that can move, or all of them cancel: no force is determined"
            site.refuse(Finding("objective-without-effect", words, *path))
        return []
    cases, none = [], np.zeros(0, dtype=np.int64)
    for end, sense in ENDS.items():
        objective = Objective(load_case.name, end, at, found.sides, found.ties, found.direction)
        settlement = Settlement(none, np.zeros((0, 6)), False, found.words, np.nan, weight, sense)
        case = replace(
            load_case,
            name=f"{load_case.name}@{end}",
            dead_load=dead,
            live_load=np.zeros_like(dead),
            dead=(*load_case.dead, *(load.times(at) for load in load_case.live)),
            live=(without_forces(f"{end} {found.words}"),),
            question=Force(settlement, objective),
        )
        cases.append(case)
    return cases


@dataclass(frozen=True)
class _Sought:
    """Sides of a cut by body, or ties; the direction in which a load cell measures them; the force in words."""

    sides: IntArray
    ties: IntArray
    direction: FloatArray
    words: str


def _sought(section: ObjectiveSection, path: KeyPath, site: LoadSite, guides: Guides, ties: Ties) -> _Sought | None:
    """What an objective asks for; None where a fault was left."""
    none = np.zeros(0, dtype=np.int64)
    if section.force is not None:
        found = _sides(section.force, (*path, "force"), site, guides, ties)
        if found is None:
            return None
        sides, words = found
        words = f"{words} along {vector(section.force.direction)}"
        return _Sought(sides, none, unit(np.array(section.force.direction)), words)
    own = [row for row, name in enumerate(ties.names) if name.rpartition("[")[0] == section.tie]
    if section.index is not None:
        own = own[section.index : section.index + 1]
    if not own:
        if not site.selection.partial and not site.selection.faults:
            known = listed(list(dict.fromkeys(ties.names)), "and") if len(ties) else "none"
            words = f"there is no such tie; there are {known}"
            site.refuse(Finding("unknown-name", words, *path, "tie" if section.index is None else "index"))
        return None
    rows, everything = np.array(own), np.zeros(len(site.blocks) + len(site.grounds), dtype=np.int64)
    pulls = ties.pulls[np.isin(ties.tie_of_point, rows)]
    largest = pulls[int(np.linalg.norm(pulls, axis=1).argmax())]
    words = f"force of {listed([ties.names[row] for row in own], 'and')}, tension positive"
    return _Sought(everything, rows, unit(largest), words)


def _sides(
    asked: ForceSection, path: KeyPath, site: LoadSite, guides: Guides, ties: Ties
) -> tuple[IntArray, str] | None:
    """Sides of the cut by body, and the force in words; None where a fault was left."""
    blocks, n_blocks = site.blocks, len(site.blocks)
    chosen: dict[str, BoolArray] = {}
    for key, selector in (("from", asked.from_), ("on", asked.on)):
        if selector is None:
            continue
        members = select_blocks(selector, (*path, key), site.selection)
        if members is None:
            return None
        chosen[key] = np.isin(np.arange(n_blocks), members)
    source, target = chosen.get("from"), chosen.get("on")
    if source is not None and target is not None and (both := np.flatnonzero(source & target)).size:
        words = f"{named(both, blocks.name)} cannot be on both sides of a force"
        site.refuse(Finding("objective-not-possible", words, *path, "on"))
        return None
    text = "force"
    text += " of the supports" if source is None else f" of {_words(source)}"
    text += " on all other blocks" if target is None else f" on {_words(target)}"
    of_supports = source is None
    source = site.fixed if source is None else source
    target = ~source if target is None else target
    if site.fixed[target].all():
        words = f"no block that {'these act' if asked.on is None else 'it acts'} on can move: the force is no unknown"
        site.refuse(Finding("objective-not-possible", words, *path, "from" if asked.on is None else "on"))
        return None
    held = np.intersect1d(held_along(guides, unit(np.array(asked.direction))), np.flatnonzero(target))
    if of_supports and len(held):
        words = f"a guide holds {named(held, blocks.name)} that way, and its force is none of a joint"
        words = f"{words}: ask for the force `from` what it holds, or on other blocks"
        site.refuse(Finding("objective-not-possible", words, *path, "direction"))
        return None
    sides, outside = np.where(target, 1, np.where(source, -1, 0)), -1 if of_supports else 0
    text += _apart(ties, np.append(sides, outside))
    return np.append(sides, np.full(len(site.grounds), outside)).astype(np.int64), text


def _apart(ties: Ties, sides: IntArray) -> str:
    """In words how many ties cross the cut, whose forces do not count; the last side is that of what is outside."""
    assert OUTSIDE == -1  # the last one
    least, greatest = (each.reduceat(sides[ties.bodies], ties.start[:-1]) for each in (np.minimum, np.maximum))
    count = int((least * greatest < 0).sum())
    return f" (without {counted(count, 'tie')})" if count else ""


def _words(chosen: BoolArray) -> str:
    return counted(int(chosen.sum()), "block")
