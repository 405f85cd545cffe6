"""The step of elastic joints: its direction solves the linearised equations, and joints remember by the law."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.resultants.interface_motions import CrushingInterfaces
from mbla.program.resultants.twisting_interfaces import TwistingInterfaces
from mbla.solution.law.elastic_joints import ElasticJoints, Memory, StepState, lengths
from mbla.solution.law.elimination import Eliminated
from mbla.solution.law.interface_rows import InterfaceRows
from mbla.solution.law.interfaces import Interfaces
from mbla.solution.law.joint_equations import JointStep, Products, products_of, residual_of
from mbla.solution.law.joint_step import direction_of, reach_of
from tests.line import WALL, line_of
from tests.solution.planar import planar_program

MORTAR = "joints.dry.cohesion=3000", "joints.dry.tensile_strength=2000", "joints.dry.compressive_strength=60000"
SIGMA = 0.3
STEP = 1e-6


def programs() -> dict[str, tuple[Program, tuple[InterfaceRows, ...]]]:
    dry, mortar = line_of(WALL, "parameters.n=3"), line_of(WALL, "parameters.n=3", *MORTAR)
    plane, blocks = planar_program(mortar), Interfaces(CrushingInterfaces.of(mortar.model, mortar.contacts))
    both = replace(blocks, twisting=TwistingInterfaces.of(mortar.model, mortar.contacts))
    return {
        "dry, plane": (planar_program(dry), ()),
        "mortar, plane": (plane, ()),
        "mortar, space": (mortar.program, ()),
        "stress blocks, plane": (plane, blocks.rows_of(plane)),
        "stress blocks, space": (mortar.program, blocks.rows_of(mortar.program)),
        "stress blocks and torsion": (mortar.program, both.rows_of(mortar.program)),
    }


def some_step(
    program: Program, dilatancy: float, interfaces: tuple[InterfaceRows, ...] = ()
) -> tuple[JointStep, StepState]:
    """A step with a history, and a state strictly within the law."""
    rng, n = np.random.default_rng(3), program.n_points
    slope = dilatancy * program.limits.friction
    joints = ElasticJoints.of(program, rng.uniform(0.5, 2.0, n), 0.4, slope, interfaces)
    motions = tuple(
        rng.normal(size=(program.components, law.rows.shape[1] // program.components)) for law in joints.laws
    )
    memory = Memory(rng.normal(size=n), rng.normal(size=(program.components - 1, n)), motions)
    normal = rng.uniform(0.1, 1.0, n)
    shear = rng.normal(size=memory.shear.shape)
    shear *= 0.5 * joints.limit(normal) / np.maximum(lengths(shear), 1e-12)
    slip = rng.normal(size=memory.shear.shape)
    state = StepState(
        u=rng.normal(size=len(joints.program.dead_load)),
        factor=0.3,
        normal=normal,
        opening=rng.uniform(0.1, 1.0, n),
        shear=shear,
        slip=slip,
        speed=1.5 * lengths(slip),
        crushing=rng.uniform(0.1, 1.0, len(joints.crushable)),
        interfaces=tuple(law.start(normal, 1.0) for law in joints.laws),
    )
    return JointStep(joints, memory, 0.7), state


@pytest.mark.parametrize("dilatancy", [0.0, 0.6])
@pytest.mark.parametrize("name", programs())
def test_a_direction_solves_the_linearised_equations(name: str, dilatancy: float) -> None:
    """Torsion is there for joints without dilatancy; its equations hold with it."""
    program, interfaces = programs()[name]
    step, state = some_step(program, dilatancy, interfaces)
    before = residual_of(step, state)
    linear = Eliminated.at(step, state)
    assert linear is not None
    wanted = before.products.towards(SIGMA, step.joints)
    direction = linear.direction(before, wanted)
    after = residual_of(step, state.plus(direction, STEP))
    for value, was in ((after.balance, before.balance), (after.normal, before.normal), (after.shear, before.shear)):
        np.testing.assert_allclose(value, (1.0 - STEP) * was, atol=1e-9)
    for value, was in zip(after.interfaces, before.interfaces, strict=True):
        np.testing.assert_allclose((value - was) / STEP, -was, atol=2e-3)
    pairs = zip(_arrays(before.products), _arrays(after.products), _arrays(wanted), strict=True)
    for was, now, change in pairs:
        np.testing.assert_allclose((now - was) / STEP, change, atol=5e-4)


def _arrays(products: Products) -> list[FloatArray]:
    return [*(getattr(products, name) for name in ("normal", "sliding", "turning", "crushing")), *products.interfaces]


def test_a_step_stays_within_the_law() -> None:
    step, state = some_step(programs()["mortar, space"][0], 0.0)
    found = direction_of(step, state, residual_of(step, state), SIGMA)
    assert found is not None
    direction, reach = found
    joints = step.joints

    def least(length: float) -> float:
        there = state.plus(direction, length)
        room = joints.room(there.normal).min()
        cone = (joints.limit(there.normal) - lengths(there.shear)).min()
        turning = (there.speed - lengths(there.slip)).min()
        return float(
            min((there.normal + joints.program.limits.tension).min(), there.opening.min(), room, cone, turning)
        )

    exact = reach_of(joints, state, direction)
    assert reach == min(1.0, exact)
    assert least(0.999 * exact) > 0.0 > least(1.001 * exact)


def test_joints_remember_slip_and_gap() -> None:
    program, _ = programs()["dry, plane"]
    joints = ElasticJoints.of(program, np.ones(program.n_points), 0.4)
    fresh, normal = Memory.stress_free(joints), np.ones(program.n_points)
    moved = np.zeros((2, program.n_points))
    moved[0], moved[1] = 0.1, 10.0  # opens, and slides further than friction lets it
    after = fresh.after(joints, moved, normal)
    np.testing.assert_allclose(after.normal, -0.1)
    np.testing.assert_allclose(after.shear, -program.limits.friction[None])
    back = after.after(joints, -moved, normal)
    np.testing.assert_allclose(back.shear, program.limits.friction[None])


def test_sliding_with_dilatancy_lifts() -> None:
    program, _ = programs()["dry, plane"]
    joints = ElasticJoints.of(program, np.ones(program.n_points), 0.4, np.full(program.n_points, 0.2))
    moved = np.zeros((2, program.n_points))
    moved[1] = 10.0
    after = Memory.stress_free(joints).after(joints, moved, np.ones(program.n_points))
    slid = 10.0 - program.limits.friction / 0.4
    np.testing.assert_allclose(after.normal, 0.2 * slid)


def test_products_are_those_of_the_state() -> None:
    step, state = some_step(programs()["dry, plane"][0], 0.0)
    central = replace(state, shear=0.0 * state.shear, slip=0.0 * state.slip)
    limit = step.joints.limit(central.normal)
    products = products_of(step.joints, replace(central, opening=SIGMA / central.normal, speed=SIGMA / limit))
    np.testing.assert_allclose(products.normal, SIGMA)
    np.testing.assert_allclose(products.sliding, SIGMA)
    np.testing.assert_allclose(products.turning, 0.0)
