"""The least change of dual variables that restores equilibrium, by normal equations and by the augmented system.

Light blocks beside heavy ones in the convex contact model.
"""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.program.resultants import assemble_convex, convex_form
from mbla.solution.cone_solvers.cone_vectors import ConeVectors
from mbla.solution.resultants.convex_units import in_units, loses_light_blocks, units_of_unknowns
from mbla.solution.resultants.least_step import Equilibrium, augmented_step, normal_step
from tests.extremes.weights import TOWER, tower_factor
from tests.line import Line, line_of, line_of_file
from tests.solution.convex_structures import DECKS, convex

CONES = ConeVectors(np.array([1, 3, 4, 1, 3]))


def inside(seed: int, distance: float) -> np.ndarray:
    """Vectors of all cones at a relative distance from their borders."""
    return CONES.pulled_inside(np.random.default_rng(seed).normal(size=12), distance)


@pytest.mark.parametrize("distance", [1.0, 1e-6])
def test_the_root_of_the_inverse_hessian_has_it_for_its_square(distance: float) -> None:
    z = inside(3, distance)
    root = CONES.root_of_inverse_hessian(z)
    assert abs(root - root.T).max() < 1e-14
    assert abs(root @ root - CONES.inverse_hessian(z)).max() < 1e-13


def test_both_ways_find_the_same_step_well_inside_the_cones() -> None:
    """There the metric is harmless. The load factor is one of the unknowns; its share in the metric is the same."""
    random = np.random.default_rng(5)
    equilibrium = Equilibrium(sp.csr_array(random.normal(size=(12, 4))), random.normal(size=4), random.normal(size=4))
    z = np.append(-0.7, inside(7, 0.5))
    by_normal, by_augmented = (step_of(equilibrium, CONES, z) for step_of in (normal_step, augmented_step))
    assert by_normal is not None
    assert by_augmented is not None
    assert np.abs(equilibrium.unbalanced(z + by_normal)).max() < 1e-13
    assert by_augmented == pytest.approx(by_normal, abs=1e-8)  # alpha is 1e-9


def test_without_weight_there_is_no_step() -> None:
    equilibrium = Equilibrium(sp.csr_array((12, 2)), np.zeros(2), np.ones(2))
    z = np.append(0.0, inside(1, 0.5))
    assert normal_step(equilibrium, CONES, z) is None
    assert augmented_step(equilibrium, CONES, z) is None


@pytest.mark.parametrize("deck", ["benchmarks/closed_forms/dome_of_slices", "tutorials/spiral_stair_round"])
def test_structures_whose_forces_lie_on_their_cones_are_proved(deck: str) -> None:
    """The normal equations have no digits left for their static bound: it was not a number.

    The solver's own forces exceed torsion on the dome by 1e-6, and its load factor is so much above both bounds.
    """
    solution, checks = convex(line_of_file(DECKS.parents[1] / f"{deck}.yaml"))
    assert checks.verified, checks.failures
    assert solution.mechanics is not None
    assert checks.static_bound == pytest.approx(checks.kinematic_bound, rel=1e-7)
    assert checks.kinematic_bound == pytest.approx(solution.mechanics.load_factor, rel=1e-6)


def tower(*loads: float) -> Line:
    """Three blocks on each other, the lowest first."""
    values = [f"parameters.{key}={load:.1e}" for key, load in zip("abc", loads, strict=True)]
    return line_of(TOWER, *values, "analysis.flow_rule=associative")


@pytest.mark.parametrize("ratio", [1e4, 1e6, 1e8])
def test_a_light_tower_on_a_heavy_block_rocks_as_by_itself(ratio: float) -> None:
    """In the units of the heavy block the factor was 0.646 at 1e4 and 1.2, that of the heavy one, at 1e8."""
    solution, checks = convex(tower(ratio, 1.0, 1.0))
    assert checks.verified, checks.failures
    assert solution.mechanics is not None
    assert solution.mechanics.load_factor == pytest.approx(tower_factor((ratio, 1.0, 1.0)), rel=1e-7)
    assert checks.static_bound == pytest.approx(checks.kinematic_bound, rel=1e-7)
    kinds = [record.kind for record in solution.programs]
    assert kinds == ["associative", "reverse", "associative", "reverse"]


def test_like_blocks_are_solved_once() -> None:
    solution, _ = convex(tower(1.0, 1.0, 1.0))
    assert [record.kind for record in solution.programs] == ["associative", "reverse"]


def test_units_follow_the_loads_and_leave_the_dual_program_as_it_is() -> None:
    line = tower(1e4, 1.0, 1.0)
    program = assemble_convex(line.model, line.contacts, line.load_case, "convex")
    form = convex_form(program)
    weight = np.abs(program.points.dead_load).reshape(-1, 6).max(axis=1)
    forces = np.zeros((program.points.n_points, 3))
    forces[:, 0] = weight[-1] / 4
    units = units_of_unknowns(form, program, forces)
    assert units.shape == form.cone_program.cost.shape
    assert units.max() <= 1.0
    heavy, light = (units[: program.n_block_rows].reshape(-1, 6)[i, 2] for i in (0, 2))
    assert light == pytest.approx(2.0 * weight[2])  # its weight and what it rests on
    assert heavy > 1e3 * light
    assert np.all(units[program.n_block_rows :][-8:] < 1e-3)  # conditions of the uppermost interface
    z, scaled = np.random.default_rng(2).normal(size=len(form.cone_program.rhs)), in_units(form.cone_program, units)
    assert scaled.matrix.T @ z * units == pytest.approx(form.cone_program.matrix.T @ z)
    assert scaled.cost * units == pytest.approx(form.cone_program.cost)


def test_what_is_lost_is_a_share_of_what_a_light_block_carries() -> None:
    """An unbalanced force of 1e-7 mean loads is nothing to the heavy block, and all to the light one."""
    solution, _ = convex(tower(1e4, 1.0, 1.0))
    line = tower(1e4, 1.0, 1.0)
    program = assemble_convex(line.model, line.contacts, line.load_case, "convex")
    scaling, mechanics = program.points.scaling, solution.mechanics
    assert mechanics is not None
    forces, factor = mechanics.contact_forces / scaling.force, mechanics.load_factor / scaling.live
    assert not loses_light_blocks(program, forces, factor)
    upper, lower = forces.copy(), forces.copy()
    height = line.contacts.points[:, 2]
    upper[np.argmax(height), 0] += 1e-7
    lower[np.argmin(height), 0] += 1e-7
    assert loses_light_blocks(program, upper, factor)
    assert not loses_light_blocks(program, lower, factor)
