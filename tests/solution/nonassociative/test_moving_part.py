"""The part that moves as a program of its own: its way back."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.solution.flow.settings import PathSettings
from mbla.solution.nonassociative.moving_part import moving_part
from tests.line import BLOCK, line_of
from tests.solution.nonassociative.structures import FERRIS_5, least_of
from tests.solution.planar import planar_program

SMALL = PathSettings(few_points=0, worthwhile=1.0, rings=1)
"""Parts of small programs too, with one ring of blocks around what moves."""


def test_the_motion_of_a_part_is_one_of_the_whole() -> None:
    program = planar_program(line_of(FERRIS_5))
    state = least_of(program)
    part = moving_part(program, state.velocities, SMALL)
    assert part is not None
    assert len(part.points) < program.n_points
    assert len(part.program.dead_load) < len(program.dead_load)
    inner = part.program.velocities(program.mechanism(state.velocities))
    assert part.lifted(inner) == pytest.approx(state.velocities, abs=1e-9 * np.abs(state.velocities).max())
    full = (program.equilibrium_matrix.T @ state.velocities).reshape(-1, 2)[part.points]
    assert (part.program.equilibrium_matrix.T @ inner).reshape(-1, 2) == pytest.approx(full, abs=1e-9)
    assert part.program.live_load @ inner == pytest.approx(1.0)


def test_small_programs_and_those_that_move_as_a_whole_have_no_part() -> None:
    wall, block = planar_program(line_of(FERRIS_5)), line_of(BLOCK).program
    assert moving_part(wall, least_of(wall).velocities, PathSettings()) is None
    assert moving_part(block, np.ones(len(block.dead_load)), PathSettings(few_points=0)) is None
