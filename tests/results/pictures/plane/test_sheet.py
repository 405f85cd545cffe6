"""What a sheet is asked to draw."""

from pathlib import Path

import numpy as np
import pytest

from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import open_page
from mbla.results.pictures.plane.sheet import new_sheet


@pytest.mark.parametrize("count", [0, 2])
def test_nothing_to_draw_leaves_no_artist_and_takes_no_room(tmp_path: Path, count: int) -> None:
    points = np.array([[0.0, 0.0], [1.0, 2.0]])[:count]
    paths = points[:, None] + np.array([[0.0, 0.0], [0.5, 0.0], [0.0, 0.5]])
    with open_page(tmp_path / "page.svg", PictureOptions()) as page:
        sheet = new_sheet(page, 1.0)
        sheet.areas(list(paths))
        sheet.lines(paths, 1.0, "#000000")
        sheet.dots(points, 3.0, color="#000000")
        sheet.arrows(points, points + 1.0, 1.0, "#000000", 1.0)
        assert len(sheet.axes.collections) == len(sheet.drawn) == (5 if count else 0)


def test_an_arrow_without_length_is_left_out(tmp_path: Path) -> None:
    """The other ends at its tip, having come by its step."""
    with open_page(tmp_path / "page.svg", PictureOptions()) as page:
        sheet = new_sheet(page, 1.0)
        sheet.arrows(np.array([[1.0, 0.0], [3.0, 4.0]]), np.array([[0.0, 0.0], [1.0, 0.0]]), 1.0, "#000000", 1.0)
        shafts, heads = sheet.axes.collections
        assert len(shafts.get_segments()) == 1
        assert shafts.get_segments()[0][0] == pytest.approx([2.0, 4.0])
        assert heads.get_paths()[0].vertices[0] == pytest.approx([3.0, 4.0])
