"""Where the time of whole runs goes, import to last file: results/line.csv.

::

    python -m tests.performance.bench_line                  the standard set, associative
    python -m tests.performance.bench_line "40 x 25" house  those whose names contain one of the words
    python -m tests.performance.bench_line --flow-rule non_associative --limit 1200
    python -m tests.performance.bench_line --of CHECKOUT    of another checkout of mbla

Each structure runs in a process of its own, on one thread, with every file that ``mbla run`` writes by default;
``processor`` are its seconds of the processor, imports included; the stages are those of its JSON object, by the clock.
A run that takes more seconds than the limit is stopped and recorded as such.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from functools import partial
from pathlib import Path
from typing import Any

from tests.performance.recording import ONE_THREAD, PROJECT, commit, record
from tests.performance.standard_set import FLOW_RULES, STANDARD_SET, Structure

LIMIT = 3600
"""seconds of the processor for one run"""
GRACE = 10
"""seconds from the signal that ends a run at its limit to the one that it cannot ignore"""
SOLVE = ("assemble", "programs", "repair", "standing", "verify")
FIGURES = ("blocks", "points", "status", "load_factor", "clock", "processor", "peak_mb")


def measured(structure: Structure, flow_rule: str, checkout: Path, limit: int) -> dict[str, object]:
    """One run of a structure: what is recorded of it."""
    settings = [f"--set={value}" for value in structure.overrides]
    environment = os.environ | ONE_THREAD | {"PYTHONPATH": str(checkout)}
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "mbla", "run", str(structure.deck), "--case", structure.load_case, *settings]
        started = time.perf_counter()
        child = subprocess.Popen(
            [*command, "--flow-rule", flow_rule, "--json", "-q", "-o", folder],
            cwd=checkout,
            env=environment,
            stdout=subprocess.PIPE,
            text=True,
            preexec_fn=partial(resource.setrlimit, resource.RLIMIT_CPU, (limit, limit + GRACE)),
        )
        assert child.stdout is not None
        output = child.stdout.read()
        _, _, used = os.wait4(child.pid, 0)
        clock = time.perf_counter() - started
    if not output:
        stopped: dict[str, object] = dict.fromkeys((*FIGURES, *stages({})), "")
        return stopped | {"status": "stopped"}
    used_up = {"clock": clock, "processor": used.ru_utime + used.ru_stime, "peak_mb": used.ru_maxrss / 1024}
    return row_of(json.loads(output), used_up)


def row_of(found: dict[str, Any], used_up: dict[str, float]) -> dict[str, object]:
    """What is recorded of a run by its JSON object."""
    (case,) = found["cases"]
    factor = case["load_factor"]
    return {
        "blocks": found["model"]["blocks"],
        "points": found["model"]["contact_points"],
        "status": case["status"],
        "load_factor": "" if factor is None else f"{factor:.9g}",
        **used_up,
        **stages(found["time"]),
    }


def stages(spent: dict[str, float]) -> dict[str, float]:
    """Seconds of reading, contacts, the parts of solving, and writing."""
    names = {"read": "read", "contacts": "contacts", **{part: f"solve/{part}" for part in SOLVE}, "write": "write"}
    return {name: spent.get(key, 0.0) for name, key in names.items()}


def main() -> None:
    """One row per structure."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="words in the names of structures; all structures without any")
    parser.add_argument("--flow-rule", choices=FLOW_RULES, default="associative")
    parser.add_argument("--limit", type=int, default=LIMIT, metavar="SECONDS", help="of the processor for one run")
    parser.add_argument("--of", type=Path, default=PROJECT, metavar="CHECKOUT", help="checkout of mbla to measure")
    options = parser.parse_args()
    checkout = options.of.resolve()
    for structure in STANDARD_SET:
        if not options.names or any(name in structure.name for name in options.names):
            row = measured(structure, options.flow_rule, checkout, options.limit)
            occasion = {"flow_rule": options.flow_rule, "commit": commit(checkout)}
            record("line", {"structure": structure.name} | occasion | row)


if __name__ == "__main__":
    main()
