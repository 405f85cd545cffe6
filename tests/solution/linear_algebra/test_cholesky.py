from __future__ import annotations

import hashlib
import subprocess
import sys
from collections.abc import Iterator

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.errors import SolverError
from mbla.solution.linear_algebra import SymmetricPattern, cholesky, factorization, installed
from mbla.solution.linear_algebra.cholesky import LIBRARIES
from tests.solution.linear_algebra.matrices import random_matrix, triangle_of

EVERY = [
    pytest.param(name, marks=pytest.mark.skipif(name not in installed(), reason=f"{name} is not installed"))
    for name in LIBRARIES
]
every_library = pytest.mark.parametrize("library", EVERY)


def definite(n: int, seed: int = 1, spread: float = 0.0) -> tuple[SymmetricPattern, FloatArray]:
    """Random B D Bᵀ + I·1e-3 of n unknowns, three to a block, D over that many decades."""
    rng = np.random.default_rng(seed)
    half = random_matrix((n, 2 * n), min(1.0, 3.0 / n), rng)
    weights = sp.diags_array(10.0 ** rng.uniform(-spread / 2, spread / 2, 2 * n))
    return triangle_of(sp.csc_array(half @ weights @ half.T + 1e-3 * sp.eye_array(n)))


@every_library
@pytest.mark.parametrize("n", [1, 2, 3, 17, 120])
def test_solves_as_the_dense_matrix_does(library: str, n: int) -> None:
    pattern, values = definite(n, seed=n)
    factors = factorization(pattern, library)
    assert factors.library == library
    assert factors.factorize(values)
    rhs = np.random.default_rng(2).normal(size=n)
    expected = np.linalg.solve(pattern.matrix(values).toarray(), rhs)
    assert factors.solve(rhs) == pytest.approx(expected, rel=1e-9, abs=1e-12)


@every_library
def test_several_right_hand_sides_are_solved_as_one_by_one(library: str) -> None:
    pattern, values = definite(50)
    factors = factorization(pattern, library)
    assert factors.factorize(values)
    rhs = np.random.default_rng(3).normal(size=(50, 4))
    kept = rhs.copy()
    for ordered in (rhs, np.asfortranarray(rhs), rhs[:, ::2], rhs[::-1]):
        answer = factors.solve(ordered)
        assert answer.shape == ordered.shape
        one_by_one = np.column_stack([factors.solve(column) for column in ordered.T])
        assert answer == pytest.approx(one_by_one, rel=1e-12, abs=1e-14)
    assert np.array_equal(rhs, kept)


@every_library
def test_factorises_again_and_again_on_one_pattern(library: str) -> None:
    """Among the values there are stored zeros: a pattern is never thinned out."""
    pattern, values = definite(80)
    factors = factorization(pattern, library)
    rng, rhs = np.random.default_rng(4), np.ones(80)
    on_diagonal = pattern.columns() == pattern.indices
    only_diagonal = np.where(on_diagonal, values, 0.0)
    for _ in range(10):
        for changed in (only_diagonal, values + np.where(on_diagonal, rng.uniform(0.0, 5.0, len(values)), 0.0)):
            given = changed.copy()
            assert factors.factorize(given)
            assert np.array_equal(given, changed)
            given[:] = np.nan  # the factors do not look at it any more
            assert pattern.matrix(changed) @ factors.solve(rhs) == pytest.approx(rhs, abs=1e-10)


@every_library
def test_what_is_not_positive_definite_is_reported_and_the_next_matrix_is_solved(library: str) -> None:
    pattern, values = definite(40)
    eigenvalues = np.linalg.eigvalsh(pattern.matrix(values).toarray())
    on_diagonal = pattern.columns() == pattern.indices
    one_negative = values - np.where(on_diagonal, 0.5 * (eigenvalues[0] + eigenvalues[1]), 0.0)
    assert (one_negative[on_diagonal] > 0).all()  # seen only while factorising
    spoilt = values.copy()
    spoilt[3] = np.nan
    factors = factorization(pattern, library)
    for bad in (one_negative, -values, np.zeros_like(values), spoilt, values * np.inf):
        assert not factors.factorize(bad)
        with pytest.raises(ValueError, match="without a good factorisation"):
            factors.solve(np.ones(40))
        assert factors.factorize(values)
        assert pattern.matrix(values) @ factors.solve(np.ones(40)) == pytest.approx(np.ones(40), abs=1e-10)


@every_library
def test_a_matrix_over_sixteen_decades_is_solved_to_rounding(library: str) -> None:
    """Backward error row by row, in the scaling to a diagonal of ones that Cholesky does not see (van der Sluis)."""
    pattern, values = definite(200, spread=16.0)
    matrix = pattern.matrix(values)
    assert np.linalg.cond(matrix.toarray()) > 1e9
    factors = factorization(pattern, library)
    assert factors.factorize(values)
    rhs = matrix @ np.random.default_rng(5).normal(size=200)
    answer = factors.solve(rhs)
    size = np.sqrt(matrix.diagonal())
    reach = np.linalg.norm(size * answer)
    assert np.linalg.norm((matrix @ answer - rhs) / size) < 1e-13 * reach


@every_library
def test_a_right_hand_side_of_another_length_is_refused(library: str) -> None:
    pattern, values = definite(10)
    factors = factorization(pattern, library)
    assert factors.factorize(values)
    for rhs in (np.ones(9), np.ones((11, 2))):
        with pytest.raises(ValueError, match=r"size|rows"):
            factors.solve(rhs)


DIGEST = """
from tests.solution.linear_algebra.matrices import random_matrix
from tests.solution.linear_algebra.test_cholesky import digest
print(digest("{}"))
"""


def digest(library: str) -> str:
    """Of the bits of solutions after several factorisations."""
    pattern, values = definite(600, spread=8.0)
    factors = factorization(pattern, library)
    answers = hashlib.sha256()
    for scale in (1.0, 3.0, 1.0):
        assert factors.factorize(scale * values)
        answers.update(factors.solve(np.linspace(-1.0, 1.0, 600)).tobytes())
    return answers.hexdigest()


@every_library
def test_reruns_are_identical_to_the_bit(library: str) -> None:
    here = digest(library)
    assert digest(library) == here
    command = [sys.executable, "-c", DIGEST.format(library)]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip() == here


def test_an_unknown_library_is_named() -> None:
    with pytest.raises(SolverError, match="no factorisation mumps: it is one of qdldl, superlu, cholmod"):
        factorization(definite(3)[0], "mumps")


@pytest.fixture
def only_qdldl(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """As if the extra were not installed."""
    cholesky._fault.cache_clear()
    monkeypatch.setitem(sys.modules, "cvxopt", None)
    monkeypatch.delitem(sys.modules, "mbla.solution.linear_algebra.cholmod_factors", raising=False)
    yield
    cholesky._fault.cache_clear()


@pytest.mark.usefixtures("only_qdldl")
def test_what_is_not_installed_is_left_out_and_said_where_it_is_asked_for() -> None:
    pattern = definite(3)[0]
    assert installed() == ("qdldl", "superlu")
    with pytest.raises(SolverError, match=r"the factorisation cholmod does not work here: .+"):
        factorization(pattern, "cholmod")


class Wrong:
    """Factors that give a wrong answer."""

    library = "cholmod"

    def factorize(self, values: FloatArray) -> bool:
        return True

    def solve(self, rhs: FloatArray) -> FloatArray:
        return rhs


def test_a_library_with_wrong_answers_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    made = cholesky._made
    monkeypatch.setattr(cholesky, "_made", lambda name, pattern: Wrong() if name == "cholmod" else made(name, pattern))
    cholesky._fault.cache_clear()
    try:
        assert "cholmod" not in installed()
        with pytest.raises(SolverError, match="cholmod does not work here: it gave a wrong answer in a small trial"):
            factorization(definite(3)[0], "cholmod")
        assert factorization(definite(400)[0]).library != "cholmod"
    finally:
        cholesky._fault.cache_clear()


@pytest.mark.parametrize(
    ("there", "n", "expected"),
    [
        ({"cholmod"}, cholesky.CHOLMOD_FROM, "cholmod"),
        ({"cholmod"}, cholesky.CHOLMOD_FROM - 1, "qdldl"),
        (set(), cholesky.SUPERLU_FROM, "superlu"),
        (set(), cholesky.SUPERLU_FROM - 1, "qdldl"),
    ],
)
def test_the_best_for_the_size(monkeypatch: pytest.MonkeyPatch, there: set[str], n: int, expected: str) -> None:
    monkeypatch.setattr(cholesky, "_fault", lambda library: None if library in there else "missing")
    assert cholesky.best_library(n) == expected
