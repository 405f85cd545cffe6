"""Tables of sweeps made by hand."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import product
from typing import Any

import numpy as np

from mbla.sweeps.design.design import DesignDimension
from mbla.sweeps.tables.sweep_table import SweepColumn, SweepTable

UNITS = {"thickness": "m", "azimuth": "degree"}
FAILED = {"status": "numerical_error", "load_factor": None, "mechanism.class": None}
FALLEN = {"status": "no_equilibrium", "load_factor": None, "mechanism.class": None}
UNBOUNDED = {"status": "unbounded", "load_factor": None, "mechanism.class": None}
Row = Mapping[str, Any]


def grid(levels: Mapping[str, Sequence[Any]], solve: Callable[..., Row | float], **changes: Any) -> SweepTable:
    """Every value of each parameter with every value of the others; ``azimuth`` and ``to_azimuth`` are directions."""
    rows = [dict(zip(levels, values, strict=True)) for values in product(*levels.values())]
    position = list(product(*(range(len(values)) for values in levels.values())))
    dimensions = [(name, len(values)) for name, values in levels.items()]
    own = {name: name for name in levels}
    return table_of(rows, solve, dimensions, position, own, **changes)


def sample(
    draws: Mapping[str, Sequence[Any]], solve: Callable[..., Row | float], sampling: str = "random", **changes: Any
) -> SweepTable:
    """Points that change several parameters together, drawn from distributions unless ``samples`` says otherwise."""
    rows = [dict(zip(draws, values, strict=True)) for values in zip(*draws.values(), strict=True)]
    position = [(i,) for i in range(len(rows))]
    changes = {"samples": sampling, "sampling": sampling} | changes
    own = dict.fromkeys(draws, sampling)
    return table_of(rows, solve, [(sampling, len(rows))], position, own, **changes)


def sphere(
    directions: Sequence[tuple[float, float]], levels: Mapping[str, Sequence[Any]], solve: Callable[..., Row | float]
) -> SweepTable:
    """Azimuths and elevations over a sphere, each with every value of the other parameters."""
    places = list(product(range(len(directions)), *(range(len(values)) for values in levels.values())))
    rows = [
        {"to_azimuth": directions[first][0], "to_elevation": directions[first][1]}
        | {name: values[i] for (name, values), i in zip(levels.items(), rest, strict=True)}
        for first, *rest in places
    ]
    dimensions = [("to", len(directions)), *((name, len(values)) for name, values in levels.items())]
    own = {"to_azimuth": "to", "to_elevation": "to"} | {name: name for name in levels}
    return table_of(rows, solve, dimensions, places, own)


def table_of(
    rows: Sequence[Mapping[str, Any]],
    solve: Callable[..., Row | float],
    dimensions: Sequence[tuple[str, int]],
    position: Sequence[tuple[int, ...]],
    dimension_of: Mapping[str, str],
    *,
    samples: str = "",
    sampling: str = "",
    title: str = "Arch on spreading supports",
) -> SweepTable:
    """A table of rows of the design, each solved by a function of its values."""
    results = [_result(solve(**row)) for row in rows]
    parts: list[tuple[SweepColumn, Any]] = [(_column("point", "int", "number"), np.arange(1, len(rows) + 1))]
    for name, dimension in dimension_of.items():
        values = [row[name] for row in rows]
        angle = name.rpartition("_")[2]
        role = angle if angle in ("azimuth", "elevation") else "parameter"
        kind = _kind(values)
        parts.append((_column(name, kind, role, dimension, random=dimension == samples), _values(kind, values)))
    states = [None if r["status"] is None else "failed" if r["status"] in NO_ANSWER else "done" for r in results]
    parts.append((_column("state", "text", "state"), _values("text", states)))
    for name in results[0]:
        values = [result[name] for result in results]
        kind = "text" if name in ("status", "mechanism.class") else _kind(values)
        parts.append((_column(name, kind, "result", case="push", path=name), _values(kind, values)))
    return SweepTable(
        title, tuple(column for column, _ in parts), tuple(values for _, values in parts),
        tuple(DesignDimension(*each) for each in dimensions), np.array(position).reshape(len(rows), len(dimensions)),
        samples=samples, sampling=sampling,
    )  # fmt: skip


NO_ANSWER = ("numerical_error", "not_verified", "iteration_limit", "time_limit")


def _result(result: Row | float) -> Row:
    if isinstance(result, Mapping):
        return result
    return {"status": "solved", "load_factor": float(result), "mechanism.class": "hinging"}


def _kind(values: Sequence[Any]) -> str:
    known = [value for value in values if value is not None]
    if all(isinstance(value, bool) for value in known) and known:
        return "bool"
    return "text" if any(isinstance(value, str) for value in known) else "float"


def _values(kind: str, values: Sequence[Any]) -> Any:
    if kind == "float":
        return np.array([np.nan if value is None else value for value in values], dtype=float)
    if kind == "bool":
        return np.ma.masked_array([bool(value) for value in values], [value is None for value in values])
    array = np.empty(len(values), dtype=object)
    array[:] = list(values)
    return array


def _column(name: str, kind: str, role: str, dimension: str = "", **changes: Any) -> SweepColumn:
    return SweepColumn(name, UNITS.get(name, ""), name, kind, role, dimension, **changes)
