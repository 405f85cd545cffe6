"""A block that is let go from a tilt: when it hits its base, and what the impact leaves of its velocity (Housner)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.analytic.rocking import RockingBlock, time_to_impact
from tests.solution.time_history.followed import deck_text, marched, turned_pose

SLENDER = RockingBlock(0.2, 1.0)
BOX = "[{box: {material: stone, min: [0, 0, 0], max: [0.2, 0.3, 1]}}]"
TEXT = deck_text(
    BOX, "motion: {pulse: rectangle, amplitude: 0.01 g, duration: 9, direction: x, scale: 0}", "friction: 5"
)


def test_first_impact_and_restitution() -> None:
    """Let go at half of α; the loss of energy is that between the angles where it comes to rest."""
    march, rest = marched(TEXT)
    tilt, step = 0.5 * SLENDER.alpha, 0.002
    state = replace(rest, pose=turned_pose(march, (0.0, 1.0, 0.0), (0.2, 0.0, 0.0), tilt), shear=0.0 * rest.shear)
    turns, times = [tilt], [0.0]
    for made in march.steps(state, step):
        rotation = made.after.pose.rotation[0]
        turns.append(float(np.arctan2(rotation[0, 2], rotation[0, 0])))
        times.append(made.after.time)
        if made.after.time > 0.68:
            break
    angles = np.array(turns)
    impact = int(np.argmax(angles < 0.0))
    before = angles[impact - 1] / (angles[impact - 1] - angles[impact])
    assert times[impact - 1] + before * step == pytest.approx(time_to_impact(SLENDER, tilt), abs=1e-3)
    assert time_to_impact(SLENDER, tilt) == pytest.approx(0.34709, abs=1e-5)
    a, other = SLENDER.alpha, float(-angles.min())
    kept = np.sqrt((np.cos(a - other) - np.cos(a)) / (np.cos(a - tilt) - np.cos(a)))
    assert kept == pytest.approx(SLENDER.restitution, rel=0.02)
