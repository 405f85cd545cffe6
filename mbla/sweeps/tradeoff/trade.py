"""Distances from the reference, the Pareto front and the advice, load case by load case.

The reference is ``accuracy: reference`` where it is verified, else the verified setting of the deck's own model that is
good to the least share; its own accuracy is the resolution below which distances cannot be told apart. On the front are
the verified settings of the same model of which no other is both as fast and as near. Nothing that is not verified, and
no other model, is ever on the front or advised: the difference of another model is no error.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from mbla.results.listing.text import small
from mbla.solution.solution import Status
from mbla.sweeps.tradeoff.ladder import REFERENCE, Rung

NAN = math.nan
ROUNDING = 1e-12
"""least resolution: rounding of figures that are the same"""
VERDICTS = (Status.NO_EQUILIBRIUM, Status.UNBOUNDED)
"""statuses that are an answer without a figure, once verified"""
SAME_TIME = 0.1
"""share of time that another run of the same may differ by: a preset is preferred to a single knob within it"""
SAME_SECONDS = 0.03
"""seconds that it may differ by however short it is, as the system does other things meanwhile"""
PRESETS = ("accuracy: standard", "accuracy: draft", "accuracy: reference")
"""the one that needs no word in the deck first"""


@dataclass(frozen=True)
class Row:
    """What one setting gave for one load case, a travelling load by its worst position; nan where there is no figure.

    state    : ``done``, ``failed``, ``unfit``, ``not run``, ``interrupted`` or ``terminated``; of the setting
    reason   : why it is not done, or why the case has no answer
    status   : of the load case; empty where it was not solved
    verified : as sharply as the setting asks for, or that there is no load factor
    answer   : load factor, angle of a tilting table, or reaction of a support that gives way
    accuracy : what the answer is good to, relatively: the gap of the bounds, or the largest residual
    lower, upper : proved bounds of associative flow, in the unit of the answer
    ends     : of the verified range of load factors
    seconds, solver : of the load case by the clock, and of the programs in it
    distance : relative, from the reference; 0 where both say that there is no load factor
    front    : on the Pareto front
    reference : is the reference
    """

    rung: Rung
    state: str = "done"
    reason: str = ""
    status: str = ""
    verified: bool = False
    answer: float = NAN
    accuracy: float = NAN
    residual: float = NAN
    lower: float = NAN
    upper: float = NAN
    ends: tuple[float, float] = (NAN, NAN)
    iterations: int = 0
    seconds: float = NAN
    solver: float = NAN
    distance: float = NAN
    front: bool = False
    reference: bool = False

    @property
    def name(self) -> str:
        """Of the setting."""
        return self.rung.name

    @property
    def verdict(self) -> str:
        """``answer``, or why there is none: the status, or ``locked_in`` where it stands only by self-stress."""
        if not math.isnan(self.answer):
            return "answer"
        return "locked_in" if self.status == Status.SOLVED else self.status

    @property
    def sound(self) -> bool:
        """Verified, of the deck's own model, and comparable with the reference: may be on the front and be advised."""
        return self.verified and not self.rung.model and not math.isnan(self.distance)


@dataclass(frozen=True)
class CaseTrade:
    """The trade of one load case.

    kind, unit : of the answer: ``load factor``, ``angle`` or ``reaction``
    resolution : distances below this are none that can be told
    verified   : the reference is verified
    """

    name: str
    rows: tuple[Row, ...]
    resolution: float
    verified: bool
    kind: str = "load factor"
    unit: str = ""

    @property
    def reference(self) -> Row | None:
        """The row that the others are held against."""
        return next((row for row in self.rows if row.reference), None)

    @property
    def solved(self) -> list[Row]:
        """Rows whose setting gave something."""
        return [row for row in self.rows if row.status]

    @property
    def has_figure(self) -> bool:
        """Whether the reference has an answer; else it has but a verdict (unbounded, no equilibrium)."""
        return self.reference is not None and self.reference.verdict == "answer"

    def error(self, row: Row) -> float:
        """Distance of a row, at least what can be told; nan where it has none."""
        return NAN if math.isnan(row.distance) else max(row.distance, self.resolution)


def case_trade(
    name: str, rows: Sequence[Row], least: float = 0.0, kind: str = "load factor", unit: str = ""
) -> CaseTrade:
    """The trade of one load case from its rows, which have no distances yet.

    least : size below which differences of answers are relative to this
    """
    chosen = _reference(rows)
    if chosen is None:
        return CaseTrade(name, tuple(rows), NAN, False, kind, unit)
    resolution = max(ROUNDING, 0.0 if math.isnan(chosen.accuracy) else chosen.accuracy)
    placed = [replace(row, distance=distance(row, chosen, least), reference=row is chosen) for row in rows]
    sharp = _is_sharp(chosen)
    points = [(row.seconds, max(row.distance, resolution)) if sharp and row.sound else None for row in placed]
    marked = [replace(row, front=best) for row, best in zip(placed, on_front(points), strict=True)]
    return CaseTrade(name, tuple(marked), resolution, sharp, kind, unit)


def _reference(rows: Sequence[Row]) -> Row | None:
    """The preset if it is verified, else the sharpest that is, else the sharpest that has an answer at all."""
    own = [row for row in rows if row.status and not row.rung.model]
    verified = [row for row in own if _is_sharp(row)]
    preset = next((row for row in verified if row.name == REFERENCE), None)
    answers = [row for row in own if row.verdict == "answer"]
    return preset or min(verified or answers, key=_sharpness, default=None)


def _is_sharp(row: Row) -> bool:
    """Verified and not only as sharply as a draft asks for: others may be held against it."""
    return row.verified and row.status != Status.APPROXIMATE


def _sharpness(row: Row) -> float:
    return math.inf if math.isnan(row.accuracy) else row.accuracy


def distance(row: Row, reference: Row, least: float = 0.0) -> float:
    """Relative difference of two answers; 0 where both confirm that there is none, nan where only one has one."""
    if not row.status or row.verdict != reference.verdict:
        return NAN
    if row.verdict != "answer":
        return 0.0 if row.verified and reference.verified else NAN
    size = max(abs(reference.answer), least) or abs(row.answer)
    return abs(row.answer - reference.answer) / size if size > 0.0 else 0.0


def on_front(points: Sequence[tuple[float, float] | None]) -> list[bool]:
    """Whether of each point (time, error) no other is at least as good in both and better in one; None is never.

    Of points that are the same in both every one is on the front.
    """
    known = [point for point in points if point is not None]

    def best(point: tuple[float, float]) -> bool:
        return not any(other[0] <= point[0] and other[1] <= point[1] and other != point for other in known)

    return [point is not None and best(point) for point in points]


# --- advice -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Advice:
    """What is advised.

    rung    : the setting; None where none can be advised
    seconds : that it takes, all load cases of the advice together
    error   : largest distance from the reference; nan without a setting
    sentence: the advice, or why there is none
    """

    rung: Rung | None
    seconds: float
    error: float
    sentence: str


def advice(trades: Sequence[CaseTrade], wanted: float) -> Advice:
    """For some load cases together: a setting must be sound and near enough under every one of them."""
    lacking = [trade.name for trade in trades if trade.reference is None]
    if lacking:
        return _none(f"No setting can be advised: there is no reference for {', '.join(lacking)}.")
    unsure = [trade.name for trade in trades if not trade.verified]
    if unsure:
        return _none(f"No setting can be advised: no setting is verified for {', '.join(unsure)}.")
    coarse = max(trade.resolution for trade in trades)
    if coarse > wanted:
        return _none(
            f"No setting can be advised for an error of {_digits(wanted)}: the reference itself is good to "
            f"{small(coarse)}."
        )
    candidates = [one for rows in zip(*(trade.rows for trade in trades), strict=True) if (one := _candidate(rows))]
    fit = [each for each in candidates if each.error <= wanted]
    fastest = min((each.seconds for each in fit), default=math.inf)
    enough = max((1.0 + SAME_TIME) * fastest, fastest + SAME_SECONDS * len(trades))
    near = {each.rung.name: each for each in fit if each.rung is not None and each.seconds <= enough}
    preset = next((near[name] for name in PRESETS if name in near), None)
    chosen = preset or min(near.values(), key=lambda each: each.seconds)  # the reference is always among those that fit
    usual = next((each for each in candidates if each.rung is not None and each.rung.name == PRESETS[0]), None)
    figures = any(trade.has_figure for trade in trades)
    return replace(chosen, sentence=_sentence(chosen, usual, wanted, coarse, figures=figures))


def _candidate(rows: Sequence[Row]) -> Advice | None:
    """A setting over all load cases; None where it is not sound under one."""
    if not all(row.sound for row in rows):
        return None
    return Advice(rows[0].rung, sum(row.seconds for row in rows), max(row.distance for row in rows), "")


def _sentence(chosen: Advice, usual: Advice | None, wanted: float, coarse: float, *, figures: bool) -> str:
    """``figures``: a load case has one; others have the same verdict in the reference and in all that is advised."""
    assert chosen.rung is not None
    if not figures:
        reached = "it comes to the same verdict as the reference"
    elif chosen.error > coarse:
        reached = f"{small(chosen.error)} from the reference"
    else:
        reached = f"not to be told from the reference, which is good to {small(coarse)}"
    freed = chosen.rung.freed
    without = f" without {', '.join(f'analysis.{name}' for name in freed)}" if freed else ""
    other = usual is not None and usual.rung != chosen.rung
    beside = f"; {PRESETS[0]} {duration(usual.seconds)}" if usual is not None and other else ""
    take = f"For an error of {_digits(wanted)} take" if figures else "Take"
    return f"{take} {chosen.rung.name}{without} ({duration(chosen.seconds)}{beside}): {reached}."


def _none(sentence: str) -> Advice:
    return Advice(None, NAN, NAN, sentence)


def _digits(value: float) -> str:
    """``1e-4``, ``0.02``."""
    text = f"{value:.3g}" if value >= 0.01 else f"{value:.2e}"
    mantissa, _, exponent = text.partition("e")
    return f"{float(mantissa):g}e{int(exponent)}" if exponent else text


def duration(seconds: float) -> str:
    """``0.81 s``, ``12.3 s``, ``-``."""
    return "-" if math.isnan(seconds) else f"{seconds:.3g} s" if seconds < 1000.0 else f"{seconds:.0f} s"
