from __future__ import annotations

import numpy as np
import pytest

from mbla.deck.sections.analysis import PublishedScheme
from mbla.program.program import Program
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.nonassociative import published
from mbla.solution.nonassociative.collapse_state import FlowResult
from mbla.solution.nonassociative.published import solve_published
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from tests.line import BLOCK, WALL, line_of, load_factor, verified
from tests.solution.failing_solver import said

NON_ASSOCIATIVE = "analysis={flow_rule: non_associative, scheme: published}"


def test_a_sliding_block_needs_its_friction_with_either_flow_rule() -> None:
    solution, checks, status = verified(line_of(BLOCK, NON_ASSOCIATIVE, "parameters.h=0.5"))
    assert status is Status.SOLVED
    assert solution.mechanics is not None
    assert solution.associative is not None
    assert solution.mechanics.load_factor == pytest.approx(0.5, rel=1e-6)
    assert checks.complementarity_residual < 1e-4
    assert solution.mechanics.contact_velocities[:, 0] == pytest.approx(0, abs=1e-9)  # no dilatancy
    lift = solution.associative.contact_velocities
    assert lift[:, 0] == pytest.approx(0.5 * np.hypot(lift[:, 1], lift[:, 2]), rel=1e-5)  # friction angle


def test_where_nothing_slides_both_flow_rules_give_one_factor() -> None:
    assert load_factor(BLOCK, NON_ASSOCIATIVE, "parameters.mu=0.9") == pytest.approx(0.5, rel=1e-6)


@pytest.mark.parametrize("n", [4, 7])
def test_the_non_associative_factor_lies_below_the_associative_one(n: int) -> None:
    solution, _, status = verified(line_of(WALL, NON_ASSOCIATIVE, f"parameters.n={n}"))
    assert status is Status.SOLVED
    assert solution.mechanics is not None
    assert solution.associative is not None
    assert solution.mechanics.load_factor <= solution.associative.load_factor * (1 + 1e-6)


def test_a_slope_above_zero_is_a_dilatancy_and_verification_sees_it() -> None:
    """The published slope of 0.01 μ on a sliding block: v_N = 0.01 μ s, so 1 % of the power is not explained."""
    solution, checks, status = verified(
        line_of(BLOCK, NON_ASSOCIATIVE, "parameters.h=0.5", "analysis.published={slope: 0.01}")
    )
    assert solution.mechanics is not None
    assert solution.mechanics.load_factor == pytest.approx(0.5, rel=1e-5)
    assert checks.complementarity_residual == pytest.approx(0.01, rel=2e-2)
    assert status in (Status.APPROXIMATE, Status.NOT_VERIFIED)


def test_a_sequence_that_may_not_go_on_says_how_far_it_came() -> None:
    solution, _, status = verified(line_of(WALL, NON_ASSOCIATIVE, "analysis.published={max_programs: 2}"))
    assert status in (Status.APPROXIMATE, Status.NOT_VERIFIED)
    assert "did not settle in 2 programs" in solution.reason
    assert [program.kind for program in solution.programs] == ["associative", "published", "published"]


def test_cohesion_adds_to_friction() -> None:
    weight = 0.5 * 2000 * 9.81
    factor = load_factor(BLOCK, NON_ASSOCIATIVE, "parameters.h=0.5", "parameters.c=1000")
    assert factor == pytest.approx(0.5 + 1000 / weight, rel=1e-5)


def sequence(program: Program, most: int = 4) -> FlowResult:
    """The sequence of at most a few programs, from a right associative answer."""
    settings = SolverSettings(1e-8)
    associative = solve_associative(program, settings, lambda record: None)
    none = np.zeros(program.n_points)
    scheme = PublishedScheme(max_programs=most)
    return solve_published(program, associative, scheme, none, settings, lambda record: None)


@pytest.mark.parametrize(
    ("said_to_be", "status", "words"),
    [
        (Status.NO_EQUILIBRIUM, Status.NOT_VERIFIED, "the friction that belongs to the forces before does not carry"),
        (Status.UNBOUNDED, Status.NOT_VERIFIED, "does not give way to the live load"),
        (Status.NUMERICAL_ERROR, Status.NUMERICAL_ERROR, "ended without a solution (clarabel: said numerical_error)"),
    ],
)
@pytest.mark.parametrize("after", [0, 2])
def test_a_program_without_a_solution_breaks_the_sequence_off(
    said_to_be: Status, status: Status, words: str, after: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What it says is true of the joints made up for it only; the best state so far is kept."""
    program = line_of(WALL, "parameters.n=4").program
    monkeypatch.setattr(published, "cone_solver", said(said_to_be, after))
    result = sequence(program)
    assert result.status is status
    assert f"program {len(result.programs)} of the sequence" in result.reason
    assert words in result.reason
    assert [record.status for record in result.programs if record.kind == "published"][after:] == [said_to_be]
    assert (result.state is None) is (after == 0)


def test_programs_short_of_their_tolerance_settle_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """The load factor of a sliding block is right from the first program on."""
    program = line_of(BLOCK, "parameters.h=0.5").program
    assert sequence(program).status is Status.SOLVED
    monkeypatch.setattr(published, "cone_solver", said(Status.APPROXIMATE))
    result = sequence(program)
    assert result.status is Status.APPROXIMATE
    assert result.reason.startswith("its programs end short of the solver's tolerance (clarabel: said approximate); ")
    assert "did not settle in 4 programs" in result.reason
    assert result.state is not None
    assert program.scaling.load_factor(result.state.load_factor) == pytest.approx(0.5, rel=1e-6)
