"""The tests run nearly every line and branch of ``mbla/``, commands and children that they start included.

``[tool.coverage.run]`` of ``pyproject.toml`` says what is measured.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.decks.folder import ROOT
from tests.trust.counts import record_counts

LEAST = 0.95
STARTS = """
import subprocess, sys

def test_the_command_starts():
    subprocess.run([sys.executable, "-m", "mbla", "--help"], check=True, capture_output=True)
"""


def coverage(folder: Path, command: str, *options: str) -> int:
    """Exit status of a command of coverage.py, whose data are in a folder."""
    environment = {**os.environ, "COVERAGE_FILE": str(folder / "data")}
    call = [sys.executable, "-m", "coverage", command, "--rcfile", str(ROOT / "pyproject.toml"), *options]
    return subprocess.run(call, cwd=ROOT, env=environment, check=False).returncode


def gather(folder: Path, *options: str) -> int:
    """Exit status of pytest; the data of its process and its children are put together in the folder."""
    status = coverage(folder, "run", "-m", "pytest", "-p", "no:cacheprovider", *options)
    assert coverage(folder, "combine", "--quiet") == 0
    return status


def test_lines_that_a_child_runs_are_counted(tmp_path: Path) -> None:
    measured = pytest.importorskip("coverage")
    (tmp_path / "test_started.py").write_text(STARTS, encoding="utf-8")
    assert gather(tmp_path, "--rootdir", str(tmp_path), str(tmp_path)) == 0
    found = measured.CoverageData(str(tmp_path / "data"))
    found.read()
    assert found.has_arcs(), "branches are measured as well"
    assert str(ROOT / "mbla" / "cli" / "__init__.py") in found.measured_files()
    assert all(Path(file).is_relative_to(ROOT / "mbla") for file in found.measured_files())


@pytest.mark.trust
def test_lines_and_branches_of_the_program(tmp_path: Path) -> None:
    gather(tmp_path, "--deselect", str(Path(__file__).relative_to(ROOT)))
    report = tmp_path / "coverage.json"
    assert coverage(tmp_path, "json", "--quiet", "-o", str(report)) == 0
    found = json.loads(report.read_text(encoding="utf-8"))["totals"]
    assert found["covered_lines"] >= LEAST * found["num_statements"], found
    assert found["covered_branches"] >= LEAST * found["num_branches"], found
    record_counts(
        "coverage",
        90,
        "The tests run nearly every line of the program and take nearly every branch",
        {
            "lines": found["num_statements"],
            "of them run": found["covered_lines"],
            "branches": found["num_branches"],
            "of them taken": found["covered_branches"],
        },
    )
