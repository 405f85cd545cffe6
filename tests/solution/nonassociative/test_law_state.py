"""The residual of a state where load factors are next to nothing."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.program.program import Program
from mbla.solution.nonassociative.collapse_state import CollapseState, collapse_state
from mbla.solution.thresholds import NEAR_ZERO
from tests.line import BLOCK, line_of

LIGHT_BESIDE_HEAVY = """\
mbla: 1
materials: {stone: {density: 2000}, cork: {density: 2.0e-5}}
joints: {dry: {friction: 0.5}}
contacts: {joint: dry}
blocks:
  - box: {group: heavy, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: light, material: cork, min: [5, 0, 0], max: [6, 1, 1]}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0], on: light}]}}
"""


def sliding(program: Program, friction: float, share: float) -> CollapseState:
    """One block that slides along x at the load factor ``friction``, with only a share of the friction as forces."""
    velocities = np.zeros(len(program.live_load))
    velocities[0] = 1.0 / program.live_load[0]
    forces = np.zeros((program.n_points, program.components))
    forces[:, 0] = -program.dead_load[2] / program.n_points
    v = (program.equilibrium_matrix.T @ velocities).reshape(forces.shape)
    forces[:, 1:] = -share * friction * forces[:, [0]] * v[:, 1:] / np.linalg.norm(v[:, 1:], axis=1)[:, None]
    return collapse_state(program, 0.0, forces, velocities, friction)


@pytest.mark.parametrize(("friction", "miss"), [(0.5, 0.1), (1e-3, 0.1), (1e-8, 1e-8 * 0.1 / NEAR_ZERO)])
def test_what_is_missed_is_a_share_of_the_balance_or_of_next_to_nothing(friction: float, miss: float) -> None:
    """A tenth of the friction is missed; of a balance that rounding could have made that is no fault of the forces."""
    program = line_of(BLOCK, f"parameters.mu={friction!r}").program
    state = sliding(program, friction, 0.9)
    assert state.residual == pytest.approx(miss, rel=1e-6)


def test_next_to_nothing_is_measured_on_the_blocks_that_move() -> None:
    """A block 1e8 times as heavy that stays where it is would make a load factor of 0.5 next to nothing."""
    program = line_of(LIGHT_BESIDE_HEAVY).program
    velocities = np.zeros(len(program.live_load))
    velocities[6] = 1.0 / program.live_load[6]
    assert program.scaling.load_factor(program.dead_over_live) == pytest.approx(1e8)
    assert program.scaling.load_factor(program.moved_over_live(velocities)) == pytest.approx(1.0)
    velocities[0] = velocities[6]
    assert program.moved_over_live(velocities) == pytest.approx(program.dead_over_live)


@pytest.mark.parametrize("lift", [0.5, 0.25, 0.0])
def test_a_joint_that_lifts_by_less_than_its_sliding_misses_the_law(lift: float) -> None:
    """Friction holds and nothing closes: the weight does not do the work that a dilatancy of 0.5 wants of it."""
    program = line_of(BLOCK).program
    slides = sliding(program, 0.5, 1.0)
    velocities = slides.velocities.copy()
    velocities[2] = lift * velocities[0]
    weight, balance = -float(program.dead_load[2]), 0.5 * -float(program.dead_load[2])
    expected = weight * (0.5 - lift) * velocities[0] / (balance * velocities[0])
    state = collapse_state(program, 0.5, slides.forces, velocities, 0.5)
    assert state.residual == pytest.approx(expected, abs=1e-12)
