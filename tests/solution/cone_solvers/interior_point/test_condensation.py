"""The condensed solution, refined, against a dense solution of the whole system."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mbla.arrays import FloatArray
from mbla.solution.cone_solvers.interior_point.condensation import Condensation, refined_solution
from mbla.solution.cone_solvers.interior_point.cones import ConeData, ConeProduct, NesterovToddScaling, cone_data
from tests.solution.cone_solvers.interior_point.programs import Known, inside, known_program

quick = settings(max_examples=25, derandomize=True)
seeds = st.integers(0, 2**32 - 1)


def kinematic(seed: int, quadratic: bool) -> Known:
    """Few equations; half-lines and cones over a dozen unknowns."""
    rng = np.random.default_rng(seed)
    product = ConeProduct(int(rng.integers(0, 12)), int(rng.integers(6, 12)))
    return known_program(rng, int(rng.integers(4, 13)), int(rng.integers(0, 4)), product, quadratic)


def system(data: ConeData, scaling: NesterovToddScaling) -> FloatArray:
    """[Q + GᵀW⁻²G, Eᵀ; E, 0], dense."""
    bent = np.column_stack([scaling.inverse(column) for column in data.cone_matrix.toarray().T])
    equations = data.equations.toarray()
    none = np.zeros((len(equations),) * 2)
    return np.block([[np.diag(data.quadratic) + bent.T @ bent, equations.T], [equations, none]])


@pytest.mark.parametrize("quadratic", [False, True], ids=["linear", "quadratic"])
@pytest.mark.parametrize("distance", [1.0, 1e-3])
@quick
@given(seed=seeds)
def test_condensed_and_refined_is_the_solution_of_the_whole_system(seed: int, distance: float, quadratic: bool) -> None:
    rng = np.random.default_rng(seed)
    data = cone_data(kinematic(seed, quadratic).program)
    condensation = Condensation(data, "qdldl")
    s, z = (inside(rng, data.product, distance) for _ in range(2))
    scaling = NesterovToddScaling.of(data.product, s, z)
    assert condensation.factorize(scaling)
    r_x, r_e = rng.normal(size=len(data.cost)), rng.normal(size=len(data.equation_rhs))
    x, y = refined_solution(data, condensation, scaling, r_x, r_e)
    matrix = system(data, scaling)
    rhs = np.concatenate([r_x, r_e])
    found = np.concatenate([x, y])
    size = np.abs(matrix) @ np.abs(found) + np.abs(rhs)
    assert np.abs(matrix @ found - rhs).max() <= 1e-11 * size.max()
    if np.linalg.cond(matrix) < 1e8:
        np.testing.assert_allclose(found, np.linalg.solve(matrix, rhs), atol=1e-6 * np.abs(found).max())


def test_one_condensation_serves_one_scaling_after_another() -> None:
    """A second factorisation leaves nothing of the first."""
    data, rng = cone_data(kinematic(5, True).program), np.random.default_rng(5)
    pairs = [tuple(inside(rng, data.product, 0.1) for _ in range(2)) for _ in range(2)]
    right = rng.normal(size=len(data.cost)), rng.normal(size=len(data.equation_rhs))
    used, fresh = Condensation(data, "qdldl"), Condensation(data, "qdldl")
    for pair in pairs:
        assert used.factorize(NesterovToddScaling.of(data.product, *pair))
    assert fresh.factorize(NesterovToddScaling.of(data.product, *pairs[1]))
    for one, other in zip(used.solve(*right), fresh.solve(*right), strict=True):
        np.testing.assert_array_equal(one, other)


def test_zero_has_the_solution_zero() -> None:
    data = cone_data(kinematic(1, False).program)
    condensation = Condensation(data, "qdldl")
    scaling = NesterovToddScaling.identity(data.product)
    assert condensation.factorize(scaling)
    x, y = refined_solution(data, condensation, scaling, np.zeros_like(data.cost), np.zeros_like(data.equation_rhs))
    assert not x.any()
    assert not y.any()


def test_a_scaling_that_is_no_number_is_a_breakdown() -> None:
    data = cone_data(kinematic(2, False).program)
    scaling = NesterovToddScaling.identity(data.product)
    spoiled = NesterovToddScaling(data.product, scaling.line, scaling.w, np.full_like(scaling.eta, np.nan))
    with np.errstate(invalid="ignore"):
        assert not Condensation(data, "qdldl").factorize(spoiled)
