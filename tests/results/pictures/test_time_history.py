"""Diagrams and films of a structure in time."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.results.collapse.motion import drawn_motion, peak_state
from mbla.results.pictures.animation import write_animation
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.plot import pictures_of, plot_results
from mbla.results.pictures.scene import scene_of
from mbla.results.results import Results
from mbla.solution.time_history.history import HalfStep
from mbla.solution.time_history.step_rows import HistoryEnd
from tests.results.rocking import frames, peaks, rocking_case, rocks, turns
from tests.results.synthetic import tower_results


@pytest.fixture(scope="module")
def results() -> Results:
    found = tower_results()
    return replace(found, cases=(rocking_case(found.cases[0]),))


def test_it_has_a_curve(results: Results, tmp_path: Path) -> None:
    options = PictureOptions(kinds=("curve",), size=(900, 600))
    (path,) = plot_results(results, tmp_path, "tower", options)
    assert path.name == "tower_shaken_curve.png"
    assert path.read_bytes().startswith(b"\x89PNG")
    every = pictures_of(results, results.cases, PictureOptions(kinds=("model", "mechanism", "curve")))
    assert "_shaken_curve" in [picture.name for picture in every]


def test_its_history_is_its_curves(results: Results, tmp_path: Path) -> None:
    drawn = [
        plot_results(results, tmp_path / kind, "tower", PictureOptions(kinds=(kind,), size=(900, 600), format="svg"))[0]
        for kind in ("history", "curve")
    ]
    assert [path.name for path in drawn] == ["tower_shaken_history.svg", "tower_shaken_curve.svg"]
    assert "displacement" in drawn[0].read_text(encoding="utf-8")
    every = pictures_of(results, results.cases, PictureOptions(kinds=("history", "curve")))
    assert [picture.name for picture in every] == ["_shaken_curve"]


def test_without_named_points_the_block_of_the_peak_is_drawn(results: Results, tmp_path: Path) -> None:
    (case,) = results.cases
    asked = case.load_case.time_history
    assert asked is not None
    bare = replace(case, load_case=replace(case.load_case, time_history=replace(asked, points=(), motions=())))
    fallen = rocking_case(tower_results().cases[0], peaks=replace(peaks(), falling=np.array([np.nan, 3.0, np.nan])))
    for own in (bare, fallen):
        options = PictureOptions(kinds=("curve",), size=(900, 600))
        (path,) = plot_results(replace(results, cases=(own,)), tmp_path, "tower", options)
        assert path.stat().st_size > 10_000


def test_it_is_drawn_where_it_is_displaced_most(results: Results) -> None:
    scene = scene_of(results, results.cases[0], PictureOptions(), "mechanism")
    assert peak_state(rocks()) == 4
    assert scene.moment.startswith("drawn: at 0.4 s, ")
    assert scene.moment.endswith(" times its displacements")
    assert scene.words_of("mechanism")[-1] == scene.moment
    assert scene.is_result
    assert scene.mark_of("mechanism") == ""
    turn = drawn_motion(scene.model, results.cases[0])[1, 4]
    assert turn >= turns(frames().times)[4]


def test_what_depends_on_the_step_is_marked(results: Results) -> None:
    case = rocking_case(tower_results().cases[0], half=HalfStep(1.0, 0.4, 0.0, HistoryEnd.DURATION))
    scene = scene_of(replace(results, cases=(case,)), case, PictureOptions(), "curve")
    assert scene.mark_of("curve").startswith("APPROXIMATE: with half of the step the greatest displacement changes")


@pytest.mark.long
def test_a_film_in_its_own_time(results: Results, tmp_path: Path) -> None:
    from PIL import Image, ImageSequence

    path = tmp_path / "rocks.gif"
    options = PictureOptions(size=(320, 200))
    write_animation(results, results.cases[0], path, options)
    with Image.open(path) as film:
        assert len(list(ImageSequence.Iterator(film))) > 10
