"""Pivots of matrices that need not be definite."""

from __future__ import annotations

from typing import Literal

import numpy as np
import pytest
import scipy.sparse as sp
import scipy.sparse.linalg as spla

from mbla.arrays import IntArray
from mbla.solution.linear_algebra.pattern import lower_triangle
from mbla.solution.linear_algebra.qdldl_factors import QdldlFactors, elimination_order, sets_of_equal_rows


@pytest.mark.parametrize("seed", range(5))
def test_as_many_pivots_are_negative_as_eigenvalues(seed: int) -> None:
    random = np.random.default_rng(seed)
    dense = random.standard_normal((30, 30)) * (random.random((30, 30)) < 0.2)
    matrix = sp.csc_array(dense + dense.T + np.diag(random.standard_normal(30)))
    pattern, values = lower_triangle(matrix)
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
    pattern, values = lower_triangle(sp.csc_array(np.eye(3)))
    values[1] = value
    factors = QdldlFactors(pattern)
    assert factors.pivots(values) is None
    with pytest.raises(ValueError, match="without a good factorisation"):
        factors.solve(np.ones(3))


def test_the_lower_triangle_of_a_matrix_whose_rows_come_in_no_order() -> None:
    dense = np.array([[4.0, 1.0, 0.0, 2.0], [1.0, 5.0, 0.0, 0.0], [0.0, 0.0, 6.0, 3.0], [2.0, 0.0, 3.0, 7.0]])
    matrix = sp.csc_array(dense)
    for column in range(4):
        part = slice(matrix.indptr[column], matrix.indptr[column + 1])
        matrix.indices[part], matrix.data[part] = matrix.indices[part][::-1].copy(), matrix.data[part][::-1].copy()
    matrix.has_sorted_indices = False
    pattern, values = lower_triangle(matrix)
    assert np.array_equal(pattern.matrix(values).toarray(), dense)
    assert np.array_equal(pattern.indices[pattern.pointers[:-1]], np.arange(4))


def blocks_of(graph: sp.coo_array, size: int) -> sp.coo_array:
    """Pattern with a dense block of rows for each node of a graph, ones on its diagonal included."""
    return sp.coo_array(sp.kron(graph, np.ones((size, size)), format="coo"))


def grid(m: int, n: int) -> sp.coo_array:
    """Nodes of a rectangular grid that touch their four neighbours and themselves."""
    node = np.arange(m * n).reshape(m, n)
    pairs = [(node, node), (node[1:], node[:-1]), (node[:-1], node[1:])]
    pairs += [(node[:, 1:], node[:, :-1]), (node[:, :-1], node[:, 1:])]
    row, column = (np.concatenate([pair[end].ravel() for pair in pairs]) for end in (0, 1))
    return sp.coo_array((np.ones(len(row)), (row, column)), shape=(m * n, m * n))


def fill(pattern: sp.coo_array, order: IntArray, own: Literal["NATURAL", "MMD_AT_PLUS_A"] = "NATURAL") -> int:
    """Entries of the factor L of the rows in that order, or in one of SuperLU's own on top of it."""
    held = pattern.toarray()[np.ix_(order, order)]
    dominant = sp.csc_array(held + np.diag(held.sum(axis=1)))
    lu = spla.splu(dominant, permc_spec=own, diag_pivot_thresh=0.0, relax=1, options={"SymmetricMode": True})
    return int(lu.nnz)


@pytest.mark.parametrize("size", [1, 3, 6])
def test_every_row_comes_once_and_rows_of_a_block_together(size: int) -> None:
    order = elimination_order(blocks_of(grid(7, 5), size))
    assert np.array_equal(np.sort(order), np.arange(35 * size))
    block = order.reshape(35, size) // size
    assert (block == block[:, :1]).all()


def test_blocks_of_different_sizes_are_told_by_their_columns() -> None:
    """Rows 0 and 1 touch the same columns, 2 and 3 likewise; 4 touches those of 2 and 3 besides its own."""
    pattern = sp.coo_array(sp.block_diag([np.ones((2, 2)), np.ones((3, 3))]))
    row, column = (np.asarray(part, dtype=np.int64) for part in pattern.coords)
    assert sets_of_equal_rows(5, row, column).tolist() == [0, 0, 1, 1, 1]
    longer = np.append(row, [0, 4]), np.append(column, [4, 0])
    assert sets_of_equal_rows(5, *longer).tolist() == [0, 1, 2, 2, 3]


def test_a_star_keeps_its_centre_for_last() -> None:
    """Taken first it would join all the others: 21 entries of L in place of 11 for five rays."""
    centre = np.zeros((6, 6))
    centre[2] = centre[:, 2] = 1.0
    pattern = sp.coo_array(np.maximum(centre, np.eye(6)))
    order = elimination_order(pattern)
    assert 2 in order[-2:].tolist()  # of the last two either may come first: there is no fill left
    assert fill(pattern, order) == 2 * 11


@pytest.mark.long
@pytest.mark.parametrize("size", [3, 6])
def test_fill_is_that_of_the_order_of_all_rows_or_about(size: int) -> None:
    """That of SuperLU, as dear as a factorisation. On a small grid it fills 3 % less, on walls 10 % more."""
    pattern = blocks_of(grid(30, 30), size)
    own = fill(pattern, elimination_order(pattern))
    assert own < 1.1 * fill(pattern, np.arange(900 * size), "MMD_AT_PLUS_A")
    assert own < 0.8 * fill(pattern, np.arange(900 * size))


def test_parts_that_do_not_touch_and_no_rows_at_all_have_an_order() -> None:
    assert elimination_order(sp.coo_array(sp.eye_array(4))).shape == (4,)
    assert elimination_order(sp.coo_array((0, 0))).tolist() == []
