"""Points beyond their limits, and one that kills its process: the others are done, and it is told which and why."""

from __future__ import annotations

import csv
import sys
from functools import partial
from pathlib import Path

import pytest

from mbla.cli import main
from mbla.sweeps.engine import processes
from mbla.sweeps.engine.supervised import SupervisedRunner
from tests.line import BLOCK
from tests.sweeps import faulty_child
from tests.sweeps.faulty_child import HANGS, KILLS, LOG, TAKES
from tests.sweeps.killed_sweeps import keys_in_journals

pytestmark = pytest.mark.long

POINTS = 8
SWEEP = f"""\
mbla_sweep: 1
deck: block.yaml
parameters:
  mu: {{linear: {{from: 0.1, to: 0.45, points: {POINTS}}}}}
limits: {{time: 10, memory: 500}}
"""
"""ten seconds: thousands of times what a point of one block takes, so that a busy machine stops no other"""
REASONS = {
    KILLS: (
        "1",
        "2",
        "its process was ended by SIGKILL, as the system does where memory runs out; given up after 2 tries",
    ),
    HANGS: ("7", "1", "stopped at the limit of 10 s for a point"),
    TAKES: ("7", "2", "more than the 500 MB of memory that a point may take"),
}
"""exit code, tries and reason of each; memory is tried again in a fresh process, so that no earlier point counts"""


@pytest.mark.parametrize("workers", ["1", "2"])
def test_limits(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, workers: str) -> None:
    """Each fails for its reason, is not begun again by --resume, and is by --retry-failed."""
    (tmp_path / "block.yaml").write_text(BLOCK, encoding="utf-8")
    path, folder, log = tmp_path / "sweep.yaml", tmp_path / "sweep.out", tmp_path / "begun"
    path.write_text(SWEEP, encoding="utf-8")
    monkeypatch.setenv(LOG, str(log))
    command = ["sweep", str(path), "-q", "-j", workers]
    with monkeypatch.context() as patch:
        faulty = partial(SupervisedRunner, command=(sys.executable, "-P", str(Path(faulty_child.__file__))))
        patch.setattr(processes, "SupervisedRunner", faulty)
        assert main(command) == 8
        check_rows(folder)
        begun = sorted(int(line) for line in log.read_text(encoding="ascii").split())
        assert begun == sorted([*range(1, POINTS + 1), KILLS, TAKES])
        (folder / "sweep.csv").unlink()
        assert main([*command, "--resume"]) == 8
        check_rows(folder)
        assert len(log.read_text(encoding="ascii").split()) == len(begun)
    assert main([*command, "--retry-failed"]) == 0
    assert {row["state"] for row in rows_of(folder)} == {"done"}
    assert len(keys_in_journals(folder)) == POINTS + len(REASONS)  # the rows of the failures stay


def check_rows(folder: Path) -> None:
    """What failed has no value, and its reason; what did not has both."""
    for row in rows_of(folder):
        number = int(row["point"])
        if number in REASONS:
            assert (row["state"], row["load_factor"]) == ("failed", "")
            assert (row["exit_code"], row["tries"], row["reason"]) == REASONS[number]
        else:
            assert (row["state"], row["exit_code"], row["tries"], row["reason"]) == ("done", "0", "1", "")
            assert float(row["load_factor"]) == pytest.approx(float(row["mu"]), rel=1e-6)


def rows_of(folder: Path) -> list[dict[str, str]]:
    """Of the table."""
    with (folder / "sweep.csv").open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))
