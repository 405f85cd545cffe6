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

    status   : of the load case; empty where it was not solved
    verified : as sharply as the setting asks for, or that there is no load factor
    answer   : load factor, angle of a tilting table, or reaction of a support that gives way
    accuracy : what the answer is good to, relatively: the gap of the bounds, or the largest residual
    residual : the largest
    lower, upper : proved bounds of associative flow, in the unit of the answer
    seconds  : of the load case by the clock
    distance : relative, from the reference; 0 where both say that there is no load factor
    front    : on the Pareto front
    """

    rung: Rung
    status: str = ""
    verified: bool = False
    answer: float = NAN
    accuracy: float = NAN
    residual: float = NAN
    lower: float = NAN
    upper: float = NAN
    seconds: float = NAN
    distance: float = NAN
    front: bool = False

    @property
    def verdict(self) -> str:
        """``answer``, or the status without one: ``solved`` is what stands only by self-stress."""
        return self.status if math.isnan(self.answer) else "answer"

    @property
    def sound(self) -> bool:
        """Verified, of the deck's own model, and comparable with the reference: may be on the front and be advised."""
        return self.verified and not self.rung.model and not math.isnan(self.distance)


@dataclass(frozen=True)
class CaseTrade:
    """The trade of one load case.

    reference  : the row that the others are held against, without distance; None where nothing has an answer
    resolution : distances below this are none that can be told
    verified   : the reference is verified
    what       : load factor, or angle or reaction with its unit
    """

    name: str
    rows: tuple[Row, ...]
    reference: Row | None
    resolution: float
    verified: bool
    what: str = "load factor"


def case_trade(name: str, rows: Sequence[Row], least: float = 0.0, what: str = "load factor") -> CaseTrade:
    """The trade of one load case from its rows, which have no distances yet.

    least : size below which differences of answers are relative to this
    """
    chosen = _reference(rows)
    if chosen is None:
        return CaseTrade(name, tuple(rows), None, NAN, False, what)
    resolution = max(ROUNDING, _sharpness(chosen) if math.isfinite(_sharpness(chosen)) else 0.0)
    placed = [replace(row, distance=distance(row, chosen, least)) for row in rows]
    sharp = _is_sharp(chosen)
    points = [(row.seconds, max(row.distance, resolution)) if sharp and row.sound else None for row in placed]
    marked = [replace(row, front=best) for row, best in zip(placed, on_front(points), strict=True)]
    return CaseTrade(name, tuple(marked), chosen, resolution, sharp, what)


def _reference(rows: Sequence[Row]) -> Row | None:
    """The preset if it is verified, else the sharpest that is, else the sharpest that has an answer at all."""
    own = [row for row in rows if row.status and not row.rung.model]
    verified = [row for row in own if _is_sharp(row)]
    preset = next((row for row in verified if row.rung.name == REFERENCE), None)
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


@dataclass(frozen=True)
class Advice:
    """What is advised.

    rung    : the setting; None where none can be advised
    seconds : that it takes, all load cases of the advice together
    error   : largest distance from the reference
    sentence: the advice, or why there is none
    """

    rung: Rung | None
    seconds: float
    error: float
    sentence: str


def advice(trades: Sequence[CaseTrade], wanted: float) -> Advice:
    """For some load cases together: a setting must be sound and near enough under every one of them."""
    unsure = [trade.name for trade in trades if not trade.verified]
    if unsure:
        return _none(f"no setting is verified for {', '.join(unsure)}")
    coarse = max(trade.resolution for trade in trades)
    if coarse > wanted:
        return _none(f"an error of {wanted:g} is asked for, and the reference itself is good to {small(coarse)}")
    fit = [one for rows in zip(*(trade.rows for trade in trades), strict=True) if (one := _candidate(rows, wanted))]
    fastest = min(each.seconds for each in fit)  # the reference is always among them
    enough = max((1.0 + SAME_TIME) * fastest, fastest + SAME_SECONDS * len(trades))
    near = {each.rung.name: each for each in fit if each.rung is not None and each.seconds <= enough}
    chosen = next((near[name] for name in PRESETS if name in near), min(fit, key=lambda each: each.seconds))
    assert chosen.rung is not None
    words = " without ".join([chosen.rung.name, *(f"analysis.{name}" for name in chosen.rung.without)])
    near_to = small(max(chosen.error, coarse))
    sentence = f"For an error of {wanted:g} take {words} ({chosen.seconds:.3g} s, within {near_to} of the reference)."
    return replace(chosen, sentence=sentence)


def _candidate(rows: Sequence[Row], wanted: float) -> Advice | None:
    """A setting over all load cases; None where it is not sound under one, or too far from the reference."""
    error = max(row.distance for row in rows)
    fits = all(row.sound for row in rows) and error <= wanted
    return Advice(rows[0].rung, sum(row.seconds for row in rows), error, "") if fits else None


def _none(why: str) -> Advice:
    return Advice(None, NAN, NAN, f"No setting can be advised: {why}.")
