"""Bodies that touch nothing: they fall freely, and a spin about a skew axis keeps its energy and angular momentum."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.model.pose import Pose
from tests.solution.time_history.followed import deck_text, marched

BOX = "[{box: {material: stone, min: [0, 0, 0], max: [0.2, 0.3, 1]}}]"
TEXT = deck_text(BOX, "motion: {pulse: rectangle, amplitude: 0.01 g, duration: 9, direction: x, scale: 0}")


def test_a_block_thrown_up_with_a_spin() -> None:
    march, rest = marched(TEXT)
    bodies, step, n = march.bodies, 0.001, 400
    spin, speed = np.array([3.0, 4.0, 5.0]), np.array([1.0, 0.5, 2.0])
    momentum = np.concatenate([bodies.masses[0] * speed, bodies.tensors[0] @ spin])[None]
    pose = Pose(np.array([[0.0, 0.0, 50.0]]), np.eye(3)[None])
    state = replace(rest, pose=pose, velocities=np.concatenate([speed, spin])[None], momenta=momentum)
    energy = 0.5 * float(spin @ bodies.tensors[0] @ spin)
    for made in march.steps(state, step):
        state = made.after
        if state.counts.steps == n:
            break
    assert state.momenta[0, 3:] == pytest.approx(momentum[0, 3:], rel=1e-10)
    tensor = bodies.tensors_at(state.pose.rotation)[0]
    assert 0.5 * float(state.momenta[0, 3:] @ np.linalg.solve(tensor, state.momenta[0, 3:])) == pytest.approx(
        energy, rel=1e-6
    )
    time = n * step
    expected = speed * time - 0.5 * 9.81 * np.array([0.0, 0.0, time**2]) + [0.0, 0.0, 50.0]
    assert state.pose.shift[0] == pytest.approx(expected, abs=1e-9)
