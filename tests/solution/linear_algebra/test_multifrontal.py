"""Fronts of many shapes: supernodes with zeros, several children, runs of rows and scattered ones, several trees."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.solution.linear_algebra import lower_triangle
from mbla.solution.linear_algebra.multifrontal_factors import MultifrontalFactors
from mbla.solution.linear_algebra.supernodes import supernodes


def grid(width: int, height: int, unknowns: int = 3) -> sp.csc_array:
    """Blocks in a grid, each tied to its eight neighbours, definite by little."""
    generator = np.random.default_rng(7)
    number = np.arange(width * height).reshape(height, width)
    pairs = [
        (number[:, :-1].ravel(), number[:, 1:].ravel()),
        (number[:-1].ravel(), number[1:].ravel()),
        (number[:-1, :-1].ravel(), number[1:, 1:].ravel()),
        (number[:-1, 1:].ravel(), number[1:, :-1].ravel()),
    ]
    a, b = (np.concatenate(side) for side in zip(*pairs, strict=True))
    rows = np.arange(len(a))
    entries = (np.repeat([1.0, -1.0], len(a)), (np.tile(rows, 2), np.concatenate([a, b])))
    links = sp.csr_array(sp.coo_array(entries, shape=(len(a), number.size)))
    matrix = sp.kron(links, generator.normal(size=(unknowns, unknowns)))
    weights = 10.0 ** generator.uniform(-3, 3, matrix.shape[0])
    return sp.csc_array(matrix.T @ sp.diags_array(weights) @ matrix + sp.eye_array(matrix.shape[1]))


def arrow(n: int) -> sp.csc_array:
    """A diagonal with one full row and column."""
    matrix = sp.lil_array((n, n))
    matrix.setdiag(np.full(n, 2.0 * n))
    matrix[0, 1:], matrix[1:, 0] = 1.0, 1.0
    return sp.csc_array(matrix)


MATRICES = {
    "grid": grid(25, 20),
    "long": grid(400, 1),
    "arrow": arrow(300),
    "diagonal": sp.csc_array(sp.diags_array(np.arange(1.0, 200.0))),
    "apart": sp.block_diag([grid(9, 9), grid(30, 2), sp.eye_array(5)], format="csc"),
}


@pytest.mark.parametrize("name", MATRICES)
def test_solves_what_it_factorises(name: str) -> None:
    matrix = sp.csc_array(MATRICES[name])
    pattern, values = lower_triangle(matrix)
    factors = MultifrontalFactors(pattern)
    rhs = np.random.default_rng(3).normal(size=(pattern.n, 2))
    for factor in (1.0, 3.0):
        assert factors.factorize(factor * values)
        answer = factors.solve(rhs)
        size = abs(matrix).max() * np.abs(answer).max()
        assert np.abs(factor * (matrix @ answer) - rhs).max() < 1e-13 * factor * size
        assert np.array_equal(factors.solve(rhs[:, 0]), factors.solve(rhs[:, 0]))


@pytest.mark.parametrize("name", MATRICES)
def test_supernodes_are_a_postordered_tree_that_holds_the_factor(name: str) -> None:
    matrix = sp.csc_array(MATRICES[name])
    tree = supernodes(lower_triangle(matrix)[0])
    n = matrix.shape[0]
    assert np.array_equal(np.sort(tree.order), np.arange(n))
    assert tree.starts[0] == 0
    assert tree.starts[-1] == n
    assert (np.diff(tree.starts) > 0).all()
    held = np.zeros((n, n), dtype=bool)
    for a, b, below in zip(tree.starts[:-1], tree.starts[1:], tree.below, strict=True):
        held[a:b, a:b] = True
        held[below, a:b] = True
        assert (below >= b).all()
    assert ((tree.parent > np.arange(len(tree.parent))) | (tree.parent == -1)).all()
    factor = np.linalg.cholesky(matrix.toarray()[np.ix_(tree.order, tree.order)])
    assert held[np.abs(factor) > 0].all()


def test_a_negative_pivot_anywhere_is_found() -> None:
    matrix = sp.csc_array(MATRICES["grid"])
    pattern, values = lower_triangle(matrix)
    factors = MultifrontalFactors(pattern)
    for unknown in (0, 700, pattern.n - 1):
        broken = values.copy()
        broken[pattern.pointers[unknown]] = -1e9
        assert not factors.factorize(broken)
        with pytest.raises(ValueError, match="without a good factorisation"):
            factors.solve(np.ones(pattern.n))
    assert factors.factorize(values)


def test_two_of_one_pattern_keep_their_own_values() -> None:
    pattern, values = lower_triangle(sp.csc_array(MATRICES["apart"]))
    first, second = MultifrontalFactors(pattern), MultifrontalFactors(pattern)
    assert first.factorize(values)
    assert second.factorize(2.0 * values)
    rhs = np.ones(pattern.n)
    assert np.allclose(first.solve(rhs), 2.0 * second.solve(rhs), rtol=1e-12)
