"""Modes before and after a time history of one run: in its files, as they are read and verified."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import h5py
import meshio
import numpy as np
import pytest

from mbla.results.hdf5.result_file import read_results_hdf5
from mbla.results.listing.blocks import Paragraph
from mbla.results.listing.sections.modes import NOT_TOGETHER, modes_blocks, modes_words
from mbla.results.results import Results
from mbla.results.tables.tables import tables_of
from mbla.run import RunOptions, run
from mbla.solution.modes.after import HAS_FALLEN
from mbla.verify import verify_file

DECK = """mbla: 1
materials: {stone: {density: 2500}}
joints: {dry: {friction: 0.3, stiffness: {normal: 1.e10, ratio: 0.4}}}
blocks:
  - box: {group: low, material: stone, min: [0, 0, 0], max: [1, 1, 0.5]}
  - box: {group: high, material: stone, min: [0, 0, 0.5], max: [1, 1, 1]}
contacts: {joint: dry}
supports: [{blocks: low}]
load_cases:
  slides:
    time_history: {motion: {pulse: half_sine, amplitude: 0.6 g, duration: 0.5, direction: x}, duration: 1, step: 0.01}
    modes: 6
  falls:
    time_history: {motion: {pulse: half_sine, amplitude: 3 g, duration: 0.5, direction: x}, duration: 1, step: 0.01}
    modes: 1
"""


@pytest.fixture(scope="module")
def slid(tmp_path_factory: pytest.TempPathFactory) -> tuple[Results, Path]:
    """Results and their folder."""
    folder = tmp_path_factory.mktemp("slid")
    (folder / "slid.yaml").write_text(DECK)
    return run(folder / "slid.yaml", RunOptions(folder=folder)), folder


def test_periods_stand_beside_each_other(slid: tuple[Results, Path]) -> None:
    results, folder = slid
    further = results.case("slides").solution.further
    before, after = further.modes, further.modes_after
    assert before.verified
    assert after.verified
    assert (after.periods > 1.05 * before.periods).all()
    longer = f"{100 * (after.period / before.period - 1):.1f} % longer"
    assert f"the first period is {after.period:.6g} s, {longer}" in modes_words(results.case("slides"))
    text = " ".join((folder / "slid.lst").read_text().split())
    assert "After the time history: 6 modes about the state it leaves, verified." in text
    (case, other) = json.loads((folder / "slid.json").read_text())["cases"]
    assert case["modes_after"]["period"] == pytest.approx(after.period)
    assert other["modes_after"] is None
    assert len(tables_of(results, ("modes_after",))["modes_after"]) == 6


def test_modes_say_that_they_have_no_blocks_that_move_as_one(slid: tuple[Results, Path]) -> None:
    """In the time history they do."""
    case = slid[0].case("slides")
    history = case.load_case.time_history
    assert history is not None
    rigid = replace(case.load_case, time_history=replace(history, rigid=(np.arange(2),)))
    for load_case, said in ((case.load_case, False), (rigid, True)):
        blocks = modes_blocks(slid[0].assembly, replace(case, load_case=load_case))
        assert (Paragraph(NOT_TOGETHER) in blocks) is said


def test_shapes_are_drawn_where_blocks_end(slid: tuple[Results, Path]) -> None:
    results, folder = slid
    peaks = results.case("slides").solution.further.time_history.peaks
    assert peaks is not None
    mesh = meshio.read(folder / "slid_slides_modes_after.vtu")
    assert set(mesh.point_data) == {f"mode_{number}" for number in range(1, 7)}
    assert mesh.points[:, 0].min() == pytest.approx(peaks.ends[1, 0])
    assert peaks.residuals[1] == pytest.approx(abs(peaks.ends[1, 0]), rel=1e-6)
    assert not (folder / "slid_falls_modes_after.vtu").exists()


def test_what_falls_says_why_it_has_none_after(slid: tuple[Results, Path]) -> None:
    solution = slid[0].case("falls").solution
    assert len(solution.further.modes) == 1
    assert solution.further.modes_after.reason == HAS_FALLEN
    assert "no-modes-after" in [remark.identifier for remark in solution.remarks]


def test_a_file_is_read_as_it_was_written_and_verified(slid: tuple[Results, Path]) -> None:
    results, folder = slid
    read = read_results_hdf5(folder / "slid.h5").case("slides").solution.further.modes_after
    assert read.shapes.tolist() == results.case("slides").solution.further.modes_after.shapes.tolist()
    again, differences = verify_file(folder / "slid.h5")
    assert differences == ()
    assert again.exit_code == results.exit_code == 0
    assert again.case("slides").solution.further.modes_after.verified


@pytest.mark.every(3)
@pytest.mark.parametrize("name", ["periods", "shapes", "masses", "stiffness", "pressed", "ends"])
def test_a_file_with_other_modes_is_not(slid: tuple[Results, Path], tmp_path: Path, name: str) -> None:
    path = tmp_path / "other.h5"
    path.write_bytes((slid[1] / "slid.h5").read_bytes())
    with h5py.File(path, "r+") as file:
        group = "time_history/peaks" if name == "ends" else "vibration_after"
        values = file[f"cases/slides/{group}/{name}"]
        changed = {"shapes": np.asarray(values)[::-1], "pressed": np.zeros(1)}
        values[...] = changed.get(name, np.asarray(values) * 1.001)
    _, differences = verify_file(path)
    assert differences


def test_a_file_without_them_is_not(slid: tuple[Results, Path], tmp_path: Path) -> None:
    path = tmp_path / "other.h5"
    path.write_bytes((slid[1] / "slid.h5").read_bytes())
    with h5py.File(path, "r+") as file:
        del file["cases/slides/vibration_after"]
    _, differences = verify_file(path)
    assert any("modes after the time history" in text for text in differences)
