"""Contact points of refined interfaces: those that cannot matter under associative flow, and shares of the others.

Over the common plane of two bodies the velocity is affine, and v_N ≥ μ ‖v_T‖ describes a convex set: where it holds at
the corners of the convex hull it holds inside. So with dry friction only the corners of the hull of all common surfaces
in one plane need unknowns, and the forces of the others are zero. Without normality this does not hold: there points
inside share the load.

Contact points are as stiff as their shares of the area, where an interface has more of them than corners. Forces that
limit analysis leaves open are found by joints on springs (the state under the dead load, standing, steps of the law),
one at every point. Points of a refined interface stand for unlike shares: on a grid one at a corner for a quarter of
one inside. With forces in the unknowns y, x = √s y, equally stiff springs for y are springs of stiffness s for x, and ½
‖y‖² is ½ Σ ‖x‖²/s: the sum that goes to the integral over the interface with the square of the distance of points. s is
the share over the mean of the interface, so that its total stiffness stays. The joint law is that of x; strengths
come divided by √s, velocities of the points multiplied.

Where all points are corners of the interface all are equally stiff: a corner stands for a hinge, not for a share. A
refined interface has points along its edges, where its outline goes straight on.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.program.lift import Lift
from mbla.program.program import Program
from mbla.program.reductions.restrict import chosen_limits, restricted, selection
from mbla.program.reductions.scene import COPLANAR, STRAIGHT_ON, ProgramGeometry, part_of, turns


def without_inner_points(scene: ProgramGeometry) -> ProgramGeometry:
    """The scene with the corners of the hulls alone; the same one where there is nothing to leave out."""
    limits = scene.program.limits
    dry = (limits.cohesion == 0) & (limits.tension == 0) & np.isinf(limits.compression)
    kept = np.ones(len(scene.points), dtype=bool)
    for group in _groups(scene, dry):
        kept[group] = _on_hull(scene, group)
    if kept.all():
        return scene
    points = np.flatnonzero(kept)
    forces = selection(points, scene.program.n_points, 3)
    program = restricted(scene.program, None, forces, chosen_limits(limits, points))
    return part_of(scene, program, np.arange(len(scene.centroids)), points)


def _groups(scene: ProgramGeometry, dry: BoolArray) -> list[IntArray]:
    """Points of one pair of bodies, one plane and one joint law, where they may hold more than corners of a hull."""
    candidates = np.flatnonzero(dry & np.isin(scene.interfaces, _suspicious(scene)))
    if not len(candidates):
        return []
    normal = scene.frames[candidates, 0]
    offset = ((scene.points[candidates] - scene.centroids.mean(axis=0)) * normal).sum(axis=1) / scene.length
    places = round(-np.log10(COPLANAR)) - 1
    planes = np.round(np.column_stack([normal, offset]), places) + 0.0
    friction = scene.program.limits.friction[candidates]
    keys = np.column_stack([np.sort(scene.bodies[candidates], axis=1), planes, friction, scene.cut[candidates]])
    _, group = np.unique(keys, axis=0, return_inverse=True)
    order = np.argsort(group, kind="stable")
    return np.split(candidates[order], np.flatnonzero(np.diff(group[order])) + 1)


def _suspicious(scene: ProgramGeometry) -> IntArray:
    """Interfaces that share their pair of bodies with another one, or do not turn strictly left at each point."""
    return np.union1d(several_of_a_pair(scene), scene.interfaces[turns(scene) <= STRAIGHT_ON])


def several_of_a_pair(scene: ProgramGeometry) -> IntArray:
    """Numbers of the interfaces, (n_found,), that share their pair of bodies with another one.

    All that does not move is one body.
    """
    first = np.flatnonzero(np.diff(scene.interfaces, prepend=-1))
    number, pair = scene.interfaces[first], np.sort(scene.bodies[first], axis=1)
    _, which, count = np.unique(pair, axis=0, return_inverse=True, return_counts=True)
    return np.asarray(number[count[which] > 1])


def _on_hull(scene: ProgramGeometry, group: IntArray) -> BoolArray:
    from scipy.spatial import ConvexHull, QhullError

    flat = (scene.points[group] - scene.points[group[0]]) @ scene.frames[group[0], 1:].T / scene.length
    kept = np.zeros(len(group), dtype=bool)
    try:
        kept[ConvexHull(flat).vertices] = True
    except (QhullError, ValueError):  # all on one line, or fewer than three
        kept[_ends(flat)] = True
    return kept


def _ends(flat: FloatArray) -> IntArray:
    direction = np.linalg.svd(flat - flat.mean(axis=0), full_matrices=False)[2][0]
    along = flat @ direction
    return np.array([along.argmin(), along.argmax()])


ALIKE = 1e-9
"""Relative difference of shares that is rounding."""


def program_by_shares(part: ProgramGeometry, program: Program, way: Lift) -> Program:
    """A program of the part, reduced or not, in such unknowns; the same one where all its points are alike.

    way : back from it to that of the part, but for the motions that guides leave
    """
    share = _shares(part, way) if part.refined_points.any() else np.ones(program.n_points)
    if np.all(np.abs(share - 1.0) <= ALIKE):
        return program
    root = np.sqrt(share)
    limits = replace(
        program.limits,
        cohesion=program.limits.cohesion / root,
        tension=program.limits.tension / root,
        compression=program.limits.compression / root,
    )
    forces = sp.csr_array(sp.diags_array(np.repeat(root, program.components), format="csr"))
    of_blocks = program.of_blocks
    if of_blocks is not None:
        of_blocks = Lift.after(of_blocks, program, None, forces, program.components)
    return replace(restricted(program, None, forces, limits), of_blocks=of_blocks, guided=program.guided)


def _shares(part: ProgramGeometry, way: Lift) -> FloatArray:
    """Stiffness s of every point of a program of the part, mean 1 in each interface, (n_points,).

    With x = P y between the part and its reduction Σ ‖x‖²/a is Σ ‖y‖²/b: b from the normal components is the area that
    a point of the reduction stands for.
    """
    normals = sp.csc_array(way.normal_forces.power(2))
    area = 1.0 / np.asarray(normals.T @ (1.0 / part.areas))
    interface = part.interfaces[normals.indices[normals.indptr[:-1]]]
    count, total = np.bincount(interface), np.bincount(interface, area)
    share = area * count[interface] / total[interface]
    refined = part.interfaces[part.refined_points]
    return np.asarray(np.where(np.isin(interface, refined), share, 1.0))
