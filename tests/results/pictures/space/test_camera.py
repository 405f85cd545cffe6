"""The camera, and panels that share a sheet."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.scene import scene_of
from mbla.results.pictures.space.camera import CLOSE, FRAME, axes_of, fitted, focus_of, panels_of
from tests.results.synthetic import tower_results

BOX = np.array([[x, y, z] for x in (0.0, 4.0) for y in (0.0, 2.0) for z in (0.0, 3.0)])


@pytest.mark.parametrize(
    ("azimuth", "elevation", "right", "up"),
    [(-90.0, 0.0, [1, 0, 0], [0, 0, 1]), (0.0, 0.0, [0, 1, 0], [0, 0, 1]), (-90.0, 90.0, [1, 0, 0], [0, 1, 0])],
)
def test_front_right_and_top_are_those_of_drawings(
    azimuth: float, elevation: float, right: list[int], up: list[int]
) -> None:
    towards, across, above = axes_of(azimuth, elevation)
    assert across == pytest.approx(np.array(right), abs=1e-12)
    assert above == pytest.approx(np.array(up), abs=1e-12)
    assert np.cross(across, above) == pytest.approx(towards, abs=1e-12)


@pytest.mark.parametrize("shift", [0.0, 1e6])
@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_everything_lies_in_the_frame_and_fills_it_in_one_direction(shift: float, scale: float) -> None:
    points = scale * (BOX + shift)
    places = fitted(points, -60.0, 25.0, 1.6).project(points)
    (left, end), (bottom, top) = FRAME
    assert places[:, 0].min() >= left - 1e-6
    assert places[:, 0].max() <= end + 1e-6
    assert places[:, 1].min() >= bottom - 1e-6
    assert places[:, 1].max() <= top + 1e-6
    fills = np.ptp(places, axis=0) / [end - left, top - bottom]
    assert fills.max() == pytest.approx(1.0, abs=1e-6)


def test_parallel_projection_keeps_lengths_across_the_line_of_sight() -> None:
    camera = fitted(BOX, -90.0, 0.0, 1.6)
    a, b = camera.project(np.array([[0.0, 0.0, 0.0], [4.0, 2.0, 0.0]]))
    assert (b[0] - a[0]) * camera.height * camera.aspect == pytest.approx(4.0)


def test_a_single_point_is_no_division_by_nothing() -> None:
    camera = fitted(np.ones((1, 3)), 0.0, 0.0, 1.6)
    assert np.isfinite(camera.project(np.ones((1, 3)))).all()


# --- What is enlarged beside the whole, and where it is said to be --------------------------------------------------


VIEW, ASPECT = (-60.0, 25.0), 1.6
ROOM = ((0.03, 0.97), (0.1, 0.85))


def box(low: float, high: float) -> np.ndarray:
    """Corners of a cube."""
    return np.array([[x, y, z] for x in (low, high) for y in (low, high) for z in (low, high)])


def test_a_small_part_gets_a_panel_of_its_own() -> None:
    whole, close = panels_of(box(0, 10), box(8, 10), VIEW, ASPECT, ROOM)
    assert (whole.across, close.across) == ((0.0, 1 - CLOSE), (1 - CLOSE, 1.0))
    assert whole.gain == 1.0
    assert close.gain == pytest.approx(whole.camera.height / close.camera.height)
    assert close.gain > 2
    places = close.camera.project(box(8, 10))
    assert (places > 0).all()
    assert (places < 1).all()


def test_the_frame_in_the_whole_holds_the_part_and_little_else() -> None:
    whole, _ = panels_of(box(0, 10), box(8, 10), VIEW, ASPECT, ROOM)
    assert whole.inside is not None
    left, bottom, width, height = whole.inside
    places = whole.camera.project(box(8, 10))
    assert places.min(axis=0) == pytest.approx([left + 0.01, bottom + 0.01])
    assert places.max(axis=0) == pytest.approx([left + width - 0.01, bottom + height - 0.01])


def test_nothing_in_front_of_the_part_is_cut_away() -> None:
    """The eye is farther from the middle of the part than anything of the structure."""
    _, close = panels_of(box(0, 10), box(0, 1), VIEW, ASPECT, ROOM)
    ahead = (box(0, 10) - close.camera.centre) @ close.camera.towards
    assert ahead.max() < 3 * close.camera.depth


@pytest.mark.parametrize("focus", [None, box(0, 9)], ids=["nothing", "nearly all"])
def test_one_panel_where_that_shows_as_much(focus: np.ndarray | None) -> None:
    panels = panels_of(box(0, 10), focus, VIEW, ASPECT, ROOM)
    assert [panel.across for panel in panels] == [(0.0, 1.0)]
    assert panels[0].inside is None


def test_the_focus_is_what_moves_before_and_after() -> None:
    """The upper block of the tower moves, from z = 1 to 2 at rest."""
    results = tower_results()
    scene = scene_of(results, results.cases[0], PictureOptions(), "mechanism")
    focus = focus_of(scene)
    assert focus is not None
    moving = (scene.clusters > 0)[scene.model.blocks.block_of_vertex]
    assert len(focus) == 2 * moving.sum()
    assert np.abs(focus[moving.sum() :] - scene.moved[moving]).max() == 0
    assert focus_of(replace(scene, drawn=np.zeros_like(scene.motion))) is None
