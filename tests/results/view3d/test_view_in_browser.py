"""The view in a real browser: that it is drawn, turns, moves and names blocks, and asks for nothing from a network."""

from dataclasses import replace
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.results.results import Results
from mbla.results.view3d.view import page_html, view_html
from mbla.solution.solution import Status
from tests.browser import Visit, visited
from tests.results.synthetic import tower_results

pytestmark = pytest.mark.long

PLOT = ".mbla-view3d-plot"
READY = "[data-mbla-ready]"


@pytest.fixture(scope="module")
def results() -> Results:
    return tower_results()


@pytest.fixture(scope="module")
def visit(browser: Any, results: Results, tmp_path_factory: pytest.TempPathFactory) -> Visit:
    path = tmp_path_factory.mktemp("view") / "page.html"
    path.write_text(page_html(results, results.cases[0]), encoding="utf-8")
    found = visited(browser, path.as_uri())
    found.page.wait_for_selector(READY, state="attached")
    return found


def test_the_structure_is_drawn_and_nothing_else_is_asked_for(visit: Visit) -> None:
    picture = visit.still(PLOT)
    assert (picture.min(axis=2) < 250).mean() > 0.05
    orange = (picture[..., 0] - picture[..., 2] > 60).sum()
    assert orange > 2000  # the tower, which is the part that moves
    assert visit.requests == []
    assert visit.errors == []


def test_it_turns_with_the_mouse(visit: Visit) -> None:
    before = visit.still(PLOT)
    box = visit.page.locator(PLOT).bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    visit.page.mouse.move(x, y)
    visit.page.mouse.down()
    visit.page.mouse.move(x + 150, y + 40, steps=5)
    visit.page.mouse.up()
    visit.still(PLOT, before, 5000)
    assert visit.errors == []


def test_slider_moves_the_tower_as_the_pictures_do(visit: Visit, results: Results) -> None:
    """The browser's finite rotation against that of motion.py, and as built at the other end."""
    from mbla.results.collapse.motion import drawn_motion, moved_vertices

    blocks = results.model.blocks
    for time in ("1", "0.5", "0"):
        visit.page.locator("input[type=range]").fill(time)
        visit.still(PLOT)
        drawn = visit.page.evaluate(
            f"(() => {{ const mesh = document.querySelector('{PLOT}').data[0];"
            "return [mesh.x, mesh.y, mesh.z].map((values) => Array.from(values)); })()"
        )
        expected = moved_vertices(blocks, float(time) * drawn_motion(results.model, results.cases[0]))
        np.testing.assert_allclose(np.transpose(drawn), expected, atol=1e-6)


def test_colours_and_layers_can_be_chosen(visit: Visit) -> None:
    before = visit.still(PLOT)
    visit.page.select_option("select", "group")
    coloured = visit.still(PLOT, before, 2000)
    assert visit.page.locator(".mbla-view3d-legend").inner_text().split() == ["base", "tower", "brick"]
    visit.page.get_by_label("resultant").check()
    assert visit.page.get_by_label("see through blocks").is_checked()
    visit.still(PLOT, coloured, 2000)
    assert visit.errors == []


def test_hover_names_the_block(visit: Visit) -> None:
    """On the page as it opens: how far a drag turned it depends on how busy the machine was."""
    visit.page.reload()
    visit.page.wait_for_selector(READY, state="attached")
    visit.page.select_option("select", "group")
    box = visit.page.locator(PLOT).bounding_box()
    told: set[str] = set()
    for patience in (150, 500, 1500):  # ms at each place: a busy machine draws what is hovered over late
        for down, across in product((0.6, 0.7, 0.5), np.linspace(0.2, 0.8, 7)):
            visit.page.mouse.move(box["x"] + across * box["width"], box["y"] + down * box["height"], steps=2)
            visit.page.wait_for_timeout(patience)
            told.update(visit.page.locator(".hoverlayer text, .nums").all_text_contents())
            if any("base[0]" in text for text in told):
                return
    raise AssertionError(f"no block base[0] in {told}")


def test_two_views_share_the_library(browser: Any, results: Results, tmp_path: Path) -> None:
    falling = replace(results.cases[1], status=Status.NO_EQUILIBRIUM)
    parts = [
        view_html(results, results.cases[0], include_library=True),
        view_html(results, falling, include_library=False),
    ]
    path = tmp_path / "page.html"
    path.write_text(f'<!DOCTYPE html><meta charset="utf-8">{"".join(parts)}', encoding="utf-8")
    found = visited(browser, path.as_uri(), 390, 900)
    found.page.wait_for_selector(READY, state="attached")
    found.page.locator(".mbla-view3d").last.scroll_into_view_if_needed()
    found.page.wait_for_function(f"document.querySelectorAll('{READY}').length === 2")
    assert found.page.evaluate("document.documentElement.scrollWidth") <= 390  # nothing juts out on a phone
    assert (found.errors, found.requests) == ([], [])
