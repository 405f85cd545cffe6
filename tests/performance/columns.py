"""What the columns of recorded figures are: which tell the cases of a benchmark apart, and which are times."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Columns:
    """What tells the cases of a benchmark apart, and which of its columns are times, in seconds."""

    case: tuple[str, ...]
    times: tuple[str, ...]


COLUMNS = {
    "all": Columns(("benchmark",), ("processor", "clock")),
    "deck": Columns(("case", "blocks"), ("seconds", "processor_seconds", "events_processor_seconds")),
    "growth": Columns(("family", "flow_rule", "blocks"), ("solver", "total", "clock")),
    "growth_exponents": Columns(("family", "flow_rule", "time"), ()),
    "line": Columns(("structure", "flow_rule"), ("processor", "clock", "outside")),
    "rivals": Columns(("structure", "rival"), ("processor", "clock", "solver")),
    "solver": Columns(("case", "dimension"), ("reducing", "associative", "first_program", "non_associative")),
    "sweep": Columns(("sweep", "way", "points"), ("seconds", "processor_seconds")),
    "sweep_memory": Columns(("workers", "process", "points"), ("processor_seconds",)),
}
"""Benchmarks whose columns do not tell by their names, as those of the others do: see ``columns_of``."""


def columns_of(benchmark: str, header: Sequence[str]) -> Columns:
    """From ``COLUMNS``; else times are the columns of seconds, and the text before the first of them tells the case.

    Raises
    ------
    ValueError
        no column is known to be a time
    """
    if benchmark in COLUMNS:
        return COLUMNS[benchmark]
    times = tuple(name for name in header if name.endswith("seconds"))
    if not times:
        raise ValueError(f"{benchmark}: no column of seconds, and none in COLUMNS of tests/performance/columns.py")
    return Columns(tuple(name for name in header[: header.index(times[0])] if name != "date"), times)
