"""Decks whose soil is moved before it is solved: figures, what stays fixed, and files that are read again."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest

from mbla.errors import FileError
from mbla.process.run_options import RunOptions
from mbla.results.hdf5.result_file import read_results_hdf5
from mbla.results.listing.verdict_words import verdict
from mbla.results.outcome import answer_of, figure_of
from mbla.results.results import Results
from mbla.run import run
from mbla.solution.solution import Status
from mbla.verify import verify_file
from tests.model.soil.decks import ARCH, FOOTING, deck, fill

FOOTED = "live: [{force: [0, 0, -1], on: footing}]"
STRIP = "soil: {group: backfill, material: earth, outline: [[-1.4, 0], [2.7, 0], [2.7, 1], [-1.4, 1]], width: 1, " + (
    "cells: {size: 0.4}, friction_angle: 0, cohesion: 100000, wall: {cohesion: 100000}}"
)
HELD = "[{ground: {z: 0}}, {ground: {x: -1.4}}, {ground: {point: [2.7, 0, 0], normal: [-1, 0, 0]}}]"


def solved(folder: Path, *blocks: str, loads: str, soil: str = "", supports: str = HELD) -> Results:
    deck(folder, *blocks, fill=soil, supports=supports, loads=loads)
    return run(folder / "deck.yaml", RunOptions(folder / "out", force=True))


@pytest.fixture(scope="module")
def footing(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Result file of a rough strip on clay."""
    folder = tmp_path_factory.mktemp("footing")
    solved(folder, STRIP, FOOTING, loads=FOOTED)
    return folder / "out" / "deck.h5"


def test_a_strip_on_clay_carries_what_prandtl_says(footing: Path) -> None:
    """On cells as they are divided it is 17 % more at the least; the strip weighs what the live load does besides."""
    results = read_results_hdf5(footing)
    (case,) = results.cases
    weight = -case.load_case.dead_load[results.model.blocks.groups.index("footing"), 2]
    exact = (2.0 + np.pi) * 100000.0 * 0.5 - weight
    assert case.status is Status.SOLVED
    assert 1.0 < figure_of(case) / exact < 1.05
    assert [figure.followed for figure in case.load_case.soil] == [True, True]
    assert min(figure.load_factor for figure in case.load_case.soil) == pytest.approx(figure_of(case), rel=1e-5)


def test_so_does_a_pressure_on_a_strip_of_its_width(tmp_path: Path) -> None:
    """Corners move along the top, and what cells carry of the pressure with them."""
    pressed = "live: [{pressure: {value: 1000, normal: [0, 0, 1], box: [[0.4, 0, 0.9], [0.9, 1, 1.1]]}, on: backfill}]"
    (case,) = solved(tmp_path, STRIP, loads=pressed).cases
    assert 1.0 < figure_of(case) / ((2.0 + np.pi) * 100.0) < 1.06
    assert min(figure.load_factor for figure in case.load_case.soil) == pytest.approx(figure_of(case), rel=1e-5)


def test_a_result_is_built_again_on_moved_corners(footing: Path) -> None:
    results, differences = verify_file(footing)
    assert differences == ()
    (soil,) = results.model.soils
    assert soil.moved


def test_corners_off_the_outline_are_refused(footing: Path, tmp_path: Path) -> None:
    path = tmp_path / "forged.h5"
    path.write_bytes(footing.read_bytes())
    with h5py.File(path, "r+") as file:
        file["model/soil_corners"][:] = 1.01 * file["model/soil_corners"][()]
    with pytest.raises(FileError, match="corners of cells of soil backfill are off its outline"):
        read_results_hdf5(path)


def test_where_no_live_load_acts_in_the_plane_the_figure_is_not_verified(tmp_path: Path) -> None:
    """A load across the plane of the soil: its cells stay as they are divided."""
    results = solved(tmp_path, STRIP, FOOTING, loads="live: [{force: [0, 1, 0], on: footing}]")
    (case,) = results.cases
    assert not results.model.soils[0].moved
    assert case.status is Status.APPROXIMATE
    assert {failure.identifier for failure in case.checks.failures} == {"soil-mesh-fixed"}


def test_positions_have_the_figure_of_a_mesh_of_their_own(tmp_path: Path) -> None:
    travel = "travel: {force: [0, 0, -1], contact: 0.4, width: 1, path: [[0.6, 1, 1.5], [3.4, 1, 1.5]], positions: 3}"
    results = solved(tmp_path, ARCH, soil=fill(), supports="[]", loads=f"live: [{{{travel}}}]")
    figures = {case.load_case.name: case.load_case.soil for case in results.cases}
    followed = [name for name, meshes in figures.items() if any(mesh.followed and mesh.shown for mesh in meshes)]
    assert len(followed) == 1
    told = {case.load_case.name: figure_of(case) for case in results.cases}
    assert min(told, key=lambda name: told[name]) == followed[0]
    for name, meshes in figures.items():
        assert told[name] <= min(mesh.load_factor for mesh in meshes) * (1.0 + 1e-6)
    for case in results.cases:
        words = verdict(results.model.of_case(case.load_case), case)
        assert ("at no more than" in words) == (figure_of(case) < answer_of(case))
