"""Time of whole commands as users wait for them, each in a process of its own; appends to results/run.csv.

::

    python -m tests.performance.bench_run
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path

from tests.decks.folder import BENCHMARKS
from tests.performance.recording import best_time, record

DECKS = Path(__file__).parents[2] / "decks"


def command(*arguments: str) -> None:
    """Run mbla with these arguments to its end."""
    subprocess.run([sys.executable, "-m", "mbla", *arguments], check=True, capture_output=True)


def cases(folder: str) -> dict[str, tuple[str, ...]]:
    """Arguments by name of the case."""
    output = ("-o", folder, "--force")
    return {
        "help": ("--help",),
        "arch tutorial": ("run", str(DECKS / "tutorials" / "arch.yaml"), *output),
        "wall 20x20": ("run", str(BENCHMARKS["wall_20x20"]), "--case", "in_plane", *output),
        "wall 3 of Ferris and Tin-Loi, non-associative": (
            "run",
            str(BENCHMARKS["ferris_wall_3"]),
            *output,
        ),
        "cross vault, two directions": ("run", str(DECKS / "tutorials" / "crossvault.yaml"), *output),
    }


def main() -> None:
    """Best of a few runs of each command, one row each."""
    with tempfile.TemporaryDirectory() as folder:
        for name, arguments in cases(folder).items():
            seconds, _ = best_time(partial(command, *arguments))
            record("run", {"case": name, "seconds": seconds})


if __name__ == "__main__":
    main()
