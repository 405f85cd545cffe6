"""Every short scene in the normal run, the others under ``-m long``: no red line."""

from __future__ import annotations

import pytest

from tests.extremes.outcome import Scene, outcome_of
from tests.extremes.scenes import all_scenes


@pytest.mark.parametrize(
    "scene",
    [
        pytest.param(scene, id=f"{scene.family}: {scene.name}", marks=[pytest.mark.long] if scene.long else [])
        for scene in all_scenes()
    ],
)
def test_no_red_line(scene: Scene) -> None:
    outcome = outcome_of(scene)
    assert not outcome.is_red, (outcome.verdict, outcome.got, scene.expected, outcome.status, outcome.words)
