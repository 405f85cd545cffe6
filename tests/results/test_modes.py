"""Modes of vibration on their way through a run: answers, files, verification."""

from __future__ import annotations

import json
import math
from pathlib import Path

import h5py
import meshio
import numpy as np
import pytest

from mbla.process.run_options import RunOptions
from mbla.results.collapse.motion import SHARE_OF_SIZE, movable_size
from mbla.results.hdf5.result_file import read_results_hdf5
from mbla.results.listing.answers import answer_columns
from mbla.results.outcome import answer_of
from mbla.results.results import Results
from mbla.results.tables.tables import tables_of
from mbla.run import run
from mbla.solution.solution import Standing, Status
from mbla.verify import verify_file
from tests.results.synthetic import same

DECKS = Path(__file__).parents[2] / "decks"
WALL = DECKS / "time_histories" / "modes_of_a_wall.yaml"


@pytest.fixture(scope="module", name="wall")
def solved(tmp_path_factory: pytest.TempPathFactory) -> tuple[Results, Path]:
    """Of four courses."""
    folder = tmp_path_factory.mktemp("wall")
    return run(WALL, RunOptions(folder=folder, overrides=("parameters.n=4",))), folder


def test_the_first_period_is_the_answer_of_a_load_case_that_asks_nothing_else(wall: tuple[Results, Path]) -> None:
    case, other = wall[0].cases
    assert case.status is Status.SOLVED
    assert answer_of(case) == case.solution.further.modes.period == other.solution.further.modes.period
    assert math.isclose(answer_of(other), 0.3125, rel_tol=1e-6)
    assert len(case.solution.further.modes) == 6
    assert len(other.solution.further.modes) == 1
    assert wall[0].exit_code == 0


def test_a_table_has_the_first_periods_of_all(wall: tuple[Results, Path]) -> None:
    heads, rows = answer_columns(wall[0].model, wall[0].cases)
    column = heads.index("first period [s]")
    assert rows[0][column] == rows[1][column] != ""
    assert rows[1].count("") == 0


def test_files_hold_them(wall: tuple[Results, Path]) -> None:
    results, folder = wall
    modes = results.case("rest").solution.further.modes
    record = json.loads((folder / "modes_of_a_wall.json").read_text())["cases"][0]["modes"]
    assert record["periods"] == modes.periods.tolist()
    assert record["period"] == modes.period
    assert record["mass_together"] == pytest.approx(modes.masses.sum(axis=0))
    table = tables_of(results, ("modes",))["modes"]
    assert len(table) == 7
    mesh = meshio.read(folder / "modes_of_a_wall_rest_modes.vtu")
    assert set(mesh.point_data) == {f"mode_{number}" for number in range(1, 7)}
    largest = np.linalg.norm(mesh.point_data["mode_1"], axis=1).max()
    assert largest == pytest.approx(SHARE_OF_SIZE * movable_size(results.model))
    listing = (folder / "modes_of_a_wall.lst").read_text()
    assert "6 modes of vibration about the state at rest under the dead load, verified" in " ".join(listing.split())


def test_a_file_is_read_as_it_was_written(wall: tuple[Results, Path]) -> None:
    results, folder = wall
    again = read_results_hdf5(folder / "modes_of_a_wall.h5")
    for one, other in zip(results.cases, again.cases, strict=True):
        mine, read = one.solution.further.modes, other.solution.further.modes
        assert same(mine, read)
        assert answer_of(one) == answer_of(other)


def test_a_file_is_verified(wall: tuple[Results, Path]) -> None:
    results, differences = verify_file(wall[1] / "modes_of_a_wall.h5")
    assert differences == ()
    assert results.exit_code == 0


def test_a_file_with_other_modes_is_not(wall: tuple[Results, Path], tmp_path: Path) -> None:
    path = tmp_path / "other.h5"
    path.write_bytes((wall[1] / "modes_of_a_wall.h5").read_bytes())
    with h5py.File(path, "r+") as file:
        file["cases/rest/vibration/periods"][...] *= 1.001
    results, differences = verify_file(path)
    assert results.case("rest").status is Status.NOT_VERIFIED
    assert differences


def test_a_file_without_the_modes_asked_for_is_not_verified(wall: tuple[Results, Path], tmp_path: Path) -> None:
    path = tmp_path / "other.h5"
    path.write_bytes((wall[1] / "modes_of_a_wall.h5").read_bytes())
    with h5py.File(path, "r+") as file:
        del file["cases/push/vibration"]
    _, differences = verify_file(path)
    assert any("modes of vibration" in text for text in differences)


FALLING = """mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
blocks:
  - box: {group: low, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: high, material: stone, min: [0.8, 0, 1], max: [1.8, 1, 2]}
contacts: {joint: dry}
supports: [{blocks: low}]
load_cases: {rest: {modes: 2}, push: {modes: 2, live: [{acceleration: [1, 0, 0]}]}}
"""


def test_what_falls_has_none(tmp_path: Path) -> None:
    (tmp_path / "deck.yaml").write_text(FALLING)
    results = run(tmp_path / "deck.yaml", RunOptions(folder=tmp_path))
    for case in results.cases:
        assert case.status is Status.NO_EQUILIBRIUM
        assert len(case.solution.further.modes) == 0
    (rest, push) = results.cases
    assert rest.solution.standing is not None
    assert rest.solution.standing.verdict is Standing.NO
    assert math.isnan(answer_of(rest))
    assert "no-modes" in [remark.identifier for remark in push.solution.remarks]
    assert results.exit_code == 5
    _, differences = verify_file(tmp_path / "deck.h5")
    assert differences == ()


def test_what_stands_only_by_self_stress_has_none(tmp_path: Path) -> None:
    text = (DECKS / "benchmarks" / "closed_forms" / "bar_between_walls.yaml").read_text()
    head = text.split("load_cases:")[0].split("expected:")[0]
    (tmp_path / "deck.yaml").write_text(f"{head}load_cases: {{rest: {{modes: 2}}}}\n")
    results = run(tmp_path / "deck.yaml", RunOptions(folder=tmp_path))
    (rest,) = results.cases
    assert rest.status is Status.NOT_VERIFIED
    assert rest.solution.standing is not None
    assert rest.solution.standing.verdict is Standing.SELF_STRESS
