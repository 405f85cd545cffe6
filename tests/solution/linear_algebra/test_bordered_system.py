"""The bordered system of repairs: both ways of solving it against the dense matrix, near-mechanism included."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.solution.linear_algebra import bordered_system
from mbla.solution.linear_algebra.bordered_system import bordered_solver


def with_mechanism(n: int, smallest: float) -> tuple[sp.csc_array, FloatArray]:
    """A matrix with one tiny eigenvalue, as that of a collapse mechanism, and a live load that works in it."""
    generator = np.random.default_rng(5)
    axes = np.linalg.qr(generator.normal(size=(n, n)))[0]
    sizes = np.append(10.0 ** generator.uniform(-3, 0, n - 1), smallest)
    matrix = (axes * sizes) @ axes.T
    return sp.csc_array(0.5 * (matrix + matrix.T)), axes[:, -1] + 0.1 * axes[:, 0]


@pytest.mark.parametrize("first", [1, 10**9], ids=["border last", "as one"])
@pytest.mark.parametrize("weight", [np.inf, 1e-2])
@pytest.mark.parametrize("smallest", [1e-3, 1e-9, 1e-12])
def test_solves_the_bordered_system(
    monkeypatch: pytest.MonkeyPatch, first: int, weight: float, smallest: float
) -> None:
    monkeypatch.setattr(bordered_system, "CHOLESKY_FROM", first)
    matrix, live = with_mechanism(60, smallest)
    corner = 0.0 if np.isinf(weight) else -1.0 / weight
    whole = np.block([[matrix.toarray(), live[:, None]], [live[None, :], np.array([[corner]])]])
    rhs = np.random.default_rng(2).normal(size=60)
    expected = np.linalg.solve(whole, np.append(rhs, 0.0))
    solve = bordered_solver(matrix, live, weight)
    assert solve is not None
    assert np.abs(solve(rhs) - expected).max() < 1e-6 * np.abs(expected).max()


def test_a_border_that_cannot_be_last_is_taken_with_the_matrix(monkeypatch: pytest.MonkeyPatch) -> None:
    """An indefinite matrix has no Cholesky factors, at any regularisation; the bordered one is solved all the same."""
    monkeypatch.setattr(bordered_system, "CHOLESKY_FROM", 1)
    matrix = sp.csc_array(np.array([[2.0, 3.0], [3.0, 2.0]]))
    solve = bordered_solver(matrix, np.array([1.0, 0.0]), np.inf)
    assert solve is not None
    assert solve(np.array([1.0, 4.0])) == pytest.approx([0.0, 2.0, -5.0], abs=1e-9)


def test_without_live_load_the_matrix_alone_is_solved(monkeypatch: pytest.MonkeyPatch) -> None:
    matrix, _ = with_mechanism(20, 1e-2)
    rhs = np.arange(20.0)
    for first in (1, 10**9):
        monkeypatch.setattr(bordered_system, "CHOLESKY_FROM", first)
        solve = bordered_solver(matrix, np.zeros(20), np.inf)
        assert solve is not None
        assert np.allclose(matrix @ solve(rhs)[:-1], rhs, atol=1e-8)


def test_without_factors_there_is_no_solver(monkeypatch: pytest.MonkeyPatch) -> None:
    matrix, live = with_mechanism(20, 1e-2)
    monkeypatch.setattr(bordered_system, "factorize", lambda *arguments, **named: None)
    assert bordered_solver(matrix, live, np.inf) is None


def test_factors_that_give_no_numbers_are_not_used(monkeypatch: pytest.MonkeyPatch) -> None:
    """The border cannot be last then, and is taken with the matrix."""

    class Broken:
        def solve(self, rhs: FloatArray) -> FloatArray:
            return np.full_like(rhs, np.nan)

    monkeypatch.setattr(bordered_system, "CHOLESKY_FROM", 1)
    monkeypatch.setattr(bordered_system, "_factors", lambda scaled: Broken())
    matrix, live = with_mechanism(20, 1e-2)
    rhs = np.arange(20.0)
    solve = bordered_solver(matrix, live, np.inf)
    assert solve is not None
    found = solve(rhs)
    assert np.abs(matrix @ found[:-1] + found[-1] * live - rhs).max() < 1e-8
    assert live @ found[:-1] == pytest.approx(0.0, abs=1e-8)


def test_a_row_without_entries_stays_at_rest(monkeypatch: pytest.MonkeyPatch) -> None:
    """2 y_1 + y_2 + t = 1, y_1 + 2 y_2 + t = 4 and y_1 + y_2 = 0; nothing acts on the third unknown."""
    matrix = sp.csc_array(np.array([[2.0, 1.0, 0.0], [1.0, 2.0, 0.0], [0.0, 0.0, 0.0]]))
    for first in (1, 10**9):
        monkeypatch.setattr(bordered_system, "CHOLESKY_FROM", first)
        solve = bordered_solver(matrix, np.array([1.0, 1.0, 0.0]), np.inf)
        assert solve is not None
        assert solve(np.array([1.0, 4.0, 0.0])) == pytest.approx([-1.5, 1.5, 0.0, 2.5], rel=1e-9)


@pytest.mark.parametrize(("good", "left"), [(1.0, 0.0), (0.6, 0.4**5), (0.4, 0.6)])
def test_refinement_ends_where_it_is_good_does_not_help_or_has_gone_on_enough(good: float, left: float) -> None:
    """A solver that finds a share of each answer: after four rounds of 0.6, 0.4^5 is left; of 0.4 none is made."""
    rhs = np.array([1.0, -2.0])
    x = bordered_system._refined(lambda b: good * b, lambda b, x: b - x, rhs)
    assert rhs - x == pytest.approx(left * rhs, rel=1e-12, abs=1e-15)
