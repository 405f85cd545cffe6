"""Sums of small products against dense arithmetic."""

from __future__ import annotations

import sys

import numpy as np
import pytest
import scipy.sparse as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from mbla.arrays import FloatArray, IntArray
from mbla.program.program import Program
from mbla.solution.cone_solvers.interior_point.condensation import bordered
from mbla.solution.linear_algebra.block_products import PlacedProducts, dense_rows, inverses, placed_products
from mbla.solution.solution import Status
from tests.line import BLOCK, line_of, verified

quick = settings(max_examples=40, derandomize=True)
seeds = st.integers(0, 2**32 - 1)


def dense(placed: PlacedProducts, values: FloatArray) -> FloatArray:
    """The whole symmetric matrix from its stored triangle."""
    pattern = placed.pattern
    triangle = sp.csc_array((values, pattern.indices, pattern.pointers), shape=(pattern.n, pattern.n)).toarray()
    return np.asarray(triangle + np.tril(triangle, -1).T)


@quick
@given(seed=seeds, n=st.integers(4, 12), n_batches=st.integers(0, 3))
def test_the_sum_is_that_of_dense_products(seed: int, n: int, n_batches: int) -> None:
    rng = np.random.default_rng(seed)
    columns: list[IntArray] = []
    blocks: list[FloatArray] = []
    expected = np.zeros((n, n))
    for _ in range(n_batches):
        n_blocks, width, height = rng.integers(1, 5), rng.integers(1, 5), rng.integers(1, 4)
        held = np.sort([rng.choice(n, width, replace=False) for _ in range(n_blocks)], axis=1).astype(np.int64)
        x = rng.normal(size=(n_blocks, height, width))
        columns.append(held)
        blocks.append(x)
        for rows, block in zip(held, x, strict=True):
            expected[np.ix_(rows, rows)] += block.T @ block
    placed = placed_products(n, columns)
    values = placed.summed(blocks)
    np.testing.assert_allclose(dense(placed, values), expected, atol=1e-13)
    np.testing.assert_allclose(values[placed.diagonal], np.diag(expected), atol=1e-13)


def test_a_column_without_any_block_has_its_diagonal_all_the_same() -> None:
    placed = placed_products(3, [np.array([[0, 2]])])
    values = placed.summed([np.array([[[1.0, 2.0]]])])
    np.testing.assert_array_equal(dense(placed, values), [[1, 0, 2], [0, 0, 0], [2, 0, 4]])


@quick
@given(seed=seeds)
def test_rows_gathered_into_blocks_are_those_of_the_matrix(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n_rows, n_columns, n_groups = 9, 7, 3
    group = rng.integers(-1, n_groups, n_rows)
    matrix = rng.normal(size=(n_rows, n_columns)) * (rng.random((n_rows, n_columns)) < 0.5)
    gathered = dense_rows(sp.csr_array(matrix), group, n_groups)
    place = np.array([int(np.sum(group[:row] == group[row])) for row in range(n_rows)])
    for number in range(n_groups):
        rows = matrix[group == number]
        held = np.flatnonzero(rows.any(axis=0))
        assert gathered.widths[number] == len(held)
        if len(held):
            np.testing.assert_array_equal(gathered.columns_of(np.array([number]))[0], held)
            block = gathered.blocks(np.array([number]), place, len(rows))[0]
            np.testing.assert_array_equal(block, rows[:, held])


def test_each_block_by_itself() -> None:
    blocks = np.random.default_rng(3).normal(size=(5, 3, 3))
    alone = inverses(blocks[[0, 1, 3, 4]])
    blocks[2, 2] = 0.0
    found = inverses(blocks)
    assert np.isnan(found[2]).all()
    assert np.array_equal(found[[0, 1, 3, 4]], alone)
    assert np.matmul(alone, blocks[[0, 1, 3, 4]]) == pytest.approx(np.broadcast_to(np.eye(3), (4, 3, 3)), abs=1e-12)


def test_a_border_that_overflowed_has_no_solution() -> None:
    assert np.isnan(bordered(np.array([[np.inf]]), np.array([1.0]))).all()
    assert bordered(np.array([[2.0]]), np.array([1.0])) == pytest.approx(0.5)


def test_a_breakdown_of_a_part_is_a_status(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(program: Program, *_: object) -> None:
        raise np.linalg.LinAlgError("Singular matrix")

    monkeypatch.setattr(sys.modules["mbla.solution.solve"], "solve_part", broken)
    solution, _, status = verified(line_of(BLOCK))
    assert status is Status.NUMERICAL_ERROR
    assert solution.mechanics is None
    assert "singular matrix" in solution.reason
