"""Pattern and factorisation of A C A^T against products of sparse matrices."""

from __future__ import annotations

import numpy as np
import pytest

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
