"""The tests run nearly every line and branch of ``mbla/``."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.trust.counts import record_counts
from tests.trust.coverage.measuring import ROOT, gather, measure

LEAST = 0.95


def test_lines_that_a_child_runs_are_counted(tmp_path: Path) -> None:
    coverage = pytest.importorskip("coverage")
    assert gather(tmp_path, ["-p", "no:cacheprovider", "tests/trust/coverage/started.py"]) == 0
    found = coverage.CoverageData(str(tmp_path / "data"))
    found.read()
    assert found.has_arcs(), "branches are measured as well"
    assert str(ROOT / "mbla" / "cli" / "__init__.py") in found.measured_files()
    assert not any("tests" in Path(file).relative_to(ROOT).parts for file in found.measured_files())


@pytest.mark.trust
def test_lines_and_branches_of_the_program(tmp_path: Path) -> None:
    _, covered = measure(tmp_path, ["--deselect", str(Path(__file__).relative_to(Path.cwd()))])
    assert covered.lines_run >= LEAST * covered.lines, covered
    assert covered.branches_taken >= LEAST * covered.branches, covered
    record_counts(
        "coverage",
        90,
        "The tests run nearly every line of the program and take nearly every branch",
        {
            "lines": covered.lines,
            "of them run": covered.lines_run,
            "branches": covered.branches,
            "of them taken": covered.branches_taken,
        },
    )
