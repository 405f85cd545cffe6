"""Pivots of matrices that need not be definite."""

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.solution.linear_algebra.pattern import lower_triangle, stored_lower_triangle
from mbla.solution.linear_algebra.qdldl_factors import QdldlFactors


@pytest.mark.parametrize("seed", range(5))
def test_as_many_pivots_are_negative_as_eigenvalues(seed: int) -> None:
    random = np.random.default_rng(seed)
    dense = random.standard_normal((30, 30)) * (random.random((30, 30)) < 0.2)
    matrix = sp.csc_array(dense + dense.T + np.diag(random.standard_normal(30)))
    pattern, values = stored_lower_triangle(matrix)
    factors = QdldlFactors(pattern)
    negative = int((np.linalg.eigvalsh(matrix.toarray()) < 0).sum())
    pivots = factors.pivots(values)
    assert pivots is not None
    assert 0 < negative < 30
    assert int((pivots < 0).sum()) == negative
    rhs = random.standard_normal(30)
    assert matrix @ factors.solve(rhs) == pytest.approx(rhs, abs=1e-8)
    assert not factors.factorize(values)
    with pytest.raises(ValueError, match="without a good factorisation"):
        factors.solve(rhs)


@pytest.mark.parametrize("value", [0.0, np.nan, np.inf])
def test_a_pivot_that_is_none(value: float) -> None:
    pattern, values = stored_lower_triangle(sp.csc_array(np.eye(3)))
    values[1] = value
    factors = QdldlFactors(pattern)
    assert factors.pivots(values) is None
    with pytest.raises(ValueError, match="without a good factorisation"):
        factors.solve(np.ones(3))


def test_what_is_stored_need_not_be_looked_for() -> None:
    """Both ways to the lower triangle, of a matrix whose rows come in no order."""
    dense = np.array([[4.0, 1.0, 0.0, 2.0], [1.0, 5.0, 0.0, 0.0], [0.0, 0.0, 6.0, 3.0], [2.0, 0.0, 3.0, 7.0]])
    matrix = sp.csc_array(dense)
    for column in range(4):
        part = slice(matrix.indptr[column], matrix.indptr[column + 1])
        matrix.indices[part], matrix.data[part] = matrix.indices[part][::-1].copy(), matrix.data[part][::-1].copy()
    matrix.has_sorted_indices = False
    (pattern, values), (searched, found) = stored_lower_triangle(matrix), lower_triangle(matrix)
    assert pattern.indices.tolist() == searched.indices.tolist()
    assert pattern.pointers.tolist() == searched.pointers.tolist()
    assert values.tolist() == found.tolist()
