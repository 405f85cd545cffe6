"""Resultants and velocities of one block on another, by hand."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.program.assemble import yield_limits
from mbla.solution.verification.statics import (
    LoadScale,
    bodies_of_points,
    contact_resultants,
    contact_velocities,
    load_scale,
    power,
)
from tests.line import BLOCK, HEAD, Line, line_of

STACK = (
    HEAD
    + """\
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: lower, material: stone, min: [0, 0, 0], max: [2, 2, 1]}
  - box: {group: upper, material: stone, min: [0, 0, 1], max: [1, 2, 4]}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""
)


@pytest.fixture(scope="module")
def stack() -> Line:
    return line_of(STACK)


def test_which_bodies_meet_at_a_point(stack: Line) -> None:
    high = stack.contacts.points[:, 2] > 0.5
    bodies = bodies_of_points(stack.contacts)
    assert high.sum() == 4
    assert bodies[high].tolist() == [[0, 1]] * 4
    assert (bodies[~high].max(axis=1) == 2).all()


def test_what_a_point_does_to_both_blocks(stack: Line) -> None:
    """3 up and (1, 2) across on the upper block at x, y, and as much against the lower one."""
    contacts = stack.contacts
    for point in np.flatnonzero(contacts.points[:, 2] > 0.5):
        assert contacts.frames[point, 0].tolist() == pytest.approx([0, 0, 1])
        forces = np.zeros((len(contacts.points), 3))
        forces[point] = contacts.frames[point] @ np.array([1.0, 2.0, 3.0])
        x, y, z = contacts.points[point]
        found = contact_resultants(stack.model, contacts, forces)
        for block, sign, (a, b, c) in ((0, -1.0, (1.0, 1.0, 0.5)), (1, 1.0, (0.5, 1.0, 2.5))):
            arm = (x - a, y - b, z - c)
            moment = [arm[1] * 3 - arm[2] * 2, arm[2] * 1 - arm[0] * 3, arm[0] * 2 - arm[1] * 1]
            assert found[block].tolist() == pytest.approx([sign * value for value in (1, 2, 3, *moment)])


def test_the_ground_pushes_what_stands_on_it(stack: Line) -> None:
    contacts = stack.contacts
    point = int(np.flatnonzero(contacts.points[:, 2] < 0.5)[0])
    forces = np.zeros((len(contacts.points), 3))
    forces[point, 0] = 4.0
    x, y, _ = contacts.points[point]
    found = contact_resultants(stack.model, contacts, forces)
    assert found[0].tolist() == pytest.approx([0, 0, 4, 4 * (y - 1), -4 * (x - 1), 0])
    assert found[1].tolist() == [0.0] * 6


@pytest.mark.parametrize("block", [0, 1])
@pytest.mark.parametrize("way", range(6))
def test_power_of_forces_is_that_of_their_velocities(block: int, way: int, stack: Line) -> None:
    """Of forces within joints against each other: what they do to the blocks is what they lose over the joints."""
    contacts = stack.contacts
    mechanism = np.zeros((2, 6))
    mechanism[block, way] = 0.5
    forces = np.random.default_rng(1).normal(size=(len(contacts.points), 3))
    within = float((forces * contact_velocities(stack.model, contacts, mechanism)).sum())
    assert within == pytest.approx(power(contact_resultants(stack.model, contacts, forces), mechanism))


def test_velocities_of_the_upper_block_off_the_lower_one(stack: Line) -> None:
    contacts = stack.contacts
    high = contacts.points[:, 2] > 0.5
    mechanism = np.array([[1.0, 2.0, 3.0, 0, 0, 0], [2.0, 5.0, 7.0, 0, 0, 0.5]])
    found = np.einsum("pjx,pj->px", contacts.frames, contact_velocities(stack.model, contacts, mechanism))
    arm = contacts.points[high] - [0.5, 1.0, 2.5]
    expected = np.column_stack([1.0 - 0.5 * arm[:, 1], 3.0 + 0.5 * arm[:, 0], np.full(4, 4.0)])
    assert found[high] == pytest.approx(expected)
    on_ground = found[~high] * np.where(contacts.frames[~high][:, 0, 2:] > 0, 1.0, -1.0)
    assert on_ground == pytest.approx(np.tile([1.0, 2.0, 3.0], (int((~high).sum()), 1)))


def test_power() -> None:
    assert power(np.arange(12.0).reshape(2, 6), np.full((2, 6), 0.5)) == 33.0


# What residuals are relative to, for two blocks of 2 and 6 tonnes side by side on the ground.


PAIR = BLOCK.replace("supports", "  - box: {group: far, material: stone, min: [5, 0, 0], max: [6, 3, 1]}\nsupports")
TONNE = 9810.0


def scale_of(line: Line) -> LoadScale:
    return load_scale(line.model, line.contacts, line.load_case, yield_limits(line.model, line.contacts))


def test_loads_and_their_mean() -> None:
    scale = scale_of(line_of(PAIR, "parameters.h=1"))
    assert scale.own == pytest.approx([2 * TONNE, 6 * TONNE])
    assert scale.mean == pytest.approx(4 * TONNE)
    assert scale.live == pytest.approx(np.hypot(2, 6) * TONNE)


def test_a_block_has_to_balance_its_load_and_what_presses_on_it_up_to_the_mean() -> None:
    line = line_of(PAIR, "parameters.h=1")
    scale, none = scale_of(line), np.zeros((len(line.contacts.points), 3))
    assert scale.block_scale(line.contacts, none) == pytest.approx([2 * TONNE, 4 * TONNE])
    pressed = none.copy()
    first = (line.contacts.bodies[line.contacts.interface_of_point] == 0).any(axis=1)
    pressed[np.flatnonzero(first)[0], 0] = TONNE
    assert scale.block_scale(line.contacts, pressed) == pytest.approx([3 * TONNE, 4 * TONNE])
    assert scale.of_lighter(line.contacts, scale.block_scale(line.contacts, pressed))[first] == pytest.approx(3 * TONNE)


def test_without_dead_load_the_strength_of_the_joints_is_the_scale() -> None:
    text = PAIR.replace("push: {live", "push: {dead: [{gravity: none}], live")
    bonded = scale_of(line_of(text, "parameters.c=300", "parameters.ft=100"))
    assert bonded.own == pytest.approx(2 * [(300 + 100) * (1 + 3) / 2])  # on areas of 1 and 3 m²
    dry = scale_of(line_of(text, "parameters.h=1"))
    assert dry.own == pytest.approx([2 * TONNE, 6 * TONNE])  # of the live load


def test_the_least_factor_is_that_of_the_blocks_that_move() -> None:
    scale = scale_of(line_of(PAIR, "parameters.h=1"))
    motion = np.zeros((2, 6))
    motion[0, 0] = 1 / (2 * TONNE)
    alone = scale.least_factor(motion)
    assert alone == pytest.approx(1e-3 * np.hypot(2, 6) / np.hypot(2, 6))  # no less than of the whole
    motion[0, 0] = 0.1 / (2 * TONNE)
    assert scale.least_factor(motion) == pytest.approx(1e-4)
