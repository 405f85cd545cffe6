"""The process that measures, seen from the parent: how its end is told, and that nothing is left of it."""

from __future__ import annotations

import json
import sys
import time
from dataclasses import asdict
from pathlib import Path

import pytest

from mbla.sweeps.measure.measured_run import Task
from mbla.sweeps.measure.measuring import MeasuringProcess
from tests.line import BLOCK
from tests.sweeps.tradeoff.hand_made import SOLVED

READY = 'import sys, os, time; print("{\\"ready\\": true}", flush=True); sys.stdin.readline(); '


def process_that(code: str, *, ready: bool = True) -> MeasuringProcess:
    return MeasuringProcess((sys.executable, "-c", (READY if ready else "import sys; ") + code))


def test_killed_from_outside() -> None:
    with process_that("os.kill(os.getpid(), 9)") as process:
        run = process.run(Task("deck.yaml"))
    assert (run.end, run.words) == (
        "died",
        "its process was ended by SIGKILL, as the system does where memory runs out",
    )


def test_one_that_breaks_says_its_last_words() -> None:
    with process_that('sys.exit("no such thing")') as process:
        run = process.run(Task("deck.yaml"))
    assert run.words == "its process ended with status 1: no such thing"
    with process_that('sys.exit("cannot import")', ready=False) as process:
        assert process.run(Task("deck.yaml")).words == "its process ended with status 1: cannot import"


def test_load_cases_done_before_the_copy_died_are_kept() -> None:
    line = json.dumps({"measurement": asdict(SOLVED) | {"residual": 1e-9, "memory": 1.0}})
    with process_that(f"print({line!r}); print('{{\"gone\": -11}}', flush=True); time.sleep(60)") as process:
        run = process.run(Task("deck.yaml"))
    assert run.end == "died"
    assert "SIGSEGV" in run.words
    assert [measurement.case for measurement in run.measurements] == ["push"]


@pytest.mark.parametrize("limit", ["seconds", "until"])
def test_stopped_at_its_limit_and_gone_with_its_copies(tmp_path: Path, limit: str) -> None:
    mark = tmp_path / "numbers"
    code = f"copy = os.fork(); open({str(mark)!r}, 'a').write(f'{{os.getpid()}} '); time.sleep(60)"
    seconds, until = (1.5, None) if limit == "seconds" else (None, time.monotonic() + 3.0)
    with process_that(code) as process:
        assert process.run(Task("deck.yaml"), until, seconds).end == "stopped"
        seen = time.monotonic()
        numbers = [int(number) for number in mark.read_text().split()]
        assert len(numbers) == 2
        while any(map(runs, numbers)) and time.monotonic() < seen + 30.0:
            time.sleep(0.01)  # a copy's own end is told to nobody, and takes a moment on a busy machine
        assert not any(map(runs, numbers))


def runs(number: int) -> bool:
    """Whether a process runs; one that is dead and only waits to be asked for its status does not."""
    try:
        state = Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state not in "ZX"


def test_a_deck_with_faults_is_told_by_the_process_that_measures(tmp_path: Path) -> None:
    """Faults that come with a setting or after the parent read the deck; the process goes on to the next task."""
    deck = tmp_path / "block.yaml"
    deck.write_text(BLOCK, encoding="utf-8")
    with MeasuringProcess() as process:
        refused = process.run(Task(str(deck), overrides=("parameters.h=-1",)))
        unfit = process.run(Task(str(deck), overrides=("analysis.solver=highs", "analysis.reductions=false")))
        gone = process.run(Task(str(tmp_path / "none.yaml")))
        sound = process.run(Task(str(deck), overrides=("parameters.mu=0.4", "analysis.accuracy=draft")))
    assert (refused.end, refused.measurements) == ("unfit", ())
    assert "block.yaml:" in refused.words
    assert "blocks" in refused.words
    assert unfit.end == "unfit"
    assert "highs solves linear programs only" in unfit.words
    assert gone.end == "failed"
    assert "none.yaml" in gone.words
    assert sound.end == "done"
    assert [measurement.answer for measurement in sound.measurements] == [pytest.approx(0.4, rel=1e-6)]
