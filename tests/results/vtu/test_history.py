"""States of a structure in time as files for ParaView."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import meshio
import numpy as np
import pytest

from mbla.deck.content import OutputSection
from mbla.results.results import CaseResult
from tests.results.outputs import write_outputs
from tests.results.rocking import DURATION, STEP, WEIGHT, frames, rocking_case, shifts
from tests.results.synthetic import tower_results

RESULTS = tower_results()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("rocks")
    write(rocking_case(RESULTS.cases[0]), folder)
    return folder


def write(case: CaseResult, folder: Path) -> None:
    shown = RESULTS.assembly.with_load_cases((case.load_case, *RESULTS.model.load_cases[1:]))
    rocks = replace(RESULTS, assembly=shown, cases=(case,))
    write_outputs(rocks, folder, "tower", force=False, output=OutputSection())


def played_in(folder: Path) -> list[tuple[str, str]]:
    """Times and files of the film."""
    return re.findall(r'timestep="([^"]+)".*file="([^"]+)"', (folder / "tower_shaken_history.pvd").read_text("utf-8"))


def test_a_file_for_each_state_with_its_time(folder: Path) -> None:
    played = played_in(folder)
    times = [float(time) for time, _ in played]
    assert times == pytest.approx(frames().times.tolist())
    assert times[-1] == pytest.approx(DURATION)
    assert all((folder / name).exists() for _, name in played)


def test_the_end_is_played_after_the_last_state(tmp_path: Path) -> None:
    """States begin with a step: here the last one is kept a step before the end."""
    case = rocking_case(RESULTS.cases[0])
    found = case.solution.further.time_history
    assert found.rows is not None
    found = replace(found, rows=replace(found.rows, times=np.append(found.rows.times[:-1], DURATION + STEP)))
    further = replace(case.solution.further, time_history=found)
    write(replace(case, solution=replace(case.solution, further=further)), tmp_path)
    played = played_in(tmp_path)
    assert (len(played), float(played[-1][0])) == (len(frames()) + 1, DURATION + STEP)
    mesh = meshio.read(tmp_path / played[-1][1])
    assert found.peaks is not None
    assert mesh.point_data["displacement"][8:16].mean(axis=0) == pytest.approx(found.peaks.ends[1, :3], abs=1e-12)
    assert np.isnan(mesh.point_data["velocity"]).all()  # of the step after it


def test_blocks_are_where_they_are(folder: Path) -> None:
    state = 4
    mesh = meshio.read(folder / f"tower_shaken_history_{state:03d}.vtu")
    moved = mesh.point_data["displacement"]
    assert mesh.point_data["velocity"].shape == moved.shape
    assert moved[:8] == pytest.approx(np.zeros((8, 3)))  # the base
    assert moved[8:16].mean(axis=0) == pytest.approx(shifts(frames().times)[state], abs=1e-12)


def test_forces_are_where_they_act(folder: Path) -> None:
    at_rest, rocking = (meshio.read(folder / f"tower_shaken_history_forces_{state:03d}.vtu") for state in (0, 4))
    assert len(at_rest.points) == 4
    assert at_rest.points[:, 2] == pytest.approx(np.ones(4))
    assert len(rocking.points) == 2
    for mesh in (at_rest, rocking):
        assert mesh.point_data["contact_force"].sum(axis=0) == pytest.approx([0.0, 0.0, WEIGHT])
        assert mesh.point_data["normal_force"].sum() == pytest.approx(WEIGHT)
    assert rocking.points[:, 0] == pytest.approx(np.ones(2), abs=1e-9)  # the edge about which it turns
