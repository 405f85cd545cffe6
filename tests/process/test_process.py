"""Interruptions that wait, the garbage collector, and seconds by stage."""

from __future__ import annotations

import gc
import signal
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from mbla.process.collector import loading, no_collection
from mbla.process.signals import held_signals
from mbla.process.stopwatch import stage, timing


def test_a_signal_counts_at_the_end_of_the_block() -> None:
    done: list[str] = []

    def work() -> None:
        with held_signals():
            signal.raise_signal(signal.SIGINT)
            done.append("whole")

    with pytest.raises(KeyboardInterrupt):
        work()
    assert done == ["whole"]


def test_handlers_are_as_they_were_and_blocks_may_stand_in_blocks() -> None:
    before = signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)
    done: list[str] = []

    def work() -> None:
        with held_signals():
            with held_signals():
                signal.raise_signal(signal.SIGINT)
            done.append("the outer block goes on")

    with pytest.raises(KeyboardInterrupt):
        work()
    assert done == ["the outer block goes on"]
    assert (signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)) == before


def test_other_threads_are_never_interrupted() -> None:
    done: list[str] = []

    def work() -> None:
        with held_signals():
            done.append("whole")

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert done == ["whole"]


@pytest.fixture
def delivered() -> Iterator[list[int]]:
    """Numbers of the signals that reach the handler of SIGTERM."""
    numbers: list[int] = []
    earlier = signal.signal(signal.SIGTERM, lambda number, frame: numbers.append(number))
    yield numbers
    signal.signal(signal.SIGTERM, earlier)


def test_whether_a_signal_has_arrived_is_known_in_the_block(delivered: list[int]) -> None:
    with held_signals() as signalled:
        assert not signalled()
        signal.raise_signal(signal.SIGTERM)
        assert signalled()
        assert delivered == []
    assert delivered == [signal.SIGTERM]


def test_an_ignored_signal_stays_ignored() -> None:
    earlier = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with held_signals() as signalled:
            signal.raise_signal(signal.SIGINT)
            assert not signalled()
        assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGINT, earlier)


# The garbage collector is paused, given back as it was found, and passes over what was loaded.


def _fail_within() -> None:
    with no_collection():
        assert not gc.isenabled()
        raise KeyError


@pytest.mark.parametrize("enabled", [True, False])
def test_the_collector_is_given_back_as_it_was(enabled: bool) -> None:
    was_enabled = gc.isenabled()
    try:
        (gc.enable if enabled else gc.disable)()
        with pytest.raises(KeyError):
            _fail_within()
        assert gc.isenabled() is enabled
    finally:
        (gc.enable if was_enabled else gc.disable)()


def test_what_is_loaded_is_passed_over_and_nothing_else(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a_module_to_be_loaded.py").write_text("held = [[] for _ in range(1000)]\n", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    try:
        before = gc.get_freeze_count()
        with loading():
            import json  # noqa: F401
        assert gc.get_freeze_count() == before  # it was there already
        with loading():
            import a_module_to_be_loaded  # type: ignore[import-not-found]  # noqa: F401
        assert gc.get_freeze_count() >= before + 1000
    finally:
        gc.unfreeze()
        sys.modules.pop("a_module_to_be_loaded", None)


# Seconds by stage: each without what the stages inside it take, nothing without a stopwatch.


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
    @stage("again")
    def work(times: int) -> None:
        clock.now += 1.0
        if times > 1:
            work(times - 1)

    with timing() as stopwatch:
        work(3)
        work(1)
    assert stopwatch.seconds == {"again": 4.0}


def test_a_stage_that_fails_is_timed_and_leaves_no_trace(clock: Clock) -> None:
    @stage("inner")
    def break_off() -> None:
        clock.now += 1.0
        raise ValueError("broken")

    with timing() as stopwatch, stage("outer"):
        with pytest.raises(ValueError, match="broken"):
            break_off()
        clock.now += 2.0
    assert stopwatch.seconds == {"inner": 1.0, "outer": 2.0}
