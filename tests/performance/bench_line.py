"""Where the time of whole runs goes, import to last file, and what of it is not the solver: results/line.csv.

::

    python -m tests.performance.bench_line                  the standard set, associative
    python -m tests.performance.bench_line "40 x 25" house  those whose names contain one of the words
    python -m tests.performance.bench_line --flow-rule non_associative --limit 1200
    python -m tests.performance.bench_line --of CHECKOUT    of another checkout of mbla

Each structure runs in a process of its own with every file that ``mbla run`` writes by default; seconds are those of
the processor, imports included. ``programs`` is the solver: cone programs and steps of the joint law, as in
``time.solver`` of the JSON; of these ``least_forces`` choose one of many force fields. All else is ``outside``. A run
that takes more seconds than the limit is stopped and recorded as such.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path
from typing import Any

from tests.performance.recording import PROJECT, RESULTS, commit, read_rows, record
from tests.performance.standard_set import DECKS, FLOW_RULES, STANDARD_SET, Structure

LIMIT = 3600
"""seconds of the processor for one run"""
GRACE = 10
"""seconds from the signal that ends a run at its limit to the one that it cannot ignore"""


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


def measured(
    structure: Structure, flow_rule: str, checkout: Path, environment: dict[str, str], limit: int
) -> dict[str, Any] | None:
    """One run of a structure by ``line_run``; None where it was stopped."""
    script = str(Path(__file__).with_name("line_run.py"))
    values = (*structure.overrides, f"analysis.flow_rule={flow_rule}")
    with tempfile.TemporaryDirectory() as folder:
        options = [*(word for value in values for word in ("--set", value)), "--case", structure.load_case]
        done = subprocess.run(
            [sys.executable, script, str(structure.deck), *options, "-o", folder],
            cwd=checkout,
            env=environment,
            stdout=subprocess.PIPE,
            text=True,
            preexec_fn=partial(resource.setrlimit, resource.RLIMIT_CPU, (limit, limit + GRACE)),
        )
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return None
    found: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return found


def row_of(found: dict[str, Any]) -> dict[str, object]:
    """What is recorded of a run: totals, shares, stages."""
    stages: dict[str, float] = found["stages"]
    total = found["processor"]
    outside = total - stages["programs"]
    (factor,) = found["load_factors"]
    return {
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


def main() -> None:
    """One row per structure."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="words in the names of structures; all structures without any")
    parser.add_argument("--flow-rule", choices=FLOW_RULES, default="associative")
    parser.add_argument("--limit", type=int, default=LIMIT, metavar="SECONDS", help="of the processor for one run")
    parser.add_argument("--of", type=Path, default=PROJECT, metavar="CHECKOUT", help="checkout of mbla to measure")
    options = parser.parse_args()
    chosen = [each for each in STANDARD_SET if not options.names or any(name in each.name for name in options.names)]
    if not chosen:
        parser.error(f"no structure of that name; there are {'; '.join(each.name for each in STANDARD_SET)}")
    checkout = options.of.resolve()
    occasion = {"flow_rule": options.flow_rule, "commit": commit(checkout)}
    with tempfile.TemporaryDirectory() as compiled:
        environment = environment_of(checkout, compiled)
        compile_modules(checkout, environment)
        for structure in chosen:
            found = measured(structure, options.flow_rule, checkout, environment, options.limit)
            stopped = dict.fromkeys(list(read_rows(RESULTS / "line.csv")[0])[4:-2], "") | {"status": "stopped"}
            row = stopped if found is None else row_of(found)
            record("line", {"structure": structure.name} | occasion | row)


if __name__ == "__main__":
    main()
