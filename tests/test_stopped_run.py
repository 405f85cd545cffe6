"""A run that is stopped leaves the load cases that were done, and never touches an earlier result."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

import mbla
from mbla import cli
from mbla.errors import DeckError, FileError, SolverError, UsageError
from mbla.process.signals import Terminated
from mbla.results import partial
from mbla.results.hdf5.result_file import read_results_hdf5, write_results_hdf5
from mbla.results.results import CaseResult
from mbla.solution.solution import Status
from mbla.verify import verify_file
from tests.line import BLOCK, WALL

CASES = "load_cases:\n  push: {live: [{acceleration: [1, 0, 0]}]}\n  pull: {live: [{acceleration: [-2, 0, 0]}]}\n"
DECK = BLOCK.replace("load_cases:\n  push: {live: [{acceleration: [1, 0, 0]}]}\n", CASES)
PARTIAL = [f"block.partial.{suffix}" for suffix in ("h5", "json", "lst", "sta")]

run_deck = import_module("mbla.run")  # the name in the package is the function


@pytest.fixture
def deck(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("block.yaml").write_text(DECK, encoding="utf-8")
    return Path("block.yaml")


def stop_at(name: str, error: BaseException, patch: pytest.MonkeyPatch) -> None:
    """Let the load case of that name end the run."""
    solve = run_deck.solve_case

    def solve_or_stop(*of_case: Any) -> CaseResult:
        if of_case[2].name == name:
            raise error
        solved: CaseResult = solve(*of_case)
        return solved

    patch.setattr(run_deck, "solve_case", solve_or_stop)


def names(folder: str = "block.out") -> list[str]:
    return sorted(path.name for path in Path(folder).iterdir())


def printed(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, dict[str, Any], str]:
    """Exit status, the one JSON object, standard error."""
    capsys.readouterr()
    code = cli.main([*arguments, "--json"])
    out, err = capsys.readouterr()
    return code, json.loads(out), err


@pytest.mark.every(3)
@pytest.mark.parametrize(
    ("error", "status", "identifier"),
    [
        (KeyboardInterrupt(), 130, "exit-130"),
        (Terminated(), 143, "exit-143"),
        (MemoryError(), 7, "out-of-memory"),
        (SolverError("factorisation-missing", "no"), 4, "factorisation-missing"),
        (ZeroDivisionError("float division by zero"), 1, "internal-error"),
    ],
)
def test_load_cases_that_were_done_are_left_and_told(
    deck: Path,
    error: BaseException,
    status: int,
    identifier: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    stop_at("pull", error, monkeypatch)
    code, record, err = printed(capsys, "run", str(deck))
    assert (code, record["exit_code"], record["identifiers"]) == (status, status, [identifier])
    assert [(case["name"], round(case["load_factor"], 6)) for case in record["cases"]] == [("push", 0.5)]
    assert (record["complete"], record["not_done"], record["files"]) == (False, ["pull"], PARTIAL)
    assert "load cases done: 1 of 2, in block.out/block.partial.h5" in err
    assert "push solved 0.5" in " ".join(err.split())
    assert names() == PARTIAL
    code, shown, _ = printed(capsys, "show", "block.out/block.partial.h5")
    assert (code, shown["complete"], shown["not_done"]) == (0, False, ["pull"])
    code, shown, _ = printed(capsys, "verify", "block.out/block.partial.h5")
    assert (code, shown["agrees"], shown["complete"]) == (4, True, False)
    for command in ("show", "verify"):
        cli.main([command, "block.out/block.partial.h5"])
        words = " ".join(capsys.readouterr().out.split())
        assert "load cases done: 1 of 2; not done: pull" in words


def test_what_a_partial_file_says_of_its_run_is_held_against_it(deck: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A case that was done and is gone, told as not done or not at all, and another cause of the end."""
    stop_at("pull", KeyboardInterrupt(), monkeypatch)
    assert cli.main(["run", str(deck), "-q"]) == 130
    path = Path("block.out/block.partial.h5")
    sound = read_results_hdf5(path)

    def said_of(**changes: Any) -> tuple[int, str]:
        path.write_bytes(write_results_hdf5(replace(sound, **changes)))
        again, disagreements = verify_file(path)
        return again.exit_code, "\n".join((*disagreements, *again.unconfirmed))

    assert said_of() == (4, "")
    assert "does not say what stopped the run" in said_of(cases=(), not_done=("push", "pull"))[1]
    assert "its last remark does not say" in said_of(not_done=())[1]
    assert "are no others of the deck" in said_of(not_done=("push", "pull"))[1]
    assert "does not say what stopped the run" in said_of(cases=())[1]


def test_an_earlier_result_stays_and_a_whole_one_takes_the_place_of_what_was_left(
    deck: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["run", str(deck), "-q"]) == 0
    earlier = {path.name: path.read_bytes() for path in Path("block.out").iterdir()}
    with monkeypatch.context() as patch:
        stop_at("pull", KeyboardInterrupt(), patch)
        for _ in range(2):  # what a stopped run left gives way to what another leaves
            assert cli.main(["run", str(deck), "-q", "--force"]) == 130
    assert {name: Path("block.out", name).read_bytes() for name in earlier} == earlier
    assert names() == sorted([*earlier, *PARTIAL])
    assert cli.main(["run", str(deck), "-q", "--force"]) == 0
    assert names() == sorted(earlier)


def test_before_any_load_case_is_done_its_lines_are_left(
    deck: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    stop_at("push", KeyboardInterrupt(), monkeypatch)
    code, record, err = printed(capsys, "run", str(deck), "other.yaml")
    assert (code, record["deck"], record["exit_code"], record["cases"]) == (130, "block.yaml", 130, [])
    first = err.splitlines()[0]
    assert first == "mbla: interrupted; load cases done: 0 of 2, in block.out/block.partial.h5  [exit-130]"
    assert names() == PARTIAL
    assert Path("block.out/block.partial.sta").read_text(encoding="utf-8").startswith("# mbla status file")
    code, shown, _ = printed(capsys, "verify", "block.out/block.partial.h5")
    assert (code, shown["agrees"], shown["not_done"]) == (4, True, ["push", "pull"])


@pytest.mark.parametrize("error", [UsageError("no-expectations", "none"), DeckError([])])
def test_what_is_refused_leaves_nothing(deck: Path, error: BaseException, monkeypatch: pytest.MonkeyPatch) -> None:
    at_once(monkeypatch)
    stop_at("pull", error, monkeypatch)
    with pytest.raises(type(error)):
        mbla.run(deck, output="block.out")
    assert not Path("block.out").exists()


def test_on_a_full_disk_what_was_written_before_stays(deck: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    at_once(monkeypatch)
    stop_at("pull", FileError("file-not-written", "full"), monkeypatch)
    with pytest.raises(FileError) as refused:
        mbla.run(deck, output="block.out")
    assert refused.value.__notes__ == ["load cases done: 1 of 2, in block.out/block.partial.h5"]
    assert names() == PARTIAL[:3]
    assert mbla.read_results("block.out/block.partial.h5")["push"].status == Status.SOLVED


def test_a_result_of_another_deck_is_not_overwritten(
    deck: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    other = Path("block.partial.yaml")
    other.write_text(DECK, encoding="utf-8")
    assert cli.main(["run", str(other), "-q", "-o", "block.out"]) == 0
    before = {path.name: path.read_bytes() for path in Path("block.out").iterdir()}
    at_once(monkeypatch)
    stop_at("pull", KeyboardInterrupt(), monkeypatch)
    code, record, err = printed(capsys, "run", str(deck))
    assert (code, len(record["cases"]), record["files"]) == (130, 1, [])
    assert "load cases done: 1 of 2, which could not be written: block.out/block.partial.h5: exists already" in err
    assert {path.name: path.read_bytes() for path in Path("block.out").iterdir()} == before


def at_once(patch: pytest.MonkeyPatch) -> None:
    """Let partial results be written as soon as there are any."""
    patch.setattr(partial, "FIRST", 0.0)


def test_stopped_while_its_files_are_written(
    deck: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """ParaView files and pictures may take long; all load cases are done by then."""

    def interrupted(*what: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("mbla.results.write.write_mesh_files", interrupted)
    code, record, _ = printed(capsys, "run", str(deck))
    assert (code, len(record["cases"]), record["complete"], record["not_done"]) == (130, 2, False, [])
    assert names() == PARTIAL


def test_in_python_it_is_the_interruption_itself(deck: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    stop_at("pull", KeyboardInterrupt(), monkeypatch)
    with pytest.raises(KeyboardInterrupt):
        mbla.run(deck, output="out")
    left = mbla.read_results("out/block.partial.h5")
    assert left["push"].status == Status.SOLVED
    assert left["push"].verified
    assert not left.verified
    assert left.exit_code == 130


# --- processes that are killed ---------------------------------------------------------------------------------------

PUSHED = """
output: {vtu: false}
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
  onward: {live: [{acceleration: [1, 0, 0]}], pushover: {step: 1e-5, steps: 100000}}
"""
PUSHED_DECK = WALL[: WALL.index("load_cases:")] + PUSHED.lstrip()
PATIENCE = 120.0
"""seconds"""


def begun(*options: str) -> subprocess.Popen[bytes]:
    """A run of the wall, whose last load case has no end soon."""
    Path("wall.yaml").write_text(PUSHED_DECK, encoding="utf-8")
    return subprocess.Popen([sys.executable, "-m", "mbla", "run", "wall.yaml", "-q", *options])


def wait_for(happened: Callable[[], bool]) -> None:
    until = time.monotonic() + PATIENCE
    while not happened():
        assert time.monotonic() < until, "it has not come so far"
        time.sleep(0.02)


def test_a_killed_run_leaves_load_cases_and_steps_that_are_done(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    run = begun()
    wait_for(Path("wall.out/wall.partial.h5").exists)
    run.kill()
    assert run.wait() == -signal.SIGKILL
    code, shown, _ = printed(capsys, "show", "wall.out/wall.partial.h5")
    assert (code, shown["complete"], shown["exit_code"], shown["not_done"][-1]) == (0, False, 137, "onward")
    assert [case["status"] for case in shown["cases"]] == ["solved"] * len(shown["cases"])
    cli.main(["show", "wall.out/wall.partial.h5"])
    assert "the run was stopped (killed, or still at work); load cases done: " in flat(capsys)
    code, shown, _ = printed(capsys, "verify", "wall.out/wall.partial.h5")
    assert (code, shown["agrees"]) == (4, True)
    assert cli.main(["run", "wall.yaml", "-q", "--case", "push"]) == 0
    assert [name for name in names("wall.out") if "partial" in name] == []


@pytest.mark.long
def test_an_interrupted_pushover_leaves_its_steps(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    run = begun("--case", "onward")
    lines = Path("wall.out/wall.sta")
    wait_for(lambda: lines.exists() and lines.read_text("utf-8").partition("# onward: solved")[2].count("\n") > 150)
    run.send_signal(signal.SIGINT)
    assert run.wait() == 130
    code, shown, _ = printed(capsys, "show", "wall.out/wall.partial.h5")
    (case,) = shown["cases"]
    assert (shown["not_done"], case["curve_end"]) == (["onward"], "the run was stopped")
    assert len(case["curve"]) > 2
    assert all(row["residual"] < 1e-5 for row in case["curve"][1:])
    cli.main(["show", "wall.out/wall.partial.h5"])
    assert f"not done: onward (its pushover came to step {len(case['curve']) - 1})" in flat(capsys)
    assert "# onward: solved" in Path("wall.out/wall.partial.sta").read_text(encoding="utf-8")
    code, shown, _ = printed(capsys, "verify", "wall.out/wall.partial.h5")
    assert (code, shown["agrees"]) == (4, True)


def flat(capsys: pytest.CaptureFixture[str]) -> str:
    """What was printed, in one line."""
    return " ".join(capsys.readouterr().out.split())
