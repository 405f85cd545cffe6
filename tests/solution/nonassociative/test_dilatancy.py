"""Dilatancy between none and the friction angle: closed form of a wedge in a groove, both ends, wall 3."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.deck.sections.analysis import ProximalScheme
from mbla.program.program import Program
from mbla.program.reductions import reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.associative.solve_associative import AssociativeResult, solve_associative
from mbla.solution.nonassociative import dilatancy
from mbla.solution.nonassociative.dilatancy import solve_dilatancy
from mbla.solution.nonassociative.law_state import LawState, SequenceResult
from mbla.solution.nonassociative.proximal import ProximalRun, solve_proximal
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from mbla.solution.standing import standing
from mbla.solution.standing.weak_spring_continuation import Outcome, Weakening
from tests.line import BLOCK, HEAD, line_of, verified
from tests.solution.failing_solver import said
from tests.solution.nonassociative.test_proximal import FERRIS_3

SETTINGS = SolverSettings(1e-8)


def with_share(program: Program, share: float) -> Program:
    """The program with a dilatancy angle that is a share of the friction angle at every joint."""
    limits = program.limits
    return replace(
        program,
        limits=replace(limits, dilatancy=np.tan(share * np.arctan(limits.friction)) * np.ones(program.n_points)),
    )


def solved(program: Program) -> tuple[float, SequenceResult]:
    associative = solve_associative(program, SETTINGS, lambda record: None)
    result = solve_dilatancy(program, associative, ProximalScheme(), SETTINGS, lambda record: None)
    assert result.status is Status.SOLVED, result.reason
    assert result.state is not None
    assert result.state.residual < 1e-9
    return program.scaling.load_factor(result.state.load_factor), result


def wall_3() -> Program:
    line = line_of(FERRIS_3)
    (program,) = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=False).parts
    return program


def groove(friction: float, slope: float) -> Program:
    """Prism in a groove of two planes inclined at ``slope``, pushed along it."""
    t, s, c = math.tan(slope), math.sin(slope), math.cos(slope)
    text = HEAD + (
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
    return line_of(text).program


@pytest.mark.parametrize("share", [0.0, 0.02, 0.1, 0.5, 0.9, 1.0])
def test_a_wedge_in_a_groove_lifts_by_its_dilatancy(share: float) -> None:
    """Velocity 1 along and w upwards: on each plane v_N = w cos b, s = sqrt(1 + w^2 sin^2 b), with v_N = tan(psi) s::

        w^2 (cos^2 b - tan^2 psi sin^2 b) = tan^2 psi.

    Friction mu N against (1, w sin b)/s; with the weight W, 2 N (cos b - mu w sin^2 b/s) = W and 2 mu N/s = load:

        load factor = mu / (s cos b - mu w sin^2 b),

    mu / cos b at psi = 0 and mu / sqrt(cos^2 b - mu^2 sin^2 b) at the friction angle.
    """
    mu, b = 0.84, math.radians(30)
    program = with_share(groove(mu, b), share)
    rise = math.tan(share * math.atan(mu))
    w = rise / math.sqrt(math.cos(b) ** 2 - (rise * math.sin(b)) ** 2)
    s = math.hypot(1.0, w * math.sin(b))
    factor, result = solved(program)
    assert factor == pytest.approx(mu / (s * math.cos(b) - mu * w * math.sin(b) ** 2), rel=1e-8)
    assert not result.remarks


def test_dilatancy_of_a_free_block_lifts_it_and_changes_no_load_factor() -> None:
    program = with_share(line_of(BLOCK, "parameters.h=0.5", "parameters.c=1000").program, 0.4)
    factor, result = solved(program)
    assert factor == pytest.approx(0.5 + 1000 / (0.5 * 2000 * 9.81), rel=1e-9)
    assert result.state is not None
    v = (program.equilibrium_matrix.T @ result.state.velocities).reshape(-1, 3)
    assert v[:, 0] == pytest.approx(program.limits.dilatancy * np.hypot(v[:, 1], v[:, 2]), abs=1e-9)


def test_without_dilatancy_it_is_the_non_associative_answer() -> None:
    program = wall_3()
    associative = solve_associative(program, SETTINGS, lambda record: None)
    expected = solve_proximal(program, associative, 60, SETTINGS, lambda record: None).state
    assert expected is not None
    factor, _ = solved(with_share(program, 0.0))
    assert factor == pytest.approx(program.scaling.load_factor(expected.load_factor), rel=1e-12)


def test_with_the_friction_angle_it_is_the_associative_answer() -> None:
    factor, _ = solved(with_share(wall_3(), 1.0))
    assert factor == pytest.approx(0.403694104, abs=1e-8)


@pytest.mark.parametrize("share", [0.02, 0.1])
def test_a_little_dilatancy_locks_confined_joints(share: float) -> None:
    """The load factor of wall 3 jumps from 0.3558 without dilatancy to almost the associative one."""
    factor, _ = solved(with_share(wall_3(), share))
    assert factor == pytest.approx(0.40249, abs=1e-5)


def test_the_associative_answer_is_reached_from_the_dead_load_too() -> None:
    """The steps know nothing of the associative program: a second way to its load factor."""
    program = with_share(wall_3(), 1.0)
    nothing = replace(solve_associative(program, SETTINGS, lambda record: None), state=None)
    result = solve_dilatancy(program, nothing, ProximalScheme(), SETTINGS, lambda record: None)
    assert result.state is not None
    assert program.scaling.load_factor(result.state.load_factor) == pytest.approx(0.403694104, abs=1e-8)


def test_a_deck_asks_for_dilatancy_and_it_is_verified() -> None:
    solution, checks, status = verified(
        line_of(
            FERRIS_3,
            "joints.dry.dilatancy=10",
            "analysis={flow_rule: dilatancy, standing: false, range: false}",
        )
    )
    assert status is Status.SOLVED, (solution.reason, checks.failures)
    assert checks.complementarity_residual < 1e-9
    assert solution.mechanics is not None
    assert solution.mechanics.load_factor == pytest.approx(0.402487, abs=1e-5)


# --- where the angle cannot be taken in one go: steps made up, as of a wall on which they creep ---------------------

ANGLE, FRICTION = 0.25, math.atan(0.5)
RAISED = [0.0, 0.25 * ANGLE, 0.5 * ANGLE, 0.75 * ANGLE, ANGLE]
LOWERED = [FRICTION + share * (ANGLE - FRICTION) for share in (0.25, 0.5, 0.75, 1.0)]


def sliding() -> tuple[Program, AssociativeResult]:
    """A block with dilatancy, and its associative answer."""
    program = line_of(BLOCK, "parameters.h=0.5").program
    limits = replace(program.limits, dilatancy=np.full(program.n_points, math.tan(ANGLE)))
    program = replace(program, limits=limits)
    return program, solve_associative(program, SETTINGS, lambda record: None)


def stepped(
    monkeypatch: pytest.MonkeyPatch, residuals: dict[int, float], *, locked: bool = False
) -> tuple[list[float], SequenceResult]:
    """Angles that steps were taken with, and the result; ``residuals`` of the sequences by number, 2e-3 of others.

    The load factor of each sequence is its number; one whose residual is not a number ends by the time limit.
    """
    program, associative = sliding()
    angles: list[float] = []

    def steps(run: ProximalRun, anchor: FloatArray, most: int) -> SequenceResult:
        angles.append(float(np.arctan(run.stepper.slope[0])))
        residual = residuals.get(len(angles), 2e-3)
        if math.isnan(residual):
            return SequenceResult(Status.TIME_LIMIT, None, "the time limit was reached", ())
        found = LawState(anchor, np.zeros(len(program.live_load)), float(len(angles)), residual)
        return SequenceResult(Status.SOLVED if residual <= 1e-6 else Status.APPROXIMATE, found, "", ())

    monkeypatch.setattr(dilatancy, "steps_from", steps)
    given = replace(associative, state=None) if locked else associative
    return angles, solve_dilatancy(program, given, ProximalScheme(), SETTINGS, lambda record: None)


@pytest.mark.parametrize(
    ("residuals", "locked", "angles", "answer"),
    [
        ({6: 1e-9}, False, [ANGLE, *RAISED], 6.0),
        ({}, True, [ANGLE, *RAISED], 1.0),
        ({6: 1e-3}, True, [ANGLE, *RAISED], 6.0),
        ({10: 1e-9}, False, [ANGLE, *RAISED, *LOWERED], 10.0),
        ({6: 1e-3}, False, [ANGLE, *RAISED, *LOWERED], 6.0),
        ({10: 1e-3}, False, [ANGLE, *RAISED, *LOWERED], 10.0),
    ],
)
def test_an_angle_that_is_not_reached_at_once_is_raised_then_lowered(
    residuals: dict[int, float], locked: bool, angles: list[float], answer: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What fits the law is the answer, else what misses it least; from the friction angle only with forces of there."""
    taken, result = stepped(monkeypatch, residuals, locked=locked)
    assert taken == pytest.approx(angles)
    assert result.state is not None
    assert result.state.load_factor == answer
    assert (result.status is Status.SOLVED) is (1e-9 in residuals.values())
    assert [remark.identifier for remark in result.remarks] == ["load-factor-not-unique"] * (answer == 10.0)


def test_steps_beyond_the_time_limit_are_the_last(monkeypatch: pytest.MonkeyPatch) -> None:
    taken, result = stepped(monkeypatch, {1: math.nan})
    assert taken == pytest.approx([ANGLE])
    assert result.status is Status.TIME_LIMIT
    taken, result = stepped(monkeypatch, {3: math.nan}, locked=True)
    assert taken == pytest.approx([ANGLE, *RAISED[:2]])
    assert result.state is not None
    assert result.state.load_factor == 1.0


@pytest.mark.parametrize(("residual", "remarked"), [(1e-9, True), (1e-3, False)])
def test_another_state_is_remarked_on_where_it_fits_the_law(
    residual: float, remarked: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    taken, result = stepped(monkeypatch, {1: 1e-9, 2: residual})
    assert taken == pytest.approx([ANGLE, ANGLE])
    assert result.state is not None
    assert result.state.load_factor == 1.0
    assert [remark.identifier for remark in result.remarks] == ["load-factor-not-unique"] * remarked


def test_a_dead_load_that_no_forces_carry_ends_the_scheme(monkeypatch: pytest.MonkeyPatch) -> None:
    program, associative = sliding()
    undecided = replace(associative, stress_free=Weakening(Outcome.UNDECIDED, None, np.nan, ""))
    monkeypatch.setattr(standing, "interior_point_solver", said(Status.UNBOUNDED))
    result = solve_dilatancy(program, undecided, ProximalScheme(), SETTINGS, lambda record: None)
    assert result.status is Status.NOT_VERIFIED
    assert result.state is None
    assert "ended without a solution (clarabel: said unbounded)" in result.reason


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
    factor, _ = solved(line_of(text).program)
    assert factor == pytest.approx(0.5, rel=1e-8)
