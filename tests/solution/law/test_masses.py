"""Masses in a step of the joint law: sets of rows that they couple, and their inverse."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.solution.law.masses import MassPattern


def test_the_inverse_goes_by_sets_of_coupled_rows_of_any_size_and_order() -> None:
    random = np.random.default_rng(3)
    dense = np.zeros((7, 7))
    for rows in ([0, 4, 5], [1], [2, 6], [3]):
        root = random.normal(size=(len(rows), len(rows)))
        dense[np.ix_(rows, rows)] = root @ root.T + np.eye(len(rows))
    matrix = sp.csr_array(dense)
    pattern = MassPattern(sp.csr_array((dense != 0.0).astype(np.float64)))
    right = random.normal(size=7)
    found = pattern.solved(pattern.inverses(matrix.data), right)
    np.testing.assert_allclose(found, np.linalg.solve(dense, right), rtol=1e-12)
    np.testing.assert_array_equal(pattern.filled(matrix.data).toarray(), dense)
