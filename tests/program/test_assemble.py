"""Programs from model, contacts and loads: equilibrium, units of force, and units of light blocks."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.program.assemble import LIGHT, _scaling, equilibrium_matrix, own_units
from mbla.solution.verification.statics import contact_resultants, contact_velocities
from tests.line import BLOCK, WALL, line_of


def test_equilibrium_matrix_agrees_with_summing_forces_over_blocks() -> None:
    line = line_of(WALL)
    rng = np.random.default_rng(1)
    forces = rng.normal(size=(len(line.contacts.points), 3))
    matrix = equilibrium_matrix(line.model, line.contacts, line.model.free)
    assert (matrix @ forces.ravel()).reshape(-1, 6) == pytest.approx(
        contact_resultants(line.model, line.contacts, forces)[line.model.free], abs=1e-13
    )


def test_compatibility_is_the_transpose_of_equilibrium() -> None:
    line = line_of(WALL)
    mechanism = np.random.default_rng(2).normal(size=(len(line.model.blocks), 6))
    matrix = equilibrium_matrix(line.model, line.contacts, line.model.free)
    assert (matrix.T @ mechanism[line.model.free].ravel()).reshape(-1, 3) == pytest.approx(
        contact_velocities(line.model, line.contacts, mechanism), abs=1e-13
    )


def test_compression_pushes_the_block_off_the_ground() -> None:
    line = line_of(BLOCK)
    forces = np.zeros((4, 3))
    forces[:, 0] = 1.0
    assert contact_resultants(line.model, line.contacts, forces)[0] == pytest.approx([0, 0, 4, 0, 0, 0], abs=1e-14)


@pytest.mark.parametrize(
    "overrides",
    [
        ("units.length=mm", "parameters.b=1000", "parameters.h=2000", "materials.stone.density=2e-6"),
        ("materials.stone.density=2e-3",),
        ("units.force=kip",),
        ("units.mass=lb", "materials.stone.density=5"),
    ],
)
def test_the_program_does_not_know_units(overrides: tuple[str, ...]) -> None:
    text = BLOCK.replace('max: ["=b", 1, "=h"]', 'max: ["=b", "=b", "=h"]')
    here, there = line_of(text).program, line_of(text, *overrides).program
    assert there.equilibrium_matrix.toarray() == pytest.approx(here.equilibrium_matrix.toarray(), abs=1e-12)
    assert there.dead_load == pytest.approx(here.dead_load)
    assert there.live_load == pytest.approx(here.live_load)


def test_load_factor_of_the_program_goes_back_to_that_of_the_model() -> None:
    line = line_of(BLOCK, "load_cases.push.live=[{force: [10, 0, 0], on: block}]")
    scaling = line.program.scaling
    physical = line.program.live_load / (scaling.row * scaling.live)
    assert physical[:3] == pytest.approx([10, 0, 0])
    assert np.linalg.norm(line.program.live_load) == pytest.approx(1.0)


def test_unit_of_force_counts_moments_over_lever_arms_and_loaded_blocks_alone() -> None:
    dead = np.array([[0, 0, 3.0, 8.0, 0, 0], [0, 0, 0, 0, 0, 0]])
    live = np.array([[0, 0, 0, 0, 0, 0], [6.0, 0, 0, 0, 32.0, 0]])
    scaling = _scaling(np.array([2.0, 4.0]), dead.ravel(), live.ravel())
    assert scaling.force == pytest.approx(5.0)  # 3 and 8/2
    assert scaling.live == pytest.approx(5.0 / np.sqrt(100.0 / 2))  # 6 and 32/4 on one of two blocks
    assert scaling.row.reshape(2, 6) == pytest.approx(np.array([[1, 1, 1, 0.5, 0.5, 0.5], [1, 1, 1] + 3 * [0.25]]) / 5)
    assert _scaling(np.array([2.0, 4.0]), 0.0 * dead.ravel(), live.ravel()).force == pytest.approx(10.0)


@pytest.mark.parametrize("size", [2.0**-20, 1.0, 2.0**20])
def test_units_grow_with_the_loads_however_small_these_are(size: float) -> None:
    dead, live = np.zeros((2, 6)), np.zeros((2, 6))
    dead[:, 2], live[:, 0] = (0.25, 0.75), 2.0
    scaling = _scaling(np.ones(2), size * dead.ravel(), live.ravel())
    assert (scaling.force, scaling.live) == pytest.approx((0.5 * size, 0.25 * size))
    weightless = _scaling(np.ones(2), 0.0 * dead.ravel(), size * live.ravel())
    assert (weightless.force, weightless.live) == pytest.approx((2.0 * size, 1.0))


FIXED = -1


@pytest.mark.parametrize(
    ("loads", "bodies", "units"),
    [
        ([1, 1e-12], [(FIXED, 0), (0, 1)], [1, 1e-12]),
        ([1, 1e-12], [(FIXED, 0), (1, 0), (0, 1)], [1, 1e-12]),
        ([1, 2 * LIGHT], [(FIXED, 0), (0, 1)], [1, 1]),
        ([1e-12, 1], [(FIXED, 0), (0, 1)], [1, 1]),  # light below heavy
        ([1, 1e-12, 1], [(FIXED, 0), (0, 1), (1, 2)], [1, 1, 1]),
        ([1, 1e-12, 1e-10], [(FIXED, 0), (0, 1), (1, 2)], [1, 1e-10, 1e-10]),  # a pile has the unit of its largest load
        ([1, 1e-12, 1e-10], [(FIXED, 0), (0, 1), (0, 2)], [1, 1e-12, 1e-10]),
        ([1, 1e-12, 1e-10], [(FIXED, 0), (0, 1), (1, 2), (FIXED, 2)], [1, 1, 1]),
        ([1, 1e-12], [(FIXED, 0), (FIXED, 1)], [1, 1e-12]),
        ([1, 0], [(FIXED, 0), (0, 1)], [1, 1]),  # without a load there is nothing to measure by
        ([1, 1], [(FIXED, 0), (0, 1)], [1, 1]),
    ],
)
def test_units(loads: list[float], bodies: list[tuple[int, int]], units: list[float]) -> None:
    assert own_units(np.array(loads, dtype=np.float64), np.array(bodies)).tolist() == units
