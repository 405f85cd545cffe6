"""The least change of forces and slacks that restores equilibrium, by the augmented system.

Light blocks beside heavy ones in the convex contact model.
"""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.solution.cone_solvers.cone_vectors import ConeVectors
from mbla.solution.proof.augmented_step import augmented_solver
from tests.extremes.weights import TOWER, tower_factor
from tests.line import Line, line_of, line_of_file
from tests.solution.convex_structures import DECKS, convex

CONES = ConeVectors(np.array([1, 3, 4, 1, 3]))


def inside(seed: int, distance: float) -> np.ndarray:
    """Vectors of all cones at a relative distance from their borders."""
    return CONES.pulled_inside(np.random.default_rng(seed).normal(size=12), distance, np.full(5, np.inf))


@pytest.mark.parametrize("distance", [1.0, 1e-6])
def test_the_root_of_the_inverse_hessian_has_it_for_its_square(distance: float) -> None:
    z = inside(3, distance)
    root = CONES.root_of_inverse_hessian(z)
    assert abs(root - root.T).max() < 1e-14
    assert abs(root @ root - CONES.inverse_hessian(z)).max() < 1e-13


def test_the_augmented_system_has_the_least_solution() -> None:
    random = np.random.default_rng(5)
    rows, wanted = random.normal(size=(4, 12)), random.normal(size=4)
    solve = augmented_solver(sp.csr_array(rows))
    assert solve is not None
    assert solve(wanted) == pytest.approx(np.linalg.lstsq(rows, wanted)[0], abs=1e-8)  # alpha is 1e-9


def test_without_weight_there_is_no_step() -> None:
    assert augmented_solver(sp.csr_array((2, 12))) is None


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
