"""Two results side by side: decks, settings, models and load cases; ``mbla diff --json`` prints its fields."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from difflib import unified_diff
from typing import Any

import numpy as np

from mbla.deck.units import Units
from mbla.errors import Notice
from mbla.model.solids.blocks import Blocks
from mbla.results.collapse.ties import tie_rows
from mbla.results.diff.cases import CaseComparison, Figure, compare_cases, figure
from mbla.results.diff.matching import SAME_PLACE, Factors, Matching, factors_between, match_models
from mbla.results.outcome import notices_of
from mbla.results.record.json_record import contacts_json, model_json, notice_json
from mbla.results.record.json_values import as_json
from mbla.results.record.keys import RECORD
from mbla.results.record.quantity import STORED_BY_PATH, UnitKind, unit_text
from mbla.results.record.scene import scene_of
from mbla.results.results import Results

SAME_TOTAL = 1e-9
"""Relative difference of weights, volumes and strengths that is rounding of units."""
TOTALS = ("blocks", "free_blocks", "total_volume", "total_weight", "interfaces", "contact_points", "contact_area")
"""counts and totals of the record that are compared"""
LAW = ("friction", "cohesion", "tensile_strength", "compressive_strength", "dilatancy")


@dataclass(frozen=True)
class ModelComparison:
    """Totals in the units of A, and the blocks that are not the same in both.

    matched_by     : how blocks were matched: ``name`` or ``place``
    matched_shares : of the volume of A and of B that is matched
    moved          : names in A of blocks whose centroid lies elsewhere in B by more than 1e-3 of their size
    changed        : names in A of blocks with another volume or mass
    only           : names of blocks without match in A and in B
    fixed_in_one   : names in A of blocks that one of the two fixes
    joints         : joint laws that differ, in words
    ties           : the same of ties
    """

    totals: tuple[Figure, ...]
    units: tuple[str, str]
    matched_by: str
    matched_shares: tuple[float, float]
    comparable: bool
    moved: tuple[str, ...]
    changed: tuple[str, ...]
    only: tuple[tuple[str, ...], tuple[str, ...]]
    fixed_in_one: tuple[str, ...]
    joints: tuple[str, ...]
    ties: tuple[str, ...]


@dataclass(frozen=True)
class Comparison:
    """What differs between results A and B; pairs are of A and of B.

    decks         : names
    deck_diff     : lines of a unified diff of the deck texts
    overrides     : changes by the user
    settings, provenance : values by name where they differ; ``-`` where there is none
    only          : names of load cases of A alone and of B alone
    warnings_gone, warnings_new : of A alone and of B alone
    """

    decks: tuple[str, str]
    created: tuple[str, str]
    deck_diff: tuple[str, ...]
    overrides: tuple[tuple[str, ...], tuple[str, ...]]
    settings: dict[str, tuple[str, str]]
    provenance: dict[str, tuple[str, str]]
    model: ModelComparison
    cases: tuple[CaseComparison, ...]
    only: tuple[tuple[str, ...], tuple[str, ...]]
    warnings_gone: tuple[Notice, ...]
    warnings_new: tuple[Notice, ...]

    @property
    def differing(self) -> int:
        """Load cases whose status or answer differs, or that are in one result only."""
        return sum(case.differs for case in self.cases) + len(self.only[0]) + len(self.only[1])


def comparison_json(comparison: Comparison, files: tuple[str, str]) -> dict[str, Any]:
    """Everything that was compared; ``files`` are the names of A and B."""
    record: dict[str, Any] = {"files": list(files), "differing": comparison.differing} | as_json(comparison)
    for case, compared in zip(record["cases"], comparison.cases, strict=True):
        case["differs"] = compared.differs
    for name in ("warnings_gone", "warnings_new"):
        record[name] = [notice_json(notice) for notice in getattr(comparison, name)]
    return record


def compare_results(first: Results, second: Results, tolerance: float | None = None) -> Comparison:
    """Everything that differs.

    tolerance : relative, of answers; None for the sum of what the two results are good to, at least 1e-6
    """
    factors = factors_between(first.model.units, second.model.units)
    matching = match_models(first.model, second.model, factors)
    own, others = ({case.load_case.name: case for case in results.cases} for results in (first, second))
    warnings = [[n for n in notices_of(results) if n.severity == "warning"] for results in (first, second)]
    pairs = [(scene_of(first, own[name]), scene_of(second, others[name])) for name in own if name in others]
    return Comparison(
        decks=(first.deck.name, second.deck.name),
        created=(first.created, second.created),
        deck_diff=tuple(_deck_lines(first, second)),
        overrides=(first.deck.overrides, second.deck.overrides),
        settings=_differing(first.settings, second.settings),
        provenance=_differing(first.provenance, second.provenance),
        model=_models(first, second, factors, matching),
        cases=tuple(compare_cases(*pair, matching, factors, tolerance) for pair in pairs),
        only=(tuple(name for name in own if name not in others), tuple(name for name in others if name not in own)),
        warnings_gone=_surplus(warnings[0], warnings[1]),
        warnings_new=_surplus(warnings[1], warnings[0]),
    )


def _deck_lines(first: Results, second: Results) -> list[str]:
    """Unified diff of the deck texts, the decks themselves first, then what they include by its name."""
    (main, *own), (other, *its) = first.deck.sources, second.deck.sources
    a, b = dict(own), dict(its)
    texts = [(*main, *other), *((name, a.get(name, ""), name, b.get(name, "")) for name in a | b)]
    return [
        line
        for name, text, new_name, new_text in texts
        for line in unified_diff(
            text.splitlines(), new_text.splitlines(), f"A {name}", f"B {new_name}", n=1, lineterm=""
        )
    ]


def _differing(first: dict[str, str], second: dict[str, str]) -> dict[str, tuple[str, str]]:
    pairs = {name: (first.get(name, "-"), second.get(name, "-")) for name in first | second}
    return {name: pair for name, pair in pairs.items() if pair[0] != pair[1]}


def _surplus(notices: list[Notice], others: list[Notice]) -> tuple[Notice, ...]:
    """Warnings that the other has not: by identifier and load case, since messages hold figures and paths."""
    left = Counter((notice.identifier, notice.case) for notice in others)
    found = []
    for notice in notices:
        key = (notice.identifier, notice.case)
        left[key] -= 1
        if left[key] < 0:
            found.append(notice)
    return tuple(found)


# --- Models ---------------------------------------------------------------------------------------------------------


def _models(first: Results, second: Results, factors: Factors, matching: Matching) -> ModelComparison:
    a, b = first.model.blocks, second.model.blocks
    rows = matching.bodies[: len(a)]
    there = np.flatnonzero(rows >= 0)
    other = rows[there]
    volumes = np.abs(b.volumes[other] * factors.length**3 - a.volumes[there]) > SAME_PLACE * a.volumes[there]
    masses = np.abs(b.masses[other] * factors.mass - a.masses[there]) > SAME_PLACE * a.masses[there]
    return ModelComparison(
        totals=_totals(first, second, factors),
        units=(_units(first.model.units), _units(second.model.units)),
        matched_by=matching.by,
        matched_shares=matching.shares,
        comparable=matching.comparable,
        moved=_names(a, np.flatnonzero(matching.moved > SAME_PLACE)),
        changed=_names(a, there[volumes | masses]),
        only=(_names(a, np.flatnonzero(rows < 0)), _names(b, np.setdiff1d(np.arange(len(b)), other))),
        fixed_in_one=_names(a, there[first.model.fixed[there] != second.model.fixed[other]]),
        joints=_joints(first, second, factors),
        ties=_ties(first, second, factors),
    )


def _names(blocks: Blocks, rows: Iterable[Any]) -> tuple[str, ...]:
    return tuple(blocks.name(int(row)) for row in rows)


def _units(units: Units) -> str:
    """``m, N, kg``."""
    return f"{units.length}, {units.force}, {units.mass}"


def _totals(first: Results, second: Results, factors: Factors) -> tuple[Figure, ...]:
    """Counts and totals, in the units of A."""
    a, b = (model_json(results.model) | contacts_json(results) for results in (first, second))
    kinds: dict[str, UnitKind] = {key.path: key.unit for key in RECORD}
    found = []
    for name in TOTALS:
        kind = kinds[f"model.{name}"]
        unit = None if kind == "1" else unit_text(kind, first.model.units)
        found.append(figure(name, unit, (a[name], b[name] * factors.of(kind)), SAME_TOTAL))
    return tuple(found)


def _joints(first: Results, second: Results, factors: Factors) -> tuple[str, ...]:
    """Joint laws that one result has alone, or that differ."""
    figures = [(key, key.replace("_", " "), factors.of(STORED_BY_PATH[f"model/{key}"].unit)) for key in LAW]
    return _other_figures(first.model.joints, second.model.joints, figures)


def _ties(first: Results, second: Results, factors: Factors) -> tuple[str, ...]:
    """Ties that one result has alone, or that have other forces or places."""
    a, b = ({row.name: row for row in tie_rows(results.model, None)} for results in (first, second))
    figures = [
        ("least", "least force", factors.force),
        ("greatest", "greatest force", factors.force),
        ("length", "length", factors.length),
    ]
    return _other_figures(a, b, figures)


def _other_figures(
    a: Mapping[str, Any], b: Mapping[str, Any], figures: Sequence[tuple[str, str, float]]
) -> tuple[str, ...]:
    """What one result has alone, or with other figures: of these field, name in words and unit of B in that of A."""
    words = [f"{name}: in {'A' if name in a else 'B'} only" for name in {**a, **b} if (name in a) != (name in b)]
    for name in (name for name in a if name in b):
        for key, what, factor in figures:
            old, new = getattr(a[name], key), getattr(b[name], key) * factor
            if old != new and not abs(new - old) <= SAME_TOTAL * max(abs(old), abs(new)):
                words.append(f"{name}: {what} {old:.6g} in A, {new:.6g} in B")
    return tuple(words)
