"""A run that is stopped leaves the load cases that were done, and never touches an earlier result."""

from __future__ import annotations

import json
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

import mbla
from mbla import cli
from mbla.errors import SolverError
from mbla.process.signals import Terminated
from mbla.results.results import CaseResult
from mbla.solution.solution import Status
from tests.line import BLOCK

CASES = "load_cases:\n  push: {live: [{acceleration: [1, 0, 0]}]}\n  pull: {live: [{acceleration: [-2, 0, 0]}]}\n"
DECK = BLOCK.replace("load_cases:\n  push: {live: [{acceleration: [1, 0, 0]}]}\n", CASES)
PARTIAL = ["block.partial.h5", "block.partial.json", "block.partial.lst"]

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
        if of_case[3].name == name:
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


@pytest.mark.every(2)
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


def test_before_any_load_case_is_done_nothing_is_left(
    deck: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    stop_at("push", KeyboardInterrupt(), monkeypatch)
    code, record, err = printed(capsys, "run", str(deck), "other.yaml")
    assert (code, record["deck"], record["exit_code"]) == (130, "block.yaml", 130)
    assert err == "mbla: interrupted; no load case was done  [exit-130]\n"
    assert not Path("block.out").exists()


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
