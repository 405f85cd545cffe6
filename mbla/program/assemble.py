"""From model, contacts and load case to the non-dimensional program.

Light blocks have units of force of their own. A program in units of the mean load cannot resolve a block whose load is
below the rounding of that unit: a block of 1 m on a free block of 10 km has 2e-12 of it. A light block, or a pile of
light blocks, that touches no more than one heavier body carries only its own loads. The unit of its equations of
equilibrium, and of the forces at its contacts, is then its own load.

A light block between two heavy blocks, or between a heavy block and a guide, carries the force between these, and keeps
the unit of the mean load.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts, TieContacts
from mbla.model.model import LoadCase, Model
from mbla.model.solids.measures import connected_labels
from mbla.program.facts import ModelFacts
from mbla.program.program import Program, Scaling
from mbla.program.reductions.restrict import guide_projector, guided_program
from mbla.program.stiffness_shares import stiffness_areas
from mbla.program.yield_conditions.limits import YieldLimits


def assemble(model: Model, contacts: Contacts, load_case: LoadCase, *, own: bool = True) -> Program:
    """Build the program of one load case; nothing in it depends on the deck's units.

    own : light blocks may have units of their own (:mod:`mbla.program.assemble`); none have where a support settles,
          whose load is a reaction that may be negligible

    With guided blocks it is a reduction of the program in which these are free.
    """
    program = _assemble_unguided(model, contacts, load_case, own)
    return guided_program(program, program.facts.allowed)


def _assemble_unguided(model: Model, contacts: Contacts, load_case: LoadCase, own: bool) -> Program:
    """The program in which guided blocks move freely, six rows a free block."""
    free = model.free
    dead, live = load_case.dead_load[free].ravel(), load_case.live_load[free].ravel()
    scaling = _scaling(lever_arms(model, contacts, free), dead, live)
    if own and load_case.question.multiplies:
        scaling = _in_own_units(scaling, model, contacts, dead, live)
    matrix = sp.diags_array(scaling.row * scaling.force) @ equilibrium_matrix(model, contacts, free)
    if not isinstance(scaling.units, float):
        matrix = matrix @ sp.diags_array(np.repeat(scaling.units, 3))
    return Program(
        equilibrium_matrix=sp.csr_array(matrix),
        dead_load=scaling.row * dead,
        live_load=scaling.row * live * scaling.live,
        limits=yield_limits(model, contacts).scaled(1.0 / (scaling.force * scaling.units)),
        scaling=scaling,
        facts=ModelFacts(
            free=free,
            n_blocks=len(model.blocks),
            areas=stiffness_areas(contacts),
            settling_support=not load_case.question.multiplies,
            allowed=guide_projector(model, free, scaling),
            brittle=None if contacts.ties is None else brittle_points(contacts, contacts.ties),
        ),
    )


def brittle_points(contacts: Contacts, ties: TieContacts) -> BoolArray:
    """Points that carry nothing any more once they have given way at their greatest and at their least force."""
    brittle = np.zeros((len(contacts.points), 2), dtype=np.bool_)
    brittle[contacts.tie_points] = ties.brittle
    return brittle


def yield_limits(model: Model, contacts: Contacts) -> YieldLimits:
    """Limits of every contact point in the deck's units: joint law times share of area, or those of its tie."""
    laws = [model.joints[name] for name in contacts.joint_names]
    joint = contacts.joints[contacts.interface_of_point]
    areas = contacts.point_areas

    def per_point(values: list[float]) -> FloatArray:
        return np.asarray(values, dtype=np.float64)[joint] if len(joint) else np.zeros(0)

    with np.errstate(invalid="ignore"):  # inf × 0 cannot arise: areas are positive where strengths are finite
        compression = per_point([law.compressive_strength for law in laws])
        compression = np.where(np.isinf(compression), np.inf, compression * areas)
    tension = per_point([law.tensile_strength for law in laws]) * areas
    if contacts.ties is not None:
        tension[contacts.tie_points], compression[contacts.tie_points] = (
            contacts.ties.tension,
            contacts.ties.compression,
        )
    return YieldLimits(
        friction=per_point([law.friction for law in laws]),
        dilatancy=per_point([law.dilatancy for law in laws]),
        cohesion=per_point([law.cohesion for law in laws]) * areas,
        tension=tension,
        compression=compression,
    )


def _scaling(arms: FloatArray, dead: FloatArray, live: FloatArray) -> Scaling:
    """Unit of force: mean load of the loaded free blocks; unit of moment: that times the block's own lever arm.

    Loads count with their moments over the lever arm, so that a pure couple has a size too. Without these units the
    same structure in centimetres, or with weights times 1e6, gives wrong load factors with status Solved.
    """
    per_length = np.repeat(1.0 / arms, 6).reshape(-1, 6)
    per_length[:, :3] = 1.0
    dead_sizes = np.linalg.norm(dead.reshape(-1, 6) * per_length, axis=1)
    live_sizes = np.linalg.norm(live.reshape(-1, 6) * per_length, axis=1)
    loaded = dead_sizes[dead_sizes > 0] if np.any(dead_sizes > 0) else live_sizes[live_sizes > 0]
    force = float(loaded.mean())
    live_size = float(np.sqrt((live_sizes**2).sum() / len(arms)))
    return Scaling(force=force, live=force / live_size, row=(per_length / force).ravel())


def _in_own_units(scaling: Scaling, model: Model, contacts: Contacts, dead: FloatArray, live: FloatArray) -> Scaling:
    """The same with units of their own for light blocks, where there are any; the live load is counted in these too."""
    number = np.full(len(model.blocks) + len(model.grounds), -1)
    number[model.free] = np.arange(len(model.free))
    dead_sizes, live_sizes = (np.linalg.norm((scaling.row * load).reshape(-1, 6), axis=1) for load in (dead, live))
    bodies = number[contacts.bodies]
    dead_sizes[number[model.guides.blocks]] = 1.0  # guides press back whatever presses on such a block
    units = own_units(dead_sizes, bodies)
    if (units == 1.0).all():
        return scaling
    return Scaling(
        force=scaling.force,
        live=1.0 / float(np.sqrt(np.mean((live_sizes / units) ** 2))),
        row=scaling.row / np.repeat(units, 6),
        units=np.append(units, 1.0)[bodies].min(axis=1)[contacts.interface_of_point],
    )


LIGHT = 1e-8
"""Load of a block over the mean load, below which it gets a unit of its own: above it the common one is sharp enough
(:mod:`mbla.results.findings`)."""


def own_units(loads: FloatArray, bodies: IntArray) -> FloatArray:
    """Unit of each free block over the mean load, (n_free,); 1 but for light ones.

    loads  : (n_free,) over the mean load
    bodies : (n_interfaces, 2) free blocks by their number among these, −1 for everything that does not move
    """
    light = (loads > 0) & (loads < LIGHT)
    units = np.ones(len(loads))
    if not light.any():
        return units
    is_light = np.append(light, False)[bodies]  # −1 takes the last entry
    inside, edge = bodies[is_light.all(axis=1)], bodies[is_light.sum(axis=1) == 1]
    pile = connected_labels(inside, len(loads))
    second = np.append(light, False)[edge[:, 1]]
    lighter, heavier = np.where(second, edge[:, ::-1].T, edge.T)
    touched = np.unique(np.stack([heavier, pile[lighter]], axis=1), axis=0)
    alone = np.bincount(touched[:, 1], minlength=len(loads)) <= 1
    largest = np.zeros(len(loads))
    np.maximum.at(largest, pile, loads)
    own = light & alone[pile]
    units[own] = largest[pile[own]]
    return units


def equilibrium_matrix(model: Model, contacts: Contacts, free: IntArray) -> sp.csr_array:
    """A, (6 n_free, 3 n_points), in the deck's units: A x is the resultant of contact forces x about the centroids.

    Columns 3 k + j belong to component j (N, T1, T2) of point k, which pushes body b along row j of its frame and
    body a against it; moments are (point − centroid) × force. Of ties only N acts.
    """
    n_bodies = len(model.blocks) + len(model.grounds)
    bodies = contacts.bodies[contacts.interface_of_point]
    matrix = _matrix(n_bodies, model.blocks.centroids, bodies, contacts.points, contacts.frames, free)
    if contacts.cut_of_point is not None:
        matrix = sp.csr_array(matrix + _on_load_cell(contacts, matrix.shape))
    if contacts.ties is None:
        return matrix
    acts = np.ones((len(bodies), 3))
    acts[contacts.tie_points, 1:] = 0.0
    in_lines = matrix @ sp.diags_array(acts.ravel())
    return sp.csr_array(in_lines + _further(n_bodies, model, contacts.ties, free, len(bodies)))


def _on_load_cell(contacts: Contacts, shape: tuple[int, int]) -> sp.csr_array:
    """What contact forces do to a load cell, the last block: forces through the cut, without moments."""
    assert contacts.cut_of_point is not None
    points = np.flatnonzero(contacts.cut_of_point)
    forces = contacts.cut_of_point[points, None, None] * contacts.frames[points]
    rows = np.broadcast_to(shape[0] - 6 + np.arange(3), forces.shape)
    columns = np.broadcast_to((3 * points[:, None] + np.arange(3))[:, :, None], forces.shape)
    entries = (forces.ravel(), (rows.ravel(), columns.ravel()))
    return sp.csr_array(sp.coo_array(entries, shape=shape))


def _further(n_bodies: int, model: Model, ties: TieContacts, free: IntArray, n_points: int) -> sp.csr_array:
    """What ties do besides forces between two bodies in one line, as further entries of A."""
    row_of_block = np.full(n_bodies, -1, dtype=np.int64)
    row_of_block[free] = np.arange(len(free))
    here = row_of_block[ties.bodies] >= 0
    block, forces = ties.bodies[here], ties.forces[here]
    arms = ties.places[here] - model.blocks.centroids[block]
    values = np.hstack([forces, np.cross(arms, forces)])
    rows = 6 * row_of_block[block][:, None] + np.arange(6)
    columns = np.repeat(3 * ties.points[here], 6)
    entries = (values.ravel(), (rows.ravel(), columns))
    return sp.csr_array(sp.coo_array(entries, shape=(6 * len(free), 3 * n_points)))


def _matrix(
    n_bodies: int, centroids: FloatArray, bodies: IntArray, points: FloatArray, frames: FloatArray, free: IntArray
) -> sp.csr_array:
    """``equilibrium_matrix``; bodies (n_points, 2)."""
    row_of_block = np.full(n_bodies, -1, dtype=np.int64)
    row_of_block[free] = np.arange(len(free))
    n_points = len(bodies)
    columns = np.broadcast_to((3 * np.arange(n_points)[:, None] + np.arange(3))[:, :, None], (n_points, 3, 6))

    values, rows, cols = [], [], []
    for side, sign in ((0, -1.0), (1, 1.0)):
        here = row_of_block[bodies[:, side]] >= 0
        block = bodies[here, side]
        force = sign * frames[here]
        arm = points[here] - centroids[block]
        moment = np.cross(arm[:, None, :], force)
        values.append(np.concatenate([force, moment], axis=2).ravel())
        first_row = 6 * row_of_block[block]
        rows.append(np.broadcast_to(first_row[:, None, None] + np.arange(6), (len(block), 3, 6)).ravel())
        cols.append(columns[here].ravel())
    shape = (6 * len(free), 3 * n_points)
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(cols)))
    return sp.csr_array(sp.coo_array(entries, shape=shape))


def lever_arms(model: Model, contacts: Contacts, free: IntArray) -> FloatArray:
    """Mean distance of contact points from the centroid of each free block, its size where it has none, (n_free,).

    Ties do not count, which may lead far away.
    """
    surfaces = ~contacts.tie_points
    bodies, points = contacts.bodies[contacts.interface_of_point][surfaces], contacts.points[surfaces]
    return _arms(model.blocks.centroids, model.blocks.sizes, bodies, points, free)


def _arms(centroids: FloatArray, sizes: FloatArray, bodies: IntArray, points: FloatArray, free: IntArray) -> FloatArray:
    """``lever_arms`` of blocks with centroids (n_blocks, 3); bodies (n_points, 2)."""
    n_blocks = len(centroids)
    total, count = np.zeros(n_blocks), np.zeros(n_blocks)
    for side in (0, 1):
        here = bodies[:, side] < n_blocks
        block = bodies[here, side]
        arm = np.linalg.norm(points[here] - centroids[block], axis=1)
        total += np.bincount(block, arm, n_blocks)
        count += np.bincount(block, minlength=n_blocks)
    mean = np.divide(total, count, out=sizes.copy(), where=count > 0)
    return np.asarray(mean[free])
