"""decks/tradeoff/measured.csv: a row for each structure, flow rule and rung, with date, versions and machine."""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from mbla.sweeps.tradeoff.study import Study
from mbla.sweeps.tradeoff.trade import Row
from tests.performance.standard_set import FLOW_RULES, STANDARD_SET, Structure

FOLDER = Path(__file__).parents[2] / "decks" / "tradeoff"
MEASURED = FOLDER / "measured.csv"
NAN = math.nan


@dataclass(frozen=True)
class Entry:
    """One row; times in seconds, memory in MB, the other figures as of ``mbla.sweeps.tradeoff.trade.Row``.

    end : ``done``, or why the rung gave nothing
    """

    structure: str
    flow_rule: str
    rung: str
    other_model: str
    end: str
    status: str = ""
    verified: bool = False
    reference: bool = False
    front: bool = False
    load_factor: float = NAN
    distance: float = NAN
    resolution: float = NAN
    static_bound: float = NAN
    kinematic_bound: float = NAN
    residual: float = NAN
    time: float = NAN
    processor_time: float = NAN
    solver_time: float = NAN
    preparation_time: float = NAN
    memory: float = NAN
    programs: int = 0
    iterations: int = 0
    solvers: str = ""
    date: str = ""
    versions: str = ""
    machine: str = ""

    @property
    def error(self) -> float:
        """Distance from the reference, at least what can be told."""
        return NAN if math.isnan(self.distance) else max(self.distance, self.resolution)


def entries_of(study: Study, structure: Structure, rule: str, date: str, versions: str, machine: str) -> list[Entry]:
    """The rows of one study of one load case; rungs that do not apply have none."""
    (trade,) = study.trades
    marks = {"date": date, "versions": versions, "machine": machine}
    return [
        _entry(row, (structure.name, rule), trade.resolution, marks) for row in trade.rows if row.run.end != "unfit"
    ]


def _entry(row: Row, names: tuple[str, str], resolution: float, marks: dict[str, Any]) -> Entry:
    rung, measured = row.run.rung, row.measurement
    start = (*names, rung.name, rung.model, row.run.words or row.run.end)
    if measured is None:
        return Entry(*start, **marks)
    return Entry(
        *start,
        status=measured.status,
        verified=measured.verified,
        reference=row.reference,
        front=row.front,
        load_factor=measured.answer,
        distance=row.distance,
        resolution=resolution,
        static_bound=measured.lower_bound,
        kinematic_bound=measured.upper_bound,
        residual=measured.residual,
        time=measured.wall,
        processor_time=measured.cpu,
        solver_time=measured.solver,
        preparation_time=measured.preparation,
        memory=measured.memory / 1e6,
        programs=measured.programs,
        iterations=measured.iterations,
        solvers=measured.solvers,
        **marks,
    )


def read_entries(path: Path = MEASURED) -> list[Entry]:
    """All rows; none where there is no file."""
    if not path.exists():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return [_parsed(row) for row in csv.DictReader(file)]


def _parsed(row: dict[str, str]) -> Entry:
    values: dict[str, Any] = {}
    for field in fields(Entry):
        text = row[field.name]
        if field.type == "float":
            values[field.name] = float(text) if text else NAN
        elif field.type in ("int", "bool"):
            values[field.name] = int(text) if field.type == "int" else text == "True"
        else:
            values[field.name] = text
    return Entry(**values)


def write_entries(entries: Sequence[Entry], path: Path = MEASURED) -> None:
    """Write all rows, in the order of the standard set; figures get eight digits."""
    order = {(s.name, rule): i for i, (s, rule) in enumerate((s, rule) for s in STANDARD_SET for rule in FLOW_RULES)}
    sorted_entries = sorted(entries, key=lambda entry: order.get((entry.structure, entry.flow_rule), len(order)))
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        names = [field.name for field in fields(Entry)]
        writer.writerow(names)
        for entry in sorted_entries:
            writer.writerow([_cell(getattr(entry, name)) for name in names])


def _cell(value: object) -> object:
    if isinstance(value, float):
        return "" if math.isnan(value) else f"{value:.8g}"
    return value
