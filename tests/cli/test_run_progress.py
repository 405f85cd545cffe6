"""What a terminal shows of a structure in time."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mbla.cli.run import in_time
from mbla.solution.time_history.progress import TimeProgress

STEP = TimeProgress(9.0, 25.0, 4500, 9000, 3e-5, 2e-14, 36, 4, 0, 45.0)
BEGIN = replace(STEP, time=0.0, seconds=0.0)


def test_a_bar_with_the_time_to_go() -> None:
    assert in_time("quake", STEP, BEGIN) == "quake: [#########...............]  36 %, 9 of 25 s, 1 min 20 s to go"
    half = replace(STEP, half=True, missed=2)
    assert in_time("quake", half, BEGIN).startswith("quake, half of the step: [###")
    assert in_time("quake", half, BEGIN).endswith(" to go, 2 steps missed")
    assert in_time("quake", STEP, STEP).endswith("9 of 25 s")


@pytest.mark.parametrize(
    ("time", "seconds", "words"),
    [(25.0, 3.0, "0 s to go"), (12.5, 41.2, "41 s to go"), (0.25, 76.0, "2 h 5 min to go")],
)
def test_the_time_to_go_in_words(time: float, seconds: float, words: str) -> None:
    assert in_time("quake", replace(STEP, time=time, seconds=seconds), BEGIN).endswith(words)


def test_speed_counts_from_where_a_run_goes_on() -> None:
    resumed = replace(STEP, time=8.0, seconds=0.5)
    assert STEP.to_go(resumed) == pytest.approx(16.0 * 44.5)
