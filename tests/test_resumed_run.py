"""A run that was stopped goes on from what it has left, to the same figures."""

from __future__ import annotations

import json
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla import cli
from mbla.errors import FileError, UsageError
from mbla.process.run_options import RunOptions
from mbla.results import partial
from mbla.results.failures import StoppedRun
from mbla.results.hdf5.result_file import read_results_hdf5
from mbla.solution.solution import Status
from mbla.verify import verify_file
from tests.line import BLOCK
from tests.results.synthetic import same
from tests.shaken import SHAKEN

run = import_module("mbla.run").run  # the name in the package is the function
CHECKPOINT, LEFT = "block.partial.checkpoint", "block.partial.h5"


@pytest.fixture
def deck(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(partial, "FIRST", 0.0)
    Path("block.yaml").write_text(SHAKEN.replace("duration: 0.6", "duration: 0.3"), encoding="utf-8")
    return Path("block.yaml")


def stopped(deck: Path, after: int, **options: Any) -> None:
    """A run that is interrupted after so many steps."""
    count = 0

    def interrupt(case: str, record: Any) -> None:
        nonlocal count
        count += hasattr(record, "duration")
        if count >= after:
            raise KeyboardInterrupt

    with pytest.raises(StoppedRun):
        run(deck, RunOptions(**options), interrupt)


def test_a_time_history_goes_on_to_the_same_figures(deck: Path) -> None:
    whole = run(deck, RunOptions(folder=Path("whole.out")))
    stopped(deck, 25)
    folder = Path("block.out")
    assert (folder / CHECKPOINT).is_file()
    left = read_results_hdf5(folder / LEFT).cases[0].solution.further.time_history
    assert left.rows is not None
    assert 0.1 < left.rows.times[-1] < 0.15
    steps: list[float] = []
    again = run(deck, RunOptions(resume=True), lambda case, record: steps.append(getattr(record, "time", np.nan)))
    assert np.nanmin(steps) == pytest.approx(left.rows.times[-1] + 0.005, abs=0.006)
    one, other = (each.cases[0].solution.further.time_history for each in (whole, again))
    for name in ("rows", "histories", "peaks", "frames", "end"):
        assert same(getattr(one, name), getattr(other, name)), name
    assert again.cases[0].status is Status.SOLVED
    assert not list(folder.glob("*partial*"))
    assert verify_file(folder / "block.h5")[1] == ()


def test_stopped_twice(deck: Path) -> None:
    stopped(deck, 15)
    stopped(deck, 15, resume=True)
    left = read_results_hdf5(Path("block.out") / LEFT).cases[0].solution.further.time_history
    assert left.rows is not None
    assert len(left.rows) - 1 >= 28
    assert run(deck, RunOptions(resume=True)).cases[0].status is Status.SOLVED


def test_load_cases_that_were_done_are_not_solved_again(deck: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    two = BLOCK.replace("  push: {live", "  pull: {live: [{acceleration: [-2, 0, 0]}]}\n  push: {live")
    deck.write_text(two, encoding="utf-8")
    module = import_module("mbla.run")
    solve, solved = module.solve_case, list[str]()

    def once(*of_case: Any) -> Any:
        solved.append(of_case[2].name)
        if solved == ["pull", "push"]:
            raise KeyboardInterrupt
        return solve(*of_case)

    monkeypatch.setattr(module, "solve_case", once)
    with pytest.raises(StoppedRun):
        run(deck, RunOptions())
    results = run(deck, RunOptions(resume=True))
    assert solved == ["pull", "push", "push"]
    assert [case.load_case.name for case in results.cases] == ["pull", "push"]
    assert results.complete
    assert verify_file(Path("block.out/block.h5"))[1] == ()


def test_what_cannot_be_resumed(deck: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(UsageError, match="run it without --resume"):
        run(deck, RunOptions(resume=True))
    stopped(deck, 20)
    with pytest.raises(UsageError, match="of another deck"):
        run(deck, RunOptions(resume=True, overrides=("load_cases.quake.time_history.duration=1",)))
    assert cli.main(["run", "block.yaml", "--resume", "--set", "title=x", "--json"]) == 2
    assert json.loads(capsys.readouterr().out)["identifiers"] == ["resume-of-another"]
    path = Path("block.out") / CHECKPOINT
    sound = path.read_bytes()
    path.write_bytes(sound[: len(sound) // 2])
    with pytest.raises(FileError, match="damaged"):
        run(deck, RunOptions(resume=True))
    path.write_bytes(sound)
    assert cli.main(["run", "block.yaml", "--resume", "-q"]) == 0


@pytest.mark.long
def test_stopped_while_it_is_followed_with_half_of_the_step(deck: Path) -> None:
    text = SHAKEN.replace("step: 0.005", "step: 0.005\n      check: true").replace("duration: 0.6", "duration: 0.4")
    deck.write_text(text, encoding="utf-8")
    whole = run(deck, RunOptions(folder=Path("whole.out")))
    stopped(deck, 100)
    again = run(deck, RunOptions(resume=True))
    one, other = (each.cases[0].solution.further.time_history for each in (whole, again))
    for name in ("rows", "histories", "peaks", "frames", "half", "end"):
        assert same(getattr(one, name), getattr(other, name)), name
