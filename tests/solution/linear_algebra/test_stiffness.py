"""Pattern and factorisation of A C A^T against products of sparse matrices."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse.linalg as spla

from mbla.program.program import Program
from mbla.program.reductions import allowed_reductions, reduce_program
from mbla.solution.linear_algebra.block_products import block_diagonal
from mbla.solution.linear_algebra.stiffness import stiffness_of
from tests.line import WALL, line_of


def programs() -> list[Program]:
    line = line_of(WALL, "parameters.n=4")
    reduced = reduce_program(
        line.model, line.contacts, line.program, allowed_reductions(line.deck.analysis), associative=False
    ).parts
    assert reduced[0].components == 2
    return [line.program, reduced[0]]


@pytest.mark.parametrize("program", programs(), ids=["spatial", "planar"])
@pytest.mark.parametrize("fixed_load", [False, True])
def test_the_bordered_system_is_solved(program: Program, fixed_load: bool) -> None:
    rng = np.random.default_rng(7)
    n, c, k = len(program.dead_load), program.components, program.n_points
    tangents = np.eye(c) + 0.2 * rng.normal(size=(k, c, c))
    tangents[::5] = 0.0  # open joints
    shift, rhs = rng.uniform(0.1, 1.0, n), rng.normal(size=n + 1)
    stiffness = stiffness_of(program)
    solve = stiffness.factorized(tangents, shift, fixed_load=fixed_load)
    assert solve is not None
    matrix = program.equilibrium_matrix @ block_diagonal(tangents) @ program.equilibrium_matrix.T
    live, answer = program.live_load, solve(rhs)
    balance = -(matrix @ answer[:-1]) - shift * answer[:-1] + answer[-1] * live
    assert balance == pytest.approx(rhs[:-1], abs=1e-9)
    assert (answer[-1] if fixed_load else live @ answer[:-1]) == pytest.approx(rhs[-1], abs=1e-9)


def test_a_matrix_without_stiffness_is_singular() -> None:
    program = programs()[1]
    nothing = np.zeros((program.n_points, 2, 2))
    assert stiffness_of(program).factorized(nothing, np.zeros(len(program.dead_load))) is None


@pytest.mark.parametrize("program", programs(), ids=["spatial", "planar"])
def test_where_a_block_has_open_joints_alone_the_matrix_is_singular_and_superlu_is_not_asked(
    program: Program, monkeypatch: pytest.MonkeyPatch
) -> None:
    def asked(*_: object, **__: object) -> None:
        raise AssertionError("SuperLU prints a line by BLAS of some matrices with empty columns")

    monkeypatch.setattr(spla, "splu", asked)
    width, c = len(program.dead_load) // len(program.facts.free), program.components
    stiffness, touching = stiffness_of(program), abs(program.equilibrium_matrix)
    for block in range(len(program.facts.free)):
        rows = touching[block * width : (block + 1) * width]
        open_there = np.any(np.asarray(rows.sum(axis=0)).reshape(-1, c), axis=1)
        tangents = np.where(open_there.reshape(-1, 1, 1), 0.0, np.eye(c))
        assert stiffness.factorized(tangents, np.zeros(len(program.dead_load))) is None
