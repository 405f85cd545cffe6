"""Time from the deck to the contacts, stage by stage, of structures from every source; to results/stages.csv.

::

    python -m tests.performance.bench_stages

Walls of up to 10,000 blocks by the generator, as polyhedra in the deck, as an OBJ file, turned in space and with split
faces; a dome; structures of ``decks/structures``; a deck with a fault in every block. Solids that may overlap are
intersected by several threads: processor time counts all of them.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np

from mbla.contacts import find_contacts
from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.model import build_model
from mbla.model.model import Model
from mbla.model.solids.polyhedra import Polyhedra
from tests.contacts.structures import any_rotation, blocks_of, model_of, moved, running_bond, section
from tests.decks.folder import DECKS
from tests.performance.recording import best_time, record

DECK = """\
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
blocks:
"""
DOME = "dome: {material: stone, span: 20, thickness: 0.8, rings: 50, segments: 60, springers: ground}"
FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
BRICK = np.array([0.4, 0.2, 0.1])
LAYERS = 10
"""of bricks one behind the other"""


def corners(count: int) -> list[list[list[float]]]:
    """Corners of bricks in stack bond, rounded as a drawing program does."""
    cube = np.array([[i >> 2 & 1, i >> 1 & 1, i & 1] for i in range(8)])
    side = int(np.ceil(np.sqrt(count / LAYERS)))
    places = [(number % side, number // side % LAYERS, number // (side * LAYERS)) for number in range(count)]
    return [np.round((cube + place) * BRICK, 3).tolist() for place in places]


def polyhedra(count: int, fault: str = "") -> str:
    """Items of bricks, a line each; ``fault`` in the place of the first coordinate of every one."""
    faces = [list(face) for face in FACES]
    items = (f"{{polyhedron: {{material: stone, vertices: {brick}, faces: {faces}}}}}" for brick in corners(count))
    return "".join(f"  - {item.replace('[[', f'[[{fault}', 1) if fault else item}\n" for item in items)


def obj(path: Path, count: int) -> str:
    """An OBJ file of bricks, an object each; the item that reads it."""
    lines = []
    for number, brick in enumerate(corners(count)):
        lines += [f"o brick_{number}", *(f"v {x} {y} {z}" for x, y, z in brick)]
        lines += ["f " + " ".join(str(8 * number + corner + 1) for corner in face) for face in FACES]
    path.write_text("\n".join(lines))
    return f"  - mesh: {{material: stone, file: {path.name}}}\n"


def wall(side: int) -> str:
    """A wall in running bond on the ground."""
    return f"  - wall: {{material: stone, unit: [0.4, 0.2, 0.175], length: {0.4 * side}, courses: {side}}}\n"


def decks(folder: Path) -> dict[str, Path]:
    """Decks by the name of the case."""
    items = {f"wall {side}x{side}": wall(side) for side in (10, 32, 100)}
    items |= {"5000 polyhedra": polyhedra(5000), "one fault per block": polyhedra(5000, "true, ")}
    items |= {"OBJ of 3000 bricks": obj(folder / "bricks.obj", 3000), "dome of 3000 blocks": f"  - {DOME}\n"}
    paths = {}
    for name, text in items.items():
        paths[name] = folder / f"{name.replace(' ', '_')}.yaml"
        head = DECK.replace("supports: [{ground: {z: 0}}]\n", "") if "springers" in text else DECK
        paths[name].write_text(head + text)
    return paths | {name: DECKS / "structures" / f"{name}.yaml" for name in ("house", "dome_on_drum", "arch_bridge")}


def turned_walls() -> dict[str, Model]:
    """The wall of 100 x 100 units turned in space, as it is and with every face split along a diagonal."""
    wall = running_bond(100, 100)
    quads = wall.loops.reshape(-1, 4)
    split = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]], axis=1).reshape(-1)
    starts = np.arange(0, len(split) + 1, 3)
    triangles = Polyhedra(wall.vertices, wall.vertex_start, split, starts, 2 * wall.face_start)
    solids = {"wall 100x100, turned": wall, "wall 100x100 in triangles, turned": triangles}
    return {name: model_of(blocks_of(moved(each, turn=any_rotation())), fixed=[0]) for name, each in solids.items()}


def refused(path: Path) -> None:
    """Read a deck and collect all its faults."""
    try:
        read_deck(path)
    except DeckError as error:
        str(error)


def measure(case: str, stage: str, run: Callable[[], object]) -> None:
    """Best of a few runs, one row."""
    seconds, processor = best_time(run)
    record("stages", {"case": case, "stage": stage, "seconds": seconds, "processor_seconds": processor})


def main() -> None:
    """Every stage of every case."""
    with tempfile.TemporaryDirectory() as folder:
        for name, path in decks(Path(folder)).items():
            if "fault" in name:
                measure(name, "read", partial(refused, path))
                continue
            deck = read_deck(path)
            model = build_model(deck)
            measure(name, "read", partial(read_deck, path))
            measure(name, "build", partial(build_model, deck))
            measure(name, "contacts", partial(find_contacts, model, deck.contacts))
    for name, model in turned_walls().items():
        measure(name, "contacts", partial(find_contacts, model, section()))


if __name__ == "__main__":
    main()
