"""What load factors without dilatancy cost beside associative ones: results/path.csv.

::

    python -m tests.performance.bench_path                  buildings and vaults of decks/structures, walls
    python -m tests.performance.bench_path house "40 x 40"  those whose names contain one of the words
    python -m tests.performance.bench_path --table          what was recorded last, for README.md

Each structure runs three times, one after the other, on one thread, with every file that ``mbla run`` writes: with
associative flow, without dilatancy, and with torsion of uniform pressure besides. ``program`` and ``path`` are the
seconds of all associative programs and of all paths, by the clock; the commands those of the processor.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from tests.decks.folder import DECKS
from tests.performance.recording import ONE_THREAD, PROJECT, RESULTS, read_rows, record

LIMIT = 1200
"""seconds by the clock for one command"""
SPATIAL = "analysis.reductions=false"
WITHOUT_TORSION = "analysis.torsion=false"


@dataclass(frozen=True)
class Run:
    """A deck with overrides."""

    name: str
    deck: Path
    overrides: tuple[str, ...] = ()


def runs() -> Iterator[Run]:
    """Buildings and vaults; walls of 20 to 60 courses in their plane, of 20 and 40 in space."""
    for path in sorted((DECKS / "structures").glob("*.yaml")):
        yield Run(path.stem, path)
    for n, more in ((20, ()), (30, ()), (40, ()), (60, ()), (20, (SPATIAL,)), (40, (SPATIAL,))):
        where = "in space" if more else "in its plane"
        wall = (f"parameters.m={n}", f"parameters.n={n}", *more)
        yield Run(f"wall {n} x {n} {where}", DECKS / "tradeoff" / "wall.yaml", wall)


def spent(run: Run, *settings: str) -> tuple[float, dict[str, float], int]:
    """Seconds of the processor of a command, those of its programs by kind, and its load cases."""
    environment = os.environ | ONE_THREAD
    overrides = [f"--set={value}" for value in (*run.overrides, *settings)]
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "mbla", "run", str(run.deck), *overrides, "-q", "-o", folder]
        before = os.times()
        subprocess.run(command, cwd=PROJECT, env=environment, capture_output=True, timeout=LIMIT, check=False)
        after = os.times()
        seconds, cases = by_kind(next(Path(folder).glob("*.h5")))
    return after.children_user + after.children_system - before.children_user - before.children_system, seconds, cases


def by_kind(file: Path) -> tuple[dict[str, float], int]:
    """Seconds of the programs of all load cases, by what each is for, and how many load cases there are."""
    seconds: dict[str, float] = {}
    with h5py.File(file) as results:
        cases = list(results["cases"].values())
        for case in cases:
            for kind, own in zip(case["programs/kind"], case["programs/seconds"], strict=True):
                seconds[kind.decode()] = seconds.get(kind.decode(), 0.0) + float(own)
    return seconds, len(cases)


def measured(run: Run) -> dict[str, object]:
    """One row."""
    normal, of_normal, cases = spent(run, "analysis.flow_rule=associative")
    plain, of_plain, _ = spent(run, "analysis.flow_rule=non_associative", WITHOUT_TORSION)
    torsion, _, _ = spent(run, "analysis.flow_rule=non_associative", "analysis.torsion=true")
    program, path = of_normal.get("associative", np.nan), of_plain.get("elastic path", np.nan)
    return {
        "structure": run.name,
        "cases": cases,
        "program": program,
        "path": path,
        "associative": normal,
        "without dilatancy": plain,
        "with torsion": torsion,
        "path over program": path / program,
        "commands": plain / normal,
        "torsion over path": (torsion - plain) / path,
    }


def table(rows: Sequence[dict[str, str]]) -> Iterator[str]:
    """The last row of each structure."""
    last = {row["structure"]: row for row in rows}
    yield "| structure | load cases | path over program | command over associative | torsion over path |"
    yield "|---|---|---|---|---|"
    for name, row in last.items():
        figures = [f"{float(row[key]):.2g}" for key in ("path over program", "commands", "torsion over path")]
        yield f"| {name} | {row['cases']} | {' | '.join(figures)} |"


def main() -> None:
    """As the first lines say."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="words in the names of structures; all of them without any")
    parser.add_argument("--table", action="store_true")
    options = parser.parse_args()
    if options.table:
        sys.stdout.write("".join(f"{line}\n" for line in table(read_rows(RESULTS / "path.csv"))))
        return
    for run in runs():
        if not options.names or any(name in run.name for name in options.names):
            record("path", measured(run))


if __name__ == "__main__":
    main()
