"""Time to find the contacts of running-bond walls; run by hand, appends to results/contacts.csv.

::

    python -m tests.performance.bench_contacts
"""

from __future__ import annotations

from functools import partial

import numpy as np

from mbla.contacts import find_contacts
from mbla.model.model import Model
from mbla.model.solids.polyhedra import Polyhedra
from tests.contacts.structures import any_rotation, blocks_of, model_of, moved, running_bond, section
from tests.performance.recording import best_time, record


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
    models = cases()
    find_contacts(models["wall 10x10"], section())  # imports are not part of the time
    for name, model in models.items():
        seconds, processor = best_time(partial(find_contacts, model, section()))
        interfaces = len(find_contacts(model, section()))
        row = {"case": name, "blocks": len(model.blocks), "interfaces": interfaces}
        record("contacts", row | {"seconds": seconds, "processor_seconds": processor})


if __name__ == "__main__":
    main()
