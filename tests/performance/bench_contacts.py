"""Time to find the contacts of running-bond walls; run by hand, appends to results/contacts.csv.

::

    python tests/performance/bench_contacts.py
"""

from __future__ import annotations

import csv
import platform
import time
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path

import numpy as np

from mbla.contacts import find_contacts
from mbla.model.model import Model
from mbla.model.polyhedra import Polyhedra
from tests.contacts.structures import any_rotation, blocks_of, model_of, moved, running_bond, section

RESULTS = Path(__file__).parent / "results" / "contacts.csv"
COLUMNS = [
    "date",
    "case",
    "blocks",
    "interfaces",
    "seconds",
    "processor_seconds",
    "mbla",
    "numpy",
    "shapely",
    "python",
    "machine",
]
REPEATS = 3


def split_into_triangles(polyhedra: Polyhedra) -> Polyhedra:
    """The same hexahedra with every face split along a diagonal."""
    quads = polyhedra.loops.reshape(-1, 4)
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]], axis=1).reshape(-1)
    return Polyhedra(
        polyhedra.vertices,
        polyhedra.vertex_start,
        triangles,
        np.arange(0, len(triangles) + 1, 3),
        2 * polyhedra.face_start,
    )


def cases() -> dict[str, Model]:
    """Models by name; the base slab is one fixed block."""
    walls = {f"wall {n}x{n}": running_bond(n, n) for n in (10, 32, 100)}
    large = walls["wall 100x100"]
    walls["wall 100x100 rotated"] = moved(large, turn=any_rotation())
    walls["wall 100x100 in triangles, rotated"] = moved(split_into_triangles(large), turn=any_rotation())
    return {name: model_of(blocks_of(wall), fixed=[0]) for name, wall in walls.items()}


def main() -> None:
    """Best of a few runs of each case, one row each."""
    new = not RESULTS.exists()
    RESULTS.parent.mkdir(exist_ok=True)
    machine = f"{platform.machine()} {platform.system()}, {_processor()}"
    models = cases()
    find_contacts(models["wall 10x10"], section())  # imports are not part of the time
    with RESULTS.open("a", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        if new:
            writer.writerow(COLUMNS)
        for name, model in models.items():
            seconds, processor = [], []
            for _ in range(REPEATS):
                start, used = time.perf_counter(), time.process_time()
                contacts = find_contacts(model, section())
                seconds.append(time.perf_counter() - start)
                processor.append(time.process_time() - used)
            row = [datetime.now(UTC).date().isoformat(), name, len(model.blocks), len(contacts)]
            row += [f"{min(seconds):.4f}", f"{min(processor):.4f}"]  # they differ where the machine is busy
            row += [version("mbla"), version("numpy"), version("shapely"), platform.python_version(), machine]
            writer.writerow(row)


def _processor() -> str:
    """Model name of the processor where the system tells it."""
    information = Path("/proc/cpuinfo")
    names = [
        line.split(":", 1)[1].strip()
        for line in (information.read_text(encoding="utf-8").splitlines() if information.exists() else [])
        if line.startswith("model name")
    ]
    return f"{len(names)} x {names[0]}" if names else platform.processor()


if __name__ == "__main__":
    main()
