"""A sweep of 1,000 points, 25 frictions and 40 directions of the 20-voussoir arch; appends to results/sweep.csv.

::

    python -m tests.performance.bench_sweep [POINTS]

Each of the two sweeps, with directions around the horizon, so that the arch is solved in space, and in its plane, by

- ``separate``: ``mbla.run(deck, set=...)`` for every point, in one process, that imports nothing any more;
- ``shared``: the points one after the other in one process, which hands on states under the dead load;
- ``one worker``, ``two workers``: the command ``mbla sweep -j 1`` and ``-j 2``, with start, journal and table.

Seconds are by the clock, as somebody waits for them, and of the processor, of this process and its children. ``ratio``
is the clock of a point by ``separate`` over that of the row: three is wanted of two workers. ``over_one`` is the clock
of one worker over that of the row: 1.8 is wanted of two. Load factors of all ways must be the same, bit for bit.
"""

from __future__ import annotations

import csv
import json
import math
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from resource import RUSAGE_CHILDREN, RUSAGE_SELF, getrusage

import numpy as np
import yaml

import mbla
from mbla.sweeps.command import FAILED_POINTS
from mbla.sweeps.engine.child import PointRunner
from mbla.sweeps.file.content import SweepContent
from mbla.sweeps.plan import Plain, Plan, Task
from tests.decks.folder import BENCHMARKS
from tests.performance.recording import record

DECK = BENCHMARKS["arch_20_voussoirs"]
CASE = "push_x"
COLUMNS: tuple[str, ...] = SweepContent.model_fields["results"].get_default(call_default_factory=True)
"""those of a sweep file that names none"""
FRICTION, DIRECTION = "parameters.mu", f"load_cases.{CASE}.live.0.acceleration"
PLANES: dict[str, tuple[str, str]] = {"around the horizon": ("x", "y"), "in its plane": ("x", "z")}
FRICTIONS = 25
Points = list[dict[str, Plain]]


def points_of(plane: str, count: int) -> Points:
    """A grid of frictions and of directions of unit length, friction changing last; 25 and 40 of 1,000."""
    n_frictions = min(FRICTIONS, count)
    n_directions = -(-count // n_frictions)
    places = ["xyz".index(axis) for axis in PLANES[plane]]
    points: Points = []
    for friction in np.linspace(0.4, 0.8, n_frictions).tolist():
        for angle in (2 * np.pi * np.arange(n_directions) / n_directions).tolist():
            direction = np.zeros(3)
            direction[places] = np.cos(angle), np.sin(angle)
            points.append({FRICTION: friction, DIRECTION: [float(part) for part in direction]})
    return points[:count]


def separate(points: Points) -> list[float | None]:
    """Load factor of each point by a call of its own."""
    return [_finite(mbla.run(DECK, set=point, cases=CASE)[CASE].load_factor) for point in points]


def shared(points: Points) -> list[float | None]:
    """Load factor of each point in one process."""
    plan = Plan(str(DECK), "", (), (CASE,), COLUMNS, program="")
    runner = PointRunner(plan)
    outcomes = [runner.run(Task(str(number), number, point)) for number, point in enumerate(points, start=1)]
    return [_number(outcome.results["load_factor"]) for outcome in outcomes]


def by_command(points: Points, workers: int) -> list[float | None]:
    """Load factor of each point by ``mbla sweep``."""
    with tempfile.TemporaryDirectory() as folder:
        sweep = Path(folder) / "sweep.yaml"
        sweep.write_text(yaml.safe_dump(content_of(points)), encoding="utf-8")
        command = [sys.executable, "-m", "mbla", "sweep", str(sweep), "-q", "-j", str(workers)]
        ended = subprocess.run(command, stdout=subprocess.DEVNULL)
        if ended.returncode not in (0, FAILED_POINTS):
            raise SystemExit(f"{' '.join(command)} ended with exit status {ended.returncode}")
        with (Path(folder) / "sweep.out" / "sweep.csv").open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return [float(row["load_factor"]) if row["load_factor"] else None for row in rows]


def content_of(points: Points) -> dict[str, object]:
    """The sweep file: friction and direction, point by point."""
    parameters = {
        name: {"key": key, "values": [point[key] for point in points]}
        for name, key in {"mu": FRICTION, "direction": DIRECTION}.items()
    }
    return {
        "mbla_sweep": 1,
        "deck": str(DECK),
        "parameters": parameters,
        "design": [{"zip": {"of": list(parameters)}}],
        "results": list(COLUMNS),
    }


def _finite(value: float) -> float | None:
    """None for the nan of a run that has no load factor."""
    return value if math.isfinite(value) else None


def _number(value: Plain) -> float | None:
    return value if isinstance(value, float) else None


def measured(run: Callable[[], list[float | None]]) -> tuple[list[float | None], float, float]:
    """Load factors, and seconds by the clock and of the processor."""
    started, used = time.perf_counter(), _processor()
    found = run()
    return found, time.perf_counter() - started, _processor() - used


def _processor() -> float:
    return sum(getrusage(who).ru_utime + getrusage(who).ru_stime for who in (RUSAGE_SELF, RUSAGE_CHILDREN))


def main(count: int) -> None:
    """Both sweeps in every way, a row each."""
    for plane in PLANES:
        points = points_of(plane, count)
        separate(points[:2])  # imports do not count
        shared(points[:2])
        ways: dict[str, Callable[[], list[float | None]]] = {
            "separate": partial(separate, points),
            "shared": partial(shared, points),
            "one worker": partial(by_command, points, 1),
            "two workers": partial(by_command, points, 2),
        }
        reference: list[float | None] = []
        clocks: dict[str, float] = {}
        for way, run in ways.items():
            found, clock, processor = measured(run)
            if way == "separate":
                reference = found
            clocks[way] = clock / len(found)
            assert json.dumps(found) == json.dumps(reference), f"{plane}, {way}: other load factors than separate runs"
            row = {"sweep": plane, "way": way, "points": len(found), "seconds": clock, "processor_seconds": processor}
            one: float | str = clocks["one worker"] / clocks[way] if "one worker" in clocks else ""
            record("sweep", {**row, "ratio": clocks["separate"] / clocks[way], "over_one": one})


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1000)
