"""``mbla strengthen``: the cheapest ties with which a structure carries what it has to, as a deck that is analysed.

Capacities of the program are rounded up to a catalogue where there is one, and candidates that it hardly uses are
left out as long as that makes the rest cheaper. Then the strengthened structure is analysed by the deck's own flow
rule, whose least load factors decide: while one falls short the program is asked for as much more in that load case, by
the secant, and where it has no more to give all capacities are raised together.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from importlib.util import find_spec
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck import Deck, read_deck
from mbla.deck.sections.selectors import GROUND
from mbla.model import Model
from mbla.model.ties.candidates import Candidates
from mbla.model.ties.ties import OUTSIDE, Ties
from mbla.process.run_options import RunOptions
from mbla.results.files import OutputFolder
from mbla.results.movable_deck import MovableDeck, movable_deck, sections_text
from mbla.results.outcome import least_known, result_of
from mbla.results.provenance import deck_record
from mbla.results.results import Results
from mbla.results.status_file import StatusFile
from mbla.results.write import write_results
from mbla.run import run, solve_deck
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.further.strengthening.cheapest import cheapest
from mbla.solution.further.strengthening.strengthening import Cheapest
from mbla.solution.solution import WITH_VALUE, Status
from mbla.sweeps.strengthen.catalogue import rounded_up
from mbla.sweeps.strengthen.ceiling import GREATEST, RAISED, greatest_capacities, settled_factors, shortfall
from mbla.sweeps.strengthen.question import SHORT, Posed, question_of, refuse_unfit, required_of, with_fewer

MOST_REPEATS, MARGIN, LEAST_SLOPE = 10, 5e-4, 0.25
"""analyses after the first one, share of a required load factor that is asked for beyond what was short, and what an
analysis gains at least of what is asked for more"""
MOST_CLOSER, CLOSE = 2, 0.02
"""analyses after the first one that carries more than enough, and share of a required load factor that is close"""
RAISE = 1.15
"""by which all capacities are raised where the program has no more to give"""


@dataclass(frozen=True)
class Strengthened:
    """What was found.

    cheapest   : answer of the program
    capacities : (k,) N, as written in the deck: rounded, and raised as far as the analysis asked for it
    asked      : load factors of which they are the cheapest capacities, by load case
    raised     : factor on these before they were rounded
    cost       : of these capacities
    factors    : by load case: required, and of the strengthened structure, nan without a result
    verified   : whether these are verified
    analyses   : of the strengthened structure
    files      : written
    shortfall  : why no capacities suffice by the deck's flow rule; empty where they do, or that is not known
    """

    deck: Deck
    model: Model
    candidates: Candidates
    cheapest: Cheapest
    capacities: FloatArray
    asked: dict[str, float]
    raised: float
    cost: float
    factors: dict[str, tuple[float, float]]
    verified: bool
    analyses: int
    files: tuple[Path, ...]
    shortfall: str = ""

    @property
    def suffices(self) -> bool:
        """Whether the strengthened structure carries what it has to."""
        return all(_carried(*each) for each in self.factors.values())

    @property
    def exit_code(self) -> int:
        """0: strengthened and verified; 4: not verified, or still short; 5: no capacities suffice."""
        if self.cheapest.status not in WITH_VALUE:
            return 5 if self.cheapest.status is Status.NO_EQUILIBRIUM else 4
        return 0 if self.suffices and self.verified else 4


def _carried(required: float, factor: float) -> bool:
    return factor >= required - SHORT * max(abs(required), SHORT)


def strengthen(deck: Deck, options: RunOptions, log: Log) -> Strengthened:
    """Find the cheapest ties, analyse the structure with them, and write both.

    log : called once per iteration of the program

    Raises UsageError: the deck asks for nothing, or for what no program of this kind answers. Raises DeckError,
    FileError, LimitError, SolverError: as a run does.
    """
    refuse_unfit(deck)
    stem = f"{deck.path.stem}_strengthened"
    movable = movable_deck(deck, deck_record(deck).files, stem)
    with OutputFolder(options.folder_for(deck.path), stem, options.force, secondary=True) as out:
        out.refuse(f"{stem}.yaml", f"{stem}.csv", *movable.files)
    model, candidates, question = posed = question_of(deck, log)
    found = cheapest(question)
    if found.status not in WITH_VALUE:
        none = np.zeros(len(candidates.costs))
        return Strengthened(deck, model, candidates, found, none, required_of(deck), 1.0, math.nan, {}, False, 0, ())
    return _analysed(deck, movable, posed, found, options)


@dataclass(frozen=True)
class _Attempt:
    """An analysis of the structure with capacities, (k,), found for load factors asked; factors by load case."""

    asked: dict[str, float]
    capacities: FloatArray
    cost: float
    results: Results
    factors: dict[str, float]

    def carries(self, required: dict[str, float]) -> bool:
        """Whether all load cases have what is required."""
        return all(_carried(factor, self.factors[name]) for name, factor in required.items())

    def surplus(self, required: dict[str, float]) -> float:
        """Least share by which load cases of which more was asked have more than is required."""
        shares = [self.factors[name] / factor - 1.0 for name, factor in required.items() if self.asked[name] > factor]
        return min(shares, default=0.0)


def _analysed(deck: Deck, movable: MovableDeck, posed: Posed, first: Cheapest, options: RunOptions) -> Strengthened:
    """The strengthened structure, as much more asked of the program as it takes for it to carry what it has to."""
    assert deck.content.strengthen is not None  # who calls knows
    model, candidates, question = posed
    required, catalogue, tries = required_of(deck), deck.content.strengthen.catalogue, list[_Attempt]()
    asked, raised, wanted, short, same = required, 1.0, with_fewer(question, first, catalogue), "", 0
    for _ in range(MOST_REPEATS + 1):
        capacities = rounded_up(raised * wanted, catalogue, question.most)
        same = same + 1 if tries and np.array_equal(capacities, tries[-1].capacities) else 0
        if same:  # the catalogue had room for what was asked for more
            tries[-1] = replace(tries[-1], asked=asked)
        else:
            results = _analysis(deck, movable, model, candidates.ties, capacities)
            factors = {name: _factor(results, name) for name in required}
            tries.append(_Attempt(asked, capacities, float(capacities @ candidates.costs), results, factors))
        more = _ask_for(required, tries, 2.0**same)
        if len(tries) == 1 and more is not None and not tries[0].carries(required):
            results = _analysis(deck, movable, model, candidates.ties, greatest_capacities(question))
            limits = settled_factors(results, tries[0].factors)
            short = shortfall(results, required, limits, candidates.ties.names, GREATEST)
        if short or more is None or (raised > 1.0 and tries[-1].carries(required)):
            break
        raising = question.asking(more)
        after = cheapest(raising) if raised == 1.0 else None
        if after is not None and after.status in WITH_VALUE:
            asked, wanted = more, with_fewer(raising, after, catalogue)
        else:
            raised *= RAISE
    best = min((each for each in tries if each.carries(required)), key=lambda each: each.cost, default=tries[-1])
    if not short and not best.carries(required):
        used = [candidates.ties.names[row] for row in np.flatnonzero(best.capacities)]
        short = shortfall(best.results, required, best.factors, used, RAISED)
    told = {name: (factor, best.factors[name]) for name, factor in required.items()}
    verified = all(case.checks.verified for case in best.results.cases)
    found = (best.capacities, best.asked, raised, best.cost, told, verified, len(tries))
    answer = Strengthened(deck, model, candidates, first, *found, (), short)
    return replace(answer, files=_files(answer, movable, best.results, options))


def _ask_for(required: dict[str, float], tries: Sequence[_Attempt], further: float) -> dict[str, float] | None:
    """Load factors to ask of the program next, by load case; None where that is of no use, or enough was found.

    further : multiple of what is asked for more where a load case fell short
    """
    last, enough = tries[-1], [each for each in tries if each.carries(required)]
    if any(map(math.isnan, last.factors.values())):
        return None
    if not enough:
        return {name: _beyond(name, factor, tries, further) for name, factor in required.items()}
    best, before = min(enough, key=lambda each: each.cost), [each for each in tries if not each.carries(required)]
    closer = len(tries) - 1 - tries.index(enough[0])
    if not before or closer == MOST_CLOSER or best.surplus(required) <= CLOSE:
        return None
    return {name: (before[-1].asked[name] + best.asked[name]) / 2.0 for name in required}


def _beyond(name: str, required: float, tries: Sequence[_Attempt], further: float) -> float:
    """Load factor to ask of the program for a load case that fell short, from what was asked before and found."""
    asked, found = tries[-1].asked[name], tries[-1].factors[name]
    if _carried(required, found):
        return asked
    slope = 1.0
    if len(tries) > 1 and asked > tries[-2].asked[name]:
        slope = (found - tries[-2].factors[name]) / (asked - tries[-2].asked[name])
    return float(asked + further * ((required - found) / min(max(slope, LEAST_SLOPE), 1.0) + MARGIN * required))


def _analysis(deck: Deck, movable: MovableDeck, model: Model, ties: Ties, capacities: FloatArray) -> Results:
    """Of the structure with ties of given capacities, (k,) N, in the load cases that have to carry something."""
    with TemporaryDirectory() as place:
        path = Path(place) / f"{movable.stem}.yaml"
        path.write_text(strengthened_deck(deck, movable, model, ties, capacities), encoding="utf-8")
        for name, content in movable.files.items():
            (path.parent / name).write_bytes(content)
        asked = RunOptions(cases=tuple(required_of(deck)))
        return solve_deck(read_deck(path), asked, StatusFile(StringIO(), ""), None, perf_counter())


def _factor(results: Results, name: str) -> float:
    """The load factor to design with: of flow without normality the least that was found; nan without a result."""
    for case in results.cases:
        if case.load_case.name == name and case.status is Status.UNBOUNDED:
            return math.inf
        if case.load_case.name == name and result_of(case) is not None:
            return least_known(case)
    return math.nan


def strengthened_deck(deck: Deck, movable: MovableDeck, model: Model, ties: Ties, capacities: FloatArray) -> str:
    """Text of the deck with ties of given capacities, (k,) N."""
    data = movable.data
    added = [_tie(model, ties, row, float(capacities[row])) for row in np.flatnonzero(capacities).tolist()]
    content = data | {"ties": [*data.get("ties", []), *added], "title": f"{deck.title or deck.path.stem}, strengthened"}
    text = sections_text(content, ("strengthen", "expected"))
    return f"# {deck.path.name} with the ties that `mbla strengthen` found.\n{text}"


def _tie(model: Model, ties: Ties, row: int, capacity: float) -> dict[str, Any]:
    """A tie as the deck writes it."""
    points = range(int(ties.start[row]), int(ties.start[row + 1]))
    order = [*points, *([points[0]] if ties.closed[row] else [])]
    groups, indices, bodies = model.blocks.groups, model.blocks.group_indices, ties.bodies[order].tolist()
    on = [GROUND if body == OUTSIDE else {"group": groups[body], "index": int(indices[body])} for body in bodies]
    name = ties.names[row].replace("[", "_").rstrip("]")
    through = [[float(f"{value:.12g}") for value in ties.places[point].tolist()] for point in order]
    return {"name": name, "through": through, "on": on, "capacity": float(f"{capacity:.9g}")}


def _files(answer: Strengthened, movable: MovableDeck, results: Results, options: RunOptions) -> tuple[Path, ...]:
    """Deck, table and results of the strengthened structure, with pictures where these can be drawn; their paths.

    results : of the last analysis, which are those of the deck unless it has other load cases
    """
    from mbla.sweeps.strengthen.report import table_csv  # late: it is written once

    deck, stem, folder = answer.deck, movable.stem, options.folder_for(answer.deck.path)
    text = strengthened_deck(deck, movable, answer.model, answer.candidates.ties, answer.capacities)
    output = deck.content.output
    with OutputFolder(folder, stem, options.force, secondary=True) as out:
        out.write_text(f"{stem}.yaml", text)
        out.write_text(f"{stem}.csv", table_csv(answer))
        for name, content in movable.files.items():
            out.write_bytes(name, content)
        if find_spec("matplotlib") and find_spec("pyvista") and not output.plots:
            _draw(results, out)
    if len(results.cases) < len(results.model.load_cases):
        run(folder / f"{stem}.yaml", replace(options, folder=folder, overrides=(), force=True))
    else:
        with OutputFolder(folder, stem, force=True) as out:
            write_results(results, out, output)
    return (*(folder / f"{stem}.{kind}" for kind in ("yaml", "csv", "h5")), *(folder / name for name in movable.files))


def _draw(results: Results, out: OutputFolder) -> None:
    """The structure with its ties, and how it collapses then."""
    from mbla.results.pictures.options import PictureOptions
    from mbla.results.pictures.plot import pictures_of

    for picture in pictures_of(results, results.cases, PictureOptions(kinds=("model", "mechanism"))):
        with out.writing(f"{out.stem}{picture.name}.png") as path:
            picture.write(path)
