"""Polyhedral answers of an oblique push on a small wall, verified; then one thing broken at a time."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import pytest

from mbla.solution.associative.polyhedral import solve_polyhedral
from mbla.solution.mechanics import mechanics_of
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Checks, Solution, Status
from mbla.solution.verification.verify import verify
from mbla.solution.verification.verify_points import verified_status
from tests.line import BLOCK, WALL, Line, line_of, solution_of

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


def failures(**changes: object) -> str:
    line, solution = answer()
    checks, _ = checked(line, replace(solution, **changes))  # type: ignore[arg-type]
    assert not checks.verified
    return "; ".join(checks.failures)


def test_sides_that_are_not_those_of_the_solution() -> None:
    """The wall slides in the direction of a corner of the octagon, which the dodecagon has not."""
    assert "complementarity residual 0.1" in failures(sides=12)


def test_polyhedra_in_the_wrong_order() -> None:
    _, solution = answer()
    inner, outer = solution.outer, solution.associative
    found = failures(mechanics=inner, associative=inner, outer=outer)
    assert "yield violation" in found
    assert "circumscribed polyhedron: complementarity residual" in found
    assert "is less than its mechanism proves" in found


def test_a_load_factor_that_the_forces_do_not_carry() -> None:
    _, solution = answer()
    assert solution.associative is not None
    raised = replace(solution.associative, load_factor=1.04 * solution.associative.load_factor)
    assert "is more than its forces prove" in failures(mechanics=raised, associative=raised)


def test_a_circumscribed_factor_below_what_its_mechanism_proves() -> None:
    _, solution = answer()
    assert solution.outer is not None
    lowered = replace(solution.outer, load_factor=solution.outer.load_factor * (1 - 3e-5))
    assert "is less than its mechanism proves" in failures(outer=lowered)


def test_circumscribed_forces_beyond_their_polygon() -> None:
    _, solution = answer()
    assert solution.outer is not None
    forces = solution.outer.contact_forces.copy()
    forces[:, 1:] *= 1.01
    found = failures(outer=replace(solution.outer, contact_forces=forces))
    assert "circumscribed polyhedron: yield violation" in found
    assert "circumscribed polyhedron: equilibrium residual" in found


def test_a_mechanism_that_closes_joints() -> None:
    _, solution = answer()
    assert solution.associative is not None
    turned = replace(solution.associative, mechanism=-solution.associative.mechanism)
    assert "penetration" in failures(mechanics=turned, associative=turned)
