"""What rests under given loads: its forces, and which blocks do not carry what is passed on to them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.program.program import Program
from mbla.program.reductions.restrict import ChosenPart
from mbla.solution.flow.resting_forces import resting_forces, rows_not_carried
from mbla.solution.law.interfaces import NONE
from tests.line import WALL, line_of
from tests.solution.flow.paths import SETTINGS, reduced


def pushed(program: Program, block: int, force: float) -> ChosenPart:
    """The program at rest with one of its blocks pushed sideways by a share of what it weighs."""
    weight = np.linalg.norm(program.dead_load.reshape(-1, 3)[block, :2])
    load = program.dead_load.copy()
    load[3 * block] += force * weight
    rest = replace(program, dead_load=load, live_load=np.zeros_like(load))
    return ChosenPart.of(rest, np.ones(len(load) // 3, dtype=bool), np.arange(program.n_points))


def test_a_block_that_is_pushed_beyond_friction_is_not_carried() -> None:
    """A block of the uppermost course of a wall, which nothing presses but its own weight."""
    program = reduced(line_of(WALL, "parameters.n=4", "load_cases.push.live=[{acceleration: [0.1, 0, 0]}]"))
    top = len(program.dead_load) // 3 - 1
    held, slides = pushed(program, top, 0.6), pushed(program, top, 0.7)
    assert rows_not_carried(held, NONE) is None
    assert resting_forces(held.program, NONE, SETTINGS, lambda record: None) is not None
    rows = rows_not_carried(slides, NONE)
    assert rows is not None
    assert np.flatnonzero(rows.reshape(-1, 3).all(axis=1)).tolist() == [top]
    assert resting_forces(slides.program, NONE, SETTINGS, lambda record: None) is None
