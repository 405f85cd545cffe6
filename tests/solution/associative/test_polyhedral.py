from __future__ import annotations

import math
from dataclasses import replace

import pytest

from mbla.contacts import find_contacts
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.program import Program, assemble
from mbla.solution.associative.polyhedral import PolyhedralResult, solve_polyhedral
from mbla.solution.associative.solve_associative import AssociativeResult, solve_associative
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, Status
from tests.decks.folder import BENCHMARKS
from tests.line import BLOCK, WALL, line_of

GROOVE = BENCHMARKS["groove"]
SETTINGS = SolverSettings(1e-8)


def ignored(record: IterationRecord) -> None:
    """A log that nobody reads."""


def pushed(degrees: float, mu: float = 0.3) -> Program:
    """A flat block, pushed at an angle in plan: it slides."""
    direction = f"[{math.cos(math.radians(degrees))!r}, {math.sin(math.radians(degrees))!r}, 0]"
    live = f"load_cases.push.live=[{{acceleration: {direction}}}]"
    return line_of(BLOCK, "parameters.h=0.5", f"parameters.mu={mu}", live).program


def solved(program: Program, sides: int, settings: SolverSettings = SETTINGS) -> PolyhedralResult:
    result = solve_polyhedral(program, sides, settings, ignored)
    assert result.inner.status is Status.SOLVED, result.inner.reason
    return result


def bracket(program: Program, sides: int) -> tuple[float, float]:
    result = solved(program, sides)
    assert result.inner.state is not None
    assert result.outer.state is not None
    live = program.scaling.live
    return result.inner.state.load_factor * live, result.outer.state.load_factor * live


def true_cone(program: Program) -> float:
    state = solve_associative(program, SETTINGS, ignored).state
    assert state is not None
    return state.load_factor * program.scaling.live


def groove(*overrides: str) -> Program:
    deck = read_deck(GROOVE, overrides)
    model = build_model(deck)
    return assemble(model, find_contacts(model, deck.contacts), model.load_cases[0])


@pytest.mark.parametrize("sides", [3, 4, 6, 8])
@pytest.mark.parametrize("degrees", [0.0, 11.0, 45.0, 200.0])
def test_sliding_strength_is_the_distance_of_the_side_in_that_direction(sides: int, degrees: float) -> None:
    """Shear opposes the push: a polygon with an odd number of sides is seen from behind."""
    step, apothem = 2 * math.pi / sides, math.cos(math.pi / sides)

    def off_middle(first_corner: float) -> float:
        return (math.radians(degrees) - first_corner) % step - step / 2

    inner, outer = bracket(pushed(degrees), sides)
    assert inner == pytest.approx(0.3 * apothem / math.cos(off_middle(0.0)), rel=1e-7)
    assert outer == pytest.approx(0.3 / math.cos(off_middle(step / 2)), rel=1e-7)
    assert inner <= 0.3 * (1 + 1e-8)
    assert outer >= 0.3 * (1 - 1e-8)


def test_the_worst_direction_converges_as_the_square_of_the_number_of_sides() -> None:
    for sides in (6, 12, 24):
        inner, outer = bracket(pushed(180.0 / sides), sides)
        assert inner / 0.3 == pytest.approx(math.cos(math.pi / sides), rel=1e-7)
        assert outer / 0.3 == pytest.approx(1 / math.cos(math.pi / sides), rel=1e-7)


def test_a_wedge_in_a_groove_is_bracketed_ever_more_closely() -> None:
    """Sliding lifts the wedge, so that it does not slide along its tangents: the closed form lies within."""
    exact = 0.6 / math.sqrt(math.cos(math.pi / 6) ** 2 - (0.6 * math.sin(math.pi / 6)) ** 2)
    program = groove("parameters.mu=0.6")
    widths = []
    for sides in (8, 16, 32):
        inner, outer = bracket(program, sides)
        assert inner < exact < outer
        widths.append(sides**2 * (outer - inner) / exact)
    assert max(widths) < 1.5 * math.pi**2  # each polygon is off by π²/2k² of the friction, λ grows 1.14 times as fast


@pytest.mark.parametrize("direction", ["[1, 0, 0]", "[0, 1, 0]", "[0.8, 0.6, 0]"])
def test_the_wall_in_space_is_bracketed(direction: str) -> None:
    program = line_of(WALL, "parameters.n=3", f"load_cases.push.live=[{{acceleration: {direction}}}]").program
    inner, outer = bracket(program, 8)
    exact = true_cone(program)
    assert inner <= exact * (1 + 1e-7)
    assert exact <= outer * (1 + 1e-7)
    assert outer / inner < 1 / math.cos(math.pi / 8) ** 2
    if direction == "[1, 0, 0]":  # all joints slide along a tangent
        assert outer / inner == pytest.approx(1.0, abs=1e-7)


def test_highs_gives_the_same_and_programs_are_numbered_on() -> None:
    program = line_of(WALL, "parameters.n=3", "load_cases.push.live=[{acceleration: [0.8, 0.6, 0]}]").program
    result = solve_polyhedral(program, 8, replace(SETTINGS, solver="highs"), ignored, first=4)
    assert result.inner.status is Status.SOLVED
    assert result.inner.state is not None
    assert result.inner.state.load_factor * program.scaling.live == pytest.approx(bracket(program, 8)[0], rel=1e-6)
    assert [record.program for record in result.programs] == [4, 5, 6, 7]
    assert {record.solver for record in result.programs} == {"highs"}


def test_the_bracket_is_told() -> None:
    between = solved(pushed(11.0), 8).bracket
    assert "8 sides" in str(between)
    assert "0.282842" in str(between)
    assert "0.305615" in str(between)
    assert "7.5 % apart" in str(between)


def test_what_the_polyhedra_say_together() -> None:
    """The bank of the slope is between what the two polyhedra need; the wedge locks in the one about the circle."""
    slope = "load_cases.push.dead=[{gravity: [2.75, 2.75, -9.81]}]"  # tan of the slope 0.3964
    push = "load_cases.push.live=[{acceleration: [1, -1, 0]}]"
    flat = ("parameters.h=0.1", slope, push)

    def case(mu: float, sides: int) -> AssociativeResult:
        return solve_polyhedral(line_of(BLOCK, *flat, f"parameters.mu={mu}").program, sides, SETTINGS, ignored).inner

    assert case(0.42, 8).status is Status.SOLVED
    falls = case(0.2, 4)
    assert falls.status is Status.NO_EQUILIBRIUM
    assert falls.certificate is not None
    undecided = case(0.42, 4)
    assert undecided.status is Status.NOT_VERIFIED
    assert "raise analysis.sides" in undecided.reason
    assert undecided.state is None
    assert undecided.certificate is None
    locking = groove("parameters.mu=0.84", "parameters.beta=48")
    assert true_cone(locking) > 0
    wedge = solve_polyhedral(locking, 6, SETTINGS, ignored)
    assert wedge.inner.status is Status.NOT_VERIFIED
    assert "the circumscribed one locks" in wedge.inner.reason
    into_the_ground = line_of(BLOCK, "load_cases.push.live=[{acceleration: [0, 0, -1]}]").program
    assert solve_polyhedral(into_the_ground, 4, SETTINGS, ignored).inner.status is Status.UNBOUNDED
