"""With ``--json`` a command that fails prints one object a line and nothing else, whatever went wrong."""

from __future__ import annotations

import argparse
import errno
import json
from pathlib import Path
from typing import Any

import pytest

from mbla import cli
from mbla.cli import build_parser
from mbla.process.signals import Terminated
from mbla.results.explanations import explanations
from mbla.results.hdf5.result_file import write_results_hdf5
from tests.cli.test_sweep_commands import SWEEP
from tests.line import BLOCK
from tests.results.synthetic import tower_results

FILE = {
    "run": "deck",
    "check": "deck",
    "interact": "deck",
    "tradeoff": "deck",
    "find": "deck",
    "sweep": "sweep",
    "show": "result",
    "verify": "result",
    "assess": "result",
}
"""what a command with one file is about, as its object names it"""


FIND = ("--target", "load_factor=0.3", "--bounds", "0.1", "0.4")


def commands() -> dict[str, argparse.ArgumentParser]:
    """Those with ``--json``, by name."""
    (choices,) = (
        action.choices for action in build_parser()._actions if isinstance(action, argparse._SubParsersAction)
    )
    return {name: parser for name, parser in choices.items() if "--json" in parser.format_help()}


@pytest.fixture(scope="module")
def result() -> bytes:
    return write_results_hdf5(tower_results())


@pytest.fixture
def folder(tmp_path: Path, result: bytes, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("deck.yaml").write_text(BLOCK, encoding="utf-8")
    Path("block.yaml").write_text(BLOCK, encoding="utf-8")
    Path("sweep.yaml").write_text(SWEEP, encoding="utf-8")
    Path("result.h5").write_bytes(result)
    Path("cut.h5").write_bytes(result[:-100])
    Path("empty").touch()
    Path("binary").write_bytes(bytes(range(256)))
    Path("faulty.yaml").write_text(BLOCK + SWEEP + "surplus: 1\n", encoding="utf-8")
    Path("folder").mkdir()
    return tmp_path


def failure(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict[str, Any]:
    """The one object, which says what standard error and the exit status do."""
    capsys.readouterr()
    code = cli.main([*arguments, "--json"])
    out, err = capsys.readouterr()
    (line,) = out.splitlines()
    record: dict[str, Any] = json.loads(line)
    assert record["exit_code"] == code > 0
    assert len(record["errors"]) == len(record["identifiers"]) > 0
    assert set(record["identifiers"]) <= explanations().keys()
    assert all(text.splitlines()[0] in err and text.endswith("]") for text in record["errors"])
    assert "Traceback" not in err
    return record


def test_what_is_wrong_is_told_in_words(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    told = {
        ("run", "result.h5"): "result.h5:1:1 is an HDF5 file, not a deck: mbla show reads results  [not-utf-8]",
        ("sweep", "folder"): "mbla: folder: is a folder, not a sweep file  [folder-given]",
        ("run", "deck.yaml", "-o", ""): "mbla: run: argument -o/--output: '' is no name of a file or a folder",
        ("new", ""): "mbla: new '': is no name of a deck  [command-line]",
        ("new", "folder/"): "mbla: new 'folder/': is no name of a deck  [command-line]",
    }
    for arguments, words in told.items():
        assert cli.main(arguments) > 0
        assert words in capsys.readouterr().err
    assert not Path(".yaml").exists()


@pytest.mark.parametrize("name", FILE)
@pytest.mark.parametrize(
    ("given", "status"), [("none", 6), ("folder", 6), ("empty", None), ("binary", None), ("faulty.yaml", None)]
)
def test_a_file_that_cannot_be_read(
    folder: Path, name: str, given: str, status: int | None, capsys: pytest.CaptureFixture[str]
) -> None:
    record = failure(capsys, name, given)
    assert record["exit_code"] == (status or (6 if FILE[name] == "result" else 3))
    assert record[FILE[name]] == given


@pytest.mark.parametrize(
    ("arguments", "identifier"),
    [
        (["verify", "cut.h5"], "damaged-result-file"),
        (["explain", "nonsuch"], "explain-unknown"),
        (["run", "deck.yaml", "--case", "nonsuch"], "unknown-load-case"),
        (["run", "deck.yaml", "--set", "parameters.nonsuch=1"], "unknown-name"),
        (["run", "deck.yaml", "--set", "nonsense"], "set-refused"),
        (["run", "deck.yaml", "-o", "empty"], "file-not-written"),
        (["run", "deck.yaml", "folder/../deck.yaml"], "same-result-files"),
        (["check", "deck.yaml", "--vtu", "-o", "empty"], "file-not-written"),
        (["run", "deck.yaml", "--expected"], "no-expectations"),
        (["interact", "deck.yaml", "--case", "nonsuch"], "unknown-load-case"),
        (["interact", "deck.yaml", "--directions", "-1"], "interact-option"),
        (["find", "deck.yaml"], "find-option"),
        (["find", "deck.yaml", "--parameter", "parameters.nu", *FIND], "find-option"),
        (["find", "deck.yaml", "--parameter", "analysis.gap", *FIND], "find-option"),
        (["find", "deck.yaml", "--parameter", "parameters.mu", *FIND, "--case", "nonsuch"], "unknown-load-case"),
        (["find", "deck.yaml", "--parameter", "parameters.mu", *FIND, "--scan", "0"], "find-option"),
        (["find", "deck.yaml", "--parameter", "parameters.mu", *FIND, "--bounds", "2", "1"], "find-option"),
        (["find", "deck.yaml", "--target", "angle=3"], "command-line"),
        (["tradeoff", "deck.yaml", "--case", "nonsuch"], "unknown-load-case"),
        (["tradeoff", "deck.yaml", "--knob", "nonsense"], "tradeoff-option"),
        (["tradeoff", "deck.yaml", "--knob", "analysis.nonsuch=1,2"], "tradeoff-option"),
        (["run", "result.h5"], "not-utf-8"),
        (["run", "deck.yaml", "-o", ""], "command-line"),
        (["run", "deck.yaml", "--threads", "1" + "0" * 20], "command-line"),
        (["sweep", "sweep.yaml", "-j", "100000"], "command-line"),
        (["interact", "deck.yaml", "--directions", "many"], "command-line"),
        (["sweep", "sweep.yaml", "--scheduler-file", "none", "-j", "2"], "sweep-option"),
        (["sweep", "sweep.yaml", "--resume", "--force"], "sweep-option"),
        (["run", "deck.yaml", "none.yaml", "--nonsuch"], "command-line"),
        (["plot", "result.h5"], "command-line"),
        (["nonsuch"], "command-line"),
        ([], "command-line"),
    ],
)
def test_what_a_command_is_asked_and_cannot_do(
    folder: Path, arguments: list[str], identifier: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert failure(capsys, *arguments)["identifiers"] == [identifier]


def test_an_unknown_option_of_a_command_is_told_with_the_usage_of_that_command(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert cli.main(["show", "a.h5", "--nonsuch"]) == 2
    usage, *_, line = capsys.readouterr().err.splitlines()
    assert usage.startswith("usage: mbla show ")
    assert line == "mbla: show: unrecognized arguments: --nonsuch; see mbla show --help  [command-line]"
    assert cli.main(["--nonsuch", "show", "a.h5"]) == 2
    assert "unrecognized arguments: --nonsuch; see mbla --help" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("error", "status", "name"),
    [
        (KeyboardInterrupt(), 130, "run"),
        (Terminated(), 143, "show"),
        (MemoryError(), 7, "show"),
        (OSError(errno.EACCES, "Permission denied", "place"), 6, "show"),
        (ZeroDivisionError("float division by zero"), 1, "show"),
    ],
)
def test_whatever_ends_a_command(
    folder: Path,
    error: BaseException,
    status: int,
    name: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def broken() -> None:
        raise error

    monkeypatch.setattr(cli, "refuse_too_low_limits", broken)
    files = {"diff": ["a", "b"], "explain": []}.get(name, ["a"])
    assert failure(capsys, name, *files)["exit_code"] == status
