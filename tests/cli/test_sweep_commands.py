"""The command line of parameter sweeps as scripts use it: standard output, exit status."""

from __future__ import annotations

import io
import json
import sys
from pathlib import Path
from typing import Any

import pytest

from mbla.cli import main
from tests.line import BLOCK

SWEEP = "mbla_sweep: 1\ndeck: block.yaml\nparameters: {mu: {values: [0.4, 0.5]}}\n"


@pytest.fixture
def sweep(tmp_path: Path) -> Path:
    (tmp_path / "block.yaml").write_text(BLOCK, encoding="utf-8")
    path = tmp_path / "friction.yaml"
    path.write_text(SWEEP, encoding="utf-8")
    return path


def failure(capsys: pytest.CaptureFixture[str], *arguments: str | Path) -> tuple[int, dict[str, Any], list[str]]:
    """Exit status, the one object on standard output, the lines on standard error."""
    code = main([str(argument) for argument in arguments])
    captured = capsys.readouterr()
    return code, json.loads(captured.out), captured.err.splitlines()


@pytest.mark.parametrize("option", ["--json", "--dry-run"])
def test_a_faulty_sweep_file_is_told_as_an_object_too(
    sweep: Path, capsys: pytest.CaptureFixture[str], option: str
) -> None:
    sweep.write_text(SWEEP.replace("values", "valves") + "surplus: 1\n", encoding="utf-8")
    code, record, lines = failure(capsys, "sweep", sweep, option, "--json")
    assert code == record["exit_code"] == 3
    assert record["sweep"] == "friction.yaml"
    assert record["errors"] == lines
    assert len(lines) == 2
    assert "valves" in lines[0]
    assert "surplus" in lines[1]
    assert not sweep.with_suffix(".out").exists()


@pytest.mark.every(2)
@pytest.mark.parametrize("gone", ["closed", "broken"])
def test_a_sweep_goes_on_where_nobody_reads_what_it_says(
    sweep: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, gone: str
) -> None:
    """The window was closed, or the program that a log was piped into has ended; a point fails, of which it tells."""
    sweep.write_text(SWEEP.replace("0.5]", "-1]"), encoding="utf-8")
    monkeypatch.setattr("sys.stderr", None if gone == "closed" else Broken())
    assert main(["sweep", str(sweep)]) == 8
    sys.stderr.close()
    assert "2: 1 done, 1 failed" in capsys.readouterr().out


class Broken(io.StringIO):
    """A stream whose reader has gone."""

    def write(self, text: str) -> int:
        raise BrokenPipeError


def test_a_dry_run_tells_the_points_and_writes_nothing(sweep: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sweep", str(sweep), "--dry-run"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[-3:] == ["  point   mu", "      1  0.4", "      2  0.5"]
    code, record, lines = failure(capsys, "sweep", sweep, "--dry-run", "--json")
    assert (code, lines) == (0, [])
    assert (record["sweep"], record["different"], len(record["keys"])) == ("friction.yaml", 2, 2)
    assert not sweep.with_suffix(".out").exists()
