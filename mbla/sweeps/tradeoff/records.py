"""The study as an object of JSON and as CSV; no number but finite ones, None or an empty cell where there is none."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from typing import Any

from mbla.deck.units import Units
from mbla.results.records.numbers import number
from mbla.sweeps.measure.measurement import NAN, Measurement
from mbla.sweeps.tradeoff.advice import Advice
from mbla.sweeps.tradeoff.study import Study
from mbla.sweeps.tradeoff.trade import CaseTrade, Row, distance

FIGURES = ("wall", "cpu", "solver", "preparation", "memory")
"""what a run took, beside the counts"""


def study_json(study: Study, files: tuple[str, ...] = ()) -> dict[str, Any]:
    """The record that ``--json`` prints and ``STEM_tradeoff.json`` holds."""
    return {
        "mbla": study.provenance["mbla"],
        "deck": study.deck,
        "title": study.title,
        "created": study.created,
        "exit_code": study.exit_code,
        "set": list(study.overrides),
        "flow_rule": study.flow_rule,
        "wanted_error": study.wanted,
        "limits": {
            "time": study.limits.budget,
            "run": study.limits.each,
            "threads": study.limits.threads,
        },
        "units": {"length": study.units.length, "force": study.units.force, "mass": study.units.mass},
        "settings": [
            {
                "name": run.rung.name,
                "set": list(run.rung.setting.overrides),
                "without": [f"analysis.{name}" for name in run.rung.setting.freed],
                "other_model": run.rung.model or None,
                "end": run.end,
                "reason": run.words or None,
            }
            for run in study.runs
        ],
        "cases": [_case_json(trade, study.advices[place]) for place, trade in enumerate(study.trades)],
        "advice": _advice_json(study.advices[-1]),
        "provenance": study.provenance,
        "time": study.seconds,
        "files": list(files),
    }


def _case_json(trade: CaseTrade, advice: Advice) -> dict[str, Any]:
    reference = trade.reference
    return {
        "name": trade.name,
        "reference": None if reference is None else reference.name,
        "reference_verified": trade.verified,
        "resolution": number(trade.resolution),
        "runs": [_row_json(row) for row in trade.rows if row.positions],
        "advice": _advice_json(advice),
    }


def _row_json(row: Row) -> dict[str, Any]:
    record: dict[str, Any] = {"setting": row.name, "distance": number(row.distance), "front": row.front}
    record |= {"reference": row.reference, "other_model": row.run.rung.model or None}
    if row.measurement is not None:
        record |= _measurement_json(row.measurement)
    if row.measurement is None or len(row.positions) > 1:
        record["positions"] = [_measurement_json(each) for each in row.positions]
    return record


def _measurement_json(measurement: Measurement) -> dict[str, Any]:
    values = asdict(measurement)
    return {name: number(value) if isinstance(value, float) else value for name, value in values.items() if value != ""}


def _advice_json(advice: Advice) -> dict[str, Any]:
    return {
        "setting": advice.rung or None,
        "set": list(advice.setting.overrides),
        "without": [f"analysis.{name}" for name in advice.setting.freed],
        "seconds": number(advice.seconds),
        "error": number(advice.error),
        "sentence": advice.sentence,
    }


# --- CSV -------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Line:
    """One line of the table: a rung under a load case; with ``position`` under one position of a travelling load."""

    row: Row
    case: str
    position: str
    measurement: Measurement | None
    distance: float


Cell = Callable[[Line], Any]


def _of(name: str) -> Cell:
    return lambda line: None if line.measurement is None else getattr(line.measurement, name)


def _answer(kind: str, turns: bool | None = None) -> Cell:
    def value(line: Line) -> float:
        found = line.measurement
        moment = found is not None and " " in found.unit
        return NAN if found is None or found.kind != kind or turns not in (None, moment) else found.answer

    return value


def columns(units: Units) -> dict[str, Cell]:
    """Columns with their units, and what fills them."""
    return {
        "case": lambda line: line.case,
        "position": lambda line: line.position,
        "setting": lambda line: line.row.name,
        "set": lambda line: " ".join(line.row.run.rung.setting.overrides),
        "other_model": lambda line: line.row.run.rung.model,
        "end": lambda line: line.row.run.end,
        "end_reason": lambda line: line.row.run.words,
        "status": _of("status"),
        "verified": _of("verified"),
        "reason": _of("reason"),
        "reference": lambda line: line.row.reference,
        "front": lambda line: line.row.front and not line.position,
        "load_factor": _answer("load factor"),
        "angle [degree]": _answer("angle"),
        f"reaction_force [{units.force}]": _answer("reaction", turns=False),
        f"reaction_moment [{units.force} {units.length}]": _answer("reaction", turns=True),
        "distance": lambda line: line.distance,
        "lower_bound": _of("lower_bound"),
        "upper_bound": _of("upper_bound"),
        "accuracy": _of("accuracy"),
        "residual": _of("residual"),
        "range_lower": _of("range_lower"),
        "range_upper": _of("range_upper"),
        "time [s]": _of("wall"),
        "processor_time [s]": _of("cpu"),
        "solver_time [s]": _of("solver"),
        "preparation_time [s]": _of("preparation"),
        "memory [MB]": lambda line: NAN if line.measurement is None else line.measurement.memory / 1e6,
        "programs": _of("programs"),
        "iterations": _of("iterations"),
        "solvers": _of("solvers"),
        "repeats": _of("repeats"),
    }


def study_csv(study: Study) -> str:
    """A line for each rung and load case, and one for each position of a travelling load; as mbla's other tables."""
    cells = columns(study.units)
    stream = io.StringIO(newline="")
    writer = csv.writer(stream, lineterminator="\r\n")
    writer.writerow(cells)
    for line in _lines(study):
        writer.writerow([_plain(of(line)) for of in cells.values()])
    return stream.getvalue()


def _lines(study: Study) -> Iterator[Line]:
    for trade in study.trades:
        reference = trade.reference
        for row in trade.rows:
            yield Line(row, trade.name, "", row.measurement, row.distance)
            if len(row.positions) < 2:
                continue
            others = () if reference is None else reference.positions
            for place, each in enumerate(row.positions):
                apart = distance(each, others[place]) if len(others) == len(row.positions) else NAN
                yield Line(row, trade.name, each.case, each, apart)


def _plain(value: Any) -> Any:
    return None if isinstance(value, float) and math.isnan(value) else value
