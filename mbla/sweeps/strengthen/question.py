"""What ``mbla strengthen`` asks: the program of a deck, and with fewer candidates where a catalogue rounds up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly import build_assembly
from mbla.deck import Deck
from mbla.deck.sections.time_history import given_in_time
from mbla.errors import DeckError, UsageError
from mbla.model import Model, build_model
from mbla.model.build import structure_of
from mbla.model.ties.candidates import Candidates, build_candidates
from mbla.model.ties.ties import joined_ties
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.further.strengthening.cheapest import cheapest
from mbla.solution.further.strengthening.strengthening import Cheapest, Requirement, Strengthening
from mbla.solution.settings import solver_settings
from mbla.solution.solution import WITH_VALUE
from mbla.sweeps.strengthen.catalogue import greatest_there, rounded_up

SHORT = 1e-6
"""share of a required load factor that may be missing: its rounding"""
MOST_ROUNDS, LITTLE = 10, 0.3
"""programs with fewer candidates that are tried where a catalogue rounds up, and share of what is rounded up to below
which a candidate is left out"""


def refuse_unfit(deck: Deck) -> None:
    """UsageError where a deck asks for nothing, or for what has no such program."""
    content = deck.content
    if content.strengthen is None:
        raise UsageError("no-strengthening", f"{deck.path}: has no section strengthen, which says what may be added")
    if content.symmetry:
        raise UsageError("strengthen-not-possible", "a deck with symmetry: give the whole structure")
    for name in content.strengthen.required:
        case = content.load_cases[name]  # the deck was checked for that
        live = case.live or []
        if case.live is None or case.objective is not None or any(load.facts.live_only for load in live):
            others = "a load that travels or tilts, a settlement, an objective"
            words = f"load case {name}: {'motion in time' if given_in_time(case) else others} has no required factor"
            raise UsageError("strengthen-not-possible", words)


Posed: TypeAlias = tuple[Model, Candidates, Strengthening]
"""model of a deck, candidates, and the program of both"""


def question_of(deck: Deck, log: Log) -> Posed:
    """What a deck asks; raises DeckError with the faults of candidates."""
    section = deck.content.strengthen
    assert section is not None  # refused before
    assembly = build_assembly(deck, build_model(deck))
    model = assembly.model
    structure = structure_of(deck)
    tolerance = deck.contacts.tolerance
    candidates = build_candidates(section.candidates, structure.selection, model.fixed, model.grounds, tolerance)
    if structure.selection.faults:
        raise DeckError(structure.selection.faults)
    cases = {case.name: case for case in model.load_cases}
    return (
        model,
        candidates,
        Strengthening(
            assembly=replace(assembly, model=replace(model, ties=joined_ties([model.ties, candidates.ties]))),
            first=len(model.ties),
            costs=candidates.costs,
            most=greatest_there(candidates.most, section.catalogue),
            requirements=tuple(Requirement(cases[name], factor) for name, factor in required_of(deck).items()),
            settings=solver_settings(deck.analysis),
            log=log,
        ),
    )


def required_of(deck: Deck) -> dict[str, float]:
    """Load factors that are required, by load case; of a deck that asks for some."""
    assert deck.content.strengthen is not None
    return dict(deck.content.strengthen.required)


def with_fewer(question: Strengthening, found: Cheapest, catalogue: Sequence[float] | None) -> FloatArray:
    """Capacities, (k,), that cost less once they are rounded up: of candidates without those that are hardly used."""
    best = found.capacities
    if catalogue is None:
        return best
    rows = np.flatnonzero(best)
    for _ in range(MOST_ROUNDS):
        rounded = rounded_up(best, catalogue, question.most)
        kept = rows[best[rows] >= LITTLE * rounded[rows]]
        if len(kept) == len(rows):
            kept = np.delete(rows, np.argmin(best[rows] / rounded[rows]))
        if not len(kept):
            break
        fewer = cheapest(question.take(kept))
        capacities = np.zeros_like(best)
        capacities[kept] = fewer.capacities
        cost = float(rounded_up(capacities, catalogue, question.most) @ question.costs)
        if fewer.status not in WITH_VALUE or cost >= float(rounded @ question.costs):
            break
        best, rows = capacities, np.flatnonzero(capacities)
    return best
