"""Time to build models of many blocks; run by hand, appends to results/model.csv.

::

    python -m tests.performance.bench_model
"""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np

from mbla.deck import read_deck
from mbla.model import build_model
from tests.model.shapes import Shape, box, moved, prism, rotation, write_deck
from tests.performance.recording import best_time, record

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
    with tempfile.TemporaryDirectory() as folder:
        for name, items in cases().items():
            deck = read_deck(write_deck(Path(folder), items, supports="[{blocks: base}]"))
            seconds, processor = best_time(partial(build_model, deck))
            row = {"case": name, "blocks": len(build_model(deck).blocks)}
            record("model", row | {"seconds": seconds, "processor_seconds": processor})


if __name__ == "__main__":
    main()
