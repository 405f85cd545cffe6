"""Angles of a tilting table that are right, and wrong in one thing."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.model.model import LoadCase
from mbla.questions.angle import Angle
from mbla.questions.load_factor import LOAD_FACTOR
from mbla.questions.tilt import Tilt
from mbla.solution.solution import Status
from mbla.solution.verification.tilting_table import never_failures, tilt_failures
from tests.asked import tilt_of
from tests.line import Line
from tests.solution.by_hand import claim, cube, found, state

FIXED, DOWN, ACROSS = np.zeros((2, 6)), np.zeros((2, 6)), np.zeros((2, 6))
FIXED[0, 1], DOWN[:, 2], ACROSS[:, 0] = 3.0, (-32.0, -4.0), (32.0, 4.0)


@pytest.fixture(scope="module")
def line() -> Line:
    return cube()


def tilt(angle: float = math.nan, tangent: bool = True, upright: float = math.nan) -> Tilt:
    return Tilt(np.array([0.0, 1.0, 0.0]), FIXED * (not tangent), DOWN, ACROSS, angle, tangent, upright)


def by_tangent(line: Line) -> LoadCase:
    return replace(line.load_case, question=Angle(tilt()), dead_load=DOWN, live_load=ACROSS)


def by_angle(line: Line, degrees: float, told: float | None = None) -> LoadCase:
    """The live load leads from the level table to the angle; another one may be told."""
    turn = math.radians(degrees)
    live = math.sin(turn) * ACROSS + (math.cos(turn) - 1.0) * DOWN
    table = tilt(degrees if told is None else told, tangent=False)
    return replace(line.load_case, question=Angle(table), dead_load=FIXED + DOWN, live_load=live)


def failures(line: Line, case: LoadCase, factor: float, status: Status = Status.SOLVED) -> tuple[str, ...]:
    solution = claim(state(np.zeros((1, 3)), np.zeros((2, 6)), factor), status)
    return tilt_failures(line.model, line.contacts, case, solution)


@pytest.mark.parametrize("factor", [0.25, 0.0, -0.5, 3.0])
def test_the_tangent_of_the_angle(factor: float, line: Line) -> None:
    assert failures(line, by_tangent(line), factor) == ()


@pytest.mark.parametrize("degrees", [10.0, 60.0, 120.0])
def test_the_angle_itself(degrees: float, line: Line) -> None:
    assert failures(line, by_angle(line, degrees), 1.0) == ()


@pytest.mark.parametrize("status", Status)
def test_a_false_angle(status: Status, line: Line) -> None:
    """Told 60 degrees at 30: 32 (cos 30° − cos 60°) of 32."""
    case = by_angle(line, 30.0, told=60.0)
    share = math.cos(math.radians(30)) - math.cos(math.radians(60))
    expected = (f"the loads at collapse are not those at 60 degrees: they differ by {share:.1e}",)
    claimed = status in (Status.SOLVED, Status.APPROXIMATE)
    assert failures(line, case, 1.0, status) == (expected if claimed else ())


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_millionth_of_what_turns_may_be_off(side: float, line: Line) -> None:
    for off, right in ((0.99e-6, True), (1e-6, True), (1.01e-6, False), (0.5, False)):
        case = by_angle(line, 30.0)
        dead = case.dead_load.copy()
        dead[1, 4] = side * (off * 32.0)
        assert (failures(line, replace(case, dead_load=dead), 1.0) == ()) == right


def test_small_loads_are_measured_by_themselves(line: Line) -> None:
    case = by_angle(line, 30.0)
    table = tilt_of(case).with_loads(lambda loads: loads / 1024)
    for off, right in ((0.99e-6, True), (1.01e-6, False)):
        dead = case.dead_load / 1024
        dead[1, 4] += off * 32.0 / 1024
        small = replace(case, question=Angle(table), dead_load=dead, live_load=case.live_load / 1024)
        assert (failures(line, small, 1.0) == ()) == right


def test_a_load_factor_that_is_no_tangent(line: Line) -> None:
    """Loads from the level table to 30 degrees, twice over."""
    (failure,) = failures(line, by_angle(line, 30.0), 2.0)
    assert "not those at 30 degrees" in failure
    other = replace(by_tangent(line), live_load=2.0 * ACROSS)
    (failure,) = failures(line, other, 1.0)
    assert "not those at 45 degrees" in failure


@pytest.mark.parametrize("joint", ["friction: 0.5, cohesion: 1", "friction: 0.5, compressive_strength: 1000"])
def test_no_tangent_where_the_size_of_the_loads_counts(joint: str, line: Line) -> None:
    strong = cube(joint)
    (failure,) = failures(strong, by_tangent(strong), 0.25)
    assert "not the tangent of the angle" in failure
    assert failures(strong, by_tangent(strong), 0.0) == ()
    case = by_tangent(line)
    pulled = replace(case, question=Angle(replace(tilt_of(case), fixed=1e-9 * DOWN)), dead_load=(1 + 1e-9) * DOWN)
    (failure,) = failures(line, pulled, 0.25)
    assert "not the tangent of the angle" in failure


def test_cases_without_an_angle(line: Line) -> None:
    case = by_angle(line, 30.0, told=math.nan)
    assert failures(line, case, 1.0) == ()
    assert failures(line, replace(by_angle(line, 30.0, told=60.0), question=LOAD_FACTOR), 1.0) == ()
    assert tilt_failures(line.model, line.contacts, by_angle(line, 30.0, told=60.0), claim(None)) == ()


def never(line: Line, upright: float, over: float, off: float = 0.0, **changes: Any) -> tuple[str, ...]:
    live = -2.0 * DOWN
    live[1, 3] += off
    return never_failures(tilt(upright=upright), live, found(static_bound=over, **changes))


NOT_PROVED = "nothing proves that the table bears every angle up to 180 degrees"
NOT_OVER = "the live load is not the change from the level table to the one turned over"


def test_a_table_that_bears_every_angle(line: Line) -> None:
    """The corners (1, 2), (1 − 2 · 4, 0) leave the half circle inside."""
    assert never(line, 2.0, 4.0) == ()
    assert never(line, 0.5, 4.0) == (NOT_PROVED,)
    assert never(line, 2.0, 0.9) == (NOT_PROVED,)
    assert never(line, math.nan, 4.0) == (NOT_PROVED,)
    assert never(line, 2.0, math.nan) == (NOT_PROVED,)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_its_live_load_turns_it_over(side: float, line: Line) -> None:
    assert never(line, 2.0, 4.0, side * 0.99e-6 * 32) == ()
    assert never(line, 2.0, 4.0, side * (1e-6 * 32.0)) == ()
    for off in (1.01e-6, 0.5):
        assert never(line, 2.0, 4.0, side * off * 32) == (NOT_OVER,)
    assert never(line, 0.5, 4.0, 16.0) == (NOT_OVER, NOT_PROVED)


def test_small_loads_that_do_not_turn_it_over(line: Line) -> None:
    table = replace(tilt(upright=2.0), turning=DOWN / 1024, across=ACROSS / 1024)
    for share, expected in ((1.0 + 0.4e-6, ()), (1.0 + 0.6e-6, (NOT_OVER,))):
        assert never_failures(table, -2.0 * share * DOWN / 1024, found(static_bound=4.0)) == expected


def test_what_else_is_wrong_stays_wrong(line: Line) -> None:
    assert never(line, 2.0, 4.0, failures=("yield",)) == ("yield",)
