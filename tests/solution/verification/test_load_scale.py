"""What residuals are relative to, for two blocks of 2 and 6 tonnes side by side on the ground."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.program.assemble import yield_limits
from mbla.solution.verification.statics import LoadScale, load_scale
from tests.line import BLOCK, Line, line_of

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
    assert scale.point_scale(line.contacts, pressed)[first] == pytest.approx(3 * TONNE)


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
