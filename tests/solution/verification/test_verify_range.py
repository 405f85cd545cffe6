"""Verification of the range of a load factor: what is right is confirmed, each single fault is seen."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.mechanics import mechanics_of
from mbla.solution.nonassociative.factor_range import factor_range
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.solution import Mechanics, Solution, Status
from mbla.solution.verification.further_claims import range_checks
from tests.line import Line, line_of
from tests.solution.nonassociative.test_factor_range import FERRIS_3, SETTINGS, solved


@pytest.fixture(scope="module")
def case() -> tuple[Line, Solution]:
    """Wall 3 of Ferris and Tin-Loi 2001 with its range."""
    line = line_of(FERRIS_3)
    state = solved(line.program)
    result = factor_range(line.program, state, SETTINGS, lambda record: None, 1)

    def mechanics(of: LawState | None) -> Mechanics:
        assert of is not None
        return mechanics_of(line.program, of)

    solution = Solution(
        flow_rule="non_associative",
        status=Status.SOLVED,
        mechanics=mechanics(state),
        associative=None,
        certificate=None,
        reason="",
        programs=result.programs,
        iterations=(),
        seconds=0.0,
        lower=mechanics(result.lower),
        upper=mechanics(result.upper),
    )
    return line, solution


def checked(line: Line, solution: Solution) -> tuple[float, float]:
    return range_checks(line.model, line.contacts, line.load_case, solution)


def test_both_ends_are_confirmed(case: tuple[Line, Solution]) -> None:
    assert checked(*case) == pytest.approx((0.3558174, 0.3793852), abs=2e-7)


def test_without_ends_there_is_nothing_to_confirm(case: tuple[Line, Solution]) -> None:
    line, solution = case
    assert np.isnan(checked(line, replace(solution, lower=None, upper=None))).all()


def test_one_end_alone_is_confirmed_alone(case: tuple[Line, Solution]) -> None:
    line, solution = case
    lower, upper = checked(line, replace(solution, upper=None))
    assert lower == pytest.approx(0.3558174, abs=2e-7)
    assert np.isnan(upper)


def faulty(solution: Solution, fault: str) -> Mechanics:
    """The upper end with one fault."""
    upper, lower = solution.upper, solution.lower
    assert upper is not None
    assert lower is not None
    if fault == "factor without its forces":
        return replace(upper, load_factor=upper.load_factor * (1.0 + 1e-4))
    if fault == "below the factor found":
        return replace(lower, load_factor=lower.load_factor * (1.0 - 1e-3))
    if fault == "another mechanism":
        return replace(upper, mechanism=upper.mechanism * (1.0 + 1e-6))
    turned = upper.contact_forces * np.where(upper.modes == 1, -1.0, 1.0)[:, None]
    return replace(upper, contact_forces=turned)


@pytest.mark.parametrize(
    "fault", ["factor without its forces", "below the factor found", "another mechanism", "pulled sliding points"]
)
def test_a_faulty_end_is_not_confirmed(case: tuple[Line, Solution], fault: str) -> None:
    line, solution = case
    lower, upper = checked(line, replace(solution, upper=faulty(solution, fault)))
    assert np.isnan(upper)
    assert np.isfinite(lower)


def test_shear_that_helps_the_motion_is_not_confirmed(case: tuple[Line, Solution]) -> None:
    """Forces of the associative solution are in equilibrium and within yield, but do not fit the mechanism."""
    line, solution = case
    associative = solve_associative(line.program, SETTINGS, lambda record: None).state
    assert associative is not None
    assert solution.mechanics is not None
    other = mechanics_of(line.program, associative)
    mixed = replace(solution.mechanics, contact_forces=other.contact_forces, load_factor=other.load_factor)
    assert np.isnan(checked(line, replace(solution, upper=mixed))[1])


def test_an_approximate_factor_has_no_verified_range(case: tuple[Line, Solution]) -> None:
    line, solution = case
    assert solution.mechanics is not None
    loose = replace(solution.mechanics, load_factor=solution.mechanics.load_factor * 1.01)
    assert np.isnan(checked(line, replace(solution, mechanics=loose))).all()
