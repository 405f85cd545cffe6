"""What vibrates: stiffness of the joints that press at rest, and masses, in the motions that supports allow.

The stiffness of an interface is that of its surface, k_N across and k_T along per area, integrated over the part that
presses (:mod:`mbla.solution.modes.pressed_surfaces`). With d and θ of body b relative to a at its centroid, in its
frame (n, t_1, t_2)::

    2 U = k_N ∫ (d_n + θ_1 y_2 − θ_2 y_1)² dA + k_T ∫ (d_1 − θ_n y_2)² + (d_2 + θ_n y_1)² dA

Springs at the corners alone would be up to three times too stiff in bending. Joints without friction and cohesion have
no stiffness along. What slides at rest sticks in small vibrations about it. Ties that are not slack are as stiff as a
contact point in the mean.

What weight does to the stiffness as blocks lean is left out: of a tower of height H and breadth B on joints that let it
sag by s it takes the share 6 s H/B², next to nothing for stiff joints.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.assembly.assembly import Assembly
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.model.model import Model
from mbla.model.solids.inertia import crossing, inertia_of
from mbla.program.assemble import equilibrium_matrix
from mbla.solution.modes.pressed_surfaces import TOUCHES, PressedSurfaces, pressed_surfaces
from mbla.solution.modes.rest import Rest


@dataclass(frozen=True)
class Vibrating:
    """K and M of the free bodies, velocities and rotations about their centroids, in the deck's units.

    stiffness : (6 n_free, 6 n_free) force per length
    masses    : (6 n_free, 6 n_free) force per acceleration
    ways      : (6 n_free, n) motions that guides allow; the identity where no body is guided
    pressed   : (n_surfaces,) share of each interface that presses
    slack     : ties that carry nothing, which are left out
    """

    stiffness: sp.csr_array
    masses: sp.csr_array
    ways: sp.csr_array
    pressed: FloatArray
    slack: int


def vibrating(assembly: Assembly, rest: Rest) -> Vibrating:
    """Of a structure at rest."""
    bodies = rest.bodies
    frames = _relative(bodies)
    n = bodies.contacts.n_surfaces
    relative = np.einsum("nij,nj->ni", frames, _ends(bodies, rest.settlement))
    surfaces = pressed_surfaces(rest, relative)
    ties, slack = _of_ties(rest)
    stiffness = _of_surfaces(bodies, frames, _blocks(rest, surfaces)) + ties
    inertia = inertia_of(assembly.model.blocks).joined(bodies.label, bodies.arms).matrices[bodies.model.free]
    masses = sp.csr_array(sp.block_diag(inertia)) * bodies.model.units.force_per_mass_acceleration
    share = surfaces.areas / np.maximum(bodies.contacts.areas[:n], 1e-300)
    return Vibrating(sp.csr_array(stiffness), sp.csr_array(masses), allowed_ways(bodies.model), share, slack)


def allowed_ways(model: Model) -> sp.csr_array:
    """Columns of the motions that guides allow, (6 n_free, n): six of every body that is not guided."""
    free = model.free
    row = np.full(len(model.blocks), -1)
    row[free] = np.arange(len(free))
    held = np.zeros(len(model.blocks), dtype=bool)
    held[model.guides.blocks] = True
    alone = np.flatnonzero(~held[free])
    own = (6 * alone[:, None] + np.arange(6)).ravel()
    columns = [sp.coo_array((np.ones(len(own)), (own, np.arange(len(own)))), shape=(6 * len(free), len(own)))]
    for body in range(model.guides.n_bodies):
        mine = np.flatnonzero(model.guides.bodies == body)
        motions = model.guides.motions[mine]
        used = np.flatnonzero(np.any(motions != 0.0, axis=(0, 1)))
        whole = np.zeros((6 * len(free), len(used)))
        rows = (6 * row[model.guides.blocks[mine]][:, None] + np.arange(6)).ravel()
        whole[rows] = motions[:, :, used].reshape(-1, len(used))
        columns.append(sp.coo_array(whole))
    return sp.csr_array(sp.hstack(columns))


def _relative(bodies: RigidBodies) -> FloatArray:
    """Of each surface the matrix from displacement and rotation in space to those in its frame, (n, 6, 6)."""
    contacts = bodies.contacts
    own = contacts.frames[contacts.point_start[: contacts.n_surfaces]]
    found = np.zeros((len(own), 6, 6))
    found[:, :3, :3], found[:, 3:, 3:] = own, own
    return found


def _at_centroid(bodies: RigidBodies, side: int) -> FloatArray:
    """Motion at the centroid of each surface from that of its body a (0) or b (1), (n, 6, 6)."""
    contacts, blocks = bodies.contacts, bodies.model.blocks
    n, centres = contacts.n_surfaces, np.vstack([blocks.centroids, np.zeros((len(bodies.model.grounds), 3))])
    arms = contacts.centroids[:n] - centres[contacts.bodies[:n, side]]
    found = np.tile(np.eye(6), (n, 1, 1))
    found[:, :3, 3:] = -crossing(arms)
    return found


def _ends(bodies: RigidBodies, motions: FloatArray) -> FloatArray:
    """Motion of body b relative to body a at the centroid of each surface, (n, 6), in space."""
    contacts = bodies.contacts
    every = np.vstack([motions, np.zeros((len(bodies.model.grounds), 6))])
    one, other = (
        np.einsum("nij,nj->ni", _at_centroid(bodies, side), every[contacts.bodies[: contacts.n_surfaces, side]])
        for side in (0, 1)
    )
    return np.asarray(other - one)


def _blocks(rest: Rest, surfaces: PressedSurfaces) -> FloatArray:
    """Stiffness of each surface in its frame, (n, 6, 6): rows and columns d_n, d_1, d_2, θ_n, θ_1, θ_2."""
    model, contacts, n = rest.bodies.model, rest.bodies.contacts, len(surfaces.areas)
    laws = [model.joints[name] for name in contacts.joint_names]
    rough = np.array([law.friction > 0.0 or law.cohesion > 0.0 for law in laws], dtype=bool)[contacts.joints[:n]]
    across, along = rest.stiffness[:n, 0], np.where(rough, rest.stiffness[:n, 1], 0.0)
    area, (s1, s2), (i11, i12, i22) = surfaces.areas, surfaces.firsts.T, surfaces.seconds.T
    found = np.zeros((n, 6, 6))
    for row, column, values in (
        (0, 0, across * area),
        (0, 4, across * s2),
        (0, 5, -across * s1),
        (4, 4, across * i22),
        (4, 5, -across * i12),
        (5, 5, across * i11),
        (1, 1, along * area),
        (2, 2, along * area),
        (1, 3, -along * s2),
        (2, 3, along * s1),
        (3, 3, along * (i11 + i22)),
    ):
        found[:, row, column] = found[:, column, row] = values
    return found


def _of_surfaces(bodies: RigidBodies, frames: FloatArray, blocks: FloatArray) -> sp.csr_array:
    """K of surfaces whose stiffness in their frames is given, (6 n_free, 6 n_free)."""
    contacts = bodies.contacts
    pressed = np.flatnonzero(blocks[:, 0, 0] > 0.0)
    row = np.full(len(bodies.model.blocks) + len(bodies.model.grounds), -1)
    row[bodies.model.free] = np.arange(len(bodies.model.free))
    ends = [sign * frames @ _at_centroid(bodies, side) for side, sign in ((0, -1.0), (1, 1.0))]
    values, rows, columns = [], [], []
    for first in (0, 1):
        for second in (0, 1):
            entries = np.einsum("nki,nkl,nlj->nij", ends[first][pressed], blocks[pressed], ends[second][pressed])
            one, other = (row[contacts.bodies[pressed, side]] for side in (first, second))
            here = (one >= 0) & (other >= 0)
            values.append(entries[here].ravel())
            rows.append(_places(one[here], entries[here].shape, 1))
            columns.append(_places(other[here], entries[here].shape, 2))
    size = 6 * len(bodies.model.free)
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    return sp.csr_array(sp.coo_array(entries, shape=(size, size)))


def _places(body: IntArray, shape: tuple[int, ...], axis: int) -> IntArray:
    """Rows (axis 1) or columns (axis 2) of blocks of entries, flat."""
    offsets = np.arange(6)[:, None] if axis == 1 else np.arange(6)[None, :]
    return np.asarray(np.broadcast_to(6 * body[:, None, None] + offsets, shape).ravel())


def _of_ties(rest: Rest) -> tuple[sp.csr_array, int]:
    """K of the ties that are not slack, (6 n_free, 6 n_free), and how many are slack."""
    model, contacts = rest.bodies.model, rest.bodies.contacts
    size = 6 * len(model.free)
    if contacts.ties is None:
        return sp.csr_array((size, size)), 0
    points = np.flatnonzero(contacts.tie_points)
    ways = sp.csr_array(equilibrium_matrix(model, contacts, model.free)[:, 3 * points])
    stiffness = rest.points[points, 0]
    force = -stiffness * (ways.T @ rest.settlement[model.free].ravel()) + contacts.ties.tension
    loads = np.linalg.norm(rest.case.dead_load[model.free, :3], axis=1)
    holds = force > TOUCHES * float(loads[loads > 0.0].mean())
    return sp.csr_array(ways @ sp.diags_array(np.where(holds, stiffness, 0.0)) @ ways.T), int((~holds).sum())
