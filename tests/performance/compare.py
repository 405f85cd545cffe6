"""Release against release: the newest recorded figures of every benchmark beside those before, on the same machine.

::

    python -m tests.performance.compare [BENCHMARK ...] [--against TEXT] [--fail FACTOR]

The newest row of a case is its last one on the machine of the file's last row; the one before it is the last of another
date or of other versions, or with ``--against`` the last whose date or versions contain a text (``2026-11-21``,
``mbla 0.1.0``). Each case and time has a line with its ratio, now over before; the worst and the median close each
benchmark.

Exit status 0; 1 with ``--fail`` where a ratio is above the factor, or something no longer comes to its end; 2 for a
benchmark that is not there. Times below a hundredth of a second on both sides are shown and not judged.
"""

from __future__ import annotations

import argparse
import statistics
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from tests.performance.recording import CASES, RESULTS, Row, read_rows

TIMES = ("seconds", "processor_seconds", "processor", "clock", "outside", "solver")
"""columns of seconds"""
JUDGED = 0.01
"""Seconds: shorter ones differ by half between two runs of the same program."""


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


def compared(rows: Sequence[Row], benchmark: str, against: str = "") -> list[Ratio]:
    """Newest row of every case against the one before, where there is one."""
    by_case: dict[tuple[str, ...], list[Row]] = {}
    for row in rows:
        if row["machine"] == rows[-1]["machine"]:
            by_case.setdefault(tuple(row[name] for name in CASES[benchmark]), []).append(row)
    ratios = []
    for case, own in by_case.items():
        before = [row for row in own if _release(row) != _release(own[-1]) and any(against in t for t in _release(row))]
        for column in [name for name in rows[0] if name in TIMES] if before else ():
            ratio = Ratio(", ".join(case), column, _seconds(before[-1][column]), _seconds(own[-1][column]))
            if ratio.before is not None or ratio.now is not None:
                ratios.append(ratio)
    return ratios


def _release(row: Row) -> tuple[str, str]:
    return row["date"], row["versions"]


def _seconds(text: str) -> float | None:
    return float(text) if text not in ("", "nan") else None


def lines_of(benchmark: str, ratios: Sequence[Ratio]) -> Iterator[str]:
    """The comparison in words, the slowest first."""
    for ratio in sorted(ratios, key=lambda ratio: -1.0 if ratio.value is None else ratio.value, reverse=True):
        value = "   new" if ratio.value is None else f"{ratio.value:6.2f}"
        note = "" if ratio.judged else "  (not judged)"
        yield f"{value}  {_told(ratio.before)} -> {_told(ratio.now)}  {ratio.case}: {ratio.column}{note}"
    values = judged_values(ratios)
    spread = f"worst {max(values):.2f}, median {statistics.median(values):.2f}" if values else "nothing to compare"
    yield f"{benchmark}: {spread} ({len(values)} times)"


def judged_values(ratios: Sequence[Ratio]) -> list[float]:
    """Of what is long enough to be judged."""
    return [ratio.value for ratio in ratios if ratio.judged and ratio.value is not None]


def _told(value: float | None) -> str:
    return " stopped" if value is None else f"{value:8.4g}"


def main(arguments: list[str], folder: Path = RESULTS) -> int:
    """Compare the benchmarks named, or all; the exit status."""
    known = [name for name in CASES if (folder / f"{name}.csv").exists()]
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
        ratios = compared(read_rows(folder / f"{name}.csv"), name, options.against)
        sys.stdout.write("".join(f"{line}\n" for line in lines_of(name, ratios)))
        slower += sum(value > options.fail for value in judged_values(ratios)) if options.fail is not None else 0
    if slower:
        sys.stdout.write(f"{slower} times are more than {options.fail:g} times as long as before\n")
    return 1 if slower else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
