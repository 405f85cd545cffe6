from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.reductions import reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.associative.force_ranges import ForceRanges, force_ranges
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord
from tests.line import HEAD, WALL, Line, line_of

SETTINGS = SolverSettings(1e-8)

BEAM = (
    HEAD.replace("contacts: {joint: dry}", "contacts: {joint: rough}")
    + """\
joints: {rough: {friction: 0.8}, slippery: {friction: 0.2}}
blocks:
  - box: {group: pier, material: stone, min: [0, 0, 0], max: [0.5, 1, 1]}
  - box: {group: pier, material: stone, min: [1.75, 0, 0], max: [2.25, 1, 1]}
  - box: {group: pier, material: stone, min: [3.5, 0, 0], max: [4, 1, 1]}
  - box: {group: beam, material: stone, min: [0, 0, 1], max: [4, 1, 1.5]}
  - box: {group: slider, material: stone, min: [1.5, 0, 1.5], max: [2.5, 1, 1.7]}
supports: [{blocks: pier}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0], on: slider}]}
"""
).replace("{joint: rough}", "{joint: rough, overrides: [{between: [beam, slider], joint: slippery}]}")
"""A beam at rest on three piers, and a block that slides on it."""


def ignored(record: IterationRecord) -> None:
    """A log that nobody reads."""


def program_of(line: Line, planar: bool) -> Program:
    if not planar:
        return line.program
    switches = ReductionSwitches(points=False, mirror=False)
    return reduce_program(line.model, line.contacts, line.program, switches, associative=True).parts[0]


def state_of(program: Program) -> LawState:
    state = solve_associative(program, SETTINGS, ignored).state
    assert state is not None
    return state


def found(line: Line, program: Program, settings: SolverSettings = SETTINGS) -> ForceRanges:
    result = force_ranges(program, state_of(program), line.contacts.interface_of_point, settings, ignored)
    assert result.remark is None
    assert len(result.programs) == 2 * len(line.contacts)
    return result


def weights(line: Line) -> FloatArray:
    """In units of the program's forces."""
    return line.model.blocks.volumes * 2000 * 9.81 / line.program.scaling.force


@pytest.mark.parametrize("planar", [False, True])
def test_a_beam_on_three_piers(planar: bool) -> None:
    """Least is nothing. The middle pier can bear all; an end pier bears most at its inner edge, the other at its outer.

    The slider is pushed at 0.6 above the piers with 0.2 of its weight; the beam passes that moment on.
    """
    line = line_of(BEAM)
    _, _, _, beam, slider = weights(line)
    ranges = found(line, program_of(line, planar)).ranges
    total = beam + slider
    np.testing.assert_allclose(ranges[1], [0.0, total], atol=2e-6 * total)
    np.testing.assert_allclose(ranges[3], [slider, slider], rtol=2e-6)
    turning = 0.2 * slider * 0.6
    np.testing.assert_allclose(ranges[2, 1], (2.0 * total + turning) / 3.5, rtol=2e-6)
    np.testing.assert_allclose(ranges[0, 1], (2.0 * total - turning) / 3.5, rtol=2e-6)
    np.testing.assert_allclose(ranges[[0, 2], 0], 0.0, atol=2e-6 * total)


def test_the_planar_program_has_the_ranges_of_the_spatial_one() -> None:
    line = line_of(WALL, "parameters.n=3")
    ranges = found(line, program_of(line, planar=False)).ranges
    np.testing.assert_allclose(found(line, program_of(line, planar=True)).ranges, ranges, atol=2e-5)
    state = state_of(line.program)
    own = np.bincount(line.contacts.interface_of_point, state.forces[:, 0])
    assert (ranges[:, 0] <= own + 1e-5).all()
    assert (own <= ranges[:, 1] + 1e-5).all()


WEDGED = (
    HEAD
    + """\
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: walls, material: stone, min: [-1, 0, 0], max: [0, 1, 1]}
  - box: {group: walls, material: stone, min: [2, 0, 0], max: [3, 1, 1]}
  - box: {group: bar, material: stone, min: [0, 0, 0], max: [2, 1, 1]}
  - box: {group: top, material: stone, min: [0.5, 0, 1], max: [1.5, 1, 1.2]}
supports: [{blocks: walls}]
load_cases:
  push: {live: [{acceleration: [0, 1, 0], on: top}]}
"""
)


def test_a_bar_between_two_walls_can_be_pressed_as_hard_as_one_likes() -> None:
    """It needs a thrust that carries its weight, and that of the block which slides on it, by friction."""
    line = line_of(WEDGED)
    ranges = found(line, line.program).ranges
    bar, top = weights(line)[2:]
    sides = np.flatnonzero(line.contacts.bodies[:, 0] < 2)
    assert np.isposinf(ranges[sides, 1]).all()
    assert (ranges[sides, 0] > (bar + top) / 2 / 0.5 * (1 - 1e-6)).all()  # more, for the thrust across
    other = np.setdiff1d(np.arange(len(ranges)), sides)
    np.testing.assert_allclose(ranges[other], top, rtol=1e-5)


def test_a_part_at_rest_has_the_ranges_of_its_loads() -> None:
    """The beam without the slider, under a given load factor."""
    text = (
        BEAM.replace("on: slider", "on: beam")
        .replace("  - box: {group: slider, material: stone, min: [1.5, 0, 1.5], max: [2.5, 1, 1.7]}\n", "")
        .replace(", overrides: [{between: [beam, slider], joint: slippery}]", "")
        .replace(", slippery: {friction: 0.2}", "")
    )
    line = line_of(text)
    program = line.program
    factor = 0.1 / program.scaling.live
    still = LawState(np.zeros((program.n_points, 3)), np.zeros_like(program.dead_load), factor, 0.0)
    ranges = force_ranges(program, still, line.contacts.interface_of_point, SETTINGS, ignored).ranges
    (weight,) = weights(line)[3:]
    np.testing.assert_allclose(ranges[1], [0.0, weight], atol=3e-6 * weight)


def test_what_was_not_found_is_told() -> None:
    line = line_of(BEAM)
    state = state_of(line.program)
    late = replace(SETTINGS, deadline=0.0)
    result = force_ranges(line.program, state, line.contacts.interface_of_point, late, ignored, first=5)
    assert np.isnan(result.ranges).all()
    assert "not found for 4 interfaces" in str(result.remark)
    assert [record.program for record in result.programs] == [5]
