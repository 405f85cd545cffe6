"""Time to build models of many blocks; run by hand, appends to results/model.csv.

::

    python tests/performance/bench_model.py
"""

from __future__ import annotations

import csv
import platform
import tempfile
import time
from collections.abc import Sequence
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path

import numpy as np

from mbla.deck import read_deck
from mbla.model import build_model
from tests.model.shapes import Shape, box, moved, prism, rotation, write_deck

RESULTS = Path(__file__).parent / "results" / "model.csv"
COLUMNS = ["date", "case", "blocks", "seconds", "mbla", "numpy", "scipy", "python", "machine"]
REPEATS = 3
STAR = [(np.cos(a) * (1 + i % 2), np.sin(a) * (1 + i % 2)) for i, a in enumerate(np.pi * np.arange(12) / 6)]


def polyhedra(shape: Shape, count: int) -> list[str]:
    """Deck items of one shape in a row, every second one with its first face turned inwards."""
    items = []
    for number in range(count):
        vertices, faces = moved(shape, rotation(number), (5.0 * number, 0, 100))
        listed = [list(face) for face in faces]
        if number % 2:
            listed[0].reverse()
        points = [[round(x, 6) for x in vertex] for vertex in vertices]
        items.append(f"polyhedron: {{group: stones, material: stone, vertices: {points}, faces: {listed}}}")
    return items


def cases() -> dict[str, Sequence[str]]:
    """Items of `blocks` by name of the case."""
    anchor = "box: {group: base, material: stone, min: [0, 0, -1], max: [1, 1, 0]}"
    wall = "wall: {material: stone, unit: [0.4, 0.2, 0.175], length: 40, courses: 100}"
    return {
        "5000 polyhedra": [anchor, *polyhedra(box(), 5000)],
        "5000 non-convex polyhedra": [anchor, *polyhedra(prism(STAR), 5000)],
        "wall 100x100": [anchor, wall],
    }


def main() -> None:
    """Best of a few runs of each case, one row each."""
    new = not RESULTS.exists()
    RESULTS.parent.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, RESULTS.open("a", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        if new:
            writer.writerow(COLUMNS)
        for name, items in cases().items():
            deck = read_deck(write_deck(Path(folder), items, supports="[{blocks: base}]"))
            seconds, blocks = np.inf, 0
            for _ in range(REPEATS):
                started = time.perf_counter()
                blocks = len(build_model(deck).blocks)
                seconds = min(seconds, time.perf_counter() - started)
            versions = [version("mbla"), np.__version__, version("scipy"), platform.python_version()]
            machine = f"{platform.machine()} {platform.system()}, {_processor()}"
            date = datetime.now(UTC).isoformat(timespec="seconds")
            writer.writerow([date, name, blocks, f"{seconds:.3f}", *versions, machine])


def _processor() -> str:
    """Model name of the processor, where the system tells it."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text(encoding="utf-8").splitlines() if info.exists() else []
    return next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), "unknown processor")


if __name__ == "__main__":
    main()
