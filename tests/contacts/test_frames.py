from __future__ import annotations

import numpy as np
import pytest

from mbla.contacts.overlay import frames_from_normals, unit


@pytest.mark.parametrize(
    ("normal", "first", "second"),
    [
        ([0, 0, 1], [1, 0, 0], [0, 1, 0]),
        ([0, 0, -1], [1, 0, 0], [0, -1, 0]),
        ([1, 0, 0], [0, 1, 0], [0, 0, 1]),
        ([0, 1, 0], [-1, 0, 0], [0, 0, 1]),
        ([0.6, 0, 0.8], [0, 1, 0], [-0.8, 0, 0.6]),
    ],
)
def test_tangents(normal: list[float], first: list[float], second: list[float]) -> None:
    frame = frames_from_normals(np.array([normal], dtype=float))[0]
    np.testing.assert_allclose(frame, [normal, first, second], atol=1e-15)


def test_frames_are_right_handed() -> None:
    normals = unit(np.random.default_rng(0).normal(size=(1000, 3)))
    frames = frames_from_normals(normals)
    np.testing.assert_allclose(np.cross(frames[:, 0], frames[:, 1]), frames[:, 2], atol=1e-14)
    np.testing.assert_allclose(np.einsum("kij,kij->ki", frames, frames), 1.0, rtol=1e-14)


@pytest.mark.parametrize("tilt", [1e-15, 1e-9, 1e-4])
def test_rounding_does_not_turn_the_tangents_of_a_bed_joint(tilt: float) -> None:
    tilted = unit(np.array([[tilt, 0, 1], [-tilt, tilt, 1], [0, -tilt, 1]]))
    frames = frames_from_normals(tilted)
    np.testing.assert_allclose(frames[:, 1], np.broadcast_to([1, 0, 0], (3, 3)), atol=2 * tilt)


def test_tangents_of_joints_that_are_nearly_level() -> None:
    """Tangent 1 is x, made perpendicular to the normal."""
    normals = unit(np.array([[0.009, 0, 1], [0.006, -0.005, -1], [-0.005, 0.005, 1]]))
    frames = frames_from_normals(normals)
    np.testing.assert_allclose(frames @ frames.transpose(0, 2, 1), np.broadcast_to(np.eye(3), (3, 3, 3)), atol=1e-15)
    assert (frames[:, 1, 0] > 0.9999).all()
