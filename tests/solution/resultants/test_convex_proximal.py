"""The scheme without dilatancy for the convex contact model, where its programs or its steps end early."""

from __future__ import annotations

import pytest

from mbla.program.resultants import ConvexProgram, assemble_convex
from mbla.solution.nonassociative.law_state import SequenceResult
from mbla.solution.resultants import convex_proximal
from mbla.solution.resultants.convex_proximal import solve_convex_proximal
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
