"""Contact points in one place are solved as one: the same states, forces shared, nothing lost on the way back."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.deck.analysis import ReductionSwitches
from mbla.program.reductions import Reduced, StepState, reduce_program
from mbla.solution.mechanics import lifted
from mbla.solution.whole import to_full
from tests.line import HEAD, Line, line_of, verified
from tests.program.reductions.test_reduce import assert_state_of, optimum

FIXED_COURSE = (
    HEAD
    + """\
parameters: {mu: 0.6, c: 0, ft: 0, gap: 0.0}
joints: {dry: {friction: "=mu", cohesion: "=c", tensile_strength: "=ft"}}
blocks:
  - box: {group: base, material: stone, min: [0, 0, -0.2], max: ["=0.4-gap", 0.2, 0]}
  - box: {group: base, material: stone, min: [0.4, 0, -0.2], max: [0.8, 0.2, 0]}
  - box: {group: brick, material: stone, min: [0.2, 0, 0], max: [0.6, 0.2, 0.2]}
  - box: {group: top, material: stone, min: [0.2, 0, 0.2], max: [0.6, 0.2, 0.5]}
supports: [{blocks: base}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
  across: {live: [{acceleration: [0, 1, 0]}]}
  skew: {live: [{acceleration: [0.8, 0.6, 0]}]}
analysis: {flow_rule: non_associative, reductions: {planar: false, mirror: false, points: false}}
"""
)
"""A brick on two fixed ones that meet under its middle, and another block on it: 12 points, of which 4 coincide."""

STRONG = ("parameters.c=2000", "parameters.ft=500")


def reduced(line: Line, **switches: bool) -> Reduced:
    own = line.deck.analysis.reductions.model_copy(update=switches)
    associative = line.deck.analysis.flow_rule == "associative"
    return reduce_program(line.model, line.contacts, line.program, own, associative=associative)


def merged_points(line: Line) -> int:
    (step,) = (step for step in reduced(line).steps if step.name == "merged")
    assert (step.state is StepState.APPLIED) == (step.found > 0)
    return step.found


@pytest.mark.parametrize("strength", [(), STRONG], ids=["dry", "mortar"])
def test_a_brick_on_two_fixed_ones_has_six_points_below(strength: tuple[str, ...]) -> None:
    line = line_of(FIXED_COURSE, *strength)
    assert line.program.n_points == 12
    assert merged_points(line) == 2
    assert reduced(line).parts[0].n_points == 10
    assert reduced(line, merged=False).parts[0].n_points == 12


def test_the_program_of_forces_and_velocities_is_the_same() -> None:
    """Springs of the merged points are as stiff as those of the points: PᵀP = I, and A P Pᵀ Aᵀ = A Aᵀ."""
    line = line_of(FIXED_COURSE, *STRONG)
    program = reduced(line).parts[0]
    assert program.reduction is not None
    ways = program.reduction.forces
    assert abs(ways.T @ ways - np.eye(ways.shape[1])).max() < 1e-14
    whole, own = line.program.equilibrium_matrix, program.equilibrium_matrix
    assert abs(whole @ whole.T - own @ own.T).max() < 1e-12


@pytest.mark.parametrize("case", [0, 1, 2])
@pytest.mark.parametrize("strength", [(), STRONG], ids=["dry", "mortar"])
def test_optimum_and_way_back(strength: tuple[str, ...], case: int) -> None:
    line = line_of(FIXED_COURSE, *strength, "analysis.flow_rule=associative", case=case)
    program = reduced(line).parts[0]
    state = optimum(program)
    assert state.load_factor == pytest.approx(optimum(line.program).load_factor, rel=1e-7)
    assert_state_of(*to_full(program, state))


@pytest.mark.parametrize("case", [0, 1, 2])
@pytest.mark.parametrize("scheme", ["proximal", "published", "interior"])
def test_no_scheme_without_normality_sees_the_difference(scheme: str, case: int) -> None:
    """Load factor, its range and the residuals recomputed in the whole model."""
    factors = []
    for merged in ("true", "false"):
        overrides = (f"analysis.reductions.merged={merged}", f"analysis.scheme={scheme}")
        solution, checks, status = verified(line_of(FIXED_COURSE, *overrides, case=case))
        assert status == "solved", checks.failures
        assert solution.mechanics is not None
        factors.append((solution.mechanics.load_factor, checks.lower, checks.upper))
    assert factors[0] == pytest.approx(factors[1], rel=1e-5, nan_ok=True)  # nan: residuals too large to ask for a range


def test_forces_are_shared_alike_and_velocities_are_those_of_the_place() -> None:
    line = line_of(FIXED_COURSE)
    program = reduced(line).parts[0]
    state = optimum(program)
    full = lifted(program, state)
    points = line.contacts.points
    twins = [(i, j) for i in range(12) for j in range(i) if np.allclose(points[i], points[j])]
    assert len(twins) == 2
    velocities = (line.program.equilibrium_matrix.T @ full.velocities).reshape(-1, 3)
    for i, j in twins:
        frames = line.contacts.frames[[i, j]]
        assert full.forces[i] @ frames[0] == pytest.approx(full.forces[j] @ frames[1], abs=1e-12)
        assert velocities[i] @ frames[0] == pytest.approx(velocities[j] @ frames[1], abs=1e-12)


@pytest.mark.parametrize(("gap", "found"), [(4e-13, 2), (4e-6, 0)])
def test_points_near_each_other_are_not_in_one_place(gap: float, found: int) -> None:
    """Of the 0.4 m of a brick: rounding is 1e-12 of it, a gap of 1e-5 of it is a gap."""
    assert merged_points(line_of(FIXED_COURSE, f"parameters.gap={gap!r}")) == found


@pytest.mark.parametrize("joint", ["{friction: 0.5}", "{friction: 0.6, cohesion: 10}"])
def test_points_of_other_laws_stay(joint: str) -> None:
    text = FIXED_COURSE.replace("joints: {dry:", f"joints: {{other: {joint}, dry:")
    overrides = "[{between: [{group: base, index: 0}, brick], joint: other}]"
    assert merged_points(line_of(text, f"contacts.overrides={overrides}")) == 0


def test_points_of_unlike_strength_stay() -> None:
    """With mortar each point is as strong as its share of the area; 0.1 m and 0.3 m of the brick."""
    moved = FIXED_COURSE.replace("[0.2, 0, 0]", "[0.1, 0, 0]").replace("[0.6, 0.2, 0.2]", "[0.5, 0.2, 0.2]")
    assert merged_points(line_of(moved)) == 2
    assert merged_points(line_of(moved, *STRONG)) == 0


def test_points_of_refined_interfaces_stay() -> None:
    assert merged_points(line_of(FIXED_COURSE, "contacts.points={per_edge: 3}")) == 0


@pytest.mark.parametrize(
    "turn", ["rotate: {axis: [1, -2, 3], angle: 40}", "scale: 1000", "translate: [1.e5, -2.e5, 3.e5]"]
)
def test_whatever_the_place(turn: str) -> None:
    """Turned, in other units, and far away; the load follows nobody, it is the places that count."""
    text = FIXED_COURSE
    for corner in ('max: ["=0.4-gap", 0.2, 0]', "max: [0.8, 0.2, 0]", "max: [0.6, 0.2, 0.2]", "max: [0.6, 0.2, 0.5]"):
        text = text.replace(corner, f"{corner}, transform: [{{{turn}}}]")
    assert text.count("transform") == 4
    assert merged_points(line_of(text)) == 2


def test_switched_off() -> None:
    line = line_of(FIXED_COURSE, "analysis.reductions.merged=false")
    assert merged_points(line) == 0
    assert {step.name: step.state for step in reduced(line).steps}["merged"] is StepState.OFF
    assert ReductionSwitches().merged
