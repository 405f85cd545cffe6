"""Meshes of what acts on the structure and what holds it.

Dead loads, live loads and reactions are vectors where they act. A force F and a moment M about the centroid c of a
block are, where M is across F, a single force on the line through c + F × M / F². It is drawn there, level with the
centroid along its own direction; where that point lies outside the box around the block, or a moment along F is left,
at the centroid together with the moment. The axles of a load that travels are drawn where they
stand, or, shared between blocks, as what lands on each. Whatever the
point, force and moment at it are statically the load of the deck.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.model.solids.blocks import Blocks
from mbla.questions.travel_position import TravelPosition
from mbla.results.collapse.interface_modes import sum_by_interface
from mbla.results.collapse.mechanics import global_forces
from mbla.results.collapse.motion import displacements_at
from mbla.results.collapse.ties import acting_with_ties
from mbla.results.pictures.geometry import ground_slabs
from mbla.results.pictures.marks.loads import lines_of_action
from mbla.results.record.scene import FIGURES, Scene
from mbla.results.series import without_vehicle
from mbla.results.vtu.arrays import Arrays
from mbla.results.vtu.meshes import Mesh, polyhedra
from mbla.solution.verification.statics import contact_resultants

DEAD, LIVE, REACTION, GUIDE = 0, 1, 2, 3
"""kinds of vectors"""
GROUND, FIXED, GUIDED = 0, 1, 2
"""kinds of supports"""
ROUNDING = 1e-7
"""relative to force and block size: below it moments and distances are zero; far from the origin digits are lost"""


@dataclass(frozen=True)
class Vectors:
    """Forces of one kind at points, with the moments that are left about these, and the body that each acts on."""

    kind: int
    bodies: IntArray
    points: FloatArray
    forces: FloatArray
    moments: FloatArray


def loads_mesh(scene: Scene) -> Mesh | None:
    """Vectors as vertices at their points; None where nothing acts."""
    parts = load_vectors(scene)
    if not parts:
        return None
    kind = np.concatenate([np.full(len(part.bodies), part.kind, dtype=np.int8) for part in parts])
    bodies, points, forces, moments = (
        np.concatenate([getattr(part, name) for part in parts]) for name in ("bodies", "points", "forces", "moments")
    )
    data = {
        "dead_forces": np.where((kind == DEAD)[:, None], forces, 0.0),
        "live_forces": np.where((kind == LIVE)[:, None], forces, 0.0),
        "reaction_forces": np.where((kind >= REACTION)[:, None], forces, 0.0),
        "moments": moments,
        "kind": kind,
        "body": bodies,
        "fixed": scene.model.fixed[bodies].astype(np.int8),
        "displacement": displacements_at(scene.model.blocks, scene.motion, bodies, points),
        "figures": np.full(len(points), FIGURES.index(scene.figures)),
    }
    return Mesh(points, [("vertex", np.arange(len(points))[:, None], slice(None))], data, {})


def load_vectors(scene: Scene) -> tuple[Vectors, ...]:
    """Dead load, live load (for load factor 1), reactions of supports and of guides, those that there are."""
    if scene.case is None:
        return ()
    load_case, blocks, place = scene.case.load_case, scene.model.blocks, scene.case.load_case.question.place
    found = (
        _on_blocks(DEAD, blocks, load_case.dead_load),
        _on_blocks(LIVE, blocks, without_vehicle(blocks, load_case.live_load, place)),
        _of_vehicle(place),
        *_reactions(scene),
    )
    return tuple(vectors for vectors in found if len(vectors.bodies))


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


def _of_vehicle(travel: TravelPosition) -> Vectors:
    """The axles of a travelling load that act, each where it stands; none that are shared between blocks."""
    forces, own = travel.forces[travel.apart], travel.apart
    return Vectors(LIVE, travel.blocks[own], travel.points[own], forces, np.zeros_like(forces))


def _reactions(scene: Scene) -> tuple[Vectors, ...]:
    """What supports do to the structure at each interface with one, and guides at each guided block."""
    case, forces, guided = scene.case, scene.forces, len(scene.model.guides.blocks) > 0
    if forces is None:
        return ()
    guides = (_of_guides(scene, case.load_case, forces),) if guided and case is not None else ()
    return _of_supports(scene, forces), *guides


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


def _of_guides(scene: Scene, load_case: LoadCase, forces: FloatArray) -> Vectors:
    """At the centroid of each guided block: what leaves it in balance. Forces that lock balance the live load alone."""
    model: Model = scene.model
    bodies = model.guides.blocks
    acting = contact_resultants(model, scene.contacts, forces)
    if scene.mechanics is None:
        acting = acting + load_case.live_load
    else:
        acting = acting_with_ties(model, acting, scene.mechanics)
        acting = acting + load_case.dead_load + scene.mechanics.load_factor * load_case.live_load
    taken = -acting[bodies]
    return Vectors(GUIDE, bodies, model.blocks.centroids[bodies], taken[:, :3], taken[:, 3:])


def supports_mesh(model: Model, contacts: Contacts) -> Mesh | None:
    """Slabs under what stands on ground, fixed blocks and guided blocks as polyhedra; None where none is."""
    size = float(np.linalg.norm(np.ptp(model.blocks.vertices, axis=0)))
    slabs = [
        (ground, slab) for ground in range(len(model.grounds)) for slab in ground_slabs(model, contacts, ground, size)
    ]
    fixed = np.flatnonzero(model.fixed)
    guided = np.setdiff1d(model.guides.blocks, fixed)
    chosen = np.concatenate([fixed, guided]).astype(np.int64)
    used = np.isin(model.blocks.block_of_vertex, chosen)
    row, of_block = np.cumsum(used) - 1, polyhedra(model.blocks)
    cells = [[row[face] for face in of_block[block]] for block in chosen.tolist()]
    kinds, bodies, points = (
        [FIXED] * len(fixed) + [GUIDED] * len(guided),
        chosen.tolist(),
        [model.blocks.vertices[used]],
    )
    for ground, slab in slabs:
        cells.append([face + sum(map(len, points)) for face in slab.faces])
        kinds.append(GROUND)
        bodies.append(len(model.blocks) + ground)
        points.append(slab.points)
    data: Arrays = {"kind": np.array(kinds, dtype=np.int8), "body": np.array(bodies, dtype=np.int64)}
    return Mesh(np.concatenate(points), [("polyhedron", cells, slice(None))], {}, data) if cells else None
