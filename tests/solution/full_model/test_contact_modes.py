from typing import Any

import numpy as np
import pytest

from mbla.program.assemble import yield_limits
from mbla.program.yield_conditions import YieldLimits
from mbla.solution.full_model.contact_modes import contact_modes
from mbla.solution.solution import ContactMode
from tests.line import WALL, line_of, solution_of

STICK, SLIDE, OPEN = ContactMode.STICK, ContactMode.SLIDE, ContactMode.OPEN


def limits_of(n: int, **changes: float) -> YieldLimits:
    values = {"friction": 0.5, "dilatancy": 0.0, "cohesion": 0.0, "tension": 0.0, "compression": np.inf} | changes
    return YieldLimits(**{name: np.full(n, value) for name, value in values.items()})


@pytest.mark.parametrize(
    ("force", "velocity", "slope", "mode"),
    [
        ((1, 0.2, 0), (0, 0, 0), 0.0, STICK),
        ((1, 0.5, 0), (0, -0.1, 0), 0.0, SLIDE),
        ((0, 0, 0), (0.1, 0, 0), 0.0, OPEN),
        ((0, 0, 0), (0.1, 1, 0), 0.0, OPEN),
        ((1e-3, 0.5e-3, 0), (0.05, -0.1, 0), 0.5, SLIDE),  # lifts as associative flow asks, under little force
        ((1e-3, 0.5e-3, 0), (0.05, -0.1, 0), 0.0, OPEN),  # the same without dilatancy
        ((1, 0.4, 0), (0, -0.05, 0), 0.0, STICK),  # creeps, with a reserve of shear larger than its speed
        ((1e-9, 0, 0), (1e-7, 0, 0), 0.0, STICK),  # noise at a point that just touches
    ],
)
def test_one_of_two_is_small(force: Any, velocity: Any, slope: float, mode: ContactMode) -> None:
    """The second point sets the scales: force 1, strength 0.5, speed 1."""
    forces = np.array([force, (1, 0, 0)], float)
    velocities = np.array([velocity, (0, 0, 0)], float)
    velocities[1, 1], forces[1, 1] = 1.0, -0.5
    assert contact_modes(forces, velocities, limits_of(2), slope).tolist() == [mode, SLIDE]


def test_a_bonded_point_opens_at_its_tensile_strength() -> None:
    limits = limits_of(2, tension=1.0, cohesion=1.0)
    forces = np.array([[-1.0, 0, 0], [2.0, 0, 0]])
    velocities = np.array([[1.0, 0, 0], [0, 0, 0]])
    assert contact_modes(forces, velocities, limits, 0.0).tolist() == [OPEN, STICK]


def test_nothing_moves_nothing_opens() -> None:
    assert contact_modes(np.ones((3, 3)), np.zeros((3, 3)), limits_of(3), 0.0).tolist() == [STICK] * 3
    assert contact_modes(np.zeros((0, 3)), np.zeros((0, 3)), limits_of(0), 0.0).tolist() == []


def test_modes_are_free_of_units() -> None:
    generator = np.random.default_rng(3)
    forces, velocities = generator.normal(size=(50, 3)), generator.normal(size=(50, 3))
    modes = contact_modes(forces, velocities, limits_of(50), 0.3)
    limits = limits_of(50)
    assert contact_modes(1e6 * forces, 1e-9 * velocities, limits, 0.3).tolist() == modes.tolist()


def test_a_wall_that_slides_by_associative_flow_slides_and_does_not_open() -> None:
    """5 x 5 units collapse at μ: every course slides on the one below, lifting by μ times the slip.

    Judged by opening alone its beds would be said to be open although they carry all the weight.
    """
    line = line_of(WALL)
    mechanics = solution_of(line).mechanics
    assert mechanics is not None
    limits = yield_limits(line.model, line.contacts)
    assert limits.friction.max() == limits.friction.min() == 0.65
    carries = mechanics.contact_forces[:, 0] > 1e-3 * mechanics.contact_forces[:, 0].max()
    assert not np.any(mechanics.modes[carries] == OPEN)
    assert np.any(mechanics.modes == SLIDE)
    flat = contact_modes(mechanics.contact_forces, mechanics.contact_velocities, limits, 0.0)
    assert np.any(flat[carries] == OPEN)  # what the dilatancy of the flow rule guards against


def test_the_modes_of_a_solution_follow_its_own_flow_rule() -> None:
    line = line_of(WALL, "analysis.flow_rule=non_associative", "parameters.n=3")
    solution = solution_of(line)
    limits = yield_limits(line.model, line.contacts)
    for mechanics, slope in (
        (solution.mechanics, np.zeros_like(limits.friction)),
        (solution.associative, limits.friction),
    ):
        assert mechanics is not None
        again = contact_modes(mechanics.contact_forces, mechanics.contact_velocities, limits, slope)
        assert again.tolist() == mechanics.modes.tolist()
