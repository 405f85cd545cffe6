"""A million triangles: one block with a surface so fine, checked in a process of its own.

::

    python -m tests.trust.geometry.huge FOLDER N

writes the cuboid of ``N`` squares along each edge as a binary STL file, 12 N² triangles, a file that lacks the last
triangle, and a deck for each.
"""

from __future__ import annotations

import resource
import struct
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mbla.arrays import FloatArray
from tests.trust.geometry.judging import DECK

ITEM = "mesh: {material: stone, file: huge.stl}"
SIDES = 289
"""squares along an edge: 12 x 289 x 289 = 1,002,252 triangles"""


@dataclass(frozen=True)
class Run:
    """How ``mbla check`` took a file: exit status, its outputs, seconds by the clock, and memory at its peak, bytes."""

    status: int
    answer: str
    words: str
    seconds: float
    memory: int


def cube(n: int) -> FloatArray:
    """Triangles of the unit cube, n x n squares to a face, (12 n², 3, 3)."""
    ticks = np.arange(n + 1, dtype=np.float64) / n
    u, v = (each.ravel() for each in np.meshgrid(np.arange(n), np.arange(n), indexing="ij"))
    squares = np.stack(
        [np.stack([ticks[u + a], ticks[v + b]], axis=1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))], axis=1
    )
    flat = np.concatenate([squares[:, [0, 1, 2]], squares[:, [0, 2, 3]]])
    faces = []
    for axis in range(3):
        for side in (0.0, 1.0):
            corners = np.insert(flat, axis, side, axis=2)
            faces.append(corners if (side == 1.0) != (axis == 1) else corners[:, ::-1])
    return np.concatenate(faces)


def write(folder: Path, triangles: FloatArray) -> Path:
    """A binary STL file and its deck; the path of the deck."""
    folder.mkdir(parents=True, exist_ok=True)
    records = np.zeros(len(triangles), dtype=[("numbers", "<f4", 12), ("attribute", "<u2")])
    records["numbers"][:, 3:] = triangles.reshape(-1, 9)
    (folder / "huge.stl").write_bytes(b" " * 80 + struct.pack("<I", len(triangles)) + records.tobytes())
    deck = folder / "deck.yaml"
    deck.write_text(DECK.format(item=ITEM), encoding="utf-8")
    return deck


def check(deck: Path, limit: float) -> Run:
    """``mbla check`` in a process of its own, ended after ``limit`` seconds."""
    began = time.perf_counter()
    command = [sys.executable, "-m", "mbla", "check", "--json", str(deck)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=limit)
    seconds = time.perf_counter() - began
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024
    return Run(done.returncode, done.stdout, done.stderr, seconds, memory)


if __name__ == "__main__":
    triangles = cube(int(sys.argv[2]))
    write(Path(sys.argv[1]) / "whole", triangles)
    write(Path(sys.argv[1]) / "open", triangles[:-1])
