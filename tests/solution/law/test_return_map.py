"""The return map of elastic joints: what it promises of every joint, its tangent, its two limits."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.law.elastic_joints import ElasticJoints, together
from mbla.solution.law.return_map import JointForces, joint_forces, joint_tangents
from tests.line import WALL, line_of

NORMAL, SHEAR = 1.4, 0.6
"""stiffness of all joints"""
STIFF = np.array([NORMAL, SHEAR, SHEAR])
COHESIVE = "joints.dry.cohesion=300", "joints.dry.tensile_strength=200", "joints.dry.compressive_strength=20000"


def wall(*overrides: str) -> Program:
    return line_of(WALL, "parameters.n=3", *overrides).program


def scattered(program: Program, seed: int = 3) -> tuple[FloatArray, FloatArray]:
    """Anchor forces and velocities that bring joints to every branch of the law."""
    rng = np.random.default_rng(seed)
    anchor = rng.normal(size=(program.n_points, 3)) + np.array([1.0, 0, 0])
    return anchor, rng.normal(size=len(program.dead_load))


def joints(program: Program, slope: FloatArray, ratio: float = SHEAR / NORMAL) -> ElasticJoints:
    return ElasticJoints.of(program, np.full(program.n_points, NORMAL), ratio, slope)


def moved(law: ElasticJoints, anchor: FloatArray, u: FloatArray) -> JointForces:
    stiff = np.array([law.normal, law.shear, law.shear])
    return joint_forces(law, anchor.T - stiff * law.velocities(u))


@pytest.mark.parametrize("overrides", [(), COHESIVE])
@pytest.mark.parametrize("share", [0.0, 0.4, 1.0])
def test_what_the_forces_leave_of_the_motion_obeys_the_law(share: float, overrides: tuple[str, ...]) -> None:
    """v + (x - anchor)/k: opens without force, slides against friction, dilates by its angle."""
    program = wall(*overrides)
    limits, slope = program.limits, share * program.limits.friction
    anchor, u = scattered(program)
    found = moved(joints(program, slope), anchor, u)
    x = together(found.normal, found.shear)
    v = (program.equilibrium_matrix.T @ u).reshape(-1, 3) + (x - anchor) / STIFF
    strength = limits.friction * x[:, 0] + limits.cohesion
    sliding = np.linalg.norm(v[:, 1:], axis=1)
    surplus = v[:, 0] - slope * sliding
    inside = (x[:, 0] > -limits.tension + 1e-9) & (x[:, 0] < limits.compression - 1e-9)
    assert 0 < np.count_nonzero(inside) < program.n_points
    assert np.all(x[:, 0] >= -limits.tension)
    assert np.all(x[:, 0] <= limits.compression)
    assert np.all(np.linalg.norm(x[:, 1:], axis=1) <= strength + 1e-12)
    assert surplus[inside] == pytest.approx(0.0, abs=1e-12)
    assert np.all(surplus[x[:, 0] <= -limits.tension] >= -1e-12)
    assert np.all(surplus[x[:, 0] >= limits.compression] <= 1e-12)
    assert strength * sliding + (x[:, 1:] * v[:, 1:]).sum(axis=1) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("overrides", [(), COHESIVE])
@pytest.mark.parametrize("share", [0.0, 0.4, 1.0])
def test_the_exact_law_agrees_with_its_tangent(share: float, overrides: tuple[str, ...]) -> None:
    """Consistent linearisation: the directional derivative of the forces, by differences."""
    program = wall(*overrides)
    slope = share * program.limits.friction
    anchor, u = scattered(program)
    du = np.random.default_rng(5).normal(size=len(u))
    law = joints(program, slope)
    here, there = (moved(law, anchor, velocities) for velocities in (u, u + 1e-7 * du))
    expected = -np.einsum("pij,pj->pi", joint_tangents(law, here), STIFF * law.velocities(du).T)
    change = together(there.normal, there.shear) - together(here.normal, here.shear)
    assert change / 1e-7 == pytest.approx(expected, abs=1e-5)


def test_with_the_friction_angle_it_is_the_projection_on_the_cone() -> None:
    """What is cut off lies in the polar cone and is at right angles to the force (Moreau)."""
    program = wall()
    anchor, u = scattered(program)
    law = joints(program, program.limits.friction, 1.0)
    trial, found = anchor - NORMAL * law.velocities(u).T, moved(law, anchor, u)
    x = together(found.normal, found.shear)
    cut = trial - x
    assert (x * cut).sum(axis=1) == pytest.approx(0.0, abs=1e-12)
    assert np.all(cut[:, 0] + program.limits.friction * np.linalg.norm(cut[:, 1:], axis=1) <= 1e-12)
