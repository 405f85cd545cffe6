"""Stages of the solution of which the next one below gives no answer: what each of them says then."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.solution.associative.condition_cones import ConditionCones
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.nonassociative import livesley
from mbla.solution.nonassociative.livesley import solve_livesley
from mbla.solution.parts import deciding_part
from mbla.solution.proof import static_repair
from mbla.solution.proof.static_repair import repaired_forces
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from mbla.solution.verification.verify import verify
from tests.line import BLOCK, line_of, solution_of
from tests.solution.by_hand import claim
from tests.solution.failing_solver import said

SETTINGS = SolverSettings(1e-8)
PRESSED = "load_cases.push.live=[{acceleration: [0, 0, -1]}]"


@pytest.mark.parametrize(
    ("said_to_be", "status"),
    [(Status.UNBOUNDED, Status.NOT_VERIFIED), (Status.ITERATION_LIMIT, Status.ITERATION_LIMIT)],
)
def test_a_correction_without_a_solution_says_nothing_of_the_structure(
    said_to_be: Status, status: Status, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = line_of(BLOCK).program
    associative = solve_associative(program, SETTINGS, lambda record: None)
    monkeypatch.setattr(livesley, "cone_solver", said(said_to_be))
    result = solve_livesley(program, associative, SETTINGS, lambda record: None)
    assert result.status is status
    assert result.state is None
    assert f"ended without a solution (clarabel: said {said_to_be})" in result.reason


def test_forces_whose_correction_is_no_number_are_not_repaired(monkeypatch: pytest.MonkeyPatch) -> None:
    program = line_of(BLOCK).program
    state = solve_associative(program, SETTINGS, lambda record: None).state
    assert state is not None
    assert repaired_forces(program, state.forces, state.load_factor) is not None
    nothing = np.full(len(program.live_load) + 1, np.nan)
    monkeypatch.setattr(static_repair, "bordered_solver", lambda *arguments: lambda rhs: nothing)
    further = ConditionCones.of(program)
    forces = static_repair._Forces(state.forces, np.zeros(0), state.load_factor)
    assert static_repair._static_correction(program, further, forces, static_repair.NORMAL) is None
    rough = state.forces + 1e-3
    assert repaired_forces(program, rough, state.load_factor) is None


def test_a_lock_without_forces_that_prove_it_is_not_verified(monkeypatch: pytest.MonkeyPatch) -> None:
    line = line_of(BLOCK, PRESSED)
    assert solution_of(line).status is Status.UNBOUNDED
    monkeypatch.setattr(deciding_part, "locking_forces", lambda *arguments: None)
    solution = solution_of(line)
    assert solution.status is Status.NOT_VERIFIED
    assert solution.reason == deciding_part.LOCK_NOT_PROVED
    checks = verify(line.assembly, line.load_case, claim(None, Status.UNBOUNDED))
    assert checks.failures == ("no forces are given that carry every multiple of the live load",)
