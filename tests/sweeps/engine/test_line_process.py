"""A process that answers in lines: how it is begun, ended, and told of when it is gone."""

from __future__ import annotations

import os
import sys
import time

import pytest

from mbla.sweeps.engine import line_process
from mbla.sweeps.engine.line_process import LineProcess

READY = "import sys, os, time; print('{}', flush=True); "


def process_that(code: str) -> LineProcess:
    process = LineProcess((sys.executable, "-c", READY + code))
    process.start()
    assert process.next(time.monotonic() + 30.0) == {}
    return process


def test_one_that_cannot_be_begun(tmp_path: os.PathLike[str]) -> None:
    process = LineProcess((f"{tmp_path}/none",))
    with pytest.raises(FileNotFoundError):
        process.start()
    assert not process.runs()


def test_what_is_said_to_one_that_is_gone_is_lost() -> None:
    process = process_that("sys.stdin.close(); sys.exit('enough')")
    assert process.next(time.monotonic() + 30.0) is None
    process.send({"task": "x" * 100_000})
    assert process.death() == "its process ended with status 1: enough"
    assert not process.runs()


def test_an_answer_that_does_not_come_in_time() -> None:
    process = process_that("time.sleep(60)")
    with pytest.raises(TimeoutError):
        process.next(time.monotonic() + 0.01)
    assert process.runs()
    process.stop()
    assert not process.runs()


@pytest.mark.parametrize(("says", "told"), [("", ""), ("print('tired', file=sys.stderr); ", ": tired")])
def test_one_that_closed_its_output_and_does_not_end_is_ended(
    monkeypatch: pytest.MonkeyPatch, says: str, told: str
) -> None:
    monkeypatch.setattr(line_process, "PATIENCE", 0.1)
    process = process_that(f"{says}os.close(1); time.sleep(60)")
    assert process.next(time.monotonic() + 30.0) is None
    assert process.runs()
    assert process.death() == f"its process closed its output and did not end{told}"
    assert not process.runs()
