"""The study in words for a terminal: a table for each load case, what was not run, and the advice."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from mbla.results.listing.answers import status_name
from mbla.results.listing.text import number, sentence, small, table
from mbla.results.outcome import range_is_a_point
from mbla.solution.solution import Status
from mbla.sweeps.plan import DONE
from mbla.sweeps.tradeoff.ladder import REFERENCE
from mbla.sweeps.tradeoff.trade import VERDICTS, CaseTrade, Row

if TYPE_CHECKING:
    from mbla.sweeps.tradeoff.study import Tradeoff

HEAD = ("setting", "time", "solve", "iter", "answer", "error", "lower", "upper", "resid.", "")
RELATIVE = "errors are relative to"
FRONT = "* "
"""before the setting: on the Pareto front"""
LEGEND = (
    "time: a load case by the clock, in seconds; solve: its share in solvers; error: distance from the reference; "
    "lower, upper: proved bounds of associative flow; resid.: largest, recomputed; *: no verified setting of the same "
    "model is both faster and nearer"
)


def study_lines(study: Tradeoff) -> list[str]:
    """Everything that the terminal shows."""
    lines = study.heading_lines
    for trade in study.trades:
        lines += ["", *trade_lines(trade)]
    if any(trade.solved for trade in study.trades):
        lines += ["", *sentence(LEGEND)]
    lines += ["", *_unsolved(study.trades[0].rows)]
    names = [f"{trade.name}: " for trade in study.trades] + ["All load cases: "]
    for name, one in zip(names if len(study.trades) > 1 else [""], study.advices, strict=True):
        lines += sentence(name + one.sentence)
    return lines


def trade_lines(trade: CaseTrade) -> list[str]:
    """The table of one load case; other models below, as their difference is no error."""
    lines = sentence(f"load case {trade.name}: {reference_words(trade)}")
    answer = trade.kind + (f" [{trade.unit}]" if trade.unit else "")
    head = [answer if name == "answer" else name for name in HEAD]
    own = [row for row in trade.solved if not row.rung.model]
    others = [row for row in trade.solved if row.rung.model]
    if own:
        lines += table(head, [_cells(trade, row) for row in own])
    if others:
        what = ", ".join(dict.fromkeys(row.rung.model for row in others))
        lines += sentence(f"other models ({what}), whose difference is no error:")
        lines += table(head, [_cells(trade, row) for row in others])
    return lines


def reference_words(trade: CaseTrade) -> str:
    """What the errors are distances from, and how small ones it can tell."""
    reference = trade.reference
    if reference is None:
        return "no setting gave a result, so there is no reference"
    words = f"{RELATIVE} {reference.name}"
    if not trade.verified:
        words += ", which is NOT VERIFIED"
    elif reference.name != REFERENCE:
        words += f", the sharpest that is verified ({REFERENCE} is not)"
    if reference.verdict != "answer":
        return f"{words.replace(RELATIVE, 'all are held against')}: {verdict_words(reference)}"
    words += f", good to {small(trade.resolution)}"
    low, high = reference.ends
    if math.isnan(low) or math.isnan(high) or range_is_a_point((low, high)):
        return words
    return f"{words}; admissible load factors for its mechanism: {number(low)} to {number(high)}"


def verdict_words(row: Row) -> str:
    """Why there is no figure."""
    return "stands only by self-stress" if row.verdict == "locked_in" else status_name(Status(row.status))


def mark_words(row: Row) -> str:
    """What the last column says of a setting."""
    words = [verdict_words(row)] if row.verdict == "locked_in" or row.status != Status.SOLVED else []
    if not row.verified and row.status in (Status.SOLVED, *VERDICTS):
        words.append("not verified")
    return ", ".join(words)


def error_words(trade: CaseTrade, row: Row) -> str:
    """The distance; ``<1e-9`` where it is less than can be told."""
    if row.reference:
        return "ref."
    if math.isnan(row.distance):
        return "-"
    if row.verdict != "answer":
        return "same"
    return f"<{small(trade.resolution)}" if row.distance < trade.resolution else small(row.distance)


def _cells(trade: CaseTrade, row: Row) -> list[str]:
    return [
        (FRONT if row.front else "  ") + row.name,
        _seconds(row.seconds),
        _seconds(row.solver),
        str(row.iterations),
        number(row.answer),
        error_words(trade, row),
        number(row.lower),
        number(row.upper),
        small(row.residual),
        mark_words(row),
    ]


def _seconds(value: float) -> str:
    """``0.012``, ``12.3``, ``1234``."""
    return "-" if math.isnan(value) else f"{value:.{3 if value < 10.0 else 1 if value < 1000.0 else 0}f}"


def _unsolved(rows: Sequence[Row]) -> Iterator[str]:
    """Settings that gave nothing or not everything, with the reason; those of one reason together."""
    reasons: dict[str, list[str]] = {}
    for row in rows:
        if row.state != DONE:
            same = row.reason.startswith(("the same as ", "applies to "))
            lead = "does not apply: " if row.state == "unfit" and not same else ""
            reasons.setdefault(f"{lead}{row.reason}", []).append(row.name)
    for reason, names in reasons.items():
        yield from sentence(f"{', '.join(names)}: {reason}")
    if reasons:
        yield ""
