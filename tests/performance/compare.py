"""Release against release: the newest recorded figures of every benchmark beside those before, on the same machine.

::

    python -m tests.performance.compare [BENCHMARK ...] [--against TEXT] [--fail FACTOR]

The newest rows of a case are those of its last date and versions on the machine of the file's last row; those before
are of the date and versions that came before these, or with ``--against`` of the last whose date or versions contain a
text (``2026-11-21``, ``mbla 0.1.0``). Of several rows of one case the shortest time counts. Each case and time has a
line with its ratio, now over before; the worst and the median close each benchmark.

Exit status 0; 1 with ``--fail`` where a ratio is above the factor, or something no longer comes to its end; 2 for a
benchmark that is not there. Times below a hundredth of a second on both sides are shown and not judged.
"""

from __future__ import annotations

import argparse
import csv
import statistics
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from tests.performance.columns import Columns, columns_of
from tests.performance.recording import RESULTS

Row = dict[str, str]

JUDGED = 0.01
"""Seconds: shorter ones differ by half between two runs of the same program."""


TIMELESS = ("growth_exponents",)
"""Recorded figures without times."""


@dataclass(frozen=True)
class Ratio:
    """One time of one case: seconds now and before, None where it did not come to its end."""

    case: str
    column: str
    before: float | None
    now: float | None

    @property
    def value(self) -> float | None:
        """Now over before; inf where it no longer comes to its end, None where it did not before."""
        if self.before is None:
            return None
        return float("inf") if self.now is None else self.now / max(self.before, 1e-12)

    @property
    def judged(self) -> bool:
        """Whether it is long enough to say anything."""
        return self.value is not None and max(self.before or 0.0, self.now or JUDGED) >= JUDGED


@dataclass(frozen=True)
class Comparison:
    """Ratios of one benchmark, and how many of its cases have nothing to be compared with."""

    ratios: tuple[Ratio, ...]
    alone: int

    def values(self) -> list[float]:
        """Of what is long enough to be judged."""
        return [ratio.value for ratio in self.ratios if ratio.judged and ratio.value is not None]


def compared(rows: Sequence[Row], columns: Columns, against: str = "") -> Comparison:
    """Newest rows of every case against those before."""
    here = [row for row in rows if row["machine"] == rows[-1]["machine"]]
    by_case: dict[tuple[str, ...], list[Row]] = {}
    for row in here:
        by_case.setdefault(tuple(row.get(name) or "" for name in columns.case), []).append(row)
    ratios: list[Ratio] = []
    alone = 0
    for case, own in by_case.items():
        now, before = _newest_and_before(own, against)
        alone += not before
        for column in columns.times if before else ():
            ratio = Ratio(", ".join(case), column, _shortest(before, column), _shortest(now, column))
            if ratio.before is not None or ratio.now is not None:
                ratios.append(ratio)
    return Comparison(tuple(ratios), alone)


def _newest_and_before(rows: Sequence[Row], against: str) -> tuple[list[Row], list[Row]]:
    newest = _release(rows[-1])
    others = [release for release in map(_release, rows) if release != newest and any(against in t for t in release)]
    before = others[-1] if others else None
    return [row for row in rows if _release(row) == newest], [row for row in rows if _release(row) == before]


def _release(row: Row) -> tuple[str, str]:
    return row["date"], row["versions"]


def _shortest(rows: Sequence[Row], column: str) -> float | None:
    times = [float(row[column]) for row in rows if row.get(column) not in (None, "", "nan")]
    return min(times, default=None)


def lines_of(benchmark: str, comparison: Comparison) -> Iterator[str]:
    """The comparison in words, the slowest first."""
    ordered = sorted(comparison.ratios, key=lambda ratio: -1.0 if ratio.value is None else ratio.value, reverse=True)
    for ratio in ordered:
        value = "   new" if ratio.value is None else f"{ratio.value:6.2f}"
        note = "" if ratio.judged else "  (not judged)"
        yield f"{value}  {_seconds(ratio.before)} -> {_seconds(ratio.now)}  {ratio.case}: {ratio.column}{note}"
    values = comparison.values()
    spread = f"worst {max(values):.2f}, median {statistics.median(values):.2f}" if values else "nothing to compare"
    without = f"; {comparison.alone} cases only once" if comparison.alone else ""
    yield f"{benchmark}: {spread} ({len(values)} times{without})"


def _seconds(value: float | None) -> str:
    return " stopped" if value is None else f"{value:8.4g}"


def read_rows(path: Path) -> list[Row]:
    """Rows of a recorded benchmark, oldest first."""
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def main(arguments: list[str], folder: Path = RESULTS) -> int:
    """Compare the benchmarks named, or all; the exit status."""
    known = {path.stem: path for path in sorted(folder.glob("*.csv")) if path.stem not in TIMELESS}
    parser = argparse.ArgumentParser(prog="python -m tests.performance.compare")
    parser.add_argument("benchmarks", nargs="*", metavar="BENCHMARK", help=f"of: {', '.join(known)}; all by default")
    parser.add_argument("--against", default="", metavar="TEXT", help="part of the date or versions to compare with")
    parser.add_argument("--fail", type=float, metavar="FACTOR", help="exit status 1 where something is slower by more")
    options = parser.parse_args(arguments)
    for name in options.benchmarks:
        if name not in known:
            parser.error(f"no benchmark {name}; there are {', '.join(known)}")
    slower = 0
    for name in options.benchmarks or known:
        rows = read_rows(known[name])
        if not rows:
            continue
        try:
            columns = columns_of(name, list(rows[0]))
        except ValueError as unknown:
            sys.stdout.write(f"not compared: {unknown}\n")
            continue
        comparison = compared(rows, columns, options.against)
        sys.stdout.write("".join(f"{line}\n" for line in lines_of(name, comparison)))
        slower += sum(value > options.fail for value in comparison.values()) if options.fail is not None else 0
    if slower:
        sys.stdout.write(f"{slower} times are more than {options.fail:g} times as long as before\n")
    return 1 if slower else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
