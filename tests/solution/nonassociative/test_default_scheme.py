"""The default scheme: closed forms with and without dilatancy, published walls, what it says where it is cut short."""

from __future__ import annotations

import math
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mbla.solution.nonassociative.default_scheme import MISSED, _Scheme, solve_by_default, state_near
from mbla.solution.nonassociative.factor_range import factor_range, unbalanced

from mbla.program.program import Program
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.nonassociative import default_scheme
from mbla.solution.nonassociative.law_state import SequenceResult
from mbla.solution.nonassociative.search import NEEDLESS
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Checks, Solution, Status
from mbla.solution.standing import standing
from mbla.solution.standing.weak_spring_continuation import Outcome, Weakening
from tests.line import BLOCK, HEAD, WALL, line_of, line_of_file, load_factor, solution_of, verified
from tests.solution.failing_solver import said
from tests.solution.nonassociative.structures import FERRIS_3, LEAST, SETTINGS, sequence_of, solved
from tests.solution.planar import planar_program

TWO_LEAVES = Path(__file__).parents[3] / "decks" / "tutorials" / "two_leaf_walls.yaml"
NON_ASSOCIATIVE = "analysis.flow_rule=non_associative"


def exact(text: str, *overrides: str, case: int = 0) -> tuple[float, Solution, Checks]:
    """Load factor of a case that must be solved, and that must fit the exact law far better than is asked."""
    solution, checks, status = verified(line_of(text, *overrides, case=case))
    assert status is Status.SOLVED, (status, solution.reason, checks.failures)
    assert solution.mechanics is not None
    assert checks.complementarity_residual < 2e-9
    assert checks.yield_violation < 1e-9
    assert checks.equilibrium_residual < 1e-9
    return solution.mechanics.load_factor, solution, checks


# --- closed forms ---------------------------------------------------------------------------------------------------


def test_a_sliding_block_does_not_lift() -> None:
    factor, solution, _ = exact(BLOCK, NON_ASSOCIATIVE, "parameters.h=0.5")
    assert factor == pytest.approx(0.5, rel=1e-9)
    assert solution.mechanics is not None
    assert solution.mechanics.contact_velocities[:, 0] == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("angle", [0, 25, 45, 70])
def test_sliding_strength_is_the_same_in_every_direction(angle: float) -> None:
    direction = f"[{math.cos(math.radians(angle))!r}, {math.sin(math.radians(angle))!r}, 0]"
    live = f"load_cases.push.live=[{{acceleration: {direction}}}]"
    factor, _, _ = exact(BLOCK, NON_ASSOCIATIVE, "parameters.h=0.3", "parameters.mu=0.4", live)
    assert factor == pytest.approx(0.4, rel=1e-8)


def test_cohesion_is_kept_while_sliding() -> None:
    factor, _, _ = exact(BLOCK, NON_ASSOCIATIVE, "parameters.h=0.5", "parameters.c=1000")
    assert factor == pytest.approx(0.5 + 1000 / (0.5 * 2000 * 9.81), rel=1e-9)


def groove(friction: float, slope: float) -> str:
    """Prism in a groove of two planes inclined at ``slope``, pushed along it."""
    t, s, c = math.tan(slope), math.sin(slope), math.cos(slope)
    return HEAD + (
        f"joints: {{dry: {{friction: {friction!r}}}}}\n"
        "blocks:\n"
        "  - polyhedron:\n"
        "      material: stone\n"
        f"      vertices: [[0, 0, 0], [4, 0, 0], [0, -1, {t!r}], [0, 1, {t!r}], [4, -1, {t!r}], [4, 1, {t!r}]]\n"
        "      faces: [[0, 2, 3], [1, 4, 5], [0, 1, 4, 2], [0, 1, 5, 3], [2, 3, 5, 4]]\n"
        "supports:\n"
        f"  - ground: {{point: [0, 0, 0], normal: [0, {s!r}, {c!r}]}}\n"
        f"  - ground: {{point: [0, 0, 0], normal: [0, {-s!r}, {c!r}]}}\n"
        "load_cases: {along: {live: [{acceleration: [1, 0, 0]}]}}\n"
    )


def with_share(program: Program, share: float) -> Program:
    """The program with a dilatancy angle that is a share of the friction angle at every joint."""
    limits = program.limits
    return replace(
        program,
        limits=replace(limits, dilatancy=np.tan(share * np.arctan(limits.friction)) * np.ones(program.n_points)),
    )


def dilatant(program: Program, settings: SolverSettings = SETTINGS) -> tuple[float, SequenceResult]:
    """Load factor by the dilatancy of the program, whose state must fit that law."""
    associative = solve_associative(program, settings, lambda record: None)
    result = solve_by_default(program, associative, program.limits.dilatancy, settings, lambda record: None)
    assert result.status is Status.SOLVED, result.reason
    assert result.state is not None
    assert result.state.residual < 1e-6
    return program.scaling.load_factor(result.state.load_factor), result


@pytest.mark.parametrize("share", [0.0, 0.02, 0.1, 0.5, 0.9, 1.0])
def test_a_wedge_in_a_groove_lifts_by_its_dilatancy(share: float) -> None:
    """Velocity 1 along and w upwards: on each plane v_N = w cos b, s = sqrt(1 + w^2 sin^2 b), with v_N = tan(psi) s::

        w^2 (cos^2 b - tan^2 psi sin^2 b) = tan^2 psi.

    Friction mu N against (1, w sin b)/s; with the weight W, 2 N (cos b - mu w sin^2 b/s) = W and 2 mu N/s = load:

        load factor = mu / (s cos b - mu w sin^2 b),

    mu / cos b at psi = 0 and mu / sqrt(cos^2 b - mu^2 sin^2 b) at the friction angle.
    """
    mu, b = 0.84, math.radians(30)
    program = with_share(line_of(groove(mu, b)).program, share)
    rise = math.tan(share * math.atan(mu))
    w = rise / math.sqrt(math.cos(b) ** 2 - (rise * math.sin(b)) ** 2)
    s = math.hypot(1.0, w * math.sin(b))
    factor, result = dilatant(program)
    assert factor == pytest.approx(mu / (s * math.cos(b) - mu * w * math.sin(b) ** 2), rel=1e-6)
    assert not result.remarks


def test_the_associative_factor_of_a_wedge_is_told_beside_it() -> None:
    """mu / cos b without dilatancy; with it the wedge locks: mu / sqrt(cos^2 b - mu^2 sin^2 b)."""
    b, mu = math.radians(30), 0.5
    factor, solution, _ = exact(groove(mu, b))
    assert factor == pytest.approx(mu / math.cos(b), rel=1e-6)
    assert solution.associative is not None
    locked = mu / math.sqrt(math.cos(b) ** 2 - (mu * math.sin(b)) ** 2)
    assert solution.associative.load_factor == pytest.approx(locked, rel=1e-6)


def test_dilatancy_of_a_free_block_lifts_it_and_changes_no_load_factor() -> None:
    program = with_share(line_of(BLOCK, "parameters.h=0.5", "parameters.c=1000").program, 0.4)
    factor, result = dilatant(program)
    assert factor == pytest.approx(0.5 + 1000 / (0.5 * 2000 * 9.81), rel=1e-6)
    assert result.state is not None
    v = (program.equilibrium_matrix.T @ result.state.velocities).reshape(-1, 3)
    sliding = np.hypot(v[:, 1], v[:, 2])
    assert v[:, 0] == pytest.approx(program.limits.dilatancy * sliding, abs=1e-5 * sliding.max())


@pytest.mark.parametrize("box", ["[2, 2, 0.5]", "[9, 9, 0.1]", "[1, 1, 1]"])
@pytest.mark.parametrize("dilatancy", [1, 3, 5, 10, 15, 20, 25, 26])
def test_one_block_slides_at_its_friction_with_every_dilatancy(box: str, dilatancy: float) -> None:
    text = HEAD + (
        f"joints: {{dry: {{friction: 0.5, dilatancy: {dilatancy}}}}}\n"
        f"blocks:\n  - box: {{group: a, material: stone, min: [0, 0, 0], max: {box}}}\n"
        "supports: [{ground: {z: 0}}]\n"
        "load_cases: {push: {live: [{acceleration: [0.8, 0.6, 0]}]}}\n"
        "analysis: {flow_rule: dilatancy}\n"
    )
    factor, _ = dilatant(line_of(text).program)
    assert factor == pytest.approx(0.5, rel=1e-6)


# --- walls of Ferris and Tin-Loi ------------------------------------------------------------------------------------


@pytest.mark.parametrize(("text", "least"), LEAST.items(), ids=["1", "3", "5"])
def test_the_least_states_known_of_published_walls(text: str, least: float) -> None:
    """The published ones are 0.640, 0.356 and 0.215, of complementarity programs started many times over.

    A state below one of these figures would be a find, and is a change of the figure; one above it is a failure.
    """
    program = planar_program(line_of(text))
    associative = solve_associative(program, SETTINGS, lambda record: None).state
    state = solved(program)
    assert associative is not None
    assert unbalanced(program, state) < 1e-6
    assert state.residual < 1e-6
    lower = factor_range(program, state, SETTINGS, lambda record: None, 1).lower
    assert lower is not None
    assert lower.residual < 1e-8
    assert program.scaling.load_factor(lower.load_factor) == pytest.approx(least, abs=1e-6)
    assert program.scaling.load_factor(state.load_factor) == pytest.approx(least, rel=1e-5)
    assert lower.load_factor < associative.load_factor


def test_wall_3_with_its_range_is_verified() -> None:
    """The lower end of the range is the figure; MPEC of 2001: 0.356; the published procedure ends at 0.373."""
    factor, solution, checks = exact(FERRIS_3)
    assert factor == pytest.approx(0.355817, rel=1e-5)
    assert checks.lower == pytest.approx(factor, rel=1e-6)
    assert solution.associative is not None
    assert solution.associative.load_factor == pytest.approx(0.403694, abs=1e-6)


def test_zero_dilatancy_is_no_dilatancy() -> None:
    program = planar_program(line_of(FERRIS_3))
    factor, _ = dilatant(with_share(program, 0.0))
    assert factor == pytest.approx(program.scaling.load_factor(solved(program).load_factor), rel=1e-6)


def test_with_the_friction_angle_it_is_the_associative_answer() -> None:
    """The scheme knows nothing of the associative program: a second way to its load factor."""
    factor, _ = dilatant(with_share(planar_program(line_of(FERRIS_3)), 1.0))
    assert factor == pytest.approx(0.403694104, rel=1e-6)


@pytest.mark.parametrize("share", [0.02, 0.1])
def test_a_little_dilatancy_locks_confined_joints(share: float) -> None:
    """The load factor of wall 3 jumps from 0.3558 without dilatancy to almost the associative one, 0.40369."""
    factor, _ = dilatant(with_share(planar_program(line_of(FERRIS_3)), share))
    assert factor == pytest.approx(0.40249, abs=1e-5)


def test_a_deck_asks_for_dilatancy_and_it_is_verified() -> None:
    """The least known between 0.3558 without dilatancy and 0.40369 with all of it."""
    factor, _, _ = exact(FERRIS_3, "joints.dry.dilatancy=10", "analysis={flow_rule: dilatancy, standing: false}")
    assert factor == pytest.approx(0.402487, abs=1e-5)


# --- the search for lower factors -----------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize("text", LEAST, ids=["1", "3", "5"])
def test_more_search_never_ends_higher(text: str) -> None:
    program = planar_program(line_of(text))
    results = [sequence_of(program, replace(SETTINGS, search=share)) for share in (0.0, 1.0, 4.0)]
    factors = [result.state.load_factor for result in results if result.state is not None]
    assert factors == sorted(factors, reverse=True)
    assert len(factors) == 3
    assert [result.first for result in results] == pytest.approx(3 * [factors[0]], rel=1e-6)


@pytest.mark.long
def test_in_space_a_search_begins_far_from_the_law() -> None:
    """Smaller tilts alone end at 0.2833 of g, where more stretchers slide along the through-stones."""
    mechanics = solution_of(line_of_file(TWO_LEAVES, "analysis.search=1", case=1)).mechanics
    assert mechanics is not None
    assert mechanics.load_factor <= 0.27668


def test_without_a_search_no_programs_are_made_for_one() -> None:
    program = planar_program(line_of(FERRIS_3))
    result = sequence_of(program, replace(SETTINGS, search=0.0))
    assert {record.kind for record in result.programs} == {"associative", "reverse", "gravity", "interior run"}
    assert result.state is not None
    assert result.state.load_factor == pytest.approx(result.first, rel=1e-6)


@pytest.mark.long
def test_nothing_depends_on_clock_or_chance() -> None:
    program = planar_program(line_of(FERRIS_3))
    one, two = sequence_of(program), sequence_of(program)
    assert one.state is not None
    assert two.state is not None
    assert np.array_equal(one.state.forces, two.state.forces)


@pytest.mark.every(2)
@pytest.mark.parametrize(
    "overrides",
    [
        ("units.length=mm", "blocks.0.wall.unit=[400, 200, 175]", "blocks.0.wall.length=2400"),
        ("materials.stone.density=2e-3",),
        ("materials.stone.density=2e9",),
    ],
)
def test_the_factor_does_not_know_units(overrides: tuple[str, ...]) -> None:
    here, _, _ = exact(WALL, NON_ASSOCIATIVE, "parameters.n=6")
    there, _, _ = exact(WALL, NON_ASSOCIATIVE, "parameters.n=6", *overrides)
    assert there == pytest.approx(here, rel=1e-6)


SLENDER = (
    HEAD
    + """\
joints: {dry: {friction: 0.65}}
blocks:
  - wall: {material: stone, unit: [0.4, 0.2, 0.175], length: 2.0, courses: 10}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
"""
)

FAR = """\
  - wall:
      material: stone
      unit: [2.0, 2.0, 0.875]
      length: 8.0
      courses: 3
      transform: {translate: [1000, 0, 0]}
supports:"""
"""A wall of units five times as large, out of reach of the slender one, that collapses later."""


@pytest.mark.long
def test_a_part_ends_where_it_does_alone() -> None:
    """Nothing may follow from parts that cannot interact, such as the unit of the load factor."""
    alone, _, _ = exact(SLENDER, NON_ASSOCIATIVE)
    beside, _, _ = exact(SLENDER.replace("supports:", FAR), NON_ASSOCIATIVE)
    assert beside == pytest.approx(alone, rel=1e-8)


# --- cut short ------------------------------------------------------------------------------------------------------


def test_beyond_the_time_limit_the_scheme_does_not_go_on() -> None:
    program = planar_program(line_of(FERRIS_3))
    associative = solve_associative(program, SETTINGS, lambda record: None)
    late = replace(SETTINGS, deadline=time.monotonic())
    result = solve_by_default(program, associative, np.zeros(program.n_points), late, lambda record: None)
    assert result.status is Status.TIME_LIMIT
    assert result.state is None


def test_a_structure_that_gives_no_time_for_a_state_ends_by_the_time_limit() -> None:
    solution, _, status = verified(line_of(FERRIS_3, "analysis.time_limit=0.01"))
    assert status is Status.TIME_LIMIT
    assert solution.mechanics is None


def scheme_with(states: list[tuple[float, float]], residual: float = SETTINGS.residual) -> _Scheme:
    """A scheme that has come to states of a sliding block of the given load factors and residuals."""
    program = line_of(BLOCK, "parameters.h=0.5").program
    scheme = _Scheme(program, np.zeros(program.n_points), replace(SETTINGS, residual=residual), lambda record: None, [])
    found = solve_associative(program, SETTINGS, lambda record: None).state
    assert found is not None
    for factor, missed in states:
        scheme.found.append(replace(found, load_factor=factor, residual=missed))
    return scheme


@pytest.mark.parametrize(
    ("states", "answer"),
    [
        ([(0.5, 1e-9), (0.4, 1e-8), (0.3, 1e-3)], 0.4),
        ([(0.5, 1e-5), (0.4, 9e-5), (0.3, 2e-4)], 0.4),
        ([(0.5, 2e-3), (0.4, 9e-3)], 0.5),
    ],
    ids=["exact", "nearly", "none"],
)
def test_the_answer_is_the_lowest_of_the_states_that_fit_the_law(
    states: list[tuple[float, float]], answer: float
) -> None:
    """To 1e-6, or nearly as well as the best; of states that miss it the one that does so least."""
    found = scheme_with(states).answer
    assert found is not None
    assert found.load_factor == answer


def test_a_mechanism_that_needs_no_live_load_is_no_collapse() -> None:
    scheme = scheme_with([(0.5, 1e-9)])
    scheme.keep(replace(scheme.found[0], load_factor=0.5 * NEEDLESS * scheme.program.dead_over_live))
    assert [state.load_factor for state in scheme.found] == [0.5]


@pytest.mark.parametrize(
    ("residual", "asked", "status", "said_of_it"),
    [
        (1e-7, 1e-6, Status.SOLVED, ""),
        (5e-5, 1e-6, Status.SOLVED, MISSED.format(5e-5)),
        (5e-4, 1e-6, Status.APPROXIMATE, MISSED.format(5e-4)),
        (5e-2, 1e-6, Status.NOT_VERIFIED, MISSED.format(5e-2)),
    ],
)
def test_a_state_is_judged_by_its_residual(residual: float, asked: float, status: Status, said_of_it: str) -> None:
    result = scheme_with([(0.5, residual)], residual=asked).result()
    assert result.status is status
    assert " ".join((result.reason, *result.remarks)).strip() == said_of_it


@pytest.mark.parametrize(("seen", "asked"), [(4e-3, 5e-3), (6e-3, None)])
def test_a_rough_state_is_enough_if_verification_sees_it_so(
    seen: float, asked: float | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What normal forces do where joints close counts for verification: on a dome 3.3e-3 became 1.1e-2."""
    monkeypatch.setattr(default_scheme, "residual_with_closing", lambda *arguments: seen)
    result = scheme_with([(0.5, 3e-3)], residual=5e-3).result()
    assert result.status is Status.APPROXIMATE
    assert result.tolerance_requested == asked


@pytest.mark.parametrize(
    ("said_to_be", "status"),
    [
        (Status.NO_EQUILIBRIUM, Status.NOT_VERIFIED),
        (Status.UNBOUNDED, Status.NOT_VERIFIED),
        (Status.ITERATION_LIMIT, Status.ITERATION_LIMIT),
    ],
)
def test_without_a_gravity_state_the_scheme_does_not_begin(
    said_to_be: Status, status: Status, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No springs say whether the block stands, and the solver says that nothing carries it."""
    program = line_of(BLOCK).program
    associative = solve_associative(program, SETTINGS, lambda record: None)
    undecided = replace(associative, stress_free=Weakening(Outcome.UNDECIDED, None, np.nan, ""))
    monkeypatch.setattr(standing, "cone_solver", said(said_to_be))
    result = solve_by_default(program, undecided, np.zeros(program.n_points), SETTINGS, lambda record: None)
    assert result.status is status
    assert result.state is None
    assert f"program {len(result.programs)} of the sequence ended without a solution" in result.reason


def test_programs_without_a_solution_leave_no_state(monkeypatch: pytest.MonkeyPatch) -> None:
    program = line_of(BLOCK, "parameters.h=0.5").program
    monkeypatch.setattr("mbla.solution.nonassociative.alternation.cone_solver", said(Status.NUMERICAL_ERROR))
    scheme = _Scheme(program, np.zeros(program.n_points), SETTINGS, lambda record: None, [])
    scheme.approach(np.ones(program.n_points))
    assert scheme.answer is None
    assert [record.status for record in scheme.records] == [Status.NUMERICAL_ERROR]


def test_a_descent_ends_where_another_one_went_on() -> None:
    """The second costs one program, the motion by which it is known; whatever follows would be the same again."""
    program = planar_program(line_of(WALL))
    scheme = _Scheme(program, np.zeros(program.n_points), SETTINGS, lambda record: None, [])
    normal = np.full(program.n_points, 1.0 / program.n_points)
    scheme.descend(normal)
    first, states = scheme.alternation.programs, len(scheme.found)
    assert first > 2
    scheme.descend(normal)
    assert (scheme.alternation.programs, len(scheme.found)) == (first + 1, states)


def test_a_state_near_another_one_is_found_from_it() -> None:
    """Forces and velocities of the block's state, a tenth too large."""
    program = line_of(BLOCK, "parameters.h=0.5").program
    exact = solve_associative(program, SETTINGS, lambda record: None).state
    assert exact is not None
    near = replace(exact, forces=1.1 * exact.forces)
    found = state_near(program, near, np.inf, SETTINGS, lambda record: None, [])
    assert found is not None
    assert found.residual < 1e-6
    assert program.scaling.load_factor(found.load_factor) == pytest.approx(0.5, rel=1e-6)


def test_a_search_for_lower_factors_ends_where_nothing_holds_a_block() -> None:
    """Its load factor is zero or a rounding of it of either sign, than which there is always a lower one."""
    found = load_factor(BLOCK, "joints.dry.friction=0", "analysis.flow_rule=non_associative")
    assert found == pytest.approx(0.0, abs=1e-12)
