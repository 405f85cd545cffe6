"""A singular block is not-a-number, and the inverses beside it are what they are without it; a breakdown is told."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from mbla.program.program import Program
from mbla.solution.cone_solvers.interior_point.condensation import bordered
from mbla.solution.linear_algebra.small_blocks import inverses
from mbla.solution.solution import Status
from tests.line import BLOCK, line_of, verified


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
