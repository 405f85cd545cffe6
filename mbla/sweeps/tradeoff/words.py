"""The study in words for a terminal: a table for each load case, what was not run, and the advice."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterator, Sequence

from mbla.results.listing.answers import status_name
from mbla.results.listing.text import INDENT, counted, number, sentence, small
from mbla.results.outcome import range_is_a_point
from mbla.solution.solution import Status
from mbla.sweeps.measure.measurement import Measurement
from mbla.sweeps.tradeoff.advice import duration
from mbla.sweeps.tradeoff.ladder_run import RungRun
from mbla.sweeps.tradeoff.rung import REFERENCE
from mbla.sweeps.tradeoff.study import Study
from mbla.sweeps.tradeoff.trade import CaseTrade, Row

HEAD = ("setting", "time", "solve", "iter", "mem.", "answer", "error", "static", "kinem.", "resid.", "")
UNITS = ("", "s", "s", "", "MB", "", "", "bound", "bound", "", "")
LEFT = (0, 10)
"""columns of words, aligned to the left"""
NAME = 25
"""columns that the name of a setting may take; a longer one takes more lines"""
RELATIVE = "errors are relative to"
FRONT = "*"
"""before the setting: on the Pareto front"""
LEGEND = (
    "time: a load case by the clock; solve: its share in solvers; mem.: beyond imports; error: distance from ref., the "
    "reference; bounds: proved, of associative flow; resid.: largest, recomputed; *: no verified setting of the same "
    "model is both faster and nearer"
)


def study_lines(study: Study) -> list[str]:
    """Everything that the terminal shows."""
    lines = [f"{study.deck}: {study.title}"]
    lines.append(f"{INDENT}flow rule {study.flow_rule}; {preparation_words(study)}")
    for trade in study.trades:
        lines += ["", *trade_lines(study, trade)]
    if any(row.measurement is not None for trade in study.trades for row in trade.rows):
        lines += ["", *sentence(LEGEND)]
    lines += ["", *_unmeasured(study)]
    for row, one in enumerate(study.advices):
        lines += sentence(_of_case(study, row) + one.sentence)
    return lines


def preparation_words(study: Study) -> str:
    """What reading, building and finding contacts takes, which the times of the table leave out."""
    found = [m.preparation for run in study.runs if not run.rung.model for m in run.measurements]
    known = [seconds for seconds in found if not math.isnan(seconds)]
    return f"reading, model and contacts take {duration(min(known, default=math.nan))} more, once for all load cases"


def trade_lines(study: Study, trade: CaseTrade) -> list[str]:
    """The table of one load case; other models below, as their difference is no error."""
    measured = [row for row in trade.rows if row.measurement is not None]
    own = [row for row in measured if not row.run.rung.model]
    others = [row for row in measured if row.run.rung.model]
    lines = sentence(f"load case {trade.name}{_positions(trade)}: {reference_words(trade)}")
    if not measured:
        return lines
    body, marks = _wrapped(own, trade)
    further, _ = _wrapped(others, trade)
    split = len(body)
    body += further
    kind, unit = _kind(measured)
    head = [kind if name == "answer" else name for name in HEAD]
    units = [unit if name == "answer" else text for name, text in zip(HEAD, UNITS, strict=True)]
    shown = aligned([head, units, *body])
    lines += shown[:2] + [mark + line[1:] for mark, line in zip(marks, shown[2 : 2 + split], strict=True)]
    if others:
        what = ", ".join(dict.fromkeys(row.run.rung.model for row in others))
        lines += [*sentence(f"other models ({what}), whose difference is no error:"), *shown[2 + split :]]
    return lines


def reference_words(trade: CaseTrade) -> str:
    """What the errors are distances from, and how small ones it can tell."""
    reference = trade.reference
    if reference is None or reference.measurement is None:
        return "no setting gave a result, so there is no reference"
    words = f"{RELATIVE} {reference.name}"
    if not trade.verified:
        words += ", which is NOT VERIFIED"
    elif reference.name != REFERENCE:
        words += f", the sharpest that is verified ({REFERENCE} is not)"
    if reference.measurement.verdict != "answer":
        return f"{words.replace(RELATIVE, 'all are held against')}: {verdict_words(reference.measurement)}"
    return f"{words}, good to {small(trade.resolution)}{_range_words(reference.measurement)}"


def _range_words(reference: Measurement) -> str:
    """Where the mechanism of the reference allows of several load factors, a distance may be another of them."""
    low, high = reference.range_lower, reference.range_upper
    if math.isnan(low) or math.isnan(high) or range_is_a_point((low, high)):
        return ""
    return f"; its mechanism allows of load factors from {number(low)} to {number(high)}, all within the joint law"


def verdict_words(measurement: Measurement) -> str:
    """Why there is no figure."""
    if measurement.verdict == "locked_in":
        return "stands only by self-stress"
    return status_name(Status(measurement.status))


def mark_words(row: Row) -> str:
    """What the last column says of a rung."""
    measurement = row.measurement
    if measurement is None:
        return ""
    words: list[str] = []
    if measurement.verdict == "locked_in":
        words.append(verdict_words(measurement))
    elif measurement.status != Status.SOLVED:
        words.append(status_name(Status(measurement.status)))
    if not measurement.verified and measurement.status in (Status.SOLVED, Status.NO_EQUILIBRIUM, Status.UNBOUNDED):
        words.append("not verified")
    return ", ".join(words)


def error_words(trade: CaseTrade, row: Row) -> str:
    """The distance; ``<1e-9`` where it is less than can be told."""
    if row.reference:
        return "ref."
    if math.isnan(row.distance):
        return "-"
    if row.measurement is not None and row.measurement.verdict != "answer":
        return "same"
    return f"<{small(trade.resolution)}" if row.distance < trade.resolution else small(row.distance)


def aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    """Columns as wide as they need, figures to the right."""
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    return [
        (INDENT + "  ".join(f"{cell:<{w}}" if i in LEFT else f"{cell:>{w}}" for i, (cell, w) in
                            enumerate(zip(row, widths, strict=True)))).rstrip()
        for row in rows
    ]  # fmt: skip


def _wrapped(rows: Sequence[Row], trade: CaseTrade) -> tuple[list[list[str]], list[str]]:
    """Cells of rows, a long name on lines of its own below its first, and what stands before each line."""
    body: list[list[str]] = []
    marks: list[str] = []
    for row in rows:
        first, *more = textwrap.wrap(row.name, NAME, subsequent_indent=INDENT, break_on_hyphens=False) or [row.name]
        body.append([first, *_cells(trade, row)])
        body += [[part, *[""] * (len(HEAD) - 1)] for part in more]
        marks += [FRONT if row.front else " ", *[" "] * len(more)]
    return body, marks


def _cells(trade: CaseTrade, row: Row) -> list[str]:
    measurement = row.measurement
    assert measurement is not None
    return [
        _seconds(measurement.wall),
        _seconds(measurement.solver),
        str(measurement.iterations),
        _megabytes(measurement.memory),
        number(measurement.answer),
        error_words(trade, row),
        _bound(measurement.lower_bound if measurement.kind != "reaction" else measurement.upper_bound),
        _bound(measurement.upper_bound if measurement.kind != "reaction" else measurement.lower_bound),
        small(measurement.residual),
        mark_words(row),
    ]


def _seconds(value: float) -> str:
    """``0.012``, ``1.234``, ``12.3``, ``1234``."""
    digits = 3 if value < 10.0 else 1 if value < 1000.0 else 0
    return "-" if math.isnan(value) else f"{value:.{digits}f}"


def _megabytes(size: float) -> str:
    return "-" if math.isnan(size) else f"{size / 1e6:.{1 if size < 1e8 else 0}f}"


def _bound(value: float) -> str:
    return "-" if math.isnan(value) else number(value)


def _kind(rows: Sequence[Row]) -> tuple[str, str]:
    """Heading of the column of the answer, in two lines."""
    first = rows[0].measurement
    assert first is not None
    return ("load", "factor") if first.kind == "load factor" else (first.kind, first.unit)


def _positions(trade: CaseTrade) -> str:
    count = max((row.measurement.positions for row in trade.rows if row.measurement is not None), default=1)
    return f", the worst of {counted(count, 'position')}" if count > 1 else ""


def _unmeasured(study: Study) -> Iterator[str]:
    """Rungs that gave nothing or not everything, with the reason; those of one reason together."""
    reasons: dict[str, list[str]] = {}
    for run in study.runs:
        if run.end != "done":
            reasons.setdefault(_reason(run), []).append(run.rung.name)
    for reason, names in reasons.items():
        yield from sentence(f"{', '.join(names)}: {reason}")
    if reasons:
        yield ""


def _reason(run: RungRun) -> str:
    told = run.words.startswith(("the same as ", "applies to "))
    lead = {
        "unfit": "" if told else "does not apply",
        "failed": "failed",
        "died": "broke off",
        "not run": "not run",
    }.get(run.end, "")
    done = f" (after {counted(len(run.measurements), 'load case')})" if run.measurements else ""
    return (f"{lead}: {run.words}" if lead else run.words) + done


def _of_case(study: Study, row: int) -> str:
    if len(study.trades) == 1:
        return ""
    return f"{study.trades[row].name}: " if row < len(study.trades) else "All load cases: "
