"""Ends of a range of load factors: confirmed at one side of each limit, not at the other."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from mbla.solution.nonassociative.factor_range import factor_range

from mbla.arrays import FloatArray
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.mechanics import lifted, mechanics_of
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.solution import Mechanics, Solution, Status
from mbla.solution.verification.further_claims import peak_check, range_checks
from mbla.solution.verification.residuals import Residuals
from tests.line import Line, line_of
from tests.solution.by_hand import EXACT, claim, cube, state
from tests.solution.nonassociative.structures import FERRIS_3, SETTINGS, solved
from tests.solution.planar import planar_program

MOTION = np.array([[0.5, 0, 0, 0, 0, -0.25]])


@pytest.fixture(scope="module")
def line() -> Line:
    return cube(f"friction: 0.5, dilatancy: {math.degrees(math.atan(0.25))}")


@pytest.fixture
def left(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """Residuals by load factor, none where nothing is said; the dilatancy they are asked for."""
    of: dict[str, Any] = {"residuals": {}, "dilatancy": None}

    def residuals_of(*arguments: Any) -> Residuals:
        *_, mechanics, dilatancy = arguments
        of["dilatancy"] = dilatancy.tolist()
        return replace(EXACT, complementarity=of["residuals"].get(mechanics.load_factor, 0.0))

    monkeypatch.setattr("mbla.solution.verification.further_claims.residuals_of", residuals_of)
    return of


def end(load_factor: float, motion: FloatArray = MOTION) -> Mechanics:
    return state(np.zeros((4, 3)), motion, load_factor)


def ends(
    line: Line, lower: Mechanics | None, upper: Mechanics | None, rule: str = "non_associative"
) -> tuple[Any, Any]:
    """Verified ends around a load factor of 2, None where they are not."""
    solution = claim(end(2.0), flow_rule=rule, associative=None, lower=lower, upper=upper)
    found = range_checks(line.model, line.contacts, line.load_case, solution)
    return tuple(None if np.isnan(value) else value for value in found)  # type: ignore[return-value]


def test_ends_that_are_right(line: Line, left: dict[str, Any]) -> None:
    assert ends(line, end(1.0), end(3.0)) == (1.0, 3.0)
    assert left["dilatancy"] == [0.0] * 4
    assert ends(line, end(1.0), None) == (1.0, None)
    assert ends(line, None, end(3.0)) == (None, 3.0)
    assert ends(line, None, None) == (None, None)
    assert ends(line, end(1.0), end(3.0), "dilatancy") == (1.0, 3.0)
    assert left["dilatancy"] == pytest.approx([0.25] * 4)


@pytest.mark.usefixtures("left")
def test_an_end_is_on_its_side(line: Line) -> None:
    assert ends(line, end(2.0), end(2.0)) == (2.0, 2.0)
    assert ends(line, end(2.125), end(1.875)) == (None, None)
    assert ends(line, end(-1.0), end(1.0)) == (-1.0, None)


def test_without_a_load_factor_there_is_no_range(line: Line) -> None:
    solution = claim(None, flow_rule="non_associative", lower=end(1.0), upper=end(3.0))
    assert np.isnan(range_checks(line.model, line.contacts, line.load_case, solution)).all()


@pytest.mark.usefixtures("left")
@pytest.mark.parametrize("at", [0, 3, 5])
def test_the_mechanism_of_an_end_is_the_same(at: int, line: Line) -> None:
    """To 1e-9 of its largest velocity, 1/2."""
    for off, same in ((0.49e-9, True), (0.51e-9, False), (0.25, False)):
        for side in (1.0, -1.0):
            other = MOTION.copy()
            other[0, at] += side * off
            expected = 1.0 if same else None
            assert ends(line, end(1.0, other), end(3.0)) == (expected, 3.0)


@pytest.mark.usefixtures("left")
def test_no_motion_is_the_same_as_none(line: Line) -> None:
    still = np.zeros((1, 6))
    solution = claim(end(2.0, still), flow_rule="non_associative", lower=end(1.0, still), upper=end(3.0))
    found = range_checks(line.model, line.contacts, line.load_case, solution)
    assert found[0] == 1.0
    assert np.isnan(found[1])


def test_an_end_fits_the_law_to_a_millionth(line: Line, left: dict[str, Any]) -> None:
    for value, fits in ((1e-6, True), (1.01e-6, False), (0.5, False), (np.nan, False)):
        left["residuals"] = {3.0: value}
        assert ends(line, end(1.0), end(3.0)) == (1.0, 3.0 if fits else None)


def test_or_as_well_as_the_load_factor_itself(line: Line, left: dict[str, Any]) -> None:
    for value, fits in ((1e-4, True), (1.01e-4, False), (0.5, False), (np.nan, False)):
        left["residuals"] = {2.0: value, 3.0: value}
        assert ends(line, end(1.0), end(3.0)) == ((1.0, 3.0) if fits else (None, None))
    left["residuals"] = {2.0: 1e-5, 3.0: 1.01e-5}
    assert ends(line, end(1.0), end(3.0)) == (1.0, None)


# A peak of a load path: its forces carry its load factor, or it is none.


def checked(line: Line, residuals: Residuals, monkeypatch: pytest.MonkeyPatch) -> float:
    """Of a peak of load factor 3 that leaves these."""
    peak = state(np.zeros((4, 3)), np.zeros((1, 6)), 3.0)

    def residuals_of(*arguments: object) -> Residuals:
        *_, mechanics, dilatancy = arguments
        assert mechanics is peak
        assert isinstance(dilatancy, np.ndarray)
        assert dilatancy.tolist() == [0.0] * 4
        return residuals

    monkeypatch.setattr("mbla.solution.verification.further_claims.residuals_of", residuals_of)
    return peak_check(line.model, line.contacts, line.load_case, peak)


@pytest.mark.parametrize("name", ["equilibrium", "yielding"])
def test_forces_carry_a_peak_to_a_millionth(name: str, line: Line, monkeypatch: pytest.MonkeyPatch) -> None:
    for value, held in ((0.0, True), (1e-6, True), (1.001e-6, False), (0.5, False), (np.nan, False)):
        found = checked(line, replace(EXACT, **{name: value}), monkeypatch)
        assert found == 3.0 if held else np.isnan(found)


def test_velocities_of_what_passes_prove_nothing(line: Line, monkeypatch: pytest.MonkeyPatch) -> None:
    off = replace(EXACT, penetration=1.0, complementarity=1.0, live_power=0.0, power_balance=1.0)
    assert checked(line, off, monkeypatch) == 3.0


def test_without_a_peak_there_is_none(line: Line) -> None:
    assert np.isnan(peak_check(line.model, line.contacts, line.load_case, None))


def test_forces_that_do_not_carry_their_load(line: Line) -> None:
    none: FloatArray = np.zeros((4, 3))
    assert np.isnan(peak_check(line.model, line.contacts, line.load_case, state(none, np.zeros((1, 6)), 1.0)))


# Verification of the range of a load factor: what is right is confirmed, each single fault is seen.


@pytest.fixture(scope="module")
def case() -> tuple[Line, Solution]:
    """Wall 3 of Ferris and Tin-Loi 2001 with its range."""
    line = line_of(FERRIS_3)
    planar = planar_program(line)
    state = lifted(planar, solved(planar))
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


def checked_solved(line: Line, solution: Solution) -> tuple[float, float]:
    return range_checks(line.model, line.contacts, line.load_case, solution)


def test_both_ends_are_confirmed(case: tuple[Line, Solution]) -> None:
    assert checked_solved(*case) == pytest.approx((0.3558174, 0.3793852), abs=2e-7)


def test_shear_that_helps_the_motion_is_not_confirmed(case: tuple[Line, Solution]) -> None:
    """Forces of the associative solution are in equilibrium and within yield, but do not fit the mechanism."""
    line, solution = case
    associative = solve_associative(line.program, SETTINGS, lambda record: None).state
    assert associative is not None
    assert solution.mechanics is not None
    other = mechanics_of(line.program, associative)
    mixed = replace(solution.mechanics, contact_forces=other.contact_forces, load_factor=other.load_factor)
    assert np.isnan(checked_solved(line, replace(solution, upper=mixed))[1])
