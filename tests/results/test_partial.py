"""When partial results are written: as soon as there are any, and then only after much more time than writing takes."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from mbla.deck.content import OutputSection
from mbla.errors import FileError
from mbla.results import partial
from mbla.results.files import OutputFolder
from mbla.results.partial import FIRST, LAST, SHARE, Partial

TAKES = 2.0
"""seconds that writing takes"""


class Clock:
    """Time that passes when it is told to, and while partial results are written."""

    def __init__(self) -> None:
        self.now = 0.0
        self.written: list[float] = []
        self.error: Exception | None = None

    def perf_counter(self) -> float:
        return self.now

    def write(self, *of_run: Any) -> None:
        self.written.append(self.now)
        self.now += TAKES
        if self.error is not None:
            raise self.error


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    clock = Clock()
    monkeypatch.setattr(partial, "time", clock)
    monkeypatch.setattr(Partial, "_write", clock.write)
    return clock


@pytest.fixture
def run(clock: Clock, tmp_path: Path) -> Partial:
    begun = Partial(OutputFolder(tmp_path, "wall"), OutputSection())
    begun.done(results(0))
    return begun


def results(done: int, of: int = 3) -> Any:
    return SimpleNamespace(cases=("case",) * done, not_done=("case",) * (of - done))


def at(clock: Clock, moment: float, run: Partial) -> None:
    clock.now = moment
    run.keep()


def test_a_load_case_is_written_when_it_is_done_and_the_next_after_a_while(run: Partial, clock: Clock) -> None:
    at(clock, 10.0, run)
    assert clock.written == []  # nothing is done yet
    run.done(results(1))
    assert clock.written == [10.0]
    run.done(results(2))
    at(clock, 10.0 + TAKES + 0.99 * SHARE * TAKES, run)
    assert clock.written == [10.0]
    at(clock, 10.0 + TAKES + SHARE * TAKES, run)
    assert len(clock.written) == 2
    at(clock, 1000.0, run)
    assert len(clock.written) == 2  # nothing new


def test_a_run_of_an_instant_writes_none(run: Partial, clock: Clock) -> None:
    clock.now = 0.9 * FIRST
    run.done(results(1))
    clock.now = 0.9 * LAST
    run.done(results(3))
    assert clock.written == []


def test_what_is_worked_at_is_new_all_the_time(run: Partial, clock: Clock) -> None:
    run.at_work(lambda: results(1))
    for moment in (1.0, 50.0, 100.0, 101.0):
        at(clock, moment, run)
    assert clock.written == [1.0, 50.0, 100.0]


def test_where_they_cannot_be_written_the_run_goes_on_without(run: Partial, clock: Clock) -> None:
    clock.error = FileError("file-not-written", "full")
    clock.now = 10.0
    run.done(results(1))
    run.done(results(2))
    at(clock, 1000.0, run)
    assert clock.written == [10.0]
