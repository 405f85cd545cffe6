"""``mbla tradeoff``: a sweep over settings of a deck, its pictures and advice."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.findings import contacts_of
from mbla.deck import Deck
from mbla.errors import LimitError, SolverError
from mbla.model import build_model
from mbla.model.model import LoadCase, Model, select_cases
from mbla.process.run_options import RunOptions
from mbla.results.diff.cases import ZERO, least_factor
from mbla.results.listing.answers import reaction_unit, status_name
from mbla.results.listing.text import number, sentence, small, table
from mbla.results.record.json_values import as_json
from mbla.results.record.scene import Values
from mbla.solution.solution import Status
from mbla.sweeps.answers import numbers_of
from mbla.sweeps.command import Finished, Report, run_sweep
from mbla.sweeps.engine.engine import NOT_BEGUN, EngineOptions
from mbla.sweeps.engine.supervised import STOPPED
from mbla.sweeps.plan import DONE
from mbla.sweeps.studies import heading_lines, prepared_study, study_options, study_plan
from mbla.sweeps.tables.sweep_table import SweepColumn, SweepTable
from mbla.sweeps.tables.write_tables import Conclusion
from mbla.sweeps.tradeoff.ladder import REFERENCE, Rung, ladder_of, named_rungs
from mbla.sweeps.tradeoff.picture import draw_trade
from mbla.sweeps.tradeoff.trade import VERDICTS, Advice, CaseTrade, advice

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
    *("gap", *RESIDUALS, "iterations", "time.total", "time.solver"),
)
SETTING = SweepColumn("setting", "", "name of the setting", "text", "parameter", "setting")


def tradeoff(deck: Deck, run: RunOptions, options: Any, report: Report | None) -> Finished:
    """Run a deck under its settings and write the files.

    options : ``knob`` and ``setting`` texts, ``wanted_error``, ``time_limit``, ``run_limit`` [s] or None

    Raises
    ------
    DeckError, UsageError
        The deck is not valid, there is no such load case, two settings have one name, or none applies.
    FileError
        Files are in the way or cannot be written.
    """
    until = None if options.time_limit is None else time.monotonic() + options.time_limit
    named = named_rungs(options.knob, options.setting)
    chosen = study_options(deck, run, "tradeoff", EngineOptions(until=until, threads=run.threads))
    assert chosen.folder is not None
    model = build_model(deck)
    contacts_of(deck, model)  # what is wrong with it is told before a process is started
    cases = {case.deck_name: case for case in select_cases(model, run.cases)}
    rungs = ladder_of(deck, run.overrides, named)
    plan = study_plan(deck, run.overrides, tuple(cases), RESULTS, chosen.folder, options.run_limit, timed=True)
    fit = [rung for rung in rungs if not rung.unfit]
    conclude = partial(conclusion_of, deck, model, tuple(cases.values()), rungs, options.wanted_error)
    settings = [rung.settings for rung in fit]
    prepared = prepared_study(deck, "tradeoff", plan, SETTING, [rung.name for rung in fit], settings, conclude)
    return run_sweep(prepared, chosen, report)


def conclusion_of(
    deck: Deck, model: Model, cases: Sequence[LoadCase], rungs: Sequence[Rung], wanted: float, results: SweepTable
) -> Conclusion:
    """What follows from the points, which are the settings that apply."""
    trades = [_trade(model, case, [rung for rung in rungs if not rung.unfit], results) for case in cases]
    advices = [advice([trade], wanted) for trade in trades]
    advices += [advice(trades, wanted)] if len(trades) > 1 else []
    columns: list[tuple[SweepColumn, Values]] = []
    for trade in trades:
        before = f"{trade.name}." if len(trades) > 1 else ""
        distance = SweepColumn(f"{before}distance", "", "relative distance from the reference", "float", "result")
        front = SweepColumn(f"{before}front", "", "on the Pareto front of time and distance", "bool", "result")
        columns.append((distance, trade.distance))
        columns.append((front, trade.front))
    pairs = list(zip(trades, advices, strict=False))
    return Conclusion(
        columns=columns,
        record={"tradeoff": _record(trades, advices, rungs, wanted)},
        pictures={
            f"tradeoff_{trade.name}": partial(draw_trade, deck.title, trade, one.sentence) for trade, one in pairs
        },
        lines=_lines(deck, trades, advices, rungs, results),
        exit_code=_exit_code(trades, results),
    )


def _exit_code(trades: Sequence[CaseTrade], results: SweepTable) -> int:
    """7: the time limit came before the reference; 4: no reference is verified; else 0."""
    settings = zip(results["setting"].tolist(), results["reason"].tolist(), strict=True)
    if any(name == REFERENCE and reason in (STOPPED, NOT_BEGUN) for name, reason in settings):
        return LimitError.exit_status
    return 0 if all(trade.reference_verified for trade in trades) else SolverError.exit_status


def _trade(model: Model, case: LoadCase, rungs: Sequence[Rung], results: SweepTable) -> CaseTrade:
    kind, unit, least = _kind(model, case)
    columns = {column.path: column for column in results.of_role("result") if column.case == case.deck_name}

    def figures(path: str) -> FloatArray:
        return numbers_of(columns[path], results[columns[path].name])

    def texts(path: str) -> list[str]:
        return [value or "" for value in results[columns[path].name].tolist()]

    answer, lower, upper = map(figures, ANSWERS[kind])
    residual = np.fmax.reduce([figures(path) for path in RESIDUALS])
    associative = np.array(texts("flow_rule")) == "associative"
    accuracy = np.nan_to_num(np.where(associative, figures("gap"), residual))
    status = np.array(texts("status"), dtype=object)
    answered = (figures("verified") == 1.0) & np.isin(status, (Status.SOLVED.value, *(each.value for each in VERDICTS)))
    as_asked = (status == Status.APPROXIMATE.value) & (results["state"] == DONE)
    return CaseTrade(
        name=case.deck_name,
        what=f"{kind} [{unit}]" if unit else kind,
        rungs=tuple(rungs),
        status=status,
        verified=np.asarray(answered | as_asked, dtype=bool),
        answer=answer,
        accuracy=np.where(np.isnan(answer), np.nan, accuracy),
        residual=residual,
        lower=lower,
        upper=upper,
        seconds=figures("time.total"),
        least=least,
    )


def _kind(model: Model, case: LoadCase) -> tuple[str, str, float]:
    """What a load case answers, its unit, and the size below which differences are relative to this."""
    if case.settlement is not None:
        return "reaction", reaction_unit(model, case.settlement), ZERO * case.settlement.unit
    return ("angle", "degree", 0.0) if case.tilt is not None else ("load factor", "", least_factor(model, case))


# --- words ------------------------------------------------------------------------------------------------------------

LEGEND = (
    "time: a load case by the clock, in seconds; error: distance from the reference, none of another model; lower, "
    "upper: proved bounds of associative flow; resid.: largest, recomputed; *: no verified setting of the same model "
    "is both faster and nearer"
)


def _lines(
    deck: Deck, trades: Sequence[CaseTrade], advices: Sequence[Advice], rungs: Sequence[Rung], results: SweepTable
) -> list[str]:
    """A table for each load case, what does not apply or failed, and the advice."""
    lines = heading_lines(deck)
    for trade in trades:
        lines += ["", *sentence(f"load case {trade.name}: {reference_words(trade)}"), *_table(trade)]
    lines += ["", *sentence(LEGEND), ""]
    failed = zip(results["setting"].tolist(), results["reason"].tolist(), strict=True)
    why: dict[str, list[str]] = {}
    for name, reason in (*((rung.name, rung.unfit) for rung in rungs), *failed):
        if reason:
            why.setdefault(reason, []).append(name)
    for reason, names in why.items():
        lines += sentence(f"{', '.join(names)}: {reason}")
    names = [f"{trade.name}: " for trade in trades] + ["All load cases: "] if len(trades) > 1 else [""]
    for name, one in zip(names, advices, strict=True):
        lines += sentence(name + one.sentence)
    return lines


def reference_words(trade: CaseTrade) -> str:
    """What the errors are distances from, and how small ones it can tell."""
    if trade.reference is None:
        return "no setting gave a result, so there is no reference"
    unsure = "" if trade.reference_verified else ", which is NOT VERIFIED"
    return f"errors are relative to {trade.rungs[trade.reference].name}{unsure}, good to {small(trade.resolution)}"


def _table(trade: CaseTrade) -> list[str]:
    head = ["setting", "time", trade.what, "error", "lower", "upper", "resid.", ""]
    rows = [
        [
            ("* " if trade.front[n] else "  ") + rung.name,
            "-" if math.isnan(trade.seconds[n]) else f"{trade.seconds[n]:.3f}",
            number(trade.answer[n]),
            "ref." if n == trade.reference else _error(trade, n),
            number(trade.lower[n]),
            number(trade.upper[n]),
            small(trade.residual[n]),
            _mark(trade, n),
        ]
        for n, rung in enumerate(trade.rungs)
        if trade.status[n]
    ]
    return table(head, rows) if rows else []


def _error(trade: CaseTrade, n: int) -> str:
    """The distance; ``<1e-9`` where it is less than can be told."""
    return f"<{small(trade.resolution)}" if trade.distance[n] < trade.resolution else small(trade.distance[n])


def _mark(trade: CaseTrade, n: int) -> str:
    """What the last column says of a setting: its status where it is not solved, its model where it is another."""
    status = Status(trade.status[n])
    words = [] if status == Status.SOLVED else [status_name(status)]
    words += ["stands only by self-stress"] if status == Status.SOLVED and math.isnan(trade.answer[n]) else []
    words += ["not verified"] if not trade.verified[n] and status in (Status.SOLVED, *VERDICTS) else []
    words += ["other model"] if trade.rungs[n].model else []
    return ", ".join(words)


def _record(
    trades: Sequence[CaseTrade], advices: Sequence[Advice], rungs: Sequence[Rung], wanted: float
) -> dict[str, Any]:
    """Settings, references, fronts and advice; figures of each setting are in the table."""
    cases = [
        {
            "name": trade.name,
            "answer": trade.what,
            "reference": None if trade.reference is None else trade.rungs[trade.reference].name,
            "reference_verified": trade.reference_verified,
            "resolution": trade.resolution,
            "front": [rung.name for rung, best in zip(trade.rungs, trade.front, strict=True) if best],
            "advice": one,
        }
        for trade, one in zip(trades, advices, strict=False)
    ]
    return dict(as_json({"wanted_error": wanted, "settings": rungs, "cases": cases, "advice": advices[-1]}))
