"""Distances from the reference, the Pareto front and the advice, load case by load case.

The reference is ``accuracy: reference`` where it is verified, else the verified rung of the deck's own model that is
good to the least share; its own accuracy is the resolution below which distances cannot be told apart. On the front are
the verified rungs of the same model of which no other is both as fast and as near. Nothing that is not verified, and no
other model, is ever on the front or advised: the difference of another model is no error.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from mbla.solution.solution import Status
from mbla.sweeps.measure.measurement import NAN, Measurement
from mbla.sweeps.tradeoff.ladder_run import RungRun
from mbla.sweeps.tradeoff.rung import REFERENCE
from mbla.sweeps.tradeoff.series import joined

ROUNDING = 1e-12
"""least resolution: rounding of figures that are the same"""


@dataclass(frozen=True)
class Row:
    """One rung under one load case.

    measurement : None where the rung gave none
    positions   : of a travelling load, in their order; the measurement alone for other load cases
    distance    : relative, from the reference, the largest of all positions; 0 where both say that there is no load
                  factor; nan where the two cannot be compared
    front       : on the Pareto front
    reference   : is the reference
    """

    run: RungRun
    measurement: Measurement | None
    positions: tuple[Measurement, ...]
    distance: float = NAN
    front: bool = False
    reference: bool = False

    @property
    def name(self) -> str:
        """Of the rung."""
        return self.run.rung.name

    @property
    def sound(self) -> bool:
        """Verified, of the deck's own model, and comparable with the reference: may be on the front and be advised."""
        verified = self.measurement is not None and self.measurement.verified
        return verified and not self.run.rung.model and not math.isnan(self.distance)


@dataclass(frozen=True)
class CaseTrade:
    """The trade of one load case.

    resolution : distances below this are none that can be told
    verified   : the reference is verified
    """

    name: str
    rows: tuple[Row, ...]
    resolution: float
    verified: bool

    @property
    def reference(self) -> Row | None:
        """The row that the others are held against."""
        return next((row for row in self.rows if row.reference), None)

    @property
    def has_figure(self) -> bool:
        """Whether the reference has a load factor; else it has but a verdict (unbounded, no equilibrium)."""
        reference = self.reference
        return reference is not None and reference.measurement is not None and reference.measurement.verdict == "answer"

    def error(self, row: Row) -> float:
        """Distance of a row, at least what can be told; nan where it has none."""
        return NAN if math.isnan(row.distance) else max(row.distance, self.resolution)


def case_trades(cases: Sequence[tuple[str, int]], runs: Sequence[RungRun]) -> tuple[CaseTrade, ...]:
    """The trade of every load case.

    cases : name, and number of its positions where the load travels, else 0
    """
    return tuple(_trade(name, count, runs) for name, count in cases)


def _trade(name: str, positions: int, runs: Sequence[RungRun]) -> CaseTrade:
    rows = [_row(run, name, positions) for run in runs]
    chosen = _reference(rows)
    if chosen is None or chosen.measurement is None:
        return CaseTrade(name, tuple(rows), NAN, verified=False)
    accuracy = chosen.measurement.accuracy
    sharp = _is_sharp(chosen.measurement)
    resolution = max(ROUNDING, 0.0 if math.isnan(accuracy) else accuracy)
    placed = [
        Row(row.run, row.measurement, row.positions, _distance(row, chosen), False, row is chosen) for row in rows
    ]
    front = on_front([_point(row, resolution) if sharp and row.sound else None for row in placed])
    rows = [
        Row(row.run, row.measurement, row.positions, row.distance, best, row.reference)
        for row, best in zip(placed, front, strict=True)
    ]
    return CaseTrade(name, tuple(rows), resolution, sharp)


def _point(row: Row, resolution: float) -> tuple[float, float] | None:
    """Time and error of a row."""
    return None if row.measurement is None else (row.measurement.wall, max(row.distance, resolution))


def _row(run: RungRun, name: str, positions: int) -> Row:
    """All positions of a travelling load must be there, else there is no measurement of it."""
    if not positions:
        own = tuple(each for each in run.measurements if each.case == name)
        return Row(run, own[0] if own else None, own)
    own = tuple(each for each in run.measurements if each.series == name)
    return Row(run, joined(own) if len(own) == positions else None, own)


def _reference(rows: Sequence[Row]) -> Row | None:
    """The preset if it is verified, else the sharpest that is, else the sharpest that has an answer at all."""
    own = [row for row in rows if row.measurement is not None and not row.run.rung.model]
    verified = [row for row in own if row.measurement is not None and _is_sharp(row.measurement)]
    for row in verified:
        if row.name == REFERENCE:
            return row
    answers = [row for row in own if row.measurement is not None and row.measurement.verdict == "answer"]
    return min(verified or answers, key=_sharpness, default=None)


def _is_sharp(measurement: Measurement) -> bool:
    """Verified and not only as sharply as a draft asks for: others may be held against it."""
    return measurement.verified and measurement.status != Status.APPROXIMATE


def _sharpness(row: Row) -> float:
    assert row.measurement is not None
    accuracy = row.measurement.accuracy
    return math.inf if math.isnan(accuracy) else accuracy


def _distance(row: Row, reference: Row) -> float:
    """The largest over all positions; nan as soon as one cannot be compared."""
    if row.measurement is None or len(row.positions) != len(reference.positions):
        return NAN
    pairs = zip(row.positions, reference.positions, strict=True)
    distances = [distance(one, other) for one, other in pairs]
    return NAN if any(math.isnan(each) for each in distances) else max(distances, default=NAN)


def distance(measurement: Measurement, reference: Measurement) -> float:
    """Relative difference of two answers; 0 where both confirm that there is none, nan where only one has one."""
    if measurement.kind != reference.kind:
        return NAN
    if measurement.verdict != reference.verdict:
        return NAN
    if measurement.verdict != "answer":
        return 0.0 if measurement.verified and reference.verified else NAN
    size = max(abs(reference.answer), reference.least) or abs(measurement.answer)
    return abs(measurement.answer - reference.answer) / size if size > 0.0 else 0.0


def on_front(points: Sequence[tuple[float, float] | None]) -> list[bool]:
    """Whether of each point (time, error) no other is at least as good in both and better in one; None is never.

    Of points that are the same in both every one is on the front.
    """
    known = [point for point in points if point is not None]

    def best(point: tuple[float, float]) -> bool:
        return not any(other[0] <= point[0] and other[1] <= point[1] and other != point for other in known)

    return [point is not None and best(point) for point in points]
