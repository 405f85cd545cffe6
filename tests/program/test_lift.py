"""The way back through several reductions, beside steps that are taken one by one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.program.lift import Lift
from mbla.program.program import Program
from mbla.program.reductions import reduce_program
from mbla.program.reductions.restrict import ChosenPart, chosen_limits, restricted, selection
from mbla.program.reductions.steps import ReductionSwitches
from tests.line import WALL, line_of
from tests.program.random_points import N_ROWS, mixed_program

DRAW = np.random.default_rng(7)


def test_a_program_of_its_own_is_its_full_one() -> None:
    program = mixed_program(3, 1)
    forces, velocities = DRAW.normal(size=(program.n_points, 3)), DRAW.normal(size=N_ROWS)
    assert program.full is program.lift.full is program
    assert np.array_equal(program.lift.contact_forces(forces), forces)
    assert np.array_equal(program.lift.motion(velocities), velocities)
    assert np.array_equal(program.lift.motion_within(velocities), velocities)
    stiffness = DRAW.uniform(1.0, 2.0, program.n_points)
    assert np.array_equal(program.lift.stiffness(stiffness), stiffness)


def test_steps_are_one_way() -> None:
    """Motions alone, then points alone, then both; every step leaves its mark on A x and Aᵀu."""
    full = mixed_program(3, 2)
    basis = sp.csr_array(np.linalg.qr(DRAW.normal(size=(N_ROWS, N_ROWS - 2)))[0])
    moving = restricted(full, basis, None, full.limits)
    points = np.arange(0, full.n_points, 2)
    fewer = selection(points, full.n_points, 3)
    some = restricted(moving, None, fewer, chosen_limits(moving.limits, points))
    last = restricted(
        some, selection(np.array([0, 2]), 5, 2), sp.csr_array(2.0 * sp.eye_array(3 * len(points))), some.limits
    )
    assert last.full is full
    velocities, forces = DRAW.normal(size=4), DRAW.normal(size=(len(points), 3))
    one_by_one = basis @ (selection(np.array([0, 2]), 5, 2) @ velocities)
    assert last.lift.motion(velocities) == pytest.approx(one_by_one)
    assert last.lift.motion_within(one_by_one) == pytest.approx(velocities)
    assert last.lift.contact_forces(forces).ravel() == pytest.approx(fewer @ (2.0 * forces.ravel()))
    balance = last.lift.velocities.T @ full.equilibrium_matrix @ last.lift.forces
    assert (balance - last.equilibrium_matrix).toarray() == pytest.approx(
        np.zeros(last.equilibrium_matrix.shape), abs=1e-12
    )


def test_points_of_one_share_have_the_stiffness_that_makes_their_forces() -> None:
    """x = P y with y = k Σ P v is x = k_x v at points that move alike."""
    full = mixed_program(3, 3)
    shares = np.array([[0.25], [0.75], [0.5]])
    forces = sp.csr_array(np.kron(np.vstack([shares, np.zeros((full.n_points - 3, 1))]), np.eye(3)))
    lift = Lift(full, sp.csr_array(sp.eye_array(N_ROWS)), forces, 3)
    velocity, stiffness = 0.3, 4.0
    pressed = lift.normal_forces @ np.array([stiffness * shares.sum() * velocity])
    assert lift.stiffness(np.array([stiffness])) * velocity == pytest.approx(pressed)


def test_a_chosen_part_has_a_way_to_its_whole_and_one_to_the_full_model() -> None:
    line = line_of(WALL)
    (whole,) = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=True).parts
    moves = np.arange(len(whole.dead_load) // 3) % 2 == 0
    part = ChosenPart.of(whole, moves, np.arange(whole.n_points))
    velocities = DRAW.normal(size=len(part.program.dead_load))
    of_whole = part.lifted(velocities)
    assert not of_whole.reshape(-1, 3)[~moves].any()
    assert part.program.full is line.program
    assert part.program.mechanism(velocities) == pytest.approx(whole.mechanism(of_whole))


def test_nothing_of_the_live_load_is_left_on_any_way() -> None:
    line = line_of(WALL, "load_cases.push.live=[{acceleration: [0, 1, 0]}]")
    (half,) = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=True).parts
    stripped = half.without_live_load()
    assert stripped.reduction is not None
    assert stripped.of_blocks is not None
    programs: tuple[Program, ...] = (stripped, stripped.full, stripped.of_blocks.full)
    for program in programs:
        assert not program.live_load.any()
        assert program.scaling.live == 1.0
    assert replace(stripped, live_load=half.live_load).own_unit == pytest.approx(half.own_unit)
