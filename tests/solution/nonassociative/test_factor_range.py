"""Range of the load factor for one mechanism: figures of published walls, closed forms, a second solver."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from mbla.solution.nonassociative.factor_range import FactorRange, factor_range, unbalanced
from scipy.optimize import linprog

from mbla.program.program import Program
from mbla.program.static import fixed_mechanism_form
from mbla.solution.mechanics import lifted
from mbla.solution.nonassociative.law_state import LawState, point_motion
from tests.line import BLOCK, HEAD, WALL, Line, line_of
from tests.solution.nonassociative.structures import FERRIS_1, FERRIS_3, FERRIS_5, SETTINGS, solved
from tests.solution.planar import planar_program


def ranged(program: Program, state: LawState) -> FactorRange:
    """The range, each end of which must be a state of the law in equilibrium, the factor found between them."""
    result = factor_range(program, state, SETTINGS, lambda record: None, 7)
    for end in (result.lower, result.upper):
        if end is not None:
            assert end.residual < 1e-8
            assert unbalanced(program, end) < 1e-9
            assert end.velocities is state.velocities
    if result.lower is not None:
        assert result.lower.load_factor <= state.load_factor
    if result.upper is not None:
        assert result.upper.load_factor >= state.load_factor
    return result


def ends(program: Program, state: LawState) -> tuple[float, float]:
    result = ranged(program, state)
    assert result.reason is None
    assert result.lower is not None
    assert result.upper is not None
    live = program.scaling.live
    return result.lower.load_factor * live, result.upper.load_factor * live


def test_the_range_of_a_published_wall() -> None:
    """Two cone programs of another author gave 0.35582 ... 0.37938; in the plane it is the same as in space."""
    line = line_of(FERRIS_3)
    planar = planar_program(line)
    state = solved(planar)
    assert ends(planar, state) == pytest.approx((0.3558174, 0.3793852), abs=2e-7)
    assert ends(line.program, lifted(planar, state)) == pytest.approx(ends(planar, state), rel=1e-7)


@pytest.mark.parametrize(
    ("text", "lower", "upper"), [(FERRIS_1, 0.6389818, 0.6428590), (FERRIS_5, 0.2079728, 0.2295567)], ids=["1", "5"]
)
def test_ranges_of_the_lowest_mechanisms_known(text: str, lower: float, upper: float) -> None:
    """Of walls 1 and 5. Two other cone programs gave 0.63898 ... 0.64286, and 0.22956 as the upper end of wall 5."""
    program = planar_program(line_of(text))
    assert ends(program, solved(program)) == pytest.approx((lower, upper), abs=2e-7)


@pytest.mark.long
@pytest.mark.parametrize(
    "line",
    [line_of(FERRIS_3), line_of(FERRIS_5)],
    ids=["3", "5"],
)
def test_a_second_solver_finds_the_same_ends(line: Line) -> None:
    planar = planar_program(line)
    state = solved(planar)
    cone = fixed_mechanism_form(planar, point_motion(planar, state, max(1e-6, 10.0 * state.residual))).cone_program
    matrix, equations = cone.matrix.toarray(), cone.n_equations

    def simplex(sign: float) -> float:
        solution = linprog(
            sign * cone.cost,
            A_ub=matrix[equations:],
            b_ub=cone.rhs[equations:],
            A_eq=matrix[:equations],
            b_eq=cone.rhs[:equations],
            bounds=(None, None),
            method="highs-ds",
        )
        assert solution.x is not None
        return float(solution.x[-1]) * planar.scaling.live

    lower, upper = ends(planar, state)
    assert (lower, upper) == pytest.approx((simplex(1.0), simplex(-1.0)), rel=1e-7)
    assert upper - lower > 1e-3  # else the comparison would say little


def test_a_sliding_block_has_one_factor() -> None:
    program = line_of(BLOCK, "parameters.h=0.5").program
    assert ends(program, solved(program)) == pytest.approx((0.5, 0.5), rel=1e-9)


def test_a_block_between_walls_has_no_upper_end() -> None:
    """It slides along both walls: from mu, with nothing locked in between them, to any multiple."""
    text = HEAD + (
        "joints: {dry: {friction: 0.4}}\n"
        "blocks: [{box: {material: stone, min: [0, 0, 0], max: [1, 1, 0.5]}}]\n"
        "supports: [{ground: {z: 0}}, {ground: {point: [0, 0, 0], normal: [0, 1, 0]}},\n"
        "           {ground: {point: [0, 1, 0], normal: [0, -1, 0]}}]\n"
        "load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}\n"
    )
    program = line_of(text).program
    result = ranged(program, solved(program))
    assert result.lower is not None
    assert result.lower.load_factor * program.scaling.live == pytest.approx(0.4, rel=1e-8)
    assert result.upper is None
    assert "carry any multiple" in str(result.reason)
    assert [record.kind for record in result.programs] == ["range, lower", "range, upper"]
    assert [record.program for record in result.programs] == [7, 8]


@pytest.mark.parametrize("joint", ["cohesion: 500", "cohesion: 500, tensile_strength: 300"])
def test_cohesion_and_tension_stay_within_their_limits(joint: str) -> None:
    program = line_of(WALL.replace('friction: "=mu"', 'friction: "=mu", ' + joint), "parameters.n=4").program
    lower, upper = ends(program, solved(program))
    assert lower <= upper


def test_crushing_points_keep_their_strength() -> None:
    joint = "dry: {friction: 0.65, compressive_strength: 1.e+5}"
    program = line_of(
        WALL.replace('dry: {friction: "=mu"}', joint), "parameters.n=5", "blocks.0.wall.courses=8"
    ).program
    state = solved(program)
    motion = point_motion(program, state, 1e-6)
    assert motion.crushes.any()
    result = ranged(program, state)
    assert result.lower is not None
    crushed = result.lower.forces[motion.crushes, 0]
    assert crushed == pytest.approx(program.limits.compression[motion.crushes], rel=1e-12)


def test_noise_in_the_velocities_does_not_narrow_the_range() -> None:
    program = planar_program(line_of(FERRIS_3))
    state = solved(program)
    rng = np.random.default_rng(4)
    size = np.abs(state.velocities).max()
    noisy = state.velocities + 1e-9 * size * rng.normal(size=len(state.velocities))
    result = factor_range(program, replace(state, velocities=noisy, residual=1e-9), SETTINGS, lambda record: None, 1)
    assert result.lower is not None
    assert result.upper is not None
    assert max(result.lower.residual, result.upper.residual) < 1e-6
    found = result.lower.load_factor * program.scaling.live, result.upper.load_factor * program.scaling.live
    assert found == pytest.approx(ends(program, state), rel=1e-7)


def test_a_factor_beyond_what_its_mechanism_allows_has_no_upper_end() -> None:
    program = planar_program(line_of(FERRIS_3))
    state = solved(program)
    wrong = LawState(state.forces, state.velocities, 3.0 * state.load_factor, state.residual)
    result = factor_range(program, wrong, SETTINGS, lambda record: None, 1)
    assert result.upper is None
    assert "on the wrong side of the factor found" in str(result.reason)
