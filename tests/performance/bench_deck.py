"""Time to read and check decks of explicit polyhedra; run by hand, appends to results/deck.csv.

::

    python -m tests.performance.bench_deck

`events` is the time in which the YAML parser alone goes through the text: the floor below which no reader gets.
Times of the processor are recorded beside those of the clock, which suffer from whatever else the machine does.
"""

from __future__ import annotations

import tempfile
from functools import partial
from pathlib import Path

import yaml

from mbla.deck import read_deck
from mbla.errors import DeckError
from tests.performance.recording import best_time, record

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
    with tempfile.TemporaryDirectory() as folder:
        for case, n_blocks, fault in [("valid", 500, ""), ("valid", 5000, ""), ("one fault per block", 5000, "true")]:
            text = polyhedra(n_blocks, fault)
            path = Path(folder) / "deck.yaml"
            path.write_text(text, encoding="utf-8")
            _, events = best_time(partial(go_through_events, text))
            seconds, processor = best_time(partial(read, path))
            row = {"case": case, "blocks": n_blocks, "megabytes": len(text) / 1e6, "seconds": seconds}
            record("deck", row | {"processor_seconds": processor, "events_processor_seconds": events})


if __name__ == "__main__":
    main()
