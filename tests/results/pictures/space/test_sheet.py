"""What stands around a spatial picture, found among the artists of its page; no image is rendered."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import HINGE, SLIDE, Page, open_page
from mbla.results.pictures.scene import Scene, scene_of
from mbla.results.pictures.space.camera import Panel, add_images, fill_sheet, fitted
from mbla.results.pictures.space.shapes import ColourScale, Drawing, rgb
from tests.results.synthetic import tower_results

EXTENT = np.array([[0.0, 0.0, 0.0], [4.0, 4.0, 3.0]])
BARE = Drawing((), (), 0.5, EXTENT, ())
LEGEND = (("hinge", HINGE), ("sliding of $5", SLIDE))


@dataclass(frozen=True)
class Filled:
    """A page with its images; where the room for the structure ends below and above."""

    page: Page
    below: float
    above: float

    def lines(self) -> list[Any]:
        """Lines and markers of the figure itself."""
        return [artist for artist in self.page.figure.artists if hasattr(artist, "get_xdata")]

    def texts(self) -> dict[str, Any]:
        """Every text of the figure and its axes."""
        axes = [text for each in self.page.figure.axes for text in each.texts]
        return {text.get_text(): text for text in (*self.page.figure.texts, *axes)}

    def named(self) -> list[str]:
        """Names of the legend."""
        return [text.get_text() for legend in self.page.figure.legends for text in legend.get_texts()]


@pytest.fixture(scope="module")
def scene() -> Scene:
    results = tower_results()
    return scene_of(results, results.cases[0], PictureOptions(), "mechanism")


@contextmanager
def filled(folder: Path, scene: Scene, drawing: Drawing, *panels: Panel) -> Iterator[Filled]:
    """A page about images that show nothing."""
    with open_page(folder / "page.svg", PictureOptions()) as page:
        below, above = fill_sheet(page, scene, "mechanism", drawing)
        images = [np.ones((10, 16, 3)) for _ in panels]
        assert len(add_images(page, images, panels, scene, drawing, (below, above))) == len(panels)
        page.figure.draw_without_rendering()  # legends find their place then
        yield Filled(page, below, above)


def whole(azimuth: float = -60.0, elevation: float = 25.0) -> Panel:
    """The only panel of a page."""
    return Panel(fitted(EXTENT, azimuth, elevation, 1.6), (0.0, 1.0))


def outlined(axes: Any) -> list[tuple[float, ...]]:
    """Frames on an image: left, bottom, width and height."""
    return [patch.get_bbox().bounds for patch in axes.patches if not patch.get_fill()]


def test_the_enlarged_part_says_how_much_and_has_a_scale_of_its_own(tmp_path: Path, scene: Scene) -> None:
    """Both scale bars have their lengths in their own panel; the frame in the whole is what the other enlarges."""
    inside = (0.3, 0.4, 0.2, 0.25)
    left = Panel(fitted(EXTENT, -60.0, 25.0, 0.6), (0.0, 0.38), inside)
    right = Panel(fitted(EXTENT / 4, -60.0, 25.0, 1.0), (0.38, 1.0), gain=4.0)
    with filled(tmp_path, scene, BARE, left, right) as sheet:
        first, second = sheet.page.figure.axes
        assert outlined(first) == [inside]
        assert outlined(second) == [pytest.approx((0.005, sheet.below, 0.985, sheet.above - sheet.below))]
        assert {"2 m", "0.2 m", "what moves, enlarged 4.0 times"} <= set(sheet.texts())
        bars = [line for line in sheet.lines() if len(line.get_xdata()) == 4]
        for panel, bar, length in zip((left, right), bars, (2.0, 0.2), strict=True):
            width = np.ptp(bar.get_xdata()) * 1.6  # of the page over its height
            assert width == pytest.approx(length / panel.camera.height)
        grounds = [patch for patch in second.patches if patch.get_fill()]
        assert [patch.get_facecolor() for patch in grounds] == 2 * [(1.0, 1.0, 1.0, 1.0)]
        for name, ground in zip(("0.2 m", "what moves, enlarged 4.0 times"), grounds, strict=True):
            place, box = sheet.page.extent_of(sheet.texts()[name]), sheet.page.extent_of(ground)
            assert box.x0 < place.x0 < place.x1 < box.x1
            assert box.y0 < place.y0 < place.y1 < box.y1


@pytest.mark.parametrize(
    ("view", "towards"), [((-90.0, 0.0), "y"), ((0.0, 0.0), "x"), ((-90.0, 90.0), "z"), ((-60.0, 25.0), "")]
)
def test_an_axis_towards_the_viewer_is_a_dot(
    tmp_path: Path, scene: Scene, view: tuple[float, float], towards: str
) -> None:
    with filled(tmp_path, scene, BARE, whole(*view)) as sheet:
        dots = [line.get_xydata()[0] for line in sheet.lines() if line.get_marker() == "o"]
        assert {"x", "y", "z"} <= set(sheet.texts())
        assert len(dots) == len(towards)
        if towards:
            apart = {name: float(np.hypot(*(sheet.texts()[name].get_position() - dots[0]))) for name in "xyz"}
            assert min(apart, key=lambda name: apart[name]) == towards


def test_without_a_legend_the_notes_alone_take_room(tmp_path: Path, scene: Scene) -> None:
    """The first note is the upper one."""
    with filled(tmp_path, scene, BARE, whole()) as sheet:
        assert sheet.below == pytest.approx(0.012)
        assert not sheet.named()
    with filled(tmp_path, scene, replace(BARE, notes=("upper $5", "lower")), whole()) as sheet:
        upper, lower = (sheet.page.extent_of(sheet.texts()[name]) for name in ("upper $5", "lower"))
        height = sheet.page.figure.bbox.height
        assert lower.y1 < upper.y0
        assert upper.y1 / height <= sheet.below + 1e-3


def test_a_legend_is_as_wide_as_the_axes_leave_room(tmp_path: Path, scene: Scene) -> None:
    """Two short names stand side by side; long ones one above the other, at the right edge."""
    with filled(tmp_path, scene, replace(BARE, legend=LEGEND, notes=("note",)), whole()) as sheet:
        (legend,) = sheet.page.figure.legends
        first, second = (sheet.page.extent_of(text) for text in legend.get_texts())
        note = sheet.page.extent_of(sheet.texts()["note"])
        assert sheet.named() == ["hinge", "sliding of $5"]
        assert first.x1 < second.x0
        assert note.y1 < first.y0
        short = sheet.below
    long = tuple((f"{name} {60 * 'n'}", colour) for name, colour in LEGEND)
    with filled(tmp_path, scene, replace(BARE, legend=long, notes=("note",)), whole()) as sheet:
        (legend,) = sheet.page.figure.legends
        first, second = (sheet.page.extent_of(text) for text in legend.get_texts())
        assert first.x0 == pytest.approx(second.x0)
        assert second.y1 < first.y0
        assert sheet.page.width_of(legend) <= 0.7
        assert sheet.below > short


def test_a_scale_of_colours_says_what_they_mean(tmp_path: Path, scene: Scene) -> None:
    """It lies above the legend, with the colours from the low end to the high one."""
    colours = np.array([rgb("#000000"), rgb(HINGE), rgb("#FFFFFF")])
    drawing = replace(BARE, legend=LEGEND, scale=ColourScale("eccentricity", 0.0, 2.0, colours))
    with filled(tmp_path, scene, drawing, whole()) as sheet:
        _, bar = sheet.page.figure.axes
        assert bar.get_title() == "eccentricity"
        assert bar.get_xlim() == (0.0, 2.0)
        assert not len(bar.get_yticks())
        assert (bar.images[0].get_array() == colours[None]).all()
        assert bar.get_position().y0 > sheet.below
