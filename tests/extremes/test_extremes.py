"""A sample of the short scenes in the normal run, all under ``-m long``: no red line."""

from __future__ import annotations

import pytest

from tests.extremes.outcome import Scene, outcome_of
from tests.extremes.scenes import all_scenes

EVERY = 12
"""The normal run takes one of so many short scenes; the table has them all."""


@pytest.mark.parametrize(
    "scene",
    [
        pytest.param(
            scene, id=f"{scene.family}: {scene.name}", marks=[pytest.mark.long] if scene.long or i % EVERY else []
        )
        for i, scene in enumerate(all_scenes())
    ],
)
def test_no_red_line(scene: Scene) -> None:
    outcome = outcome_of(scene)
    assert not outcome.is_red, (outcome.verdict, outcome.got, scene.expected, outcome.status, outcome.words)
