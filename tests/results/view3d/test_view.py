import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.errors import UsageError
from mbla.results.results import Results
from mbla.results.view3d import view
from mbla.results.view3d.view import library_html, page_html, view_html
from mbla.solution.solution import Status
from tests.browser import Visit, needs_browser, visited
from tests.results.synthetic import tower_results

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


def settled(visit: Visit) -> Any:
    visit.page.wait_for_timeout(400)
    return visit.pixels(PLOT)


def changed(first: Any, second: Any) -> int:
    return int((np.abs(first - second).max(axis=2) > 30).sum())


@needs_browser
def test_the_structure_is_drawn_and_nothing_else_is_asked_for(visit: Visit) -> None:
    picture = settled(visit)
    assert (picture.min(axis=2) < 250).mean() > 0.05
    blue = (picture[..., 2] - picture[..., 0] > 60).sum()
    assert blue > 2000  # the tower, which moves
    assert visit.requests == []
    assert visit.errors == []


@needs_browser
def test_it_turns_with_the_mouse(visit: Visit) -> None:
    before = settled(visit)
    box = visit.page.locator(PLOT).bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    visit.page.mouse.move(x, y)
    visit.page.mouse.down()
    visit.page.mouse.move(x + 150, y + 40, steps=5)
    visit.page.mouse.up()
    assert changed(before, settled(visit)) > 5000
    assert visit.errors == []


@needs_browser
def test_slider_moves_the_tower_as_the_pictures_do(visit: Visit, results: Results) -> None:
    """The browser's finite rotation against that of motion.py, and as built at the other end."""
    from mbla.results.collapse.motion import drawn_motion, moved_vertices

    blocks = results.model.blocks
    for time in ("1", "0.5", "0"):
        visit.page.locator("input[type=range]").fill(time)
        settled(visit)
        drawn = visit.page.evaluate(
            f"(() => {{ const mesh = document.querySelector('{PLOT}').data[0];"
            "return [mesh.x, mesh.y, mesh.z].map((values) => Array.from(values)); })()"
        )
        expected = moved_vertices(blocks, float(time) * drawn_motion(results.model, results.cases[0]))
        np.testing.assert_allclose(np.transpose(drawn), expected, atol=1e-6)


@needs_browser
def test_colours_and_layers_can_be_chosen(visit: Visit) -> None:
    before = settled(visit)
    visit.page.select_option("select", "group")
    coloured = settled(visit)
    assert changed(before, coloured) > 2000
    assert visit.page.locator(".mbla-view3d-legend").inner_text().split() == ["base", "brick", "tower"]
    visit.page.get_by_label("resultants").check()
    assert visit.page.get_by_label("see through blocks").is_checked()
    assert changed(coloured, settled(visit)) > 2000
    assert visit.errors == []


@needs_browser
def test_hover_names_the_block(visit: Visit) -> None:
    visit.page.select_option("select", "group")
    box = visit.page.locator(PLOT).bounding_box()
    told = set()
    for across in np.linspace(0.2, 0.8, 7):
        visit.page.mouse.move(box["x"] + across * box["width"], box["y"] + 0.6 * box["height"], steps=2)
        visit.page.wait_for_timeout(150)
        told.update(visit.page.locator(".hoverlayer text, .nums").all_text_contents())
    assert any("base[0]" in text for text in told), told


@needs_browser
def test_two_views_share_the_library(browser: Any, results: Results, tmp_path: Path) -> None:
    falling = replace(results.cases[1], status=Status.NO_EQUILIBRIUM)
    parts = [
        view_html(results, results.cases[0], include_library=True),
        view_html(results, falling, include_library=False),
    ]
    path = tmp_path / "page.html"
    path.write_text(f'<!DOCTYPE html><meta charset="utf-8">{"".join(parts)}', encoding="utf-8")
    found = visited(browser, path.as_uri(), 390, 900)
    found.page.wait_for_function(f"document.querySelectorAll('{READY}').length === 2")
    assert found.page.evaluate("document.documentElement.scrollWidth") <= 390  # nothing juts out on a phone
    assert (found.errors, found.requests) == ([], [])


def test_library_is_there_once_and_on_request(results: Results) -> None:
    with_it = view_html(results, results.cases[0], include_library=True)
    without = view_html(results, results.cases[0], include_library=False)
    assert with_it == library_html() + without
    assert len(without) < 50_000
    assert "src=" not in re.sub(r"<script>.*?</script>", "", with_it, flags=re.DOTALL)


@pytest.mark.parametrize("status", [Status.NOT_VERIFIED, Status.APPROXIMATE, Status.ITERATION_LIMIT, Status.SOLVED])
def test_title_says_what_the_figure_is_worth(results: Results, status: Status) -> None:
    text = view_html(results, replace(results.cases[0], status=status), include_library=False)
    title = text[: text.index("<script>")]
    words = {"not_verified": "NOT VERIFIED", "approximate": "approximate", "iteration_limit": "NOT SOLVED"}
    assert words.get(status.value, "0.5 g, verified") in title
    assert (view.ALARM in title) == (status is not Status.SOLVED)


def test_no_text_of_a_deck_is_markup(results: Results) -> None:
    evil = "</script><script>alert(1)</script>"
    blocks = replace(results.model.blocks, groups=("base", evil, "brick"))
    model = replace(results.model, title=evil, blocks=blocks)
    text = page_html(replace(results, model=model), results.cases[0]).replace(library_html(), "")
    assert "alert(1)</script>" not in text
    assert text.count("<script>") == 1


def test_missing_extra_is_told(results: Results, monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    view._plotly_js.cache_clear()
    monkeypatch.setitem(sys.modules, "plotly.offline", None)
    with pytest.raises(UsageError, match=r"mbla\[report\]"):
        view_html(results, results.cases[0], include_library=True)
    view_html(results, results.cases[0], include_library=False)
