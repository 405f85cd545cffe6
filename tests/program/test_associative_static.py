"""The static form against the kinematic one: the same load factor from forces as from velocities."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from mbla.program.program import Program
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.cone_solvers.clarabel_adapter import ClarabelProgram
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, Status
from tests.line import BLOCK, WALL, line_of
from tests.program.associative_static import associative_static_form
from tests.solution.planar import planar_program


def ignored(record: IterationRecord) -> None:
    """A log that nobody reads."""


COHESIVE = BLOCK.replace("tensile_strength", "compressive_strength: 5.0e+5, tensile_strength")
SMOOTH = BLOCK.replace("{ground: {z: 0}}", "{ground: {z: 0}, joint: ice}").replace(
    'joints: {dry: {friction: "=mu", cohesion: "=c", tensile_strength: "=ft"}}',
    "joints: {dry: {friction: 0.5}, ice: {friction: 0, cohesion: 1000}}",
)


def kinematic(program: Program) -> tuple[Status, float]:
    """Status and load factor by the form that the program solves."""
    result = solve_associative(program, SolverSettings(1e-8), ignored)
    return result.status, np.nan if result.state is None else result.state.load_factor


def static(program: Program) -> tuple[Status, float]:
    """By the static form: without admissible forces no equilibrium, without an upper bound of λ no collapse."""
    form = associative_static_form(program)
    solution = ClarabelProgram(form.cone_program, SolverSettings(1e-10), ignored).solve(1, 1.0)
    if solution.status is Status.UNBOUNDED or (solution.status is Status.SOLVED and solution.objective > 0.0):
        return Status.NO_EQUILIBRIUM, np.nan
    status = Status.UNBOUNDED if solution.status is Status.NO_EQUILIBRIUM else solution.status
    return status, -solution.objective


@pytest.mark.parametrize(
    ("text", "overrides"),
    [
        (WALL, ()),
        (BLOCK, ("parameters.c=4000", "parameters.ft=2000")),
        (COHESIVE, ("parameters.c=4000", "parameters.ft=2000")),
        (SMOOTH, ()),
    ],
    ids=["wall", "cohesive block", "block that crushes", "cohesion without friction"],
)
def test_forces_and_velocities_give_the_same_factor(text: str, overrides: tuple[str, ...]) -> None:
    program = line_of(text, *overrides).program
    velocities, forces = kinematic(program), static(program)
    assert velocities[0] is forces[0] is Status.SOLVED
    assert forces[1] == pytest.approx(velocities[1], rel=2e-7)


def test_the_same_in_a_plane() -> None:
    line = line_of(WALL)
    planar = planar_program(line)
    assert static(planar)[1] == pytest.approx(kinematic(planar)[1], rel=2e-7)
    assert static(planar)[1] == pytest.approx(static(line.program)[1], rel=2e-7)


@pytest.mark.parametrize("verdict_of", [kinematic, static])
def test_verdicts_are_the_same(verdict_of: Callable[[Program], tuple[Status, float]]) -> None:
    into_the_ground = line_of(WALL, "load_cases.push.live=[{acceleration: [0, 0, -1]}]").program
    assert verdict_of(into_the_ground)[0] is Status.UNBOUNDED
    steep = "load_cases.push.dead=[{gravity: [9.81, 0, -9.81]}]"
    helped = line_of(WALL, steep, "load_cases.push.live=[{acceleration: [0, 1, 0]}]").program
    assert verdict_of(helped)[0] is Status.NO_EQUILIBRIUM
