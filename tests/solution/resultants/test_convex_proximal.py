"""The scheme without dilatancy for the convex contact model, where its programs or its steps end early."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mbla.program.resultants import ConvexProgram, assemble_convex
from mbla.solution.nonassociative.law_state import LawState, SequenceResult
from mbla.solution.resultants import convex_proximal
from mbla.solution.resultants.convex_proximal import _finished, _Run, solve_convex_proximal
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from mbla.solution.standing import standing
from tests.line import WALL, line_of
from tests.solution.failing_solver import said

SETTINGS = SolverSettings(1e-8)


@pytest.fixture(scope="module")
def wall() -> ConvexProgram:
    line = line_of(WALL.replace("[1, 0, 0]", "[1, 0.3, 0]"), "parameters.n=2")
    return assemble_convex(line.model, line.contacts, line.load_case, "convex")


def sequence(convex: ConvexProgram, most: int) -> SequenceResult:
    return solve_convex_proximal(convex, (), most, SETTINGS, lambda record: None)


@pytest.mark.parametrize("after", [0, 1, 3])
@pytest.mark.parametrize(
    ("said_to_be", "status"),
    [
        (Status.UNBOUNDED, Status.NOT_VERIFIED),
        (Status.NO_EQUILIBRIUM, Status.NOT_VERIFIED),
        (Status.TIME_LIMIT, Status.TIME_LIMIT),
    ],
)
def test_a_program_without_a_solution_ends_the_scheme(
    after: int, said_to_be: Status, status: Status, wall: ConvexProgram, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first is that of the gravity state; what is said of the others is not said of the structure."""
    solver = said(said_to_be, after)
    for module in (standing, convex_proximal):
        monkeypatch.setattr(module, "interior_point_solver", solver)
    result = sequence(wall, 10)
    assert result.status is status
    assert f"ended without a solution (clarabel: said {said_to_be})" in result.reason
    assert (result.state is None) is (after < 2)
    assert [record.kind for record in result.programs] == ["gravity", *["convex step"] * max(after - 1, 0)]


def test_steps_that_may_not_go_on_say_how_far_they_came(wall: ConvexProgram) -> None:
    result = sequence(wall, 2)
    assert result.status in (Status.APPROXIMATE, Status.NOT_VERIFIED)
    assert "did not converge in 2 iterations" in result.reason
    assert result.state is not None
    assert result.spread is not None
    assert result.spread[0] <= result.state.load_factor <= result.spread[1]


@pytest.mark.parametrize(
    ("residual", "wanted", "status", "asked"),
    [
        (1e-7, 1e-3, Status.SOLVED, None),
        (5e-5, 1e-3, Status.SOLVED, None),
        (5e-5, 1e-8, Status.SOLVED, None),
        (5e-4, 1e-3, Status.APPROXIMATE, 1e-3),
        (5e-3, 1e-3, Status.APPROXIMATE, None),
        (5e-2, 1e-3, Status.NOT_VERIFIED, None),
    ],
)
def test_a_state_is_judged_by_its_residual_and_what_was_asked_for(
    residual: float, wanted: float, status: Status, asked: float | None, wall: ConvexProgram
) -> None:
    """The last two states have the same load factor; words come with all that miss the law by more than 1e-6."""
    state = sequence(wall, 1).state
    assert state is not None
    made: list[LawState] = [replace(state, residual=0.9), *[replace(state, residual=residual)] * 2]
    settings = replace(SETTINGS, residual=wanted)
    result = _finished(_Run(wall, settings, lambda record: None, [], made, [0.9, residual, residual]))
    assert result.status is status
    assert result.tolerance_requested == asked
    assert result.state is not None
    assert result.state.residual == residual
    words = " ".join((result.reason, *result.remarks))
    assert (f"{residual:.2g}" in words) is (residual > 1e-6)
    assert (f"within the requested {wanted:g}" in words) is (1e-6 < residual <= wanted)
