"""Verdicts on friction polyhedra at both sides of each limit, and the polygons by which they are judged."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from importlib import import_module
from typing import Any

import numpy as np
import pytest

from mbla.solution.associative.polyhedral import solve_polyhedral
from mbla.solution.mechanics import mechanics_of
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Checks, Mechanics, Solution, Status
from mbla.solution.verification.residuals import Residuals
from mbla.solution.verification.verify import verify
from mbla.solution.verification.verify_points import verified_status
from mbla.solution.verification.verify_polyhedral import verify_polyhedral
from tests.line import BLOCK, WALL, Line, line_of, solution_of
from tests.solution.by_hand import EXACT, claim, cube, loaded, on_ground, state

MODULE = import_module("mbla.solution.verification.verify_polyhedral")
JUST_ABOVE = 1.0 + 1e-12
RISES = np.array([[0.125, 0, 0.0625, 0, 0, 0]])


@pytest.fixture(scope="module")
def line() -> Line:
    """A block 1 x 1 x 0.5 on the ground, friction 1/2, weight 32 and a push of 8 λ at its base."""
    dry = cube()
    return replace(dry, load_case=loaded(dry.load_case, (0, 0, -32, 0, 0, 0), (8, 0, 0, 0, -2, 0)))


def answers(line: Line, inner: float = 2.0, outer: float = 2.0) -> tuple[Mechanics, Mechanics]:
    """With forces that lie in the square polygon about the circle, on its corner for the circumscribed one."""
    first, second = (on_ground(line.model, line.contacts, (8, -4, 0)) for _ in range(2))
    return state(first, RISES, inner), state(second, RISES + 0.0, outer)


def judged(line: Line, inner: Mechanics, outer: Mechanics, sides: int = 4, **changes: Any) -> Checks:
    solution = claim(inner, outer=outer, sides=sides, **changes)
    return verify_polyhedral(line.model, line.contacts, line.load_case, solution)


@pytest.fixture
def told(line: Line, monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """Residuals of inner and outer answer by polygon and by circle, and bounds: as the test says."""
    inner, outer = answers(line)
    of: dict[str, Any] = {"inner": inner, "outer": outer, "bounds": (2.0, 2.0), "polygons": {}, "left": {}}

    def residuals_of(*arguments: Any) -> Residuals:
        mechanics, dilatancy, *polygon = arguments[1:]
        name = "inner" if mechanics is of["inner"] else "outer"
        assert mechanics is of[name]
        assert dilatancy.tolist() == [0.5] * 4
        if polygon:
            of["polygons"][name] = polygon[0]
        left: Residuals = of["left"].get(
            (name, "polygon" if polygon else "circle"), replace(EXACT, complementarity=1e-7)
        )
        return left

    def bounds(*arguments: Any) -> tuple[float, float]:
        assert arguments[1].contact_forces is of["inner"].contact_forces
        assert arguments[1].mechanism is of["outer"].mechanism
        found: tuple[float, float] = of["bounds"]
        return found

    monkeypatch.setattr(MODULE, "residuals_of", residuals_of)
    monkeypatch.setattr(MODULE, "associative_bounds", bounds)
    return of


def checks_of(line: Line, told: dict[str, Any], sides: int = 4) -> Checks:
    return judged(line, told["inner"], told["outer"], sides)


def test_the_right_answer(line: Line, told: dict[str, Any]) -> None:
    checks = checks_of(line, told)
    assert checks.verified
    assert checks.failures == ()
    assert checks.gap == 0.0


LIMITS = [
    ("equilibrium", "equilibrium residual", 1e-5),
    ("yielding", "yield violation", 1e-4),
    ("penetration", "penetration", 1e-4),
    ("complementarity", "complementarity residual", 1e-4),
    ("power_balance", "power balance", 1e-4),
]


@pytest.mark.parametrize(("of", "prefix"), [("inner", ""), ("outer", "circumscribed polyhedron: ")])
@pytest.mark.parametrize(("name", "words", "limit"), LIMITS)
def test_a_residual_may_be_its_limit_and_no_more(
    name: str, words: str, limit: float, of: str, prefix: str, line: Line, told: dict[str, Any]
) -> None:
    for value, right in ((limit, True), (limit * JUST_ABOVE, False), (np.nan, False)):
        left = replace(EXACT, **{name: value})
        told["left"] = {(of, "polygon"): left, (of, "circle"): left}
        judges_itself = of == "outer" and name == "yielding"  # by the polygon, below
        expected = () if right or judges_itself else (f"{prefix}{words} {value:.2g} exceeds {limit:g}",)
        assert checks_of(line, told).failures == expected


@pytest.mark.parametrize(("of", "prefix"), [("inner", ""), ("outer", "circumscribed polyhedron: ")])
def test_the_live_power_is_one(of: str, prefix: str, line: Line, told: dict[str, Any]) -> None:
    for power, right in ((1 + 0.99e-6, True), (1 - 0.99e-6, True), (1 + 1.01e-6, False), (1 - 1.01e-6, False)):
        left = replace(EXACT, live_power=power)
        told["left"] = {(of, "polygon"): left, (of, "circle"): left}
        failures = checks_of(line, told).failures
        assert len(failures) == (not right)
        assert all(one.startswith(f"{prefix}deviation of the live power from 1 ") for one in failures)


def test_the_law_of_the_circle_may_fit_instead(line: Line, told: dict[str, Any]) -> None:
    off = replace(EXACT, complementarity=0.5, yielding=0.125, slip=0.25, tension=0.0625)
    for law in ("polygon", "circle"):
        told["left"] = {("inner", law): off, ("outer", law): off}
        assert checks_of(line, told).verified
    told["left"] |= {("inner", "polygon"): off, ("inner", "circle"): replace(off, complementarity=0.75)}
    checks = checks_of(line, told)
    measures = (checks.complementarity_residual, checks.yield_violation, checks.slip_residual, checks.tension_violation)
    assert measures == (0.5, 0.125, 0.25, 0.0625)


@pytest.mark.parametrize("sides", [3, 4, 6, 8])
def test_polygons(sides: int, line: Line, told: dict[str, Any]) -> None:
    checks_of(line, told, sides)
    inner, outer = told["polygons"]["inner"], told["polygons"]["outer"]
    assert inner.shape == outer.shape == (sides, 2)
    for corner in range(sides):
        turn, half = 2 * math.pi * corner / sides, math.pi / sides
        assert inner[corner].tolist() == pytest.approx([math.cos(turn), math.sin(turn)])
        reach = 1 / math.cos(half)
        assert outer[corner].tolist() == pytest.approx([reach * math.cos(turn + half), reach * math.sin(turn + half)])


@pytest.mark.parametrize(
    ("sides", "along", "across", "beyond"),
    [
        (4, -4.0, 0.0, 0.0),
        (4, -4.0, 4.0, 0.0),
        (4, -4.5, 0.0, 0.5),
        (4, 4.5, 4.0, 0.5),
        (4, 3.0, -5.0, 1.0),
        (8, -4.0, 4 * (math.sqrt(2) - 1), 0.0),
        (8, -4.5, 0.0, 0.5),
        (8, -4.0, 4.0, 4 * math.sqrt(2) - 4),
        (3, -4.0, 0.0, 0.0),
    ],
)
def test_forces_of_the_circumscribed_polygon_keep_within_it(
    sides: int, along: float, across: float, beyond: float, line: Line, told: dict[str, Any]
) -> None:
    forces = on_ground(line.model, line.contacts, (8, 0, 0))
    forces[:, 1:] = along, across
    told["outer"] = replace(told["outer"], contact_forces=forces)
    failures = checks_of(line, told, sides).failures
    expected = f"circumscribed polyhedron: yield violation {beyond / 32:.2g} exceeds 0.0001"
    assert failures == ((expected,) if beyond else ())


def test_a_triangle_bears_most_against_its_corners(line: Line, told: dict[str, Any]) -> None:
    """Against the first corner's side no more than 4, the other way 8."""
    for along, right in ((4.0, False), (-4.0, True)):
        forces = on_ground(line.model, line.contacts, (8, 0, 0))
        forces[0, 1] = 2.0 * along
        told["outer"] = replace(told["outer"], contact_forces=forces)
        assert checks_of(line, told, 3).verified == (not right)


FEW = "is more than its forces prove"
MANY = "is less than its mechanism proves"


@pytest.mark.parametrize(
    ("static", "kinematic", "words"),
    [
        (2.0, 2.0, ()),
        (2.5, 2.0 - 1e-4, ("lies above the kinematic bound",)),
        (2.0 - 1.99e-5, 2.0, ()),
        (2.0 - 2.01e-5, 2.0, (FEW,)),
        (2.0, 2.0 + 1.99e-5, ()),
        (2.0, 2.0 + 2.01e-5, (MANY,)),
        (2.0, 1.5, ("lies above the kinematic bound",)),
        (2.0 + 1.99e-5, 2.0, ()),
        (2.0 + 2.01e-5, 2.0, ("lies above the kinematic bound",)),
        (np.nan, 2.0, (FEW, "lies above the kinematic bound")),
        (2.0, np.nan, (FEW, MANY, "lies above the kinematic bound")),
    ],
)
def test_bounds_prove_what_the_polyhedra_say(
    static: float, kinematic: float, words: tuple[str, ...], line: Line, told: dict[str, Any]
) -> None:
    """To 1e-5 of the load factor, 2."""
    told["bounds"] = static, kinematic
    failures = checks_of(line, told).failures
    assert len(failures) == len(words), failures
    assert all(part in failure for part, failure in zip(words, failures, strict=True))


def test_polyhedra_may_lie_apart(line: Line, told: dict[str, Any]) -> None:
    told["inner"], told["outer"] = answers(line, 1.0, 2.0)
    told["bounds"] = (1.0, 2.0)
    checks = checks_of(line, told)
    assert checks.verified
    assert (checks.static_bound, checks.kinematic_bound, checks.gap) == (1.0, 2.0, 0.5)


def test_bounds_that_cross_by_rounding_have_met(line: Line, told: dict[str, Any]) -> None:
    for off, met in ((1.9e-9, True), (2.1e-9, False)):
        told["bounds"] = (2.0 + off, 2.0)
        assert (checks_of(line, told).static_bound == 2.0) == met
    told["bounds"] = (1.0, 2.0)
    assert checks_of(line, told).static_bound == 1.0


def test_the_gap_of_nearly_nothing_is_over_a_thousandth_of_dead_over_live_load(
    line: Line, told: dict[str, Any]
) -> None:
    told["bounds"] = (0.0, 0.001)
    assert checks_of(line, told).gap == pytest.approx(math.hypot(8.0, 2.0 / 0.75) / 32.0)
    told["bounds"] = (0.0, np.nan)
    assert np.isnan(checks_of(line, told).gap)


def test_an_answer_of_both_polygons_without_any_stub(line: Line) -> None:
    """Along its tangents both polygons touch the circle."""
    inner, outer = answers(line)
    forces = outer.contact_forces.copy()
    checks = judged(line, inner, replace(outer, contact_forces=forces))
    assert checks.verified, checks.failures
    assert (checks.static_bound, checks.kinematic_bound) == pytest.approx((2.0, 2.0))
    assert not judged(line, replace(inner, load_factor=2.1), outer).verified
    assert not judged(line, inner, replace(outer, load_factor=1.9)).verified


def test_another_flow_rule_has_their_bracket_alone(line: Line) -> None:
    """What the block does without dilatancy is judged by itself; the bracket is that of both polyhedra."""
    inner, outer = answers(line)
    away = replace(inner, mechanism=-RISES)
    still = replace(inner, mechanism=np.array([[0.125, 0, 0, 0, 0, 0]]))
    solution = replace(claim(still, flow_rule="non_associative", sides=4), associative=away, outer=outer)
    checks = verify_polyhedral(line.model, line.contacts, line.load_case, solution)
    assert checks.verified, checks.failures
    assert (checks.static_bound, checks.kinematic_bound) == pytest.approx((2.0, 2.0))


# Polyhedral answers of an oblique push on a small wall, verified; then one thing broken at a time.


OBLIQUE = "load_cases.push.live=[{acceleration: [0.8, 0.6, 0]}]"


@cache
def answer(sides: int = 8, solver: str = "clarabel", text: str = WALL, *overrides: str) -> tuple[Line, Solution]:
    line = line_of(text, OBLIQUE, *(overrides or ("parameters.n=3",)))
    result = solve_polyhedral(line.program, sides, SolverSettings(1e-8, solver=solver), lambda _: None)
    assert result.inner.state is not None
    assert result.outer.state is not None
    inner, outer = (mechanics_of(line.program, found.state) for found in (result.inner, result.outer) if found.state)
    solution = replace(
        solution_of(line), status=result.inner.status, mechanics=inner, associative=inner, outer=outer, sides=sides
    )
    return line, solution


def checked(line: Line, solution: Solution) -> tuple[Checks, Status]:
    checks = verify(line.model, line.contacts, line.load_case, solution)
    return checks, verified_status(solution, checks)


@pytest.mark.parametrize("sides", [3, 8])
@pytest.mark.parametrize("solver", ["clarabel", "highs"])
def test_the_bracket_is_proved_and_holds_the_true_factor(sides: int, solver: str) -> None:
    line, solution = answer(sides, solver)
    checks, status = checked(line, solution)
    assert checks.verified, checks.failures
    assert status is Status.APPROXIMATE  # both programs are solved, and leave the load factor a bracket
    true = solution_of(line).mechanics
    assert true is not None
    assert checks.static_bound <= true.load_factor * (1 + 1e-7)
    assert checks.kinematic_bound >= true.load_factor * (1 - 1e-7)
    assert checks.gap > 1e-2
    assert max(checks.complementarity_residual, checks.equilibrium_residual, checks.yield_violation) < 1e-6


def test_with_cohesion_and_tension() -> None:
    line, solution = answer(8, "clarabel", BLOCK, "parameters.c=4000", "parameters.ft=2000", "parameters.h=0.5")
    checks, _ = checked(line, solution)
    assert checks.verified, checks.failures
    assert checks.static_bound < checks.kinematic_bound


def test_where_the_polyhedra_meet_the_case_is_solved() -> None:
    """Pushed along its tangents the wall slides where both polygons touch the circle."""
    line, solution = answer(8, "clarabel", WALL, "load_cases.push.live=[{acceleration: [1, 0, 0]}]")
    checks, status = checked(line, solution)
    assert status is Status.SOLVED, checks.failures
    assert checks.gap < 1e-6
