"""Arrows and arcs of loads in a plane figure, found among the artists of its sheet."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.model.model import TravelPosition
from mbla.results.pictures.load_marks import LONGEST, LONGEST_OF_MANY, MANY, OFF_PATH, load_marks
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import LIVE_LOAD, open_page
from mbla.results.pictures.plane.flat import flat_of
from mbla.results.pictures.plane.marks import draw_load
from mbla.results.pictures.plane.sheet import Sheet, new_sheet
from mbla.results.pictures.scene import Scene, scene_of
from mbla.results.pictures.shown_loads import ShownLoad
from mbla.results.results import Results
from tests.results.pictures.rows_and_columns import row_of_blocks

OPTIONS = PictureOptions()


@contextmanager
def loaded(
    folder: Path, results: Results, loads: FloatArray, travel: TravelPosition | None = None
) -> Iterator[tuple[Sheet, Scene]]:
    """A sheet with the arrows of loads alone."""
    scene = scene_of(results, results.cases[0], OPTIONS, "model")
    flat = flat_of(scene, OPTIONS, "model")
    assert flat is not None
    with open_page(folder / "page.svg", OPTIONS) as page:
        sheet = new_sheet(page, scene.size)
        marks = load_marks(scene.model, loads, ("push on a block",), travel)
        draw_load(sheet, flat, scene, ShownLoad("live load: push on a block", LIVE_LOAD, loads, marks))
        yield sheet, scene


def arrows(sheet: Sheet) -> list[tuple[FloatArray, FloatArray]]:
    """Where each arrow begins and ends: the head's first corner is its tip, the shafts are lines of two points."""
    shafts = [line for each in sheet.axes.collections if hasattr(each, "get_segments") for line in each.get_segments()]
    heads = [path for each in sheet.axes.collections if not hasattr(each, "get_segments") for path in each.get_paths()]
    starts = [line[0] for line in shafts if len(line) == 2]
    return [(start, head.vertices[0]) for start, head in zip(starts, heads, strict=True)]


def test_the_arrow_of_a_force_ends_where_it_enters_the_block(tmp_path: Path) -> None:
    """4 N on the first block towards +x, 2 N down on the second: arrows as long as the forces are large."""
    loads = np.zeros((2, 6))
    loads[0, 0], loads[1, 2] = 4.0, -2.0
    with loaded(tmp_path, row_of_blocks(2), loads) as (sheet, scene):
        across, down = arrows(sheet)
        assert across[1] == pytest.approx([0.0, 1.0])
        assert across[1] - across[0] == pytest.approx([LONGEST * scene.size, 0.0])
        assert down[1] == pytest.approx([2.5, 2.0])
        assert down[1] - down[0] == pytest.approx([0.0, -LONGEST / 2 * scene.size])
        assert list(sheet.handles) == ["live load: push on a block"]


@pytest.mark.parametrize(("behind", "seen"), [(1.0, True), (50.0, False)])
def test_an_axle_off_the_path_is_drawn_unless_it_is_far_away(tmp_path: Path, behind: float, seen: bool) -> None:
    """2 N on the first block, 4 N before it, in one scale: what does not act is pale, and does not shrink the rest."""
    points, forces = np.array([[0.5, 0.5, 3.0], [-behind, 0.5, 3.0]]), np.array([[0, 0, -2.0], [0, 0, -4.0]])
    vehicle = TravelPosition("train", 1, 1, points, np.array([0.0, -behind - 0.5]), forces, np.array([0, -1]))
    loads = np.zeros((2, 6))
    loads[0] = [0, 0, -2, *np.cross(points[0] - [0.5, 0.5, 1.0], forces[0])]
    with loaded(tmp_path, row_of_blocks(2), loads, vehicle) as (sheet, scene):
        found = arrows(sheet)
        assert [tip.tolist() for _, tip in found] == [[0.5, 2.0], [-behind, 3.0]][: 1 + seen]
        lengths = [float(np.linalg.norm(tip - start)) / scene.size for start, tip in found]
        assert lengths == pytest.approx([LONGEST / 2, LONGEST][: 1 + seen])
        assert list(sheet.handles) == ["live load: push on a block", OFF_PATH][: 1 + seen]


def test_many_forces_have_short_arrows(tmp_path: Path) -> None:
    count = MANY + 1
    loads = np.zeros((count, 6))
    loads[:, 0] = 1.0
    with loaded(tmp_path, row_of_blocks(count), loads) as (sheet, scene):
        drawn = arrows(sheet)
        assert len(drawn) == count
        for start, tip in drawn:
            assert tip - start == pytest.approx([LONGEST_OF_MANY * scene.size, 0.0])


@pytest.mark.parametrize("sense", [1, -1])
def test_a_moment_is_an_arc_that_turns_its_way(tmp_path: Path, sense: int) -> None:
    """About y, which points into the page: the other way round on it."""
    loads = np.zeros((2, 6))
    loads[1, 4] = 3.0 * sense
    with loaded(tmp_path, row_of_blocks(2), loads) as (sheet, scene):
        (arc,) = (line for line in sheet.axes.collections[0].get_segments() if len(line) > 2)
        arms = arc - np.array([2.5, 1.0])
        radius = LONGEST * scene.size
        assert np.hypot(*arms.T) == pytest.approx(min(0.3 * scene.model.blocks.sizes[1], radius))
        turned = np.unwrap(np.arctan2(arms[:, 1], arms[:, 0]))
        assert turned[-1] - turned[0] == pytest.approx(-sense * 1.5 * np.pi)
        assert list(sheet.handles) == ["live load: push on a block"]


def test_a_moment_about_an_axis_of_the_page_has_no_arc(tmp_path: Path) -> None:
    """Only its words, with the sign of what cannot be drawn."""
    loads = np.zeros((2, 6))
    loads[0, 3] = 3.0
    with loaded(tmp_path, row_of_blocks(2), loads) as (sheet, _):
        assert not sheet.axes.collections
        assert list(sheet.handles) == ["live load: push on a block (across the page)"]
