from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.solution.linear_algebra import SymmetricPattern, lower_triangle
from tests.solution.linear_algebra.matrices import random_matrix


def test_triangle_and_back() -> None:
    rng = np.random.default_rng(1)
    half = random_matrix((30, 20), 0.1, rng)
    matrix = sp.csc_array(half @ half.T)  # some diagonal entries are not stored
    pattern, values = lower_triangle(matrix)
    assert np.array_equal(pattern.matrix(values).toarray(), matrix.toarray())
    assert np.array_equal(pattern.indices[pattern.pointers[:-1]], np.arange(30))


def test_the_upper_triangle_is_not_looked_at() -> None:
    pattern, values = lower_triangle(sp.csc_array(np.array([[2.0, 9.0], [1.0, 3.0]])))
    assert np.array_equal(pattern.matrix(values).toarray(), [[2.0, 1.0], [1.0, 3.0]])


def test_entries_stored_twice_are_added() -> None:
    twice = sp.coo_array(([1.0, 2.0], ([0, 0], [0, 0])), shape=(1, 1))
    assert lower_triangle(twice)[1].tolist() == [3.0]


@pytest.mark.parametrize(
    ("indices", "pointers", "message"),
    [
        ([0, 1], [0, 1, 1], "from 0 to its number of entries"),
        ([0, 1], [0, 2, 2], "every column of a pattern has its diagonal"),
        ([1, 0, 1], [0, 2, 3], "sorted and start on the diagonal"),
        ([0, 1, 1, 1], [0, 3, 4], "sorted and start on the diagonal"),
        ([0, 2, 1], [0, 2, 3], "sorted and start on the diagonal"),
    ],
)
def test_a_pattern_of_another_form_is_refused(indices: list[int], pointers: list[int], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        SymmetricPattern(2, np.array(indices, np.int32), np.array(pointers, np.int32))


def test_places_of_another_type_are_refused() -> None:
    with pytest.raises(ValueError, match="int32"):
        SymmetricPattern(1, np.array([0]), np.array([0, 1]))
