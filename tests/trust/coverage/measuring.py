"""The tests run under coverage.py, and its totals."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[3]


@dataclass(frozen=True)
class Covered:
    """Lines that can run and branches that can be taken, and how many were."""

    lines: int
    lines_run: int
    branches: int
    branches_taken: int

    def __str__(self) -> str:
        return (
            f"{self.lines_run} of {self.lines} lines, {100 * self.lines_run / self.lines:.1f} %; "
            f"{self.branches_taken} of {self.branches} branches, {100 * self.branches_taken / self.branches:.1f} %"
        )


def measure(folder: Path, options: Sequence[str]) -> tuple[int, Covered]:
    """Exit status of pytest, and what its tests covered; files of coverage.py go to a folder."""
    return gather(folder, options), totals(folder)


def gather(folder: Path, options: Sequence[str]) -> int:
    """Exit status of pytest; the data of its process and its children are put together in the folder."""
    status = _coverage(folder, "run", "-m", "pytest", *options)
    _done(_coverage(folder, "combine", "--quiet"))
    return status


def totals(folder: Path) -> Covered:
    """Of the data in a folder, combined before."""
    report = folder / "coverage.json"
    _done(_coverage(folder, "json", "--quiet", "-o", str(report)))
    found = json.loads(report.read_text(encoding="utf-8"))["totals"]
    return Covered(
        lines=found["num_statements"],
        lines_run=found["covered_lines"],
        branches=found["num_branches"],
        branches_taken=found["covered_branches"],
    )


def report(folder: Path) -> None:
    """Print the modules that are not covered whole, with their lines."""
    _done(_coverage(folder, "report", "--show-missing", "--skip-covered"))


def _coverage(folder: Path, command: str, *options: str) -> int:
    environment = {**os.environ, "COVERAGE_FILE": str(folder / "data")}
    settings = ["--rcfile", str(ROOT / "pyproject.toml")]
    call = [sys.executable, "-m", "coverage", command, *settings, *options]
    return subprocess.run(call, cwd=ROOT, env=environment, check=False).returncode


def _done(status: int) -> None:
    if status != 0:
        raise RuntimeError(f"coverage ended with exit status {status}")
