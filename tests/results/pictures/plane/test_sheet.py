"""The sheet of a plane picture, and the structure on it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import GROUPS, open_page
from mbla.results.pictures.plane.flat import flat_of
from mbla.results.pictures.plane.sheet import (
    MOST_NUMBERS,
    Sheet,
    colours_by_group,
    colours_by_part,
    draw_grounds,
    new_sheet,
    number_parts,
)
from mbla.results.pictures.scene import MOST_GROUPS, Scene, scene_of
from tests.results.pictures.rows_and_columns import row_of_blocks
from tests.results.synthetic import horizontal_contacts


def test_an_arrow_without_length_is_left_out(tmp_path: Path) -> None:
    """The other ends at its tip, having come by its step."""
    with open_page(tmp_path / "page.svg", PictureOptions()) as page:
        sheet = new_sheet(page, 1.0)
        sheet.arrows(np.array([[1.0, 0.0], [3.0, 4.0]]), np.array([[0.0, 0.0], [1.0, 0.0]]), 1.0, "#000000", 1.0)
        shafts, heads = sheet.axes.collections
        assert len(shafts.get_segments()) == 1
        assert shafts.get_segments()[0][0] == pytest.approx([2.0, 4.0])
        assert heads.get_paths()[0].vertices[0] == pytest.approx([3.0, 4.0])


# --- Blocks, parts and ground in a plane figure: their names and numbers --------------------------------------------


OPTIONS = PictureOptions()


def scene(count: int) -> Scene:
    results = row_of_blocks(count)
    return scene_of(results, results.cases[0], OPTIONS, "mechanism")


@contextmanager
def empty_sheet(folder: Path, shown: Scene) -> Iterator[Sheet]:
    with open_page(folder / "page.svg", OPTIONS) as page:
        yield new_sheet(page, shown.size)


@pytest.mark.parametrize(
    ("count", "numbers", "told"),
    [
        (1, 0, []),
        (2, 2, []),
        (len(GROUPS) + 1, len(GROUPS) + 1, ["parts as in the listing"]),
        (MOST_NUMBERS + 3, MOST_NUMBERS, ["parts as in the listing, and 3 more"]),
    ],
)
def test_several_parts_have_their_numbers_on_them(tmp_path: Path, count: int, numbers: int, told: list[str]) -> None:
    """Equal parts are numbered by their first block, from left to right; each number stands in its block as moved."""
    shown = scene(count)
    flat = flat_of(shown, OPTIONS)
    assert flat is not None
    with empty_sheet(tmp_path, shown) as sheet:
        number_parts(sheet, flat, shown)
        assert [text.get_text() for text in sheet.axes.texts] == [str(i + 1) for i in range(numbers)]
        assert list(sheet.handles) == told
        for text in sheet.axes.texts:
            block = int(text.get_text()) - 1
            own = flat.project(shown.moved[shown.model.blocks.block_of_vertex == block])
            assert text.get_position() == pytest.approx(own.mean(axis=0))


def test_parts_at_rest_have_no_numbers(tmp_path: Path) -> None:
    shown = scene(2)
    still = replace(shown, drawn=np.zeros_like(shown.motion))
    flat = flat_of(still, OPTIONS)
    assert flat is not None
    with empty_sheet(tmp_path, still) as sheet:
        number_parts(sheet, flat, still)
        assert not sheet.axes.texts


@pytest.mark.parametrize(("count", "named"), [(2, ["part 1", "part 2"]), (len(GROUPS) + 1, [])])
def test_few_parts_are_named_by_their_colours(tmp_path: Path, count: int, named: list[str]) -> None:
    shown = scene(count)
    with empty_sheet(tmp_path, shown) as sheet:
        colours = colours_by_part(sheet, shown)
        assert list(sheet.handles) == named
    if named:
        assert colours == list(GROUPS[:count])


def test_of_many_groups_the_first_are_named_and_the_others_counted(tmp_path: Path) -> None:
    shown = scene(MOST_GROUPS + 2)
    with empty_sheet(tmp_path, shown) as sheet:
        colours = colours_by_group(sheet, shown)
        assert list(sheet.handles) == [*(f"group {i + 1}" for i in range(MOST_GROUPS)), "and 2 more groups"]
    assert len(colours) == MOST_GROUPS + 2


@pytest.mark.parametrize("stands", [True, False])
def test_ground_is_drawn_and_named_where_something_stands_on_it(tmp_path: Path, stands: bool) -> None:
    """The thick line lies at z = 0, the hatched strip below it."""
    results = row_of_blocks(2)
    if not stands:
        contacts = horizontal_contacts([[0, 1]], [(0, 1, 0, 1, 0)])
        results = replace(results, contacts=contacts)
    shown = scene_of(results, results.cases[0], OPTIONS, "model")
    flat = flat_of(shown, OPTIONS, "model")
    assert flat is not None
    with empty_sheet(tmp_path, shown) as sheet:
        draw_grounds(sheet, flat, shown)
        assert list(sheet.handles) == ["ground"] * stands
        assert len(sheet.axes.collections) == 2 * stands
        if stands:
            strip, line = sheet.axes.collections
            assert line.get_segments()[0][:, 1] == pytest.approx([0.0, 0.0])
            assert strip.get_paths()[0].vertices[:, 1].max() == pytest.approx(0.0)
