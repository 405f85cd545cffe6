"""Reduced programs have the optimum of the whole, and their states are states of the whole."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.program.program import Program
from mbla.program.reductions import Reduced, reduce_program, unreduced
from mbla.program.reductions.steps import ReductionSwitches
from mbla.program.yield_conditions import yield_violation
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.parts import to_full
from mbla.solution.settings import SolverSettings
from tests.line import BLOCK, HEAD, WALL, Line, line_of

ARCH = (
    HEAD
    + """\
joints: {dry: {friction: 0.6}}
blocks:
  - arch: {group: arch, material: stone, shape: semicircular, span: 4, thickness: 0.5, width: 1, voussoirs: 11}
supports: [{ground: {z: 0}}]
load_cases:
  crown: {live: [{force: [0, 0, -1000], on: {group: arch, index: 5}}]}
  push: {live: [{acceleration: [1, 0, 0]}]}
analysis: {flow_rule: associative}
"""
)

MORTAR = WALL.replace(
    'joints: {dry: {friction: "=mu"}}',
    'joints: {dry: {friction: "=mu", cohesion: 3000, tensile_strength: 1000, compressive_strength: 2.e5}}',
)

TWO_WALLS = WALL.replace(
    "supports:",
    """  - wall:
      group: other
      material: stone
      unit: [0.4, 0.2, 0.175]
      length: "=0.4*n"
      courses: 9
      transform: [{translate: [0, 3, 0]}]
supports:""",
)


def reduced(line: Line, *, associative: bool = True, switches: ReductionSwitches | None = None) -> Reduced:
    switches = ReductionSwitches() if switches is None else switches
    return reduce_program(line.model, line.contacts, line.program, switches, associative=associative)


def optimum(program: Program) -> LawState:
    result = solve_associative(program, SolverSettings(1e-9), lambda record: None)
    assert result.state is not None, result.reason
    return result.state


def both(line: Line) -> tuple[LawState, LawState, Program]:
    """State of the whole program, and that of the only part with its program."""
    (part,) = reduced(line).parts
    return optimum(line.program), optimum(part), part


@pytest.mark.parametrize(
    ("text", "case"),
    [(WALL, 0), (MORTAR, 0), (ARCH, 0), (ARCH, 1), (BLOCK, 0)],
    ids=["wall", "mortar", "crown", "push", "block"],
)
def test_planar_and_spatial_optimum_agree_and_the_way_back_is_exact(text: str, case: int) -> None:
    line = line_of(text, case=case)
    spatial, planar, part = both(line)
    assert reduced(line).size.dimension == 2
    assert part.components == 2
    assert part.equilibrium_matrix.shape[0] == line.program.equilibrium_matrix.shape[0] // 2
    assert planar.load_factor == pytest.approx(spatial.load_factor, rel=1e-6)
    program, state = to_full(part, planar)
    assert program is line.program
    assert_state_of(program, state)


def assert_state_of(program: Program, state: LawState) -> None:
    """Equilibrium, yield, compatibility and unit live power in the whole program."""
    unbalanced = program.equilibrium_matrix @ state.forces.ravel() + program.dead_load
    unbalanced += state.load_factor * program.live_load
    assert np.abs(unbalanced).max() < 1e-6
    assert yield_violation(state.forces, program.limits).max() < 1e-8
    velocities = (program.equilibrium_matrix.T @ state.velocities).reshape(-1, 3)
    lack = program.limits.friction * np.hypot(velocities[:, 1], velocities[:, 2]) - velocities[:, 0]
    crushable = np.isfinite(program.limits.compression)
    assert (np.where(crushable, 0.0, lack) / np.abs(velocities).max()).max() < 1e-6
    assert program.live_load @ state.velocities == pytest.approx(1.0)


def test_a_push_along_the_middle_of_a_wall_halves_it() -> None:
    live = "load_cases.push.live=[{acceleration: [0, 1, 0]}]"
    line = line_of(WALL, live)
    whole, half, part = both(line)
    size = reduced(line).size
    assert (size.dimension, size.mirror_planes) == (3, 1)
    assert size.dropped_points == pytest.approx(line.program.n_points / 2, abs=10)
    assert half.load_factor == pytest.approx(whole.load_factor, rel=1e-6)
    assert_state_of(*to_full(part, half))


def test_points_inside_the_hull_are_left_out_of_associative_programs_only() -> None:
    """An L-shaped base: the inner corner lies within the hull of the others."""
    outline = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]
    vertices = [[x, y, z] for z in (0, 1) for x, y in outline]
    sides = [[i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6] for i in range(6)]
    faces = [[0, 1, 2, 3, 4, 5], [6, 7, 8, 9, 10, 11], *sides]
    text = BLOCK.replace(
        'box: {group: block, material: stone, min: [0, 0, 0], max: ["=b", 1, "=h"]}',
        f"polyhedron: {{group: block, material: stone, vertices: {vertices}, faces: {faces}}}",
    )
    line = line_of(text, "load_cases.push.live=[{acceleration: [1, 0.2, 0]}]", "parameters.mu=2")
    kept = reduced(line).parts[0]
    assert (line.program.n_points, kept.n_points) == (6, 5)
    assert reduced(line, associative=False).parts[0].n_points == 6
    assert optimum(kept).load_factor == pytest.approx(optimum(line.program).load_factor, rel=1e-6)


def test_everything_can_be_switched_off() -> None:
    line = line_of(TWO_WALLS)
    off = reduced(line, switches=ReductionSwitches(on=False))
    assert off.parts == (line.program,)
    assert off.size == unreduced(line.program, line.contacts).size
