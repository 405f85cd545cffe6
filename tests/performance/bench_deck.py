"""Time to read and check decks of explicit polyhedra; run by hand, appends to results/deck.csv.

::

    python tests/performance/bench_deck.py

`events` is the time in which the YAML parser alone goes through the text: the floor below which no reader gets.
Times of the processor are recorded beside those of the clock, which suffer from whatever else the machine does.
"""

from __future__ import annotations

import csv
import os
import platform
import sys
import tempfile
import time
from collections.abc import Callable
from datetime import UTC, datetime
from functools import partial
from importlib.metadata import version
from pathlib import Path

import yaml

from mbla.deck import read_deck
from mbla.errors import DeckError

RESULTS = Path(__file__).parent / "results" / "deck.csv"
COLUMNS = [
    *("date", "case", "blocks", "megabytes", "seconds", "cpu_seconds", "events_cpu_seconds"),
    *("mbla", "pyyaml", "pydantic", "python", "machine", "cores"),
]
REPEATS = 5
HEAD = """mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
contacts: {joint: dry}
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
blocks:
"""
FACES = "[[0,1,3,2],[4,5,7,6],[0,1,5,4],[2,3,7,6],[0,2,6,4],[1,3,7,5]]"


def polyhedra(n_blocks: int, fault: str = "") -> str:
    """Deck of cuboids, each as 8 vertices and 6 faces; ``fault`` replaces the first coordinate of every block."""
    rows = []
    for block in range(n_blocks):
        row, column = divmod(block, 70)
        x, z = 0.4 * column, 0.2 * row
        corners = ((x + dx, dy, z + dz) for dz in (0, 0.2) for dy in (0, 0.2) for dx in (0, 0.4))
        vertices = ",".join(f"[{a:.6g},{b:g},{c:.6g}]" for a, b, c in corners)
        if fault:
            vertices = f"[{fault}" + vertices[vertices.index(",") :]
        rows.append(f"  - polyhedron: {{material: stone, vertices: [{vertices}], faces: {FACES}}}\n")
    return HEAD + "".join(rows)


def best_time(run: Callable[[], object]) -> tuple[float, float]:
    """Shortest of a few runs by the clock and by the processor, in seconds."""
    clock, processor = [], []
    for _ in range(REPEATS):
        start = time.perf_counter(), time.process_time()
        run()
        clock.append(time.perf_counter() - start[0])
        processor.append(time.process_time() - start[1])
    return min(clock), min(processor)


def go_through_events(text: str) -> None:
    """Nothing but the parser."""
    parser = yaml.CSafeLoader(text)
    while parser.get_event() is not None:
        pass


def read(path: Path) -> None:
    """Read a deck, or collect all its faults."""
    try:
        read_deck(path)
    except DeckError as error:
        str(error)


def main() -> None:
    """Best of a few runs of each case, one row each."""
    versions = [version("mbla"), version("pyyaml"), version("pydantic"), platform.python_version()]
    machine = [f"{platform.machine()} {platform.system()}, {_processor()}", str(os.cpu_count())]
    new = not RESULTS.exists()
    RESULTS.parent.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, RESULTS.open("a", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        if new:
            writer.writerow(COLUMNS)
        for case, n_blocks, fault in [("valid", 500, ""), ("valid", 5000, ""), ("one fault per block", 5000, "true")]:
            text = polyhedra(n_blocks, fault)
            path = Path(folder) / "deck.yaml"
            path.write_text(text, encoding="utf-8")
            _, events = best_time(partial(go_through_events, text))
            seconds, cpu = best_time(partial(read, path))
            row = [case, n_blocks, f"{len(text) / 1e6:.2f}", f"{seconds:.3f}", f"{cpu:.3f}", f"{events:.3f}"]
            writer.writerow([datetime.now(UTC).date().isoformat(), *row, *versions, *machine])
            sys.stdout.write(f"{case:20} {n_blocks:6} blocks  {row[2]} MB  {seconds:.3f} s, ")
            sys.stdout.write(f"of the processor {cpu:.3f} s, events alone {events:.3f} s\n")


def _processor() -> str:
    """Model of the processor, where the system says."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text(encoding="utf-8").splitlines() if info.exists() else []
    return next(
        (line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), platform.processor()
    )


if __name__ == "__main__":
    main()
