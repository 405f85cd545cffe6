"""The recorded figures as tables for the README: ratios against rivals, exponents of growth.

::

    python -m tests.performance.tables

Of every case the last recorded row counts. Ratios are seconds of the processor over those of mbla as a whole, in
brackets the error of the load factor, or the answer where there is none.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence

from tests.performance.bench_rivals import LOAD_FACTOR, MEASURE, RIVALS
from tests.performance.compare import Row, read_rows
from tests.performance.recording import RESULTS


def rivals_table(rows: Sequence[Row]) -> Iterator[str]:
    """A line for each structure, a column for each rival; mbla itself in seconds."""
    last = {(row["structure"], row["rival"]): row for row in rows}
    structures = list(dict.fromkeys(row["structure"] for row in rows))
    others = [name for name in RIVALS if name not in MEASURE.values()]
    yield f"| structure | mbla, s | standing, s | {' | '.join(others)} |"
    yield "|---" * (3 + len(others)) + "|"
    for structure in structures:
        seconds = [last.get((structure, own), {}).get("processor", "") for own in MEASURE.values()]
        cells = [_cell(last.get((structure, name)), name) for name in others]
        yield f"| {structure} | {' | '.join(f'{_seconds(s)}' for s in seconds)} | {' | '.join(cells)} |"


def _seconds(text: str) -> str:
    return f"{float(text):.2g}" if text else "–"


def _cell(row: Row | None, rival: str) -> str:
    if row is None:
        return "–"
    ratio = f"{float(row['ratio']):.2g}" if row["ratio"] else "–"
    if row["error"]:
        doubt = "" if row["status"] in ("optimal", "solved") else f", {row['status']}"
        return f"{ratio} ({float(row['error']):.0e}{doubt})"
    if RIVALS[rival].question == LOAD_FACTOR or not row["ratio"]:
        return row["status"]
    return f"{ratio} ({row['status']})"


def exponents_table(rows: Sequence[Row]) -> Iterator[str]:
    """A line for each family and flow rule."""
    last = {(row["family"], row["flow_rule"], row["time"]): row for row in rows}
    yield "| walls | flow rule | blocks | exponent of the solver | of the whole |"
    yield "|---|---|---|---|---|"
    for family, flow_rule in dict.fromkeys((row["family"], row["flow_rule"]) for row in rows):
        solver, total = (last[family, flow_rule, time] for time in ("solver", "total"))
        sizes = f"{float(solver['fewest_blocks']):.0f} to {float(solver['most_blocks']):.0f}"
        slopes = f"{float(solver['exponent']):.2f} | {float(total['exponent']):.2f}"
        yield f"| {family} | {flow_rule} | {sizes} | {slopes} |"


def main() -> None:
    """Both tables, of what was recorded."""
    for name, table in (("rivals", rivals_table), ("growth_exponents", exponents_table)):
        path = RESULTS / f"{name}.csv"
        lines = table(read_rows(path)) if path.exists() else [f"{name}: nothing recorded"]
        sys.stdout.write("".join(f"{line}\n" for line in lines) + "\n")


if __name__ == "__main__":
    main()
