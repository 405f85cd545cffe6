"""Mutants of the modules of each group, and which of them no test notices.

::

    python -m tests.trust.mutation [GROUP ...] [--sample N] [--seed S] [--output FILE]

Exit status 1 where a mutant survives. An interrupt (Ctrl-C) ends a group; what it found by then is told.
"""

from __future__ import annotations

import argparse
import logging
import sys
import tempfile
from pathlib import Path

from tests.trust.mutation.groups import GROUPS
from tests.trust.mutation.sampling import SAMPLE, SEED, Judged, run


def main() -> int:
    """Run the groups that are named, or all."""
    parser = argparse.ArgumentParser(prog="python -m tests.trust.mutation")
    parser.add_argument("groups", nargs="*", choices=[*GROUPS, []], metavar="GROUP", help=", ".join(GROUPS))
    parser.add_argument("--sample", type=int, default=SAMPLE, help="mutants of each module")
    parser.add_argument("--seed", type=int, default=SEED, help="picks them")
    parser.add_argument("--output", type=Path, default=None, help="folder of the results as JSON")
    options = parser.parse_args()
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.output or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        found = [
            _told(name, run(name, options.sample, options.seed, folder / f"{name}.json"))
            for name in options.groups or GROUPS
        ]
    return int(any(one.killed < one.mutants for one in found))


def _told(name: str, one: Judged) -> Judged:
    lines = [f"left out: {test}" for test in one.left_out]
    for survivor in one.survivors:
        note = "noticed by no test" if survivor.reached else "no test runs it"
        lines.append(f"{survivor.module}:{survivor.line} {survivor.change}: {note}")
    score = 100.0 * one.killed / max(one.mutants, 1)
    lines.append(f"{name}: {one.killed} of {one.mutants} mutants of {one.modules} modules killed, {score:.1f} %")
    if not one.whole:
        lines.append(f"{name}: interrupted, not all tests were run")
    sys.stdout.write("\n".join(lines) + "\n")
    return one


if __name__ == "__main__":
    sys.exit(main())
