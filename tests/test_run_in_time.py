"""A run of a deck whose structure is followed in time, its files, and their verification."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.process.run_options import RunOptions
from mbla.results.findings import found_notices
from mbla.results.results import Results
from mbla.results.status_file import HISTORY_HEADER
from mbla.run import run
from mbla.solution.solution import Status
from mbla.solution.time_history.step_rows import HistoryEnd
from mbla.verify import verify_file
from tests.shaken import SHAKEN


def run_of(folder: Path, text: str, *overrides: str) -> tuple[Results, Path]:
    deck = folder / "block.yaml"
    deck.write_text(text, encoding="utf-8")
    return run(deck, RunOptions(overrides=overrides)), folder / "block.out"


@pytest.fixture(scope="module")
def shaken(tmp_path_factory: pytest.TempPathFactory) -> tuple[Results, Path]:
    return run_of(tmp_path_factory.mktemp("shaken"), SHAKEN)


def test_it_rocks(shaken: tuple[Results, Path]) -> None:
    results, folder = shaken
    (case,) = results.cases
    assert (case.status, results.exit_code) == (Status.SOLVED, 0)
    record: dict[str, Any] = json.loads((folder / "block.json").read_text(encoding="utf-8"))["cases"][0]
    found = record["time_history"]
    assert found["end"] == HistoryEnd.DURATION
    assert 0.02 < found["peak"] < 0.1
    assert found["steps"] == 120
    assert found["balance"] < 1e-9
    (motion,) = found["motions"]
    assert motion["spectral_acceleration"] == pytest.approx(motion["peak_acceleration"], rel=0.05)  # it is stiff
    assert record["load_factor"] is None
    assert found["verdict"].startswith("rocks, peak ")
    assert found["points"][0]["peak"] == pytest.approx(2.0 * found["peak"], rel=0.02)


def test_tables_of_histories(shaken: tuple[Results, Path]) -> None:
    _, folder = shaken
    with (folder / "block_history.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["point"] for row in rows[:2]] == ["base", "top"]
    base = np.array([float(row["absolute_displacement_x [m]"]) for row in rows if row["point"] == "base"])
    top = [row for row in rows if row["point"] == "top"]
    assert float(top[0]["absolute_acceleration_x [m/s2]"]) == 0.0  # it is at rest
    relative, absolute = (
        np.array([float(row[f"{kind}_x [m]"]) for row in top]) for kind in ("displacement", "absolute_displacement")
    )
    assert absolute == pytest.approx(base + relative)
    with (folder / "block_history_interfaces.csv").open(encoding="utf-8", newline="") as file:
        feet = list(csv.DictReader(file))
    assert {row["interface"] for row in feet} == {"foot"}
    assert len(feet) == len(base) == 121


def test_the_status_file_has_a_line_for_each_step(shaken: tuple[Results, Path]) -> None:
    lines = (shaken[1] / "block.sta").read_text(encoding="utf-8").splitlines()
    begin = lines.index(HISTORY_HEADER)
    steps = [line for line in lines[begin + 1 :] if not line.startswith("#")]
    assert len(steps) == 120
    assert float(steps[-1].split()[1]) == pytest.approx(0.6)
    assert len(steps[0]) == len(HISTORY_HEADER)


def test_the_file_agrees_with_what_is_recomputed(shaken: tuple[Results, Path]) -> None:
    results, disagreements = verify_file(shaken[1] / "block.h5")
    assert (disagreements, results.unconfirmed, results.exit_code) == ((), (), 0)


def test_what_does_not_stand_is_not_followed(tmp_path: Path) -> None:
    slab = "  - box: {group: slab, material: stone, min: [0.1, 0, 1], max: [0.9, 0.5, 1.2]}\nsupports"
    results, folder = run_of(tmp_path, SHAKEN.replace("supports", slab, 1))
    (case,) = results.cases
    assert case.status is Status.NO_EQUILIBRIUM
    assert case.solution.further.time_history.end is HistoryEnd.NONE
    assert results.exit_code == 5
    assert "no equilibrium" in (folder / "block.lst").read_text(encoding="utf-8")
    assert verify_file(folder / "block.h5")[1] == ()


def test_a_time_limit_leaves_what_was_followed(tmp_path: Path) -> None:
    results, folder = run_of(tmp_path, SHAKEN, "analysis.time_limit=0.4", "load_cases.quake.time_history.duration=60")
    (case,) = results.cases
    assert (case.status, results.exit_code) == (Status.TIME_LIMIT, 7)
    assert case.solution.further.time_history.rows is not None
    words = (folder / "block.lst").read_text(encoding="utf-8")
    assert "NOT SOLVED (the time ran out): followed to" in words
    assert json.loads((folder / "block.json").read_text(encoding="utf-8"))["cases"][0]["time_history"]["peak"] is None


SOIL = """\
mbla: 1
title: A wall that soil leans on
materials: {stone: {density: 2400}, sand: {density: 1800}}
joints: {dry: {friction: 0.4, stiffness: {normal: 1.e9}}}
contacts: {joint: dry}
blocks:
  - box: {group: wall, material: stone, min: [-0.9, 0, 0], max: [0, 1, 1.5]}
  - soil:
      {group: sand, material: sand, width: 1, outline: [[0, 0], [1.5, 0], [1.5, 1.5], [0, 1.5]],
       cells: {size: 1}, friction_angle: 33}
supports:
  - {ground: {z: 0}, joint: dry}
  - {ground: {point: [1.5, 0, 0], normal: [-1, 0, 0]}, blocks: sand}
load_cases:
  quake:
    time_history:
      {motion: {pulse: half_sine, amplitude: 0.7 g, duration: 0.3, direction: x}, step: 0.005, duration: 0.4}
output: {vtu: false}
"""


def test_soil_of_cells_pushes_a_wall(tmp_path: Path) -> None:
    """It slides away from the soil by more than it does alone, and the mesh of the soil is warned of."""
    results, folder = run_of(tmp_path, SOIL)
    (case,) = results.cases
    assert (case.status, results.exit_code) == (Status.SOLVED, 0)
    assert "time-history-soil" in {notice.identifier for notice in found_notices(case) if notice.severity == "warning"}
    assert verify_file(folder / "block.h5")[1] == ()
    found = case.solution.further.time_history
    assert found.frames is not None
    pushed = -found.frames.shifts[-1, 0, 0]
    t = np.linspace(0.0, 0.4, 4001)
    base = np.where(t < 0.3, 0.7 * np.sin(np.pi * t / 0.3), 0.0)
    rate = np.maximum(np.cumsum(np.where(t < t[np.argmax(base > 0.4)], 0.0, base - 0.4)) * 9.81 * 1e-4, 0.0)
    alone = float(rate.sum()) * 1e-4
    assert 1.1 * alone < pushed < 3.0 * alone


SLOPE = """\
mbla: 1
title: Soil that holds together slides down a slope of 30 degrees
materials: {clay: {density: 1800}}
joints: {dry: {friction: 0.6, stiffness: {normal: 1.e9}}}
contacts: {joint: dry, overrides: [{between: [clay, ground], joint: dry}]}
blocks:
  - soil:
      {group: clay, material: clay, width: 1, outline: [[0, 0], [0.520, -0.3], [0.720, 0.0464], [0.2, 0.3464]],
       cells: {size: 0.3}, friction_angle: 33, cohesion: 50000, tensile_strength: 50000}
supports: [{ground: {point: [0, 0, 0], normal: [0.5, 0, 0.8660254]}, joint: dry}]
load_cases:
  quake:
    time_history:
      {motion: {pulse: half_sine, amplitude: 1.5 g, duration: 0.3, direction: [-1, 0, 0]}, step: 0.005, duration: 0.9}
output: {vtu: false}
"""


@pytest.mark.long
def test_soil_falls_as_a_whole(tmp_path: Path) -> None:
    """By half of its height, not of a cell's: these are lower than it by far."""
    results, folder = run_of(tmp_path, SLOPE)
    found, blocks = results.cases[0].solution.further.time_history, results.model.blocks
    assert found.peaks is not None
    assert found.frames is not None
    extents = [np.ptp(blocks.vertices[blocks.block_of_vertex == cell, 2]) for cell in range(len(blocks))]
    assert (found.end, len(extents)) == (HistoryEnd.COLLAPSE, len(results.model.soils[0].blocks))
    lower = found.peaks.ends[:, 2] - found.frames.shifts[0, :, 2]
    assert -lower.min() == pytest.approx(0.5 * np.ptp(blocks.vertices[:, 2]), rel=0.05)
    assert max(extents) < 0.9 * np.ptp(blocks.vertices[:, 2])
    assert verify_file(folder / "block.h5")[1] == ()
