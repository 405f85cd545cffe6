"""The sweeps under decks/sweeps: their points, solved in this process, and the whole of them as ``mbla sweep`` does."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from mbla.sweeps.command import Finished, Prepared, SweepOptions, prepare, run_sweep
from mbla.sweeps.design.design import Design
from mbla.sweeps.engine.child import PointRunner
from mbla.sweeps.file.read import read_sweep
from mbla.sweeps.plan import Plain
from tests.decks.folder import DECKS

SWEEPS = DECKS / "sweeps"
NAMES = tuple(sorted(path.stem for path in SWEEPS.glob("*.yaml")))

Row = Mapping[str, Plain]
"""a point: its parameters, state and results by name"""


def sweep_path(name: str) -> Path:
    """The sweep file of that name."""
    return SWEEPS / f"{name}.yaml"


@cache
def prepared_sweep(name: str, overrides: tuple[str, ...] = ()) -> Prepared:
    """A sweep that could begin; ``overrides`` are ``key.path=value`` of its deck, for every point."""
    return prepare(read_sweep(sweep_path(name), overrides), SweepOptions())


def values_of_points(design: Design) -> list[dict[str, Plain]]:
    """Parameters of each point by name, with its number."""
    names = [column.name for column in design.columns]
    return [{"point": point.number, **dict(zip(names, point.values, strict=True))} for point in design.points]


def solve_some(prepared: Prepared, chosen: Callable[[Row], bool]) -> list[Row]:
    """Those points of a sweep that are chosen by their parameters, solved one after the other in this process."""
    runner = PointRunner(prepared.plan)
    tasks = {task.key: task for task in prepared.tasks}
    rows: list[Row] = []
    for key, values in zip(prepared.keys, values_of_points(prepared.design), strict=True):
        if chosen(values):
            outcome = runner.run(tasks[key])
            rows.append({**values, "state": outcome.state, "reason": outcome.reason, **outcome.results})
    return rows


@cache
def whole_sweep(name: str) -> tuple[Finished, Sequence[Row]]:
    """A sweep as ``mbla sweep`` runs it, with its points."""
    with TemporaryDirectory() as folder:
        options = SweepOptions(folder=Path(folder) / "out")
        finished = run_sweep(prepare(read_sweep(sweep_path(name)), options), options)
    table = finished.table
    columns = {column.name: table[column.name].tolist() for column in table.columns}
    return finished, [dict(zip(columns, values, strict=True)) for values in zip(*columns.values(), strict=True)]


def number(row: Row, name: str) -> float:
    """A value that is a number."""
    value = row[name]
    assert isinstance(value, int | float), f"{name} = {value!r}"
    return float(value)
