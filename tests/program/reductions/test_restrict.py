"""Matrices of smaller programs, without the rounding of entries that are none."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.program.reductions.restrict import tidy


def test_rounding_of_the_largest_entry_is_left_out() -> None:
    matrix = tidy(sp.coo_array((np.array([1e-16, -4.0, 1e-3, 0.0]), ([1, 0, 1, 0], [0, 1, 1, 0])), shape=(2, 3)))
    assert matrix.indices.tolist() == [1, 1]
    assert matrix.data.tolist() == [-4.0, 1e-3]
    assert matrix.shape == (2, 3)
    assert tidy(sp.coo_array((2, 3))).nnz == 0


def test_entries_come_in_order() -> None:
    given = sp.csr_array((np.array([3.0, 1.0, 4.0]), np.array([2, 0, 1]), np.array([0, 2, 3])), shape=(2, 3))
    assert not given.has_sorted_indices
    for matrix in (given, sp.csc_array(given), sp.coo_array(given)):
        clean = tidy(matrix)
        assert clean.has_canonical_format
        assert clean.toarray().tolist() == [[1.0, 0.0, 3.0], [0.0, 4.0, 0.0]]
