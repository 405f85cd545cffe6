"""The recorded figures as tables for README.md beside this file: ratios against rivals, exponents of growth.

::

    python -m tests.performance.tables

Of every case the last recorded row counts. Ratios are seconds of the processor over those of mbla as a whole, in
brackets the error of the load factor, or the answer where there is none. An exponent is the slope of log time over log
blocks by least squares, over the walls of at least 100 blocks that came to their end.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence

import numpy as np

from tests.performance.bench_rivals import LOAD_FACTOR, MEASURE, RIVALS
from tests.performance.recording import RESULTS, Row, read_rows
from tests.performance.standard_set import FLOW_RULES, STANDARD_SET

FEWEST_BLOCKS, FEWEST_SIZES = 100, 3
ENDED = ("solved", "approximate")
"""what breaks off early would flatter the exponent"""


def rivals_table(rows: Sequence[Row]) -> Iterator[str]:
    """A line for each structure, a column for each rival; mbla itself in seconds."""
    last = {(row["structure"], row["rival"]): row for row in rows}
    others = [name for name in RIVALS if name not in MEASURE.values()]
    yield f"| structure | mbla, s | standing, s | {' | '.join(others)} |"
    yield "|---" * (3 + len(others)) + "|"
    for structure in dict.fromkeys(row["structure"] for row in rows):
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


def exponent(blocks: Sequence[float], seconds: Sequence[float]) -> tuple[float, float]:
    """Slope of log time over log blocks by least squares, and the root mean square left."""
    x, y = np.log(blocks), np.log(seconds)
    slope, offset = np.polyfit(x, y, 1)
    return float(slope), float(np.sqrt(np.mean((slope * x + offset - y) ** 2)))


def growth_table(rows: Sequence[Row]) -> Iterator[str]:
    """A line for each family of walls and flow rule."""
    last = {(row["structure"], row["flow_rule"]): row for row in rows}
    yield "| walls | flow rule | blocks | exponent of the solver | of the whole |"
    yield "|---|---|---|---|---|"
    for family in ("wall, planar", "wall, spatial"):
        names = [structure.name for structure in STANDARD_SET if structure.family == family]
        for flow_rule in FLOW_RULES:
            found = [last[name, flow_rule] for name in names if (name, flow_rule) in last]
            ended = [row for row in found if row["status"] in ENDED and int(row["blocks"]) >= FEWEST_BLOCKS]
            if len(ended) >= FEWEST_SIZES:
                blocks = [float(row["blocks"]) for row in ended]
                columns = [[float(row[name]) for row in ended] for name in ("programs", "processor")]
                slopes = " | ".join("{:.2f} ± {:.2f}".format(*exponent(blocks, seconds)) for seconds in columns)
                yield f"| {family} | {flow_rule} | {min(blocks):.0f} to {max(blocks):.0f} | {slopes} |"


def main() -> None:
    """Both tables, of what was recorded."""
    for name, table in (("rivals", rivals_table), ("line", growth_table)):
        sys.stdout.write("".join(f"{line}\n" for line in table(read_rows(RESULTS / f"{name}.csv"))) + "\n")


if __name__ == "__main__":
    main()
