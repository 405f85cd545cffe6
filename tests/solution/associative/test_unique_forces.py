from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.reductions import reduce_program
from mbla.program.yield_conditions import yield_violation
from mbla.solution.associative.associative_form import FORMS
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.associative.unique_forces import NOT_FOUND, least_forces, point_weights
from mbla.solution.mechanics import forces_of
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord
from tests.line import HEAD, WALL, Line, line_of

SETTINGS = SolverSettings(1e-8)

STACK = (
    HEAD.replace("contacts: {joint: dry}", "contacts: {joint: slippery}")
    + """\
joints: {rough: {friction: 0.9}, slippery: {friction: 0.3}}
blocks:
  - box: {group: lower, material: stone, min: [0, 0, 0], max: [2, 1, 0.5]}
  - box: {group: upper, material: stone, min: [0, 0, 0.5], max: [2, 1, 1]}
supports: [{ground: {z: 0}, joint: rough}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0], on: upper}]}
"""
)
"""The upper block slides; what the lower one passes on is at rest."""


def ignored(record: IterationRecord) -> None:
    """A log that nobody reads."""


def associative(program: Program, form: str = "kinematic") -> LawState:
    state = solve_associative(program, SETTINGS, ignored, form=FORMS[form](program, None)).state
    assert state is not None
    return state


def reduced(line: Line) -> Program:
    switches = line.deck.analysis.reductions
    return reduce_program(line.model, line.contacts, line.program, switches, associative=True).parts[0]


def least(line: Line, program: Program, form: str = "kinematic") -> FloatArray:
    """Contact forces of the model, in mean block loads."""
    state, weights = associative(program, form), point_weights(program, line.contacts.point_areas)
    found = least_forces(program, state, weights, SETTINGS, ignored)
    assert found.remark is None
    loads = program.dead_load + found.state.load_factor * program.live_load
    assert np.abs(program.equilibrium_matrix @ found.state.forces.ravel() + loads).max() <= 1e-9
    assert yield_violation(found.state.forces, program.limits).max() <= 1e-6
    assert found.state.load_factor == pytest.approx(state.load_factor, rel=1e-6)
    before, after = (np.repeat(weights, program.components) @ s.forces.ravel() ** 2 for s in (state, found.state))
    assert after <= before * (1 + 1e-6)
    return forces_of(program, found.state.forces) / line.program.scaling.force


def test_shear_of_a_joint_at_rest_spreads_evenly() -> None:
    """Ground under the lower block: the moment fixes the normal forces of both sides, nothing fixes the shear."""
    line = line_of(STACK)
    ground = line.contacts.interface_of_point == int(np.flatnonzero(line.contacts.bodies[:, 0] == 2)[0])
    forces = least(line, line.program)[ground]
    shear = forces[:, 1:] @ line.contacts.frames[ground][0, 1:, 0]
    np.testing.assert_allclose(np.abs(shear), 0.3 / 4, rtol=1e-6)
    right = line.contacts.points[ground][:, 0] > 1.0
    lever = 0.3 * 0.75 / 2.0  # of 0.3 W at 0.75 above the ground, over the width
    np.testing.assert_allclose(forces[right, 0], (1.0 + lever) / 2, rtol=1e-6)
    np.testing.assert_allclose(forces[~right, 0], (1.0 - lever) / 2, rtol=1e-6)


@pytest.mark.parametrize("push", ["[1, 0, 0]", "[0, 1, 0]", "[0.8, 0.6, 0]"])
def test_forces_do_not_depend_on_what_found_the_load_factor_nor_on_reductions(push: str) -> None:
    line = line_of(WALL, "parameters.n=4", f"load_cases.push.live=[{{acceleration: {push}}}]")
    one = least(line, line.program)
    assert np.abs(associative(line.program).forces - one).max() > 1e-2  # the solver's own are others
    np.testing.assert_allclose(least(line, line.program, "static"), one, atol=1e-4)
    np.testing.assert_allclose(least(line, reduced(line)), one, atol=1e-4)


def test_where_every_joint_moves_the_least_forces_are_found_all_the_same() -> None:
    """The wall slides on the ground at the friction coefficient, and each of its joints may slide with it."""
    line = line_of(WALL)
    one = least(line, line.program)
    for form in ("kinematic", "static"):
        np.testing.assert_allclose(least(line, reduced(line), form), one, atol=1e-4)


def test_a_state_that_is_none_is_given_back_with_a_remark() -> None:
    line = line_of(WALL, "parameters.n=4")
    state = associative(line.program)
    weights = point_weights(line.program, line.contacts.point_areas)
    too_high = replace(state, load_factor=1.001 * state.load_factor)
    found = least_forces(line.program, too_high, weights, SETTINGS, ignored, first=7)
    assert found.remark == NOT_FOUND
    assert found.state is too_high
    assert [record.program for record in found.programs] == list(range(7, 7 + len(found.programs)))
    late = least_forces(line.program, state, weights, replace(SETTINGS, deadline=0.0), ignored)
    assert late.remark == NOT_FOUND


def test_weights_are_one_over_the_area_that_a_point_stands_for() -> None:
    line = line_of(WALL)
    program, areas = line.program, line.contacts.point_areas
    np.testing.assert_allclose(point_weights(program, areas), np.mean(1 / areas) ** -1 / areas)
    np.testing.assert_array_equal(point_weights(program, None), 1.0)
    smaller = reduced(line)
    assert smaller.components == 2
    forces = np.random.default_rng(1).normal(size=(smaller.n_points, 2))
    weights = point_weights(smaller, areas)
    by_area = (forces_of(smaller, forces) / program.scaling.force) ** 2 / areas[:, None]
    ratio = by_area.sum() / (np.repeat(weights, 2) @ forces.ravel() ** 2)
    other = np.random.default_rng(2).normal(size=(smaller.n_points, 2))
    again = (forces_of(smaller, other) / program.scaling.force) ** 2 / areas[:, None]
    assert again.sum() / (np.repeat(weights, 2) @ other.ravel() ** 2) == pytest.approx(ratio, rel=1e-12)
