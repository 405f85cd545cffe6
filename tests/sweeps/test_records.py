"""A sweep over files of records and their scale: on two processes, resumed, with peaks and figures of each record."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import mbla
from mbla.errors import DeckError

DECK = """\
mbla: 1
materials: {stone: {density: 2600}}
joints: {dry: {friction: 0.7, stiffness: {normal: 1.e10}}}
contacts: {joint: dry}
blocks:
  - box: {group: block, material: stone, min: [0, 0, 0], max: [0.2, 0.5, 1]}
supports: [{ground: {z: 0}}]
load_cases:
  quake: {time_history: {motion: {file: weak.csv, unit: g, direction: x}, step: 0.01, duration: 0.3}}
"""
SWEEP = """\
mbla_sweep: 1
deck: block.yaml
parameters:
  scale: {key: load_cases.quake.time_history.motion.scale, values: [1, 2]}
  record: {key: load_cases.quake.time_history.motion.file, values: [weak.csv, strong.csv]}
results:
  - status
  - time_history.peak
  - time_history.fallen
  - time_history.end
  - time_history.motions.0.peak_acceleration
  - time_history.motions.0.spectral_acceleration
fragility: {result: time_history.peak, limit: [0.001, falls], sample: record, over: scale}
"""
G = 9.80665


def record(peak: float) -> str:
    """A triangle of acceleration in 0.2 s."""
    return f"t,a\n0,0\n0.1,{peak}\n0.2,0\n"


@pytest.fixture
def sweep(tmp_path: Path) -> Path:
    (tmp_path / "block.yaml").write_text(DECK, encoding="utf-8")
    (tmp_path / "weak.csv").write_text(record(0.1), encoding="utf-8")
    (tmp_path / "strong.csv").write_text(record(0.4), encoding="utf-8")
    path = tmp_path / "records.yaml"
    path.write_text(SWEEP, encoding="utf-8")
    return path


@pytest.mark.long
def test_records_and_scales(sweep: Path) -> None:
    """Below b/h = 0.2 g it does not rock. A record that was changed is another point; the others stay."""
    table = mbla.sweep(sweep, jobs=2)
    assert table["record"].tolist() == ["weak.csv", "strong.csv"] * 2
    assert table["state"].tolist() == ["done"] * 4
    assert table["time_history.motions.0.peak_acceleration"] == pytest.approx(
        G * np.array([0.1, 0.4, 0.2, 0.8]), rel=2e-3
    )
    peaks = table["time_history.peak"]
    assert (peaks[[1, 3]] > 1e-3).all()
    assert peaks[0] < 1e-4
    folder = sweep.with_suffix(".out")
    assert (folder / "sweep_fragility.csv").read_text(encoding="utf-8").count("falls") == 2
    told = list[tuple[int, int]]()
    (sweep.parent / "strong.csv").write_text(record(0.5), encoding="utf-8")
    more = mbla.sweep(sweep, resume=True, progress=lambda *counts: told.append(counts))
    assert told[0] == (4, 6), "four in the journal, two anew"
    assert np.array_equal(more["seconds"][[0, 2]], table["seconds"][[0, 2]])
    assert (more["time_history.peak"][[1, 3]] > peaks[[1, 3]]).all()


def test_a_record_that_is_not_there(sweep: Path) -> None:
    """It is found before anything is solved, at its place in the list."""
    sweep.write_text(SWEEP.replace("[weak.csv, strong.csv]", "[weak.csv, strang.csv]"), encoding="utf-8")
    with pytest.raises(DeckError, match=r"records.yaml:5:\d+ parameters.record.values\[1\] = strang.csv"):
        mbla.sweep(sweep)
    assert not sweep.with_suffix(".out").exists()
