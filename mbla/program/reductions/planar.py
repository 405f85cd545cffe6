"""Planar structures: three unknowns a block, two force components a contact point, and a linear program.

A structure is planar if a mirror plane maps every block onto itself and all joints have their normals in that plane.
Then symmetric motions are motions in the plane, and contact points one behind the other move alike: one point with the
strength of all represents them. On the way back these points share the force in proportion to their areas, which keeps
each force within its limits, and a point and its image share it equally, which leaves no moment out of the plane. The
image of an interface may be another one, as where two glued blocks meet a third.

The unknown y of a group is scaled so that the squares of the forces of its points add up to y²/2: for two points it is
the sum of their forces. Least forces and equally stiff springs of the program are then those of the model.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.program.lift import Lift
from mbla.program.program import Program
from mbla.program.reductions.mirror import MirrorPlane, in_plane_motions
from mbla.program.reductions.restrict import block_matrix, restricted
from mbla.program.reductions.scene import ProgramGeometry
from mbla.program.yield_conditions.limits import YieldLimits

BEHIND = 1e-8
"""Relative to block size: points whose places in the plane differ by less are one behind the other."""


def is_planar(scene: ProgramGeometry, mirror: MirrorPlane) -> bool:
    """Every block its own image, every joint seen edge-on."""
    itself = bool(np.all(mirror.block_of == np.arange(len(mirror.block_of))))
    return itself and float(np.abs(scene.frames[:, 0] @ mirror.normal).max(initial=0.0)) <= scene.symmetric


def planar_program(scene: ProgramGeometry, mirror: MirrorPlane) -> tuple[Program, Lift]:
    """The program of motions in the plane, and the way back from it."""
    unknowns = _unknowns(scene, mirror)
    limits = _added(scene.program.limits, unknowns.group, unknowns.size)
    way = Lift(scene.program, unknowns.velocities, unknowns.forces, components=2)
    return restricted(scene.program, way.velocities, way.forces, limits, components=2), way


@dataclass(frozen=True)
class _Unknowns:
    """Ways from the unknowns in the plane to motions and forces, of each point its group, and see ``_added``."""

    velocities: sp.csr_array
    forces: sp.csr_array
    group: IntArray
    size: FloatArray


def _unknowns(scene: ProgramGeometry, mirror: MirrorPlane) -> _Unknowns:
    """They follow from the places of blocks and points alone, whatever acts on them and whatever joints they have."""
    n = len(scene.centroids)
    motions = np.broadcast_to(in_plane_motions(mirror.normal), (n, 6, 3))
    velocities = block_matrix(motions, np.arange(n), np.arange(n), (n, n))
    shear = np.cross(mirror.normal, scene.frames[:, 0])
    group = _one_behind_the_other(scene, mirror, shear)
    n_groups = int(group.max(initial=-1)) + 1
    areas = (scene.areas + scene.areas[mirror.point_of]) / 2  # cuts and points left out may make them unlike
    share = areas / np.bincount(group, areas, n_groups)[group]
    size = np.sqrt(2.0 * np.bincount(group, share**2, n_groups))
    share = share / size[group]
    maps = np.zeros((len(group), 3, 2))
    maps[:, 0, 0] = share
    maps[:, 1:, 1] = share[:, None] * np.einsum("ptx,px->pt", scene.frames[:, 1:], shear)
    forces = block_matrix(maps, np.arange(len(group)), group, (len(group), n_groups))
    return _Unknowns(velocities, forces, group, size)


def _one_behind_the_other(scene: ProgramGeometry, mirror: MirrorPlane, shear: FloatArray) -> IntArray:
    """Group of each point, by interfaces: same interface or that of the image, same place in the plane.

    An interface and its image may name their two blocks in opposite orders; places are counted the same way in both.
    """
    interface = np.minimum(scene.interfaces, scene.interfaces[mirror.point_of])
    turned = np.where(scene.bodies[:, 0] <= scene.bodies[:, 1], 1.0, -1.0)
    place = turned * ((scene.points - scene.centroids.mean(axis=0)) * shear).sum(axis=1) / scene.length
    order = np.lexsort((place, interface))
    new = np.diff(interface[order], prepend=-1) != 0
    new |= np.diff(place[order], prepend=-np.inf) > BEHIND
    group = np.empty(len(order), dtype=np.int64)
    group[order] = np.cumsum(new) - 1
    return group


def _added(limits: YieldLimits, group: IntArray, size: FloatArray) -> YieldLimits:
    """Limits of the groups: strengths add up, coefficients are those of the interface's joint law.

    size : (n_groups,) unknown of a group over the sum of its forces
    """
    n_groups = len(size)
    first = np.full(n_groups, -1)
    first[group[::-1]] = np.arange(len(group))[::-1]

    def total(values: FloatArray) -> FloatArray:
        return np.asarray(np.bincount(group, values, n_groups) * size, dtype=np.float64)

    crushable = np.isfinite(limits.compression)
    return YieldLimits(
        friction=limits.friction[first],
        dilatancy=limits.dilatancy[first],
        cohesion=total(limits.cohesion),
        tension=total(limits.tension),
        compression=np.where(crushable[first], total(np.where(crushable, limits.compression, 0.0)), np.inf),
    )
