"""Programs in forces allow what the joint laws allow, point by point, and nothing else; so do velocities."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.kinematic import kinematic_form
from mbla.program.program import Program
from mbla.program.static import gravity_form
from mbla.program.yield_conditions import YieldLimits, yield_violation
from tests.program.random_points import balance, least_room, mixed_program, random_forces, slack

BOTH = pytest.mark.parametrize("components", [2, 3])
SEEDS = range(6)


def one_point(program: Program, point: int) -> Program:
    """The program with this point alone."""
    c = program.components
    limits = program.limits
    fields = ("friction", "dilatancy", "cohesion", "tension", "compression")
    return replace(
        program,
        equilibrium_matrix=program.equilibrium_matrix[:, c * point : c * point + c],
        limits=YieldLimits(*(getattr(limits, name)[[point]] for name in fields)),
    )


def each_point(components: int) -> list[tuple[Program, FloatArray]]:
    """Every kind of point by itself, with random forces on it."""
    program, draw = mixed_program(components, 1), np.random.default_rng(2)
    return [
        (one_point(program, point), random_forces(program, draw)[[point]])
        for _ in SEEDS
        for point in range(program.n_points)
    ]


def within(program: Program, forces: FloatArray) -> bool:
    return not yield_violation(forces, program.limits).any()


@BOTH
def test_gravity_form(components: int) -> None:
    seen = set()
    for program, forces in each_point(components):
        form = gravity_form(program)
        x = forces.ravel()
        assert (least_room(form.cone_program, x) >= 0) == within(program, forces)
        np.testing.assert_allclose(slack(form.cone_program, x)[:12], balance(program, forces, 0.0))
        assert np.array_equal(form.forces(x), forces)
        assert not form.cone_program.cost.any()
        assert form.cone_program.quadratic is not None
        assert form.cone_program.quadratic.tolist() == [1.0] * components
        seen.add(within(program, forces))
    assert seen == {False, True}


@BOTH
def test_all_points_in_one_program(components: int) -> None:
    """The rows of points lie one after the other, each beside its own forces."""
    program = mixed_program(components, 4)
    draw = np.random.default_rng(5)
    inside = np.zeros((program.n_points, components))
    inside[:, 0] = 0.25 * np.minimum(program.limits.compression, 1.0)
    for point in range(program.n_points):
        for _ in range(10):
            forces = inside.copy()
            forces[point] = random_forces(program, draw)[point]
            allowed = within(program, forces)
            assert (least_room(gravity_form(program).cone_program, forces.ravel()) >= 0) == allowed


@BOTH
@pytest.mark.parametrize("reduce_dry", [True, False])
def test_velocities_and_what_they_dissipate(components: int, reduce_dry: bool) -> None:
    """With the least multipliers that allow the velocities the cost is dissipation less the power of the dead load."""
    draw = np.random.default_rng(8)
    seen = set()
    for program, _ in each_point(components):
        law = program.limits
        form = kinematic_form(program, law, reduce_dry=reduce_dry)
        u = draw.normal(size=12)
        v = program.equilibrium_matrix.T @ u
        sliding, n_p, n_d = np.linalg.norm(v[1:]), len(form.rows.frictional), len(form.rows.crushing)
        crushed = max(law.friction[0] * sliding - v[0], 0.0) if n_d else 0.0
        x = np.concatenate([u, np.full(n_p, sliding), np.full(n_d, crushed)])
        allowed = v[0] + crushed >= law.friction[0] * sliding * (1 - 1e-12)
        room = least_room(form.cone_program, x)
        assert (room >= -1e-12 * (1 + sliding)) == allowed
        assert slack(form.cone_program, x)[0] == pytest.approx(1.0 - program.live_load @ u)
        opening = max(v[0] - law.friction[0] * sliding, 0.0)
        dissipated = law.cohesion[0] * sliding + law.tension[0] * opening
        dissipated += law.compression[0] * crushed if n_d else 0.0
        if allowed:
            assert form.cone_program.cost @ x == pytest.approx(dissipated - program.dead_load @ u)
        assert np.array_equal(form.velocities(x), u)
        seen.add(bool(allowed))
    assert seen == {False, True}
