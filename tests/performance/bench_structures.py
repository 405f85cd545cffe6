"""Time from the deck to the contacts of structures that generators and files make; appends to results/structures.csv.

::

    python -m tests.performance.bench_structures
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np

from mbla.contacts import find_contacts
from mbla.deck import read_deck
from mbla.model import build_model
from tests.decks.folder import DECKS
from tests.performance.recording import best_time, record

LAYERS = 10
"""of bricks one behind the other in the file of bricks"""


def wall(columns: int, courses: int) -> str:
    """A wall on the ground."""
    size = f"unit: [0.4, 0.2, 0.175], length: {0.4 * columns}, courses: {courses}"
    return f"wall: {{group: stones, material: stone, {size}}}"


DOME = "dome: {group: stones, material: stone, span: 20, thickness: 0.8, rings: 50, segments: 60, springers: ground}"


def bricks(path: Path, count: int) -> str:
    """An OBJ file of bricks in stack bond, an object each; the item that reads it."""
    corners = np.array([[i >> 2 & 1, i >> 1 & 1, i & 1] for i in range(8)]) * [0.4, 0.2, 0.1]
    faces = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    side = int(np.ceil(np.sqrt(count / LAYERS)))
    lines = []
    for number in range(count):
        place = np.array([number % side, number // side % LAYERS, number // (side * LAYERS)]) * [0.4, 0.2, 0.1]
        lines += [f"o brick_{number}", *(f"v {x:.3f} {y:.3f} {z:.3f}" for x, y, z in corners + place)]
        lines += ["f " + " ".join(str(8 * number + corner + 1) for corner in face) for face in faces]
    path.write_text("\n".join(lines))
    return f"mesh: {{group: stones, material: stone, file: {path.name}}}"


def decks(folder: Path) -> dict[str, Path]:
    """Decks by the name of the case."""
    items = {
        "wall 25x40": wall(25, 40),
        "wall 100x100": wall(100, 100),
        "dome of 3000 blocks": DOME,
        "OBJ of 3000 bricks": bricks(folder / "bricks.obj", 3000),
    }
    paths = {}
    for name, item in items.items():
        paths[name] = folder / f"{name.replace(' ', '_')}.yaml"
        supports = "" if "springers" in item else "supports: [{ground: {z: 0}}]\n"
        paths[name].write_text(
            "mbla: 1\nmaterials: {stone: {density: 2000}}\njoints: {dry: {friction: 0.6}}\n"
            f"blocks:\n  - {item}\ncontacts: {{joint: dry}}\n{supports}"
            "load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}\n"
        )
    return paths | {name: DECKS / "structures" / f"{name}.yaml" for name in ("house", "dome_on_drum", "arch_bridge")}


def main() -> None:
    """Best of a few runs of each stage of each case, one row each.

    Solids that may overlap are intersected by several threads: processor time counts all of them and scatters where the
    machine is busy, so that it says little without the clock beside it.
    """
    with tempfile.TemporaryDirectory() as folder:
        for name, path in decks(Path(folder)).items():
            deck = read_deck(path)
            model = build_model(deck)
            contacts = find_contacts(model, deck.contacts)
            stages: dict[str, Callable[[], object]] = {
                "read": partial(read_deck, path),
                "build": partial(build_model, deck),
                "contacts": partial(find_contacts, model, deck.contacts),
            }
            row = {"case": name, "blocks": len(model.blocks), "interfaces": len(contacts)}
            times: dict[str, float] = {}
            for stage, run in stages.items():
                times[f"{stage}_seconds"], times[f"{stage}_processor_seconds"] = best_time(run)
            record("structures", row | times)


if __name__ == "__main__":
    main()
