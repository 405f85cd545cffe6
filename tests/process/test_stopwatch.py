"""Seconds by stage: each without what the stages inside it take, nothing without a stopwatch."""

from __future__ import annotations

import time

import pytest

from mbla.process.stopwatch import stage, timed, timing


class Clock:
    """A clock that stands still unless it is told how long something takes."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    clock = Clock()
    monkeypatch.setattr(time, "perf_counter", clock)
    return clock


def test_a_stage_leaves_out_the_stages_inside_it(clock: Clock) -> None:
    with timing() as stopwatch, stage("outer"):
        clock.now += 1.0
        with stage("inner"):
            clock.now += 10.0
            with stage("innermost"):
                clock.now += 100.0
        clock.now += 2.0
    assert stopwatch.seconds == {"innermost": 100.0, "inner": 10.0, "outer": 3.0}


def test_times_of_one_stage_add_up_also_inside_itself(clock: Clock) -> None:
    @timed("again")
    def work(times: int) -> None:
        clock.now += 1.0
        if times > 1:
            work(times - 1)

    with timing() as stopwatch:
        work(3)
        work(1)
    assert stopwatch.seconds == {"again": 4.0}


def test_a_stage_that_fails_is_timed_and_leaves_no_trace(clock: Clock) -> None:
    @timed("inner")
    def break_off() -> None:
        clock.now += 1.0
        raise ValueError("broken")

    with timing() as stopwatch, stage("outer"):
        with pytest.raises(ValueError, match="broken"):
            break_off()
        clock.now += 2.0
    assert stopwatch.seconds == {"inner": 1.0, "outer": 2.0}
