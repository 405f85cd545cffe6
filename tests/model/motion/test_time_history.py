"""Motions of the base that add up."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.model.motion.signal import Signal
from mbla.model.motion.time_history import BaseMotion, TimeHistory


def history(*motions: BaseMotion) -> TimeHistory:
    nothing = np.zeros((0, 9)), np.zeros((0, 6))
    return TimeHistory(motions, (), 0.1, 1.0, 0.0, 0.3, 0.1, (), (), np.inf, False, (), False, *nothing)


def test_motions_add_up_along_their_directions() -> None:
    one = BaseMotion("one", Signal(np.array([0.0, 1.0]), np.array([2.0, 2.0])), np.array([1.0, 0.0, 0.0]))
    other = BaseMotion("other", Signal(np.array([0.0, 2.0]), np.array([0.0, 2.0])), np.array([0.6, 0.0, 0.8]), "a.csv")
    both = history(one, other)
    assert both.base_acceleration(0.5) == pytest.approx([2.3, 0.0, 0.4])
    assert both.base_velocity([1.0, 2.0]) == pytest.approx(np.array([[2.3, 0.0, 0.4], [3.2, 0.0, 1.6]]))
    assert both.base_displacement(3.0) == pytest.approx([5.0 + 0.6 * (8.0 / 6.0 + 2.0), 0.0, 0.8 * (8.0 / 6.0 + 2.0)])
    assert both.drivers == (one, other)
    assert (one.peak_acceleration, one.peak_velocity, one.peak_displacement) == (2.0, 2.0, 1.0)


def test_without_motion_the_base_is_at_rest() -> None:
    assert history().base_velocity([0.0, 1.0]).tolist() == [[0.0] * 3] * 2
    assert history().base_acceleration(0.5).tolist() == [0.0] * 3
