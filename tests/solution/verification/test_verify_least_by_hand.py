"""The least state that was found: confirmed where its own forces and motion fit the law of rigid joints, else not."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.full_model.mechanics import lifted, mechanics_of
from mbla.solution.solution import Mechanics
from mbla.solution.verification.least import least_check
from mbla.solution.verification.residuals import Residuals
from tests.line import Line, line_of
from tests.solution.by_hand import EXACT, claim, cube, state
from tests.solution.nonassociative.structures import FERRIS_3, SETTINGS, least_of
from tests.solution.planar import planar_program

FIGURE = state(np.zeros((4, 3)), np.zeros((1, 6)), 2.0)
LEAST = state(np.zeros((4, 3)), np.zeros((1, 6)), 1.0)


@pytest.fixture(scope="module")
def line() -> Line:
    return cube(f"friction: 0.5, dilatancy: {math.degrees(math.atan(0.25))}")


@pytest.fixture
def seen(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """Residuals of the least state, and the dilatancy they are asked for."""
    of: dict[str, Any] = {"residuals": EXACT, "dilatancy": None}

    def residuals_of(*arguments: Any) -> Residuals:
        *_, mechanics, dilatancy = arguments
        assert mechanics is LEAST
        of["dilatancy"] = dilatancy.tolist()
        residuals: Residuals = of["residuals"]
        return residuals

    monkeypatch.setattr("mbla.solution.verification.least.residuals_of", residuals_of)
    return of


def checked(line: Line, least: Mechanics | None, rule: str = "non_associative") -> float:
    """Beside a load factor of 2."""
    solution = claim(FIGURE, flow_rule=rule, associative=None, least=least)
    return least_check(line.model, line.contacts, line.load_case, solution)


@pytest.mark.parametrize(("rule", "dilatancy"), [("non_associative", 0.0), ("dilatancy", 0.25)])
def test_it_is_judged_by_the_flow_rule_claimed(rule: str, dilatancy: float, line: Line, seen: dict[str, Any]) -> None:
    assert checked(line, LEAST, rule) == 1.0
    assert seen["dilatancy"] == pytest.approx([dilatancy] * 4)


def test_without_a_least_state_there_is_none(line: Line) -> None:
    assert np.isnan(checked(line, None))


@pytest.mark.parametrize("name", ["equilibrium", "yielding", "penetration", "complementarity", "power_balance"])
def test_it_fits_the_law_to_a_ten_thousandth(name: str, line: Line, seen: dict[str, Any]) -> None:
    for value, fits in ((1e-4, True), (1.01e-4, False), (0.5, False), (np.nan, False)):
        seen["residuals"] = replace(EXACT, **{name: value})
        assert checked(line, LEAST) == 1.0 if fits else np.isnan(checked(line, LEAST))


@pytest.fixture(scope="module")
def wall() -> tuple[Line, Mechanics]:
    """Wall 3 of Ferris and Tin-Loi 2001 with its least state."""
    line = line_of(FERRIS_3)
    planar = planar_program(line)
    return line, mechanics_of(line.program, lifted(planar, least_of(planar)))


def test_the_least_state_of_a_published_wall_is_confirmed(wall: tuple[Line, Mechanics]) -> None:
    assert checked(*wall) == pytest.approx(0.3558174, abs=2e-7)


def test_another_load_factor_is_not_confirmed(wall: tuple[Line, Mechanics]) -> None:
    line, least = wall
    assert np.isnan(checked(line, replace(least, load_factor=1.001 * least.load_factor)))


def test_shear_that_helps_the_motion_is_not_confirmed(wall: tuple[Line, Mechanics]) -> None:
    """Forces of the associative solution are in equilibrium and within yield, but do not fit the mechanism."""
    line, least = wall
    associative = solve_associative(line.program, SETTINGS, lambda record: None).state
    assert associative is not None
    other = mechanics_of(line.program, associative)
    mixed = replace(least, contact_forces=other.contact_forces, load_factor=other.load_factor)
    assert np.isnan(checked(line, mixed))
