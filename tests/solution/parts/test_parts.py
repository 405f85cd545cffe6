"""Parts at rest beside the one that collapses: what they carry, and what becomes of them where nothing is found."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.program.program import Program
from mbla.program.reductions import reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.nonassociative.collapse_state import CollapseState
from mbla.solution.parts import assemble_parts as whole
from mbla.solution.parts.assemble_parts import assemble_parts, at_rest
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from mbla.solution.standing import standing
from tests.line import BLOCK, line_of
from tests.solution.failing_solver import said

SETTINGS = SolverSettings(1e-8)


def two_blocks(*overrides: str) -> tuple[Program, ...]:
    """A block that tips at 0.5, and one of height ``g`` far from it; friction 0.9."""
    other = '  - box: {group: other, material: stone, min: [9, 0, 0], max: [10, 1, "=g"]}\n'
    text = BLOCK.replace("supports:", other + "supports:").replace("parameters: {", "parameters: {g: 1.25, ")
    line = line_of(text, "parameters.mu=0.9", *overrides)
    parts = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=False).parts
    assert len(parts) == 2
    return parts


def collapse_of(part: Program) -> CollapseState:
    state = solve_associative(part, SETTINGS, lambda record: None).state
    assert state is not None
    return state


def test_a_part_at_rest_carries_the_load_of_the_one_that_collapses() -> None:
    parts = two_blocks()
    found = assemble_parts(parts, 0, collapse_of(parts[0]), SETTINGS, lambda record: None)
    assert found is not None
    program, state = found
    assert program.scaling.load_factor(state.load_factor) == pytest.approx(0.5, rel=1e-6)
    loads = program.dead_load + state.load_factor * program.live_load
    assert np.abs(program.equilibrium_matrix @ state.forces.ravel() + loads).max() < 1e-6


def test_a_part_that_cannot_carry_that_load_leaves_no_state() -> None:
    """The other block tips at 0.625, and is asked for 1."""
    parts = two_blocks("parameters.g=1.6")
    assert (
        assemble_parts(parts, 0, replace(collapse_of(parts[0]), load_factor=1.0), SETTINGS, lambda record: None) is None
    )


def test_a_part_of_which_no_lower_state_is_found_is_looked_at_where_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    """It collapses a ten-thousandth later, and below that the solver finds nothing."""
    parts = two_blocks("parameters.g=2")
    state = collapse_of(parts[0])
    ending = replace(collapse_of(parts[1]), load_factor=state.load_factor * 1.0001)
    asked: list[float] = []

    def forces_at(program: Program, load_factor: float, *others: object) -> CollapseState | None:
        asked.append(load_factor / state.load_factor)
        return None if len(asked) == 1 else replace(ending, load_factor=load_factor)

    monkeypatch.setattr(whole, "at_rest", forces_at)
    assert assemble_parts(parts, 0, state, SETTINGS, lambda record: None, [state, ending]) is not None
    assert asked == pytest.approx([1.0 - whole.BELOW, 1.0])


def test_without_a_load_nothing_is_carried() -> None:
    program = line_of(BLOCK).program
    none = replace(program, dead_load=-0.5 * program.live_load)
    state = at_rest(none, 0.5, SETTINGS, lambda record: None)
    assert state is not None
    assert not state.forces.any()
    assert not state.velocities.any()


def test_without_an_answer_there_are_no_forces(monkeypatch: pytest.MonkeyPatch) -> None:
    program = line_of(BLOCK).program
    assert at_rest(program, 0.1, SETTINGS, lambda record: None) is not None
    monkeypatch.setattr(standing, "cone_solver", said(Status.NUMERICAL_ERROR))
    assert at_rest(program, 0.1, SETTINGS, lambda record: None) is None
