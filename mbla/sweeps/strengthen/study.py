"""``mbla strengthen``: the cheapest ties with which a structure carries what it has to, as a deck that is analysed.

The capacities of the program are rounded up to a catalogue where there is one, and candidates that it hardly uses are
left out as long as that makes the rest cheaper. Then the strengthened structure is
analysed by the deck's own flow rule, whose least load factors decide: while one falls short all capacities are raised
together, by the secant of the load factor that is shortest.
"""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from copy import deepcopy
from dataclasses import dataclass, replace
from functools import reduce
from importlib.util import find_spec
from io import StringIO
from operator import getitem
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.findings import contacts_of
from mbla.contacts.glue import held_model
from mbla.deck import Deck, read_deck
from mbla.deck.content import DeckContent
from mbla.deck.references import GROUND
from mbla.deck.text.writer import deck_text
from mbla.errors import DeckError, UsageError
from mbla.model import Model, build_model
from mbla.model.build import structure_of
from mbla.model.candidates import Candidates, build_candidates
from mbla.model.ties import OUTSIDE, Ties, joined_ties
from mbla.process.run_options import RunOptions
from mbla.results.files import OutputFolder
from mbla.results.outcome import least_and_greatest, result_of
from mbla.results.results import Results
from mbla.results.sta import StatusFile
from mbla.results.write import write_results
from mbla.run import run, solve_deck
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.settings import solver_settings
from mbla.solution.solution import WITH_VALUE
from mbla.solution.strengthening import Cheapest, Requirement, Strengthening, cheapest

SHORT = 1e-6
"""share of a required load factor that may be missing: its rounding"""
ACCURACY = 1e-4
"""share by which capacities are larger than the program says: its accuracy on large structures"""
MOST_ROUNDS, LITTLE = 10, 0.3
"""programs with fewer candidates that are tried where a catalogue rounds up, and share of what is rounded up to below
which a candidate is left out"""
MOST_RAISES, LEAST_RAISE, MOST_RAISE = 8, 2e-3, 1.0
"""analyses after the first one, and shares by which all capacities are raised at least and at most"""


@dataclass(frozen=True)
class Strengthened:
    """What was found.

    cheapest   : answer of the program
    capacities : (k,) N, as written in the deck: rounded, and raised as far as the analysis asked for it
    raised     : factor on the capacities of the program before they were rounded
    cost       : of these capacities
    factors    : by load case: required, and of the strengthened structure, nan without a result
    verified   : whether these are verified
    analyses   : of the strengthened structure
    files      : written
    """

    deck: Deck
    model: Model
    candidates: Candidates
    cheapest: Cheapest
    capacities: FloatArray
    raised: float
    cost: float
    factors: dict[str, tuple[float, float]]
    verified: bool
    analyses: int
    files: tuple[Path, ...]

    @property
    def suffices(self) -> bool:
        """Whether the strengthened structure carries what it has to."""
        return all(_carried(*each) for each in self.factors.values())

    @property
    def exit_code(self) -> int:
        """0: strengthened and verified; 4: not verified, or still short; 5: no capacities suffice."""
        if self.cheapest.status not in WITH_VALUE:
            return 5 if self.cheapest.status.value == "no_equilibrium" else 4
        return 0 if self.suffices and self.verified else 4


def _carried(required: float, factor: float) -> bool:
    return factor >= required - SHORT * max(abs(required), SHORT)


def strengthen(deck: Deck, options: RunOptions, log: Log) -> Strengthened:
    """Find the cheapest ties, analyse the structure with them, and write both.

    log : called once per iteration of the program

    Raises
    ------
    UsageError
        The deck asks for nothing, or for what no program of this kind answers.
    DeckError, FileError, LimitError, SolverError
        As a run does.
    """
    refuse_unfit(deck)
    section = deck.content.strengthen
    assert section is not None
    model = build_model(deck)
    contacts = contacts_of(deck, model)
    model = held_model(model, contacts)
    structure = structure_of(deck)
    candidates = build_candidates(section.candidates, structure.roster, model.fixed, deck.contacts.tolerance)
    if structure.roster.faults:
        raise DeckError(structure.roster.faults)
    cases = {case.name: case for case in model.load_cases}
    question = Strengthening(
        model=replace(model, ties=joined_ties([model.ties, candidates.ties])),
        contacts=contacts,
        first=len(model.ties),
        costs=candidates.costs,
        most=candidates.most,
        requirements=tuple(Requirement(cases[name], factor) for name, factor in section.required.items()),
        settings=solver_settings(deck.analysis),
        log=log,
    )
    found = cheapest(question, friction_held=deck.analysis.flow_rule != "associative")
    if found.status not in WITH_VALUE:
        none = np.zeros(len(candidates.costs))
        return Strengthened(deck, model, candidates, found, none, 1.0, math.nan, {}, False, 0, ())
    if section.catalogue is not None:
        found = with_fewer(question, found, section.catalogue)
    return _analysed(deck, model, candidates, found, options)


def with_fewer(question: Strengthening, found: Cheapest, catalogue: Sequence[float]) -> Cheapest:
    """Capacities that cost less once they are rounded up: of fewer candidates, without those that are hardly used.

    What candidates are worth and what all cost at least stays that of all of them.
    """
    best = found.capacities
    rows = np.flatnonzero(best)
    for _ in range(MOST_ROUNDS):
        rounded = rounded_up(best, catalogue)
        kept = rows[best[rows] >= LITTLE * rounded[rows]]
        if len(kept) == len(rows):
            kept = np.delete(rows, np.argmin(best[rows] / rounded[rows]))
        if not len(kept):
            break
        fewer = cheapest(question.take(kept), friction_held=False)
        capacities = np.zeros_like(best)
        capacities[kept] = fewer.capacities
        cost = float(rounded_up(capacities, catalogue) @ question.costs)
        if fewer.status not in WITH_VALUE or cost >= float(rounded @ question.costs):
            break
        best, rows = capacities, np.flatnonzero(capacities)
    return replace(found, capacities=best, cost=float(best @ question.costs))


def refuse_unfit(deck: Deck) -> None:
    """UsageError where a deck asks for nothing, or for what has no such program."""
    content = deck.content
    if content.strengthen is None:
        raise UsageError("no-strengthening", f"{deck.path}: has no section strengthen, which says what may be added")
    if content.symmetry:
        raise UsageError("strengthen-not-possible", "a deck with symmetry: give the whole structure")
    for name in content.strengthen.required:
        case = content.load_cases[name]  # the deck was checked for that
        special = case.settlement is not None or case.objective is not None
        if special or any(load.travel is not None or load.tilt is not None for load in case.live or []):
            words = f"load case {name}: a load that travels or tilts, a settlement, an objective has no required factor"
            raise UsageError("strengthen-not-possible", words)


def _analysed(deck: Deck, model: Model, candidates: Candidates, found: Cheapest, options: RunOptions) -> Strengthened:
    """The strengthened structure, its capacities raised until it carries what it has to."""
    section, raised, tried = deck.content.strengthen, 1.0, list[tuple[float, float]]()
    assert section is not None
    folder, stem = options.folder_for(deck.path), f"{deck.path.stem}_strengthened"
    for number in range(MOST_RAISES + 1):
        capacities = rounded_up(raised * found.capacities, section.catalogue)
        with TemporaryDirectory() as place:
            path = Path(place) / f"{stem}.yaml"
            path.write_text(strengthened_deck(deck, model, candidates.ties, capacities, path.parent), encoding="utf-8")
            asked = RunOptions(cases=tuple(section.required))
            results = solve_deck(read_deck(path), asked, StatusFile(StringIO(), ""), None, perf_counter())
        factors = {name: (required, _factor(results, name)) for name, required in section.required.items()}
        short = min((factor - required) / (abs(required) or 1.0) for required, factor in factors.values())
        if all(_carried(*each) for each in factors.values()) or math.isnan(short) or number == MOST_RAISES:
            break
        tried.append((raised, short))
        raised *= 1.0 + float(np.clip(_secant(tried), LEAST_RAISE, MOST_RAISE))
    verified = all(case.checks.verified for case in results.cases)
    cost = float(capacities @ candidates.costs)
    answer = Strengthened(deck, model, candidates, found, capacities, raised, cost, factors, verified, number + 1, ())
    return replace(answer, files=_files(answer, results, folder, stem, options))


def _secant(tried: Sequence[tuple[float, float]]) -> float:
    """Share by which to raise all capacities, from factors on them and what was short there, over what is required."""
    if len(tried) < 2 or tried[-1][1] <= tried[-2][1]:
        return -2.0 * tried[-1][1]
    (before, was), (now, short) = tried[-2:]
    return -short * (now - before) / (short - was) / now + LEAST_RAISE / 4.0


def _factor(results: Results, name: str) -> float:
    """The load factor to design with: of flow without normality the least that was found; nan without a result."""
    for case in results.cases:
        if case.load_case.name == name and result_of(case) is not None:
            least, _ = least_and_greatest(results.model.of_case(case.load_case), case)
            mechanics = result_of(case)
            assert mechanics is not None
            return mechanics.load_factor if math.isnan(least) else least
    return math.nan


def rounded_up(capacities: FloatArray, catalogue: Sequence[float] | None) -> FloatArray:
    """Capacities, (k,), as there are: the next in the catalogue, or as many of the greatest as it takes."""
    if catalogue is None:
        return capacities * (1.0 + ACCURACY)
    values = np.array(catalogue)
    row = np.minimum(np.searchsorted(values, capacities * (1.0 - SHORT)), len(values) - 1)
    several = np.ceil(capacities / values[-1] * (1.0 - SHORT))
    found = np.where(capacities > values[-1] * (1.0 + SHORT), several * values[-1], values[row])
    return np.where(capacities > 0.0, found, 0.0)


def strengthened_deck(deck: Deck, model: Model, ties: Ties, capacities: FloatArray, folder: Path) -> str:
    """Text of the deck with ties of given capacities, (k,) N; files that it names are named from a folder."""
    data: Any = deepcopy(deck.data)
    for side in deck.side_files:
        place = reduce(getitem, side.key[:-1], data)
        place[side.key[-1]] = os.path.relpath(deck.resolve_file(side.key, side.name), folder)
    added = [_tie(model, ties, row, float(capacities[row])) for row in np.flatnonzero(capacities).tolist()]
    content = data | {"ties": [*data.get("ties", []), *added], "title": f"{deck.title or deck.path.stem}, strengthened"}
    left_out = {"include", "strengthen", "expected"}
    kept = [key for key in DeckContent.model_fields if content.get(key) and key not in left_out]
    text = deck_text({key: content[key] for key in kept})
    return f"# {deck.path.name} with the ties that `mbla strengthen` found.\n{text}"


def _tie(model: Model, ties: Ties, row: int, capacity: float) -> dict[str, Any]:
    """A tie as the deck writes it."""
    points = range(int(ties.start[row]), int(ties.start[row + 1]))
    order = [*points, *([points[0]] if ties.closed[row] else [])]
    blocks = model.blocks
    on: list[Any] = [
        GROUND
        if ties.bodies[point] == OUTSIDE
        else {
            "group": blocks.groups[int(ties.bodies[point])],
            "index": int(blocks.group_indices[int(ties.bodies[point])]),
        }
        for point in order
    ]
    name = ties.names[row].replace("[", "_").rstrip("]")
    through = [[float(f"{value:.12g}") for value in ties.places[point].tolist()] for point in order]
    return {"name": name, "through": through, "on": on, "capacity": float(f"{capacity:.9g}")}


def _files(answer: Strengthened, results: Results, folder: Path, stem: str, options: RunOptions) -> tuple[Path, ...]:
    """Deck, table and results of the strengthened structure, with pictures where these can be drawn; their paths.

    results : of the last analysis, which are those of the deck unless it has other load cases or names other files
    """
    from mbla.sweeps.strengthen.report import table_csv  # late: it is written once

    deck = answer.deck
    text = strengthened_deck(deck, answer.model, answer.candidates.ties, answer.capacities, folder)
    draws = bool(find_spec("matplotlib") and find_spec("pyvista"))
    with OutputFolder(folder, stem, options.force, secondary=True) as out:
        out.write_text(f"{stem}.yaml", text)
        out.write_text(f"{stem}.csv", table_csv(answer))
    if deck.side_files or len(results.cases) < len(results.model.load_cases):
        drawn = ("output.plots=true",) if draws else ()
        run(folder / f"{stem}.yaml", replace(options, folder=folder, overrides=drawn, force=True))
    else:
        with OutputFolder(folder, stem, force=True) as out:
            write_results(results, out, deck.content.output.model_copy(update={"plots": draws}))
    return tuple(folder / f"{stem}.{kind}" for kind in ("yaml", "csv", "h5"))
