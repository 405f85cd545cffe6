"""``mbla tradeoff``: a sweep over settings of a deck, its table, pictures and advice."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mbla.contacts.findings import contacts_of
from mbla.deck import Deck
from mbla.errors import LimitError, SolverError, UsageError
from mbla.model import build_model
from mbla.model.model import LoadCase, Model, select_cases
from mbla.process.run_options import RunOptions
from mbla.results.diff.cases import ZERO, least_factor
from mbla.results.failures import SIGNALS
from mbla.results.files import OutputFolder
from mbla.results.listing.answers import reaction_unit
from mbla.results.record.json_values import number
from mbla.results.record.scene import Values
from mbla.solution.solution import Status
from mbla.sweeps.engine.engine import NOT_BEGUN, SerialEngine
from mbla.sweeps.engine.supervised import STOPPED
from mbla.sweeps.plan import DONE, Outcome, Plan
from mbla.sweeps.results import result_places
from mbla.sweeps.studies import (
    About,
    Study,
    about,
    plan_of,
    rows_json,
    solved,
    study_record,
    study_table,
    tasks_of,
    with_columns,
    without_empty,
    written_study,
)
from mbla.sweeps.tables.sweep_table import SweepColumn, SweepTable, as_text
from mbla.sweeps.tradeoff.ladder import REFERENCE, Rung, fitted, named_ladder, named_rungs, usual_ladder
from mbla.sweeps.tradeoff.picture import draw_trade
from mbla.sweeps.tradeoff.trade import NAN, VERDICTS, Advice, CaseTrade, Row, advice, case_trade

RESIDUALS = (
    *("equilibrium_residual", "yield_violation", "tension_violation", "penetration", "complementarity_residual"),
    *("slip_residual", "power_balance"),
)
"""what tells how badly forces and velocities fit the joint law"""
ANSWERS = {
    "load factor": ("load_factor", "static_bound", "kinematic_bound"),
    "angle": ("angle", "angle_bounds.0", "angle_bounds.1"),
    "reaction": ("reaction.value", "reaction.lower_bound", "reaction.upper_bound"),
}
"""columns of the answer and its bounds, by what a load case asks for"""
RESULTS = (
    *("status", "verified", "flow_rule", *(path for paths in ANSWERS.values() for path in paths)),
    *("gap", *RESIDUALS, "range.0", "range.1", "size.dimension", "iterations", "time.total", "time.solver"),
)
PLANAR = "friction has two directions in a planar structure: any polyhedron is exact"
REPEATS, SHORT = 3, 1.0
"""runs at most of a setting that takes fewer seconds than that, of which the shortest counts"""
SETTING = SweepColumn("setting", "", "name of the setting", "text", "parameter", "setting")
Report = Callable[[int, int], None]
"""called with the settings that are done, and all of them"""


@dataclass(frozen=True)
class Tradeoff(Study):
    """Everything that was measured and what it says.

    wanted, limits, threads : as of ``study_deck``
    trades  : by load case, a travelling load as one
    advices : by load case; then, with several, the one for all of them
    """

    wanted: float
    limits: tuple[float | None, float | None]
    threads: int
    trades: tuple[CaseTrade, ...]
    advices: tuple[Advice, ...]

    @property
    def exit_code(self) -> int:
        """130, 143: a signal; 7: the time limit came before the reference; 4: no reference is verified; else 0."""
        if self.stop:
            return self.stop
        late = [row for row in self.trades[0].rows if row.name == REFERENCE and row.reason in (STOPPED, NOT_BEGUN)]
        if late:
            return LimitError.exit_status
        return 0 if all(trade.verified for trade in self.trades) else SolverError.exit_status


def tradeoff(
    deck: Deck, run: RunOptions, options: Any, report: Report | None
) -> tuple[Tradeoff, dict[str, Any], list[str]]:
    """Run a deck under its settings and write the files; the study, its JSON record, and remarks.

    options : ``knob`` and ``setting`` texts, ``wanted_error``, ``time_limit``, ``run_limit`` [s] or None

    Raises
    ------
    DeckError, UsageError
        The deck is not valid, there is no such load case, two settings have one name, or none applies.
    FileError
        Files are in the way or cannot be written.
    """
    named = named_rungs(options.knob, options.setting)
    limits = options.time_limit, options.run_limit

    def draw(folder: OutputFolder, ending: str, study: Tradeoff) -> None:
        for trade, advised in zip(study.trades, study.advices, strict=False):
            with folder.writing(f"{folder.stem}_{trade.name}.{ending}") as path:
                draw_trade(path, study.about.heading, trade, advised.sentence)

    return written_study(
        OutputFolder(run.folder_for(deck.path), f"{deck.path.stem}_tradeoff", run.force, beside=True),
        lambda: study_deck(deck, run, named, options.wanted_error, limits, report),
        draw,
        study_json,
    )


def study_deck(
    deck: Deck,
    run: RunOptions,
    named: Sequence[Rung],
    wanted: float,
    limits: tuple[float | None, float | None] = (None, None),
    report: Report | None = None,
) -> Tradeoff:
    """Run the settings that are named with the reference, or the usual ones, and hold them against the reference.

    limits : seconds for all settings, which count from here, and for each; None for none
    """
    started = time.perf_counter()
    until = None if limits[0] is None else time.monotonic() + limits[0]
    fixed = run.overrides
    model = build_model(deck)
    contacts_of(deck, model)  # what is wrong with it is told before a process is started
    cases = {case.deck_name: case for case in select_cases(model, run.cases)}
    rungs = fitted(deck, fixed, named_ladder(deck, fixed, named) if named else usual_ladder(deck, fixed))
    _refuse_nothing_fit([rung for rung in rungs if rung.name in {own.name for own in named}])
    plan = replace(plan_of(deck, fixed, tuple(cases), RESULTS), shared=False, time_limit=limits[1])
    outcomes, ends, stop = _run(deck, plan, rungs, SerialEngine(until, run.threads), report)
    trades = tuple(_trade(model, case, plan, rungs, outcomes, ends) for case in cases.values())
    advices = [advice([trade], wanted) for trade in trades]
    of = about(deck, fixed)
    return Tradeoff(
        about=of,
        wanted=wanted,
        limits=limits,
        threads=run.threads,
        table=_table(of, plan, rungs, outcomes, trades),
        trades=trades,
        advices=tuple([*advices, advice(trades, wanted)] if len(trades) > 1 else advices),
        stop=stop,
        seconds=time.perf_counter() - started,
    )


def _refuse_nothing_fit(named: Sequence[Rung]) -> None:
    """UsageError where settings were asked for and none of them applies: there would be nothing to compare."""
    if named and all(rung.unfit for rung in named):
        why = "; ".join(f"{rung.name}: {rung.unfit}" for rung in named)
        raise UsageError("tradeoff-option", f"no setting that was asked for applies to the deck: {why}")


# --- points -----------------------------------------------------------------------------------------------------------


def _run(
    deck: Deck, plan: Plan, rungs: Sequence[Rung], engine: SerialEngine, report: Report | None
) -> tuple[dict[int, Outcome], dict[int, tuple[str, str]], int]:
    """Outcomes by number of the setting, state and reason of those without one, and what ended it.

    Settings that say nothing in a planar structure come last; quick ones are run again, and their least times count.
    """
    settings = [{} if rung.unfit else rung.settings(deck, plan.fixed) for rung in rungs]
    tasks = [task for task in tasks_of(plan, settings) if not rungs[task.number - 1].unfit]
    ends = {number: ("unfit", rung.unfit) for number, rung in enumerate(rungs, 1) if rung.unfit}
    found: dict[int, Outcome] = {}
    stop = 0

    def done(count: int) -> None:
        if report is not None:
            report(len(found) + count, len(tasks))

    with engine:
        for spatial in (False, True):
            part = [task for task in tasks if rungs[task.number - 1].spatial == spatial]
            if spatial and any(_is_planar(found[task.number]) for task in tasks if task.number in found):
                ends |= {task.number: ("unfit", PLANAR) for task in part}
            elif part and not stop:
                more, stop = solved(engine, plan, part, deck, done)
                found |= more
        for _ in range(REPEATS - 1):
            quick = [task for task in tasks if task.number in found and _is_quick(found[task.number])]
            if quick and not stop:
                again, stop = solved(engine, plan, quick, deck)
                found |= {n: _quicker(found[n], own) for n, own in again.items() if own.state == DONE}
    word = next((word for status, word in SIGNALS.values() if status == stop), "")
    ends |= {task.number: (word, f"not run: {word} before") for task in tasks if task.number not in {**found, **ends}}
    return found, ends, stop


def _is_planar(outcome: Outcome) -> bool:
    dimensions = {value for name, value in outcome.results.items() if name.endswith("size.dimension")}
    return outcome.state == DONE and dimensions == {2}


def _is_quick(outcome: Outcome) -> bool:
    return outcome.state == DONE and outcome.seconds < SHORT


def _quicker(one: Outcome, other: Outcome) -> Outcome:
    """The outcome of two runs of one setting whose solving took less."""

    def total(outcome: Outcome) -> float:
        return sum(
            float(str(v)) for name, v in outcome.results.items() if name.endswith("time.total") and v is not None
        )

    return min(one, other, key=total)


# --- what they say ----------------------------------------------------------------------------------------------------


def _trade(
    model: Model,
    case: LoadCase,
    plan: Plan,
    rungs: Sequence[Rung],
    outcomes: Mapping[int, Outcome],
    ends: Mapping[int, tuple[str, str]],
) -> CaseTrade:
    kind, unit, least = _kind(model, case)
    rows = [
        _row(rung, kind, case.deck_name, plan, outcomes[number]) if number in outcomes else Row(rung, *ends[number])
        for number, rung in enumerate(rungs, 1)
    ]
    return case_trade(case.deck_name, rows, least, kind, unit)


def _kind(model: Model, case: LoadCase) -> tuple[str, str, float]:
    """What a load case answers, its unit, and the size below which differences are relative to this."""
    if case.settlement is not None:
        return "reaction", reaction_unit(model, case.settlement), ZERO * case.settlement.unit
    return ("angle", "degree", 0.0) if case.tilt is not None else ("load factor", "", least_factor(model, case))


def _row(rung: Rung, kind: str, case: str, plan: Plan, outcome: Outcome) -> Row:
    """The row of one load case from the columns of the point."""
    places = [place for place in result_places(plan.results, plan.cases) if place.case == case]
    found: dict[str, Any] = {".".join(place.path): outcome.results.get(place.name) for place in places}

    def figure(name: str) -> float:
        value = found.get(name)
        return NAN if value is None else float(value)

    status, (answer, lower, upper) = found.get("status") or "", map(figure, ANSWERS[kind])
    residual = max((figure(name) for name in RESIDUALS if not math.isnan(figure(name))), default=NAN)
    accuracy = figure("gap") if found.get("flow_rule") == "associative" else residual
    sound = status == Status.APPROXIMATE and outcome.state == DONE  # as sharp as the setting asks for
    return Row(
        rung=rung,
        state=outcome.state,
        reason=outcome.reason,
        status=status,
        verified=sound or (bool(found.get("verified")) and status in (Status.SOLVED, *VERDICTS)),
        answer=answer,
        accuracy=NAN if math.isnan(answer) else (0.0 if math.isnan(accuracy) else accuracy),
        residual=residual,
        lower=lower,
        upper=upper,
        ends=(figure("range.0"), figure("range.1")),
        iterations=int(found.get("iterations") or 0),
        seconds=figure("time.total"),
        solver=figure("time.solver"),
    )


def _table(
    of: About, plan: Plan, rungs: Sequence[Rung], outcomes: Mapping[int, Outcome], trades: Sequence[CaseTrade]
) -> SweepTable:
    """The table of the sweep, with distance and front."""
    table = without_empty(study_table(of, SETTING, [rung.name for rung in rungs], plan, outcomes))
    columns: list[tuple[SweepColumn, Values]] = []
    for trade in trades:
        before = f"{trade.name}." if len(trades) > 1 else ""
        distance = SweepColumn(f"{before}distance", "", "relative distance from the reference", "float", "result")
        front = SweepColumn(f"{before}front", "", "on the Pareto front of time and distance", "bool", "result")
        columns.append((distance, np.array([row.distance for row in trade.rows])))
        columns.append((front, np.array([row.front for row in trade.rows])))
    return with_columns(table, columns)


def study_json(study: Tradeoff, files: tuple[str, ...] = ()) -> dict[str, Any]:
    """The record that ``--json`` prints and ``STEM_tradeoff.json`` holds; ``points`` are the rows of the table."""
    rows = study.trades[0].rows
    own = {
        "wanted_error": study.wanted,
        "limits": {"time": study.limits[0], "run": study.limits[1], "threads": study.threads},
        "settings": [
            _setting_json(row.rung)
            | {"other_model": row.rung.model or None, "end": row.state, "reason": row.reason or None}
            for row in rows
        ],
        "points": rows_json(study.table),
        "cases": [_case_json(trade, study.advices[place]) for place, trade in enumerate(study.trades)],
        "advice": _advice_json(study.advices[-1]),
    }
    return study_record(study, own, files)


def _setting_json(rung: Rung | None) -> dict[str, Any]:
    if rung is None:
        return {"name": None, "set": [], "without": []}
    texts = [f"{key}={as_text(value)}" for key, value in rung.set.items()]
    return {"name": rung.name, "set": texts, "without": [f"analysis.{name}" for name in rung.freed]}


def _case_json(trade: CaseTrade, advised: Advice) -> dict[str, Any]:
    reference = trade.reference
    return {
        "name": trade.name,
        "kind": trade.kind,
        "unit": trade.unit,
        "reference": None if reference is None else reference.name,
        "reference_verified": trade.verified,
        "resolution": number(trade.resolution),
        "verified": [row.name for row in trade.rows if row.verified],
        "front": [row.name for row in trade.rows if row.front],
        "advice": _advice_json(advised),
    }


def _advice_json(one: Advice) -> dict[str, Any]:
    setting = _setting_json(one.rung)
    return {
        "setting": setting.pop("name"),
        **setting,
        "seconds": number(one.seconds),
        "error": number(one.error),
        "sentence": one.sentence,
    }
