"""Every benchmark one after the other, each in a process of its own.

::

    python -m tests.performance.all [--list] [BENCHMARK ...]

``--list`` says what there is and the minutes that each takes: those of its last run by this command
(``results/all.csv``), else estimated. A benchmark that fails is said, and the others go on; the exit status is 1 then.
Afterwards ``python -m tests.performance.compare`` compares the figures with those before.
"""

from __future__ import annotations

import argparse
import resource
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from tests.performance.compare import read_rows
from tests.performance.recording import RESULTS, record

HERE = Path(__file__).parent
PREFIX = "bench_"

ESTIMATED = {
    "contacts": 0.2,
    "deck": 0.3,
    "growth": 60.0,
    "line": 3.0,
    "model": 0.3,
    "results": 0.5,
    "rivals": 30.0,
    "run": 0.5,
    "solver": 3.0,
    "structures": 0.5,
    "sweep": 10.0,
    "sweep_memory": 6.0,
}
"""Minutes on an idle core, at most where there is a limit, before the first run by this command."""


def benchmarks() -> list[str]:
    """Names of all, in the order of the alphabet."""
    return sorted(path.stem.removeprefix(PREFIX) for path in HERE.glob(f"{PREFIX}*.py"))


def minutes_of(benchmark: str, folder: Path = RESULTS) -> float | None:
    """Of the last recorded run, else estimated; None where nothing is known."""
    path = folder / "all.csv"
    rows = read_rows(path) if path.exists() else []
    taken = [float(row["clock"]) / 60.0 for row in rows if row["benchmark"] == benchmark]
    return taken[-1] if taken else ESTIMATED.get(benchmark)


def total_of(minutes: Sequence[float | None]) -> str:
    """Minutes of several benchmarks in words, and of how many they are not known."""
    known = [each for each in minutes if each is not None]
    said = f"{len(minutes)} benchmarks, together about {sum(known):.0f} minutes on an idle machine"
    return said + (f" and those of {len(minutes) - len(known)} more" if len(known) < len(minutes) else "")


def run(benchmark: str) -> bool:
    """Run one and record the seconds that it took; whether it came to its end."""
    started, used = time.perf_counter(), _processor()
    command = [sys.executable, "-m", f"tests.performance.{PREFIX}{benchmark}"]
    done = subprocess.run(command, check=False).returncode == 0
    if done:
        record(
            "all", {"benchmark": benchmark, "processor": _processor() - used, "clock": time.perf_counter() - started}
        )
    return done


def _processor() -> float:
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def main(arguments: list[str]) -> int:
    """List or run; the exit status."""
    parser = argparse.ArgumentParser(prog="python -m tests.performance.all")
    parser.add_argument("benchmarks", nargs="*", metavar="BENCHMARK", help="only these")
    parser.add_argument("--list", action="store_true", help="names and minutes, nothing is run")
    options = parser.parse_args(arguments)
    for name in options.benchmarks:
        if name not in benchmarks():
            parser.error(f"no benchmark {name}; there are {', '.join(benchmarks())}")
    failed, chosen = [], options.benchmarks or benchmarks()
    sys.stdout.write(f"{total_of([minutes_of(name) for name in chosen])}\n")
    for name in chosen:
        minutes = minutes_of(name)
        sys.stdout.write(f"{name}: {'unknown' if minutes is None else f'about {minutes:.1f}'} minutes\n")
        sys.stdout.flush()
        if not options.list and not run(name):
            failed.append(name)
    if failed:
        sys.stdout.write(f"failed: {', '.join(failed)}\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
