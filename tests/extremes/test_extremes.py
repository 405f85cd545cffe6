"""Every short scene and a sample of those that take long: no red line. ``python -m tests.extremes.table`` has all."""

from __future__ import annotations

import pytest

from tests.extremes.outcome import Scene, outcome_of
from tests.extremes.scenes import all_scenes

pytestmark = pytest.mark.long

EVERY = 6
"""of the scenes that take long one of so many is taken; the table has them all"""
SCENES = all_scenes()
TAKEN = [*(scene for scene in SCENES if not scene.long), *[scene for scene in SCENES if scene.long][::EVERY]]


@pytest.mark.parametrize("scene", TAKEN, ids=lambda scene: f"{scene.family}: {scene.name}")
def test_no_red_line(scene: Scene) -> None:
    outcome = outcome_of(scene)
    assert not outcome.is_red, (outcome.verdict, outcome.got, scene.expected, outcome.status, outcome.words)
