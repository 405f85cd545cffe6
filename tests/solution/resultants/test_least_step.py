"""The least change of dual variables that restores equilibrium, by normal equations and by the augmented system."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.solution.cone_solvers.cone_vectors import ConeVectors
from mbla.solution.resultants import least_step
from mbla.solution.resultants.least_step import Equilibrium, augmented_step, normal_step
from tests.line import line_of_file
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


def test_a_cone_without_shear_has_a_root_too() -> None:
    z = np.array([2.0, 3.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.5, 4.0, 0.0, 0.0])
    root = CONES.root_of_inverse_hessian(z)
    assert abs(root @ root - CONES.inverse_hessian(z)).max() < 1e-14


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


@pytest.mark.parametrize("answer", [None, np.nan], ids=["singular", "not a number"])
def test_without_an_answer_there_is_no_step(answer: float | None, monkeypatch: pytest.MonkeyPatch) -> None:
    random = np.random.default_rng(5)
    equilibrium = Equilibrium(sp.csr_array(random.normal(size=(12, 4))), random.normal(size=4), random.normal(size=4))
    z = np.append(-0.7, inside(7, 0.5))
    solve = None if answer is None else lambda rhs: np.full(len(rhs) + 1, answer)
    monkeypatch.setattr(least_step, "bordered_solver", lambda *arguments: solve)
    monkeypatch.setattr(least_step, "factorize", lambda *arguments: solve)
    assert normal_step(equilibrium, CONES, z) is None
    assert augmented_step(equilibrium, CONES, z) is None
