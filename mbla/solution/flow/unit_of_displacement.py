"""The measure of displacement on a path: how far the live load moves the structure while its joints are elastic.

All joints stick, whatever their friction, but for joints without pressure at rest that the live load opens: two leaves
that are pushed apart do not hold each other.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.program.program import Program
from mbla.solution.law.elastic_joints import ElasticJoints

LIMP, OPEN = 1e-6, 1e-3
"""Stiffness of ties over that of joints, which may be slack; and of joints that open: without any, what is about to
topple at rest would have no measure."""

RIGID = 1e8
"""Stiffness of interfaces with a motion of their own: none of it is elastic."""

PRESSED = 1e-3
"""Normal force at rest over the mean load of a point from which a joint is pressed."""


@dataclass(frozen=True)
class Measure:
    """What a path is measured by.

    load_factor  : of associative flow, or what stands for it; positive
    displacement : the unit, for a live work of 1
    motion       : (n_rows,) elastic displacements of what is followed under the live load
    """

    load_factor: float
    displacement: float
    motion: FloatArray

    def force_of(self, program: Program) -> float:
        """Mean live load of a point at the load factor."""
        return mean_live_load(program, self.load_factor)


def mean_live_load(program: Program, load_factor: float) -> float:
    """Of a point, at a load factor."""
    return abs(load_factor) * float(np.abs(program.live_load).sum()) / max(program.n_points, 1)


def measure_of(joints: ElasticJoints, load_factor: float, pressed: BoolArray) -> Measure:
    """By a load factor of what is followed itself."""
    motion = elastic_motion(joints, pressed)
    return Measure(load_factor, float(joints.program.live_load @ motion) * load_factor, motion)


def elastic_motion(joints: ElasticJoints, pressed: BoolArray) -> FloatArray:
    """Displacements of the blocks under the live load, (n_rows,).

    pressed : (n_points,) which are pressed at rest
    """
    motion = _motion(joints, np.zeros(len(pressed), dtype=np.bool_))
    opens = ~pressed & (joints.velocities(motion)[0] > 0.0)
    return _motion(joints, opens) if opens.any() else motion


def pressed_points(joints: ElasticJoints, normal: FloatArray, force: float) -> BoolArray:
    """Points that are pressed, or hold by a strength, (n_points,).

    normal : (n_points,) forces at rest; force : the mean load of a point
    """
    return np.asarray((normal > PRESSED * force) | (joints.program.limits.tension > 0.0))


def _motion(joints: ElasticJoints, limp: BoolArray) -> FloatArray:
    program = joints.program
    n_all, n = joints.matrix.program.n_points, program.n_points
    tangents = np.zeros((n_all, program.components, program.components))
    tangents[n:] = RIGID * np.eye(program.components)
    holds = (joints.friction > 0.0) | (program.limits.cohesion > 0.0)
    tangents[:n, 0, 0] = np.where(holds, joints.normal, LIMP * joints.normal)
    for tangent in range(1, program.components):
        tangents[:n, tangent, tangent] = joints.shear
    tangents[:n][limp] *= OPEN
    solve = joints.matrix.factorized(tangents, 1e-12 * joints.matrix.size, fixed_load=True)
    if solve is None:
        return np.asarray(program.live_load / float(program.live_load @ program.live_load))
    return np.asarray(-solve(np.append(program.live_load, 0.0))[:-1])
