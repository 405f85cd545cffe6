"""Two results side by side: decks, settings, models and load cases."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from difflib import unified_diff
from typing import TypeVar

import numpy as np

from mbla.errors import Notice
from mbla.results.diff.cases import CaseComparison, Figure, compare_cases, figure
from mbla.results.diff.matching import SAME_PLACE, Factors, Matching, factors_between, match_models
from mbla.results.outcome import notices_of
from mbla.results.results import Results

T = TypeVar("T")

SAME_TOTAL = 1e-9
"""Relative difference of weights, volumes and strengths that is rounding of units."""


@dataclass(frozen=True)
class ModelComparison:
    """Totals in the units of A, and the blocks that are not the same in both.

    by      : how blocks were matched: ``name`` or ``place``
    shares  : of the volume of A and of B that is matched
    moved   : names in A of blocks whose centroid lies elsewhere in B by more than 1e-3 of their size
    changed : names in A of blocks with another volume or mass
    only    : names of blocks without match in A and in B
    joints  : joint laws that differ, in words
    """

    totals: tuple[Figure, ...]
    units: tuple[str, str]
    by: str
    shares: tuple[float, float]
    comparable: bool
    moved: tuple[str, ...]
    changed: tuple[str, ...]
    only: tuple[tuple[str, ...], tuple[str, ...]]
    supports: tuple[str, ...]
    joints: tuple[str, ...]


@dataclass(frozen=True)
class Comparison:
    """What differs between results A and B.

    deck       : lines of a unified diff of the deck texts
    overrides  : changes by the user, in A and in B
    settings, provenance : name, value in A and in B where they differ; ``-`` where there is none
    only       : names of load cases of A alone and of B alone
    gone, new  : warnings of A alone and of B alone
    """

    names: tuple[str, str]
    created: tuple[str, str]
    deck: tuple[str, ...]
    overrides: tuple[tuple[str, ...], tuple[str, ...]]
    settings: tuple[tuple[str, str, str], ...]
    provenance: tuple[tuple[str, str, str], ...]
    model: ModelComparison
    cases: tuple[CaseComparison, ...]
    only: tuple[tuple[str, ...], tuple[str, ...]]
    gone: tuple[Notice, ...]
    new: tuple[Notice, ...]

    @property
    def differing(self) -> int:
        """Load cases whose status or answer differs, or that are in one result only."""
        return sum(case.differs for case in self.cases) + len(self.only[0]) + len(self.only[1])


def compare_results(first: Results, second: Results, tolerance: float | None = None) -> Comparison:
    """Everything that differs; figures of B are brought into the units of A.

    tolerance : relative, of answers; None for what the two results are good to (see ``compare_cases``)
    """
    factors = factors_between(first.model.units, second.model.units)
    matching = match_models(first.model, second.model, factors)
    others = {case.load_case.name: case for case in second.cases}
    names = [case.load_case.name for case in first.cases]
    gone, new = _warnings(first, second)
    return Comparison(
        names=(first.deck.name, second.deck.name),
        created=(first.created, second.created),
        deck=tuple(_deck_lines(first, second)),
        overrides=(first.deck.overrides, second.deck.overrides),
        settings=_differing(first.settings, second.settings),
        provenance=_differing(first.provenance, second.provenance),
        model=_models(first, second, factors, matching),
        cases=tuple(
            compare_cases(first, case, second, others[case.load_case.name], matching, factors, tolerance)
            for case in first.cases
            if case.load_case.name in others
        ),
        only=(
            tuple(name for name in names if name not in others),
            tuple(name for name in others if name not in names),
        ),
        gone=gone,
        new=new,
    )


def _deck_lines(first: Results, second: Results) -> list[str]:
    """Unified diff of the deck texts, the decks themselves first, then what they include by its name."""
    a, b = dict(first.deck.sources[1:]), dict(second.deck.sources[1:])
    pairs = [(first.deck.sources[:1], second.deck.sources[:1])]
    pairs += [
        (((name, a[name]),) if name in a else (), ((name, b[name]),) if name in b else ())
        for name in dict.fromkeys([*a, *b])
    ]
    lines: list[str] = []
    for old, new in pairs:
        (old_name, old_text), (new_name, new_text) = old[0] if old else ("-", ""), new[0] if new else ("-", "")
        lines += unified_diff(
            old_text.splitlines(), new_text.splitlines(), f"A {old_name}", f"B {new_name}", n=1, lineterm=""
        )
    return lines


def _differing(first: dict[str, str], second: dict[str, str]) -> tuple[tuple[str, str, str], ...]:
    names = dict.fromkeys([*first, *second])
    rows = ((name, first.get(name, "-"), second.get(name, "-")) for name in names)
    return tuple(row for row in rows if row[1] != row[2])


def _warnings(first: Results, second: Results) -> tuple[tuple[Notice, ...], tuple[Notice, ...]]:
    """Warnings that the other result has not: by identifier and load case, since messages hold figures and paths."""
    own, others = ([n for n in notices_of(results) if n.severity == "warning"] for results in (first, second))
    return _surplus(own, others), _surplus(others, own)


def _surplus(notices: list[Notice], others: list[Notice]) -> tuple[Notice, ...]:
    left = Counter((notice.identifier, notice.case) for notice in others)
    alike = {(notice.identifier, notice.case, notice.message) for notice in others}
    found = []
    for notice in sorted(notices, key=lambda n: (n.identifier, n.case, n.message) not in alike):
        key = (notice.identifier, notice.case)
        if left[key] > 0:
            left[key] -= 1
        else:
            found.append(notice)
    return tuple(found)


def _models(first: Results, second: Results, factors: Factors, matching: Matching) -> ModelComparison:
    a, b = first.model.blocks, second.model.blocks
    rows = matching.bodies[: len(a)]
    there = rows >= 0
    other = rows[there]
    volumes = np.abs(b.volumes[other] * factors.length**3 - a.volumes[there]) > SAME_PLACE * a.volumes[there]
    masses = np.abs(b.masses[other] * factors.mass - a.masses[there]) > SAME_PLACE * a.masses[there]
    held = first.model.fixed[there] != second.model.fixed[other]
    left = np.setdiff1d(np.arange(len(b)), other)
    matched = np.flatnonzero(there)
    return ModelComparison(
        totals=_totals(first, second, factors),
        units=(_units(first), _units(second)),
        by=matching.by,
        shares=matching.shares,
        comparable=matching.comparable,
        moved=tuple(a.name(int(block)) for block in np.flatnonzero(matching.moved > SAME_PLACE)),
        changed=tuple(a.name(int(block)) for block in matched[volumes | masses]),
        only=(
            tuple(a.name(int(block)) for block in np.flatnonzero(~there)),
            tuple(b.name(int(block)) for block in left),
        ),
        supports=tuple(a.name(int(block)) for block in matched[held]),
        joints=_joints(first, second, factors),
    )


def _units(results: Results) -> str:
    """``m, N, kg``."""
    units = results.model.units
    return f"{units.length}, {units.force}, {units.mass}"


def _totals(first: Results, second: Results, factors: Factors) -> tuple[Figure, ...]:
    """Counts and totals, in the units of A."""
    length, force = first.model.units.length, first.model.units.force

    def row(name: str, unit: str, values: tuple[float, float], factor: float = 1.0) -> Figure:
        return figure(name, unit, values[0], values[1] * factor, SAME_TOTAL)

    models, contacts = (first.model, second.model), (first.contacts, second.contacts)

    def both(of: tuple[T, T], what: Callable[[T], float]) -> tuple[float, float]:
        return float(what(of[0])), float(what(of[1]))

    return (
        row("blocks", "", both(models, lambda m: len(m.blocks))),
        row("free blocks", "", both(models, lambda m: len(m.free))),
        row("volume", f"{length}3", both(models, lambda m: m.blocks.volumes.sum()), factors.length**3),
        row("weight", force, both(models, lambda m: m.total_weight), factors.force),
        row("interfaces", "", both(contacts, len)),
        row("contact points", "", both(contacts, lambda c: len(c.points))),
        row("contact area", f"{length}2", both(contacts, lambda c: c.areas.sum()), factors.length**2),
    )


def _joints(first: Results, second: Results, factors: Factors) -> tuple[str, ...]:
    """Joint laws that one result has alone, or that differ."""
    a, b = first.model.joints, second.model.joints
    words = [
        f"{name}: in {'A' if name in a else 'B'} only" for name in dict.fromkeys([*a, *b]) if (name in a) != (name in b)
    ]
    scales = {
        "friction": 1.0,
        "cohesion": factors.stress,
        "tensile_strength": factors.stress,
        "compressive_strength": factors.stress,
        "dilatancy": 1.0,
    }
    for name in (name for name in a if name in b):
        for key, scale in scales.items():
            old, new = getattr(a[name], key), getattr(b[name], key) * scale
            if old != new and not abs(new - old) <= SAME_TOTAL * max(abs(old), abs(new)):
                words.append(f"{name}: {key.replace('_', ' ')} {old:.6g} in A, {new:.6g} in B")
    return tuple(words)
