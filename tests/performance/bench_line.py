"""Where the time of whole runs goes, import to last file, and what of it is not the solver: results/line.csv.

::

    python -m tests.performance.bench_line                  every structure below, associative
    python -m tests.performance.bench_line "40 x 25" house  those whose names contain one of the words
    python -m tests.performance.bench_line --flow-rule non_associative
    python -m tests.performance.bench_line --of CHECKOUT    of another checkout of mbla
    python -m tests.performance.bench_line --compare        the newest rows against those of the commit before

Each structure runs in a process of its own with every file that ``mbla run`` writes by default; seconds are those of
the processor, imports included. ``programs`` is the solver: cone programs and steps of the joint law, as in
``time.solver`` of the JSON; of these ``least_forces`` choose one of many force fields. All else is ``outside``.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from tests.performance.recording import RESULTS, record
from tests.performance.standard_set import DECKS, FLOW_RULES, SPATIAL, STANDARD_SET, Structure

CHECKOUT = Path(__file__).parents[2]


def _wall(name: str, m: int, n: int, *more: str) -> Structure:
    size = (f"parameters.m={m}", f"parameters.n={n}")
    return Structure(name, name, DECKS / "tradeoff" / "wall.yaml", size + more, "in_plane")


STRUCTURES = (
    *STANDARD_SET,
    _wall("wall, spatial, 40 x 25", 25, 40, *SPATIAL),
    _wall("wall, planar, 100 x 100", 100, 100),
)
"""A thousand blocks in space and ten thousand in a plane are what the time outside the solver is held to."""


def environment_of(checkout: Path, compiled: str) -> dict[str, str]:
    """One thread, and modules compiled once into a folder of their own, as they are where mbla is installed."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    threads = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    return kept | threads | {"PYTHONPATH": str(checkout), "PYTHONPYCACHEPREFIX": compiled}


def compile_modules(checkout: Path, environment: dict[str, str]) -> None:
    """A small run, after which all modules that a run needs are there compiled."""
    with tempfile.TemporaryDirectory() as folder:
        words = ["-m", "mbla", "run", str(DECKS / "tradeoff" / "arch.yaml"), "-q", "-o", folder]
        subprocess.run([sys.executable, *words], cwd=checkout, env=environment, check=True)


def measured(structure: Structure, flow_rule: str, checkout: Path, environment: dict[str, str]) -> dict[str, Any]:
    """One run of a structure by ``line_run``."""
    script = str(Path(__file__).with_name("line_run.py"))
    overrides = [
        word for value in (*structure.overrides, f"analysis.flow_rule={flow_rule}") for word in ("--set", value)
    ]
    with tempfile.TemporaryDirectory() as folder:
        options = [*overrides, "--case", structure.load_case, "-o", folder]
        command = [sys.executable, script, str(structure.deck), *options]
        done = subprocess.run(command, cwd=checkout, env=environment, stdout=subprocess.PIPE, check=True, text=True)
    found: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return found


def row_of(structure: Structure, flow_rule: str, commit: str, found: dict[str, Any]) -> dict[str, object]:
    """The row of a run: totals, shares, stages."""
    stages: dict[str, float] = found["stages"]
    total = found["processor"]
    outside = total - stages["programs"]
    (factor,) = found["load_factors"]
    return {
        "structure": structure.name,
        "flow_rule": flow_rule,
        "commit": commit,
        "blocks": found["blocks"],
        "points": found["points"],
        "status": found["status"],
        "load_factor": "" if factor is None else f"{factor:.9g}",
        "clock": found["clock"],
        "processor": total,
        "outside": outside,
        "share_outside": outside / total,
        "peak_mb": found["peak_mb"],
        **stages,
        "least_forces": found["least_forces"],
        "rest": total - sum(stages.values()),
    }


def commit_of(checkout: Path) -> str:
    """Short name of the commit, with + where files differ from it; empty without version control."""
    words = ["git", "-C", str(checkout), "describe", "--always", "--dirty=+", "--abbrev=9"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    return done.stdout.strip() if done.returncode == 0 else ""


def newest_pairs(rows: Sequence[dict[str, str]]) -> list[tuple[dict[str, str], dict[str, str]]]:
    """Of every structure its newest row and the newest one before of another commit, version or date."""
    pairs = []
    for key in dict.fromkeys((row["structure"], row["flow_rule"]) for row in rows):
        own = [row for row in rows if (row["structure"], row["flow_rule"]) == key]
        newest = own[-1]
        earlier = [row for row in own if _release(row) != _release(newest)]
        if earlier:
            pairs.append((earlier[-1], newest))
    return pairs


def _release(row: dict[str, str]) -> tuple[str, str, str]:
    return row["commit"], row["versions"], row["date"]


def comparison(earlier: dict[str, str], newest: dict[str, str]) -> list[str]:
    """Lines that say what each stage took and takes, and the ratio, now over then."""
    first, last = list(newest).index("processor"), list(newest).index("versions")
    lines = [f"{newest['structure']}, {newest['flow_rule']}: {earlier['commit']} -> {newest['commit']}"]
    for name in list(newest)[first:last]:
        then, now = float(earlier[name]), float(newest[name])
        ratio = f"{now / then:7.2f}" if then > 0 else "      -"
        lines.append(f"  {name:<14} {then:10.3f} {now:10.3f} {ratio}")
    return lines


def compare() -> None:
    """Say the newest rows against those before them."""
    with (RESULTS / "line.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    for earlier, newest in newest_pairs(rows):
        sys.stdout.write("\n".join(comparison(earlier, newest)) + "\n")


def main() -> None:
    """One row per structure."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="words in the names of structures; all structures without any")
    parser.add_argument("--flow-rule", choices=FLOW_RULES, default="associative")
    parser.add_argument("--of", type=Path, default=CHECKOUT, metavar="CHECKOUT", help="checkout of mbla to measure")
    parser.add_argument("--compare", action="store_true", help="compare recorded rows, run nothing")
    options = parser.parse_args()
    if options.compare:
        compare()
        return
    chosen = [each for each in STRUCTURES if not options.names or any(name in each.name for name in options.names)]
    if not chosen:
        parser.error(f"no structure of that name; there are {'; '.join(each.name for each in STRUCTURES)}")
    checkout = options.of.resolve()
    commit = commit_of(checkout)
    with tempfile.TemporaryDirectory() as compiled:
        environment = environment_of(checkout, compiled)
        compile_modules(checkout, environment)
        for structure in chosen:
            found = measured(structure, options.flow_rule, checkout, environment)
            record("line", row_of(structure, options.flow_rule, commit, found))


if __name__ == "__main__":
    main()
