"""``mbla tradeoff``: a sweep over settings of a deck, its pictures and advice."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly import build_assembly
from mbla.deck import Deck
from mbla.errors import LimitError, SolverError, UsageError
from mbla.model import build_model
from mbla.model.model import LoadCase, Model, select_cases
from mbla.process.run_options import RunOptions
from mbla.questions.angle import Angle
from mbla.questions.load_factor import LoadFactor
from mbla.questions.reaction import Reaction
from mbla.results.listing.answers import status_name
from mbla.results.listing.text import number, sentence, small, table
from mbla.results.outcome import least_answer
from mbla.results.pictures.diagrams import dress, open_diagrams
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import BLUE, GHOST, VERMILION, WARNING
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
from mbla.sweeps.tables.write_tables import StudyResult
from mbla.sweeps.tradeoff.settings import REFERENCE, Setting, named_settings, settings_of
from mbla.sweeps.tradeoff.trade import Advice, CaseTrade, advice, trade_of

RESIDUALS = (
    *("equilibrium_residual", "yield_violation", "tension_violation", "penetration", "complementarity_residual"),
    *("slip_residual", "power_balance"),
)
"""what says how badly forces and velocities fit the joint law"""
RESULTS = (
    *("status", "verified", "flow_rule", *LoadFactor.paths, *Angle.paths, *Reaction.paths),
    *("gap", *RESIDUALS, "iterations", "time.total", "time.solver"),
)
SETTING = SweepColumn("setting", "", "name of the setting", "text", "parameter", "setting")
VERDICTS = (Status.NO_EQUILIBRIUM, Status.UNBOUNDED)
"""statuses that are an answer without a figure, once verified"""


def tradeoff(deck: Deck, run: RunOptions, options: Any, report: Report | None) -> Finished:
    """Run a deck under its settings and write the files.

    options : ``knob`` and ``setting`` texts, ``wanted_error``, ``time_limit``, ``run_limit`` [s] or None

    Raises DeckError, UsageError: the deck is not valid, there is no such load case, or one without a load factor, two
    settings have one name, or none applies. Raises FileError: files are in the way or cannot be written.
    """
    until = None if options.time_limit is None else time.monotonic() + options.time_limit
    named = named_settings(options.knob, options.setting)
    chosen = study_options(deck, run, "tradeoff", EngineOptions(until=until, threads=run.threads))
    assert chosen.folder is not None
    model = build_model(deck)
    build_assembly(deck, model)  # what is wrong with it is reported before a process is started
    cases = {case.deck_name: case for case in select_cases(model, run.cases)}
    for name, case in cases.items():
        if not case.has_load_factor:
            words = f"load case {name}: {case.question.no_safety}, which a trade of speed for accuracy is about"
            raise UsageError("tradeoff-option", f"{words}: choose others with --case")
    settings = settings_of(deck, run.overrides, named)
    points = {setting.name: setting.settings for setting in settings if not setting.unfit}
    study_of = partial(study_result_of, deck, model, tuple(cases.values()), settings, options.wanted_error)
    plan = study_plan(deck, run.overrides, tuple(cases), RESULTS, chosen.folder)
    plan = replace(plan, time_limit=options.run_limit, timed=True)
    return run_sweep(prepared_study(deck, "tradeoff", plan, SETTING, points, study_of), chosen, report)


def study_result_of(
    deck: Deck, model: Model, cases: Sequence[LoadCase], settings: Sequence[Setting], wanted: float, results: SweepTable
) -> StudyResult:
    """What follows from the points, which are the settings that apply."""
    trades = [_trade(model, case, [setting for setting in settings if not setting.unfit], results) for case in cases]
    advices = [advice([trade], wanted) for trade in trades]
    together = [advice(trades, wanted)] if len(trades) > 1 else []
    columns: list[tuple[SweepColumn, Values]] = []
    for trade in trades:
        before = f"{trade.name}." if len(trades) > 1 else ""
        words = "relative distance from the reference"
        columns.append((SweepColumn(f"{before}distance", "", words, "float", "result"), trade.distance))
        words = "on the Pareto front of time and distance"
        columns.append((SweepColumn(f"{before}front", "", words, "bool", "result"), trade.front))
    return StudyResult(
        columns=columns,
        record={"tradeoff": _record(trades, [*advices, *together], settings, wanted)},
        pictures={
            f"tradeoff_{trade.name}": partial(draw_trade, deck.title, trade, one.sentence)
            for trade, one in zip(trades, advices, strict=True)
        },
        lines=_lines(deck, trades, [*advices, *together], settings, results),
        exit_code=_exit_code(trades, results),
    )


def _exit_code(trades: Sequence[CaseTrade], results: SweepTable) -> int:
    """7: the time limit came before the reference; 4: no reference is verified; else 0."""
    if np.isin(results["reason"][results["setting"] == REFERENCE], (STOPPED, NOT_BEGUN)).any():
        return LimitError.exit_status
    return 0 if all(trade.certain for trade in trades) else SolverError.exit_status


def _trade(model: Model, case: LoadCase, settings: Sequence[Setting], results: SweepTable) -> CaseTrade:
    """What each setting gave for one load case."""
    columns = {column.path: column for column in results.of_role("result") if column.case == case.deck_name}

    def figures(path: str) -> FloatArray:
        return numbers_of(columns[path], results[columns[path].name])

    def texts(path: str) -> np.ndarray[Any, np.dtype[Any]]:
        return np.array([value or "" for value in results[columns[path].name].tolist()], dtype=object)

    paths, least = case.question.paths, least_answer(model, case)
    answer, status = figures(paths[0]), texts("status")
    residual = np.fmax.reduce([figures(path) for path in RESIDUALS])
    accuracy = np.nan_to_num(np.where(texts("flow_rule") == "associative", figures("gap"), residual))
    accuracy[np.isnan(answer)] = np.nan
    answered = (figures("verified") == 1.0) & np.isin(status, [each.value for each in (Status.SOLVED, *VERDICTS)])
    verified = answered | (status == Status.APPROXIMATE.value) & (results["state"] == DONE)
    shown = {"lower": figures(paths[1]), "upper": figures(paths[2]), "resid.": residual}
    arrays = (status, verified, answer, accuracy, figures("time.total"))
    return trade_of(case.deck_name, case.question.head(model.units), settings, *arrays, least, shown)


# --- words ------------------------------------------------------------------------------------------------------------

LEGEND = (
    "time: a load case by the clock, in seconds; error: distance from the reference, none of another model; lower, "
    "upper: proved bounds of associative flow; resid.: largest, recomputed; *: no verified setting of the same model "
    "is both faster and nearer"
)


def _lines(
    deck: Deck, trades: Sequence[CaseTrade], advices: Sequence[Advice], settings: Sequence[Setting], results: SweepTable
) -> list[str]:
    """A table for each load case, what does not apply or failed, and the advice."""
    lines = heading_lines(deck)
    for trade in trades:
        words = "no setting gave a result, so there is no reference"
        if trade.reference is not None:
            unsure = "" if trade.certain else ", which is NOT VERIFIED"
            words = f"errors are relative to {trade.settings[trade.reference].name}{unsure}, good to "
            words += small(trade.resolution)
        lines += ["", *sentence(f"load case {trade.name}: {words}"), *_table(trade)]
    lines += ["", *sentence(LEGEND), ""]
    failed = zip(results["setting"].tolist(), results["reason"].tolist(), strict=True)
    why: dict[str, list[str]] = {}
    for name, reason in (*((setting.name, setting.unfit) for setting in settings), *failed):
        if reason:
            why.setdefault(reason, []).append(name)
    for reason, names in why.items():
        lines += sentence(f"{', '.join(names)}: {reason}")
    names = [f"{trade.name}: " for trade in trades] + ["All load cases: "] if len(trades) > 1 else [""]
    for name, one in zip(names, advices, strict=True):
        lines += sentence(name + one.sentence)
    return lines


def _table(trade: CaseTrade) -> list[str]:
    head = ["setting", "time", trade.what, "error", *trade.shown, ""]
    rows = [
        [
            ("* " if trade.front[n] else "  ") + setting.name,
            "-" if math.isnan(trade.seconds[n]) else f"{trade.seconds[n]:.3f}",
            number(trade.answer[n]),
            "ref." if n == trade.reference else _error(trade.distance[n], trade.resolution),
            *((small if name == "resid." else number)(figures[n]) for name, figures in trade.shown.items()),
            _mark(trade, n),
        ]
        for n, setting in enumerate(trade.settings)
        if trade.status[n]
    ]
    return table(head, rows) if rows else []


def _error(distance: float, resolution: float) -> str:
    """``<1e-9`` where it is less than can be resolved."""
    return f"<{small(resolution)}" if distance < resolution else small(distance)


def _mark(trade: CaseTrade, n: int) -> str:
    """Last column for a setting: its status where it is not solved, its model where it is another."""
    status = Status(trade.status[n])
    words = [] if status == Status.SOLVED else [status_name(status)]
    words += ["stands only by self-stress"] if status == Status.SOLVED and math.isnan(trade.answer[n]) else []
    words += ["not verified"] if not trade.verified[n] and status in (Status.SOLVED, *VERDICTS) else []
    words += ["other model"] if trade.settings[n].model else []
    return ", ".join(words)


def _record(
    trades: Sequence[CaseTrade], advices: Sequence[Advice], settings: Sequence[Setting], wanted: float
) -> dict[str, Any]:
    """Settings, references, fronts and advice; figures of each setting are in the table."""
    cases = [
        {
            "name": trade.name,
            "answer": trade.what,
            "reference": None if trade.reference is None else trade.settings[trade.reference].name,
            "reference_verified": trade.certain,
            "resolution": trade.resolution,
            "front": [setting.name for setting, best in zip(trade.settings, trade.front, strict=True) if best],
            "advice": _advice_json(one),
        }
        for trade, one in zip(trades, advices, strict=False)
    ]
    overall = _advice_json(advices[-1])
    return dict(as_json({"wanted_error": wanted, "settings": settings, "cases": cases, "advice": overall}))


def _advice_json(advice: Advice) -> dict[str, Any]:
    return {"rung": advice.setting, "seconds": advice.seconds, "sentence": advice.sentence}


# --- picture ----------------------------------------------------------------------------------------------------------


def draw_trade(title: str, trade: CaseTrade, advised: str, path: Path) -> None:
    """Error over time on logarithmic scales, the Pareto front marked, of the runs of the deck's own model.

    Raises UsageError where the extra for pictures is not installed, FileError where the file cannot be written.
    """
    rows = [n for n in np.flatnonzero(np.isfinite(trade.distance + trade.seconds)) if not trade.settings[n].model]
    mark = "" if trade.certain else "NOT VERIFIED: no run is verified that the others could be compared with"
    with open_diagrams(path, PictureOptions(), [title, f"load case {trade.name}", advised], mark) as sheet:
        if not rows:
            return
        page, axes = sheet.page, sheet.frames(1)[0, 0]
        dress(page, axes, "time of one load case [s]", "relative distance from the reference")
        times, errors = trade.seconds, np.maximum(trade.distance, trade.resolution)
        axes.set(xscale="log", xlim=(times[rows].min() / 2, times[rows].max() * 2))
        axes.set(yscale="log", ylim=(trade.resolution / 2, errors[rows].max() * 2))
        axes.axhline(trade.resolution, color=GHOST, linestyle="--")
        front = sorted(np.flatnonzero(trade.front), key=lambda n: times[n])
        axes.plot(times[front], errors[front], color=VERMILION, drawstyle="steps-post")
        handles = [page.line("Pareto front", color=VERMILION), page.line("resolution", color=GHOST, linestyle="--")]
        for number, n in enumerate(rows, 1):
            colour = VERMILION if trade.front[n] else BLUE if trade.sound[n] else WARNING
            look = {"marker": f"${number}$", "color": colour, "linestyle": "none"}
            axes.plot(times[n], errors[n], markersize=(9 if number < 10 else 14) * page.scale, **look)
            handles.append(page.line(trade.settings[n].name + ("" if trade.sound[n] else ", not verified"), **look))
        sheet.add_legend(handles)
