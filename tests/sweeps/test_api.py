"""Sweeps from Python: the table of the command, nothing printed, and the same refusals as errors."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import mbla
from tests.line import BLOCK

SWEEP = "mbla_sweep: 1\ndeck: block.yaml\nparameters: {mu: {values: [0.3, 0.4]}}\n"


@pytest.fixture
def sweep(tmp_path: Path) -> Path:
    (tmp_path / "block.yaml").write_text(BLOCK, encoding="utf-8")
    path = tmp_path / "friction.yaml"
    path.write_text(SWEEP, encoding="utf-8")
    return path


def test_the_table_and_its_files(sweep: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """A block that slides at its friction; going on takes what the journal has, and solves what was added."""
    told: list[tuple[int, int]] = []
    table = mbla.sweep(sweep, output=sweep.parent / "out", progress=lambda done, count: told.append((done, count)))
    assert isinstance(table, mbla.SweepTable)
    assert table["load_factor"] == pytest.approx([0.3, 0.4], rel=1e-6)
    assert told == [(0, 2), (1, 2), (2, 2)]
    assert table.title == "friction.yaml", "the sweep has none of its own"
    sweep.write_text(SWEEP.replace("0.4]", "0.4, 0.2]"), encoding="utf-8")
    told.clear()
    more = mbla.sweep(sweep, output=sweep.parent / "out", resume=True, progress=lambda *counts: told.append(counts))
    assert told == [(2, 3), (3, 3)]
    assert np.array_equal(more["seconds"][:2], table["seconds"])
    assert np.array_equal(mbla.read_sweep(sweep.parent / "out" / "sweep.csv")["load_factor"], more["load_factor"])
    assert not sweep.with_suffix(".out").exists()
    assert capfd.readouterr() == ("", "")


@pytest.mark.long
def test_values_for_every_point(sweep: Path) -> None:
    """A block twice as high as it is wide rocks at 0.5, whatever friction keeps it from sliding."""
    sweep.write_text(SWEEP.replace("0.3, 0.4", "0.8"), encoding="utf-8")
    (factor,) = mbla.sweep(sweep, set={"parameters.h": 4})["load_factor"]
    (text,) = mbla.sweep(sweep, set=["parameters.h=4"], force=True)["load_factor"]
    assert factor == text == pytest.approx(0.25, rel=1e-6)


def test_refusals(sweep: Path) -> None:
    folder = sweep.with_suffix(".out")
    folder.mkdir()
    (folder / "journal.csv").write_text("", encoding="utf-8")
    with pytest.raises(mbla.FileError, match="exists already"):
        mbla.sweep(sweep)
    with pytest.raises(mbla.UsageError, match="-j 0"):
        mbla.sweep(sweep, jobs=0, force=True)
    with pytest.raises(mbla.FileError, match="no table of a sweep"):
        mbla.read_sweep(sweep)
    sweep.write_text(SWEEP.replace("values", "valves"), encoding="utf-8")
    with pytest.raises(mbla.DeckError) as refused:
        mbla.sweep(sweep, force=True)
    assert [fault.key for fault in refused.value.faults] == ["parameters.mu.valves"]
