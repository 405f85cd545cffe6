"""Files of what acts on the structure and what holds it.

``STEM_CASE_loads.vtu``: dead loads, live loads and reactions as vectors where they act.

A force F and a moment M about the centroid c of a block are, where M is across F, a single force on the line through
c + F × M / F². It is drawn there, level with the centroid along its own direction; where that point lies outside the
box around the block, or a moment along F is left, at the centroid with the moment beside it. The axles of a load that
travels are drawn where they stand. Whatever the point, force and moment at it are statically the load of the deck.

``STEM_supports.vtu``: ground planes as slabs under what stands on them, fixed blocks and guided blocks.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.geometry.meshio_files import write_mesh
from mbla.model.model import Model, TravelPosition
from mbla.model.solids.blocks import Blocks
from mbla.results.collapse.interface_modes import sum_by_interface
from mbla.results.collapse.mechanics import global_forces
from mbla.results.collapse.motion import displacements_at
from mbla.results.pictures.geometry import SLAB_FACES, ground_slab
from mbla.results.pictures.loads import lines_of_action
from mbla.results.record.scene import FIGURES, Scene
from mbla.results.series import without_vehicle
from mbla.solution.verification.statics import contact_resultants

DEAD, LIVE, REACTION, GUIDE = 0, 1, 2, 3
"""kinds of vectors"""
ROUNDING = 1e-7
"""relative to force and block size: below it moments and distances are none; far from the origin digits are lost"""


@dataclass(frozen=True)
class Vectors:
    """Forces of one kind at points, with the moments that are left about these, and the body that each acts on."""

    kind: int
    bodies: IntArray
    points: FloatArray
    forces: FloatArray
    moments: FloatArray

    def __len__(self) -> int:
        return len(self.bodies)


def has_loads(scene: Scene) -> bool:
    """Whether anything acts on the structure."""
    return any(len(vectors) for vectors in load_vectors(scene))


def load_vectors(scene: Scene) -> tuple[Vectors, ...]:
    """Dead load, live load (for load factor 1), reactions of supports and of guides, those that there are."""
    if scene.case is None:
        return ()
    load_case, blocks = scene.case.load_case, scene.model.blocks
    found = (
        _on_blocks(DEAD, blocks, load_case.dead_load),
        _on_blocks(LIVE, blocks, without_vehicle(blocks, load_case.live_load, load_case.travel)),
        *_of_vehicle(load_case.travel),
        *_reactions(scene),
    )
    return tuple(vectors for vectors in found if len(vectors))


def write_loads_vtu(path: Path, scene: Scene) -> None:
    """Vectors as vertices at their points."""
    parts = load_vectors(scene)
    kind = np.concatenate([np.full(len(part), part.kind, dtype=np.int8) for part in parts])
    bodies, points, forces, moments = (
        np.concatenate([getattr(part, name) for part in parts]) for name in ("bodies", "points", "forces", "moments")
    )
    write_mesh(
        path,
        points,
        [("vertex", np.arange(len(points))[:, None])],
        point_data={
            "dead_forces": np.where((kind == DEAD)[:, None], forces, 0.0),
            "live_forces": np.where((kind == LIVE)[:, None], forces, 0.0),
            "reaction_forces": np.where((kind >= REACTION)[:, None], forces, 0.0),
            "moments": moments,
            "kind": kind,
            "body": bodies,
            "fixed": scene.model.fixed[bodies].astype(np.int8),
            "displacement": displacements_at(scene.model.blocks, scene.motion, bodies, points),
            "figures": np.full(len(points), FIGURES.index(scene.figures)),
        },
        cell_data={},
    )


def _on_blocks(kind: int, blocks: Blocks, loads: FloatArray) -> Vectors:
    """Loads about centroids, (n_blocks, 6), as vectors at points; blocks without load are left out."""
    bodies = np.flatnonzero(loads.any(axis=1))
    forces, moments, sizes = loads[bodies, :3], loads[bodies, 3:], blocks.sizes[bodies]
    points, left = lines_of_action(blocks.centroids[bodies], loads[bodies])
    first = blocks.vertex_start[:-1]
    low, high = (each.reduceat(blocks.vertices, first)[bodies] for each in (np.minimum, np.maximum))
    slack = ROUNDING * sizes[:, None]
    inside = ((points >= low - slack) & (points <= high + slack)).all(axis=1)
    force = np.linalg.norm(forces, axis=1)
    there = ((force > 0) & inside & (np.linalg.norm(left, axis=1) <= ROUNDING * force * sizes))[:, None]
    at = np.where(there, points, blocks.centroids[bodies])
    return Vectors(kind, bodies, at, forces, np.where(there, 0.0, moments))


def _of_vehicle(travel: TravelPosition | None) -> tuple[Vectors, ...]:
    """The axles of a travelling load that act, each where it stands."""
    if travel is None:
        return ()
    acting = travel.acting
    forces = travel.forces[acting]
    return (Vectors(LIVE, travel.blocks[acting], travel.points[acting], forces, np.zeros_like(forces)),)


def _reactions(scene: Scene) -> tuple[Vectors, ...]:
    """What supports do to the structure at each interface with one, and guides at each guided block."""
    if scene.forces is None:
        return ()
    return _of_supports(scene, scene.forces), _of_guides(scene, scene.forces)


def _of_supports(scene: Scene, forces: FloatArray) -> Vectors:
    """At the point of application of each interface between a support and a free block."""
    model, contacts, thrust = scene.model, scene.contacts, scene.thrust
    held = np.concatenate([model.fixed, np.ones(len(model.grounds), dtype=bool)])[contacts.bodies]
    wrench = global_forces(contacts, forces)
    loaded = sum_by_interface(contacts, np.linalg.norm(wrench, axis=1)) > 0
    rows = np.flatnonzero((held[:, 0] != held[:, 1]) & loaded)
    a_is_support = held[rows, 0]
    points = contacts.centroids.copy()
    if thrust is not None:
        points[thrust.carried] = thrust.points[thrust.carried]
    arms = contacts.points - points[contacts.interface_of_point]
    sums = sum_by_interface(contacts, np.hstack([wrench, np.cross(arms, wrench)]))[rows]
    sums *= np.where(a_is_support, 1.0, -1.0)[:, None]
    bodies = np.where(a_is_support, contacts.bodies[rows, 1], contacts.bodies[rows, 0])
    return Vectors(REACTION, bodies, points[rows], sums[:, :3], sums[:, 3:])


def _of_guides(scene: Scene, forces: FloatArray) -> Vectors:
    """At the centroid of each guided block: what leaves it in balance. Forces that lock balance the live load alone."""
    model: Model = scene.model
    bodies = model.guides.blocks
    case = scene.case
    if case is None or not len(bodies):
        return Vectors(GUIDE, bodies[:0], np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 3)))
    acting = contact_resultants(model, scene.contacts, forces)
    if scene.mechanics is None:
        acting = acting + case.load_case.live_load
    else:
        acting = acting + case.load_case.dead_load + scene.mechanics.load_factor * case.load_case.live_load
    taken = -acting[bodies]
    return Vectors(GUIDE, bodies, model.blocks.centroids[bodies], taken[:, :3], taken[:, 3:])


GROUND, FIXED, GUIDED = 0, 1, 2
"""kinds of supports"""


def support_slabs(model: Model, contacts: Contacts) -> tuple[tuple[int, FloatArray], ...]:
    """Ground planes that carry something, with the corners of a slab for each, (8, 3) m."""
    size = float(np.linalg.norm(np.ptp(model.blocks.vertices, axis=0)))
    slabs = [(ground, ground_slab(model, contacts, ground, size)) for ground in range(len(model.grounds))]
    return tuple((ground, slab) for ground, slab in slabs if slab is not None)


def has_supports(model: Model, contacts: Contacts) -> bool:
    """Whether there is a support to be seen."""
    return bool(model.fixed.any() or len(model.guides) or support_slabs(model, contacts))


def write_supports_vtu(path: Path, model: Model, contacts: Contacts) -> None:
    """Supports as polyhedra."""
    slabs = support_slabs(model, contacts)
    guided = np.setdiff1d(model.guides.blocks, np.flatnonzero(model.fixed))
    chosen = np.concatenate([np.flatnonzero(model.fixed), guided]).astype(np.int64)
    cells, vertices = _cells_of_blocks(model, chosen)
    for number, (_, slab) in enumerate(slabs):
        cells.append(list(_outward_faces(slab) + 8 * number + len(vertices)))
    kinds = [FIXED] * int(model.fixed.sum()) + [GUIDED] * len(guided) + [GROUND] * len(slabs)
    bodies = np.append(chosen, [len(model.blocks) + ground for ground, _ in slabs]).astype(np.int64)
    write_mesh(
        path,
        np.concatenate([vertices, *(slab for _, slab in slabs)]),
        [("polyhedron", cells)],
        point_data={},
        cell_data={"kind": [np.array(kinds, dtype=np.int8)], "body": [bodies]},
    )


def _outward_faces(slab: FloatArray) -> IntArray:
    """Faces of a slab, (6, 4), by rows of its corners, whatever way round its axes are."""
    right_handed = np.linalg.det(slab[[1, 2, 4]] - slab[0]) > 0
    return np.asarray(SLAB_FACES if right_handed else SLAB_FACES[:, ::-1])


def _cells_of_blocks(model: Model, chosen: IntArray) -> tuple[list[Any], FloatArray]:
    """Faces of each chosen block by rows of the vertices of these blocks alone, and these vertices, (n, 3) m."""
    blocks = model.blocks
    kept = np.isin(blocks.block_of_vertex, chosen)
    row = np.cumsum(kept) - 1
    cells = []
    for block in chosen.tolist():
        faces = range(int(blocks.face_start[block]), int(blocks.face_start[block + 1]))
        cells.append([row[blocks.loops[blocks.loop_start[face] : blocks.loop_start[face + 1]]] for face in faces])
    return cells, blocks.vertices[kept]
