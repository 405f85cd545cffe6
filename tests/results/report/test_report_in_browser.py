"""The report in a real browser: what it loads, how wide it is, that it opens, and what it prints."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.results.report import report as report_module
from mbla.results.report.figures import ReportFigures
from mbla.results.report.report import write_report
from mbla.results.results import Results
from tests.browser import Visit, visited
from tests.results.synthetic import tower_results

pytestmark = pytest.mark.long

WIDTHS = (1280, 390)
EVIL = "<img src=x onerror=document.title='evil'><script>document.title='evil'</script>"


def open_report(browser: Any, path: Path, width: int = 1280) -> Visit:
    return visited(browser, path.resolve().as_uri(), width)


def evil_results() -> Results:
    """Text that would run if it were not text, in everything that has a name; a long name in a table."""
    results = tower_results()
    blocks = replace(results.model.blocks, groups=(EVIL, "tower" * 30, "brick"))
    deck = replace(results.deck, sources=(("tower.yaml", f"# {EVIL}\n" + "x" * 400),))
    return replace(
        results, assembly=replace(results.assembly, model=replace(results.model, title=EVIL, blocks=blocks)), deck=deck
    )


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("report") / "evil.html"
    write_report(evil_results(), path, view=False)
    return path


@pytest.fixture(params=WIDTHS)
def opened(browser: Any, report: Path, request: pytest.FixtureRequest) -> Iterator[Visit]:
    found = open_report(browser, report, request.param)
    yield found
    found.page.close()


def test_no_errors_and_no_request_leaves_the_page(opened: Visit) -> None:
    opened.page.wait_for_timeout(100)
    assert opened.errors == []
    assert all(url.startswith("data:") for url in opened.requests)


def test_text_from_elsewhere_does_not_run(opened: Visit) -> None:
    assert opened.page.title().startswith(EVIL)
    assert opened.page.locator("h1").inner_text() == EVIL


def test_the_page_is_never_wider_than_the_screen(opened: Visit) -> None:
    sizes = opened.page.evaluate("[document.documentElement.scrollWidth, window.innerWidth]")
    assert sizes[0] <= sizes[1]
    tables = opened.page.evaluate(
        "[...document.querySelectorAll('.scroll')].map(box => [box.scrollWidth, box.clientWidth, "
        "getComputedStyle(box).overflowX])"
    )
    assert all(overflow == "auto" for _, _, overflow in tables)
    if sizes[1] == min(WIDTHS):
        assert any(inner > outer for inner, outer, _ in tables)  # so that something was there to overflow


def contrast(first: str, second: str) -> float:
    """Contrast of two colours, https://www.w3.org/TR/WCAG21/#dfn-contrast-ratio."""

    def luminance(colour: str) -> float:
        parts = np.array([float(part) for part in re.findall(r"[\d.]+", colour)[:3]]) / 255
        linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
        return float(linear @ [0.2126, 0.7152, 0.0722])

    light, dark = sorted((luminance(first), luminance(second)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def test_all_text_can_be_read(opened: Visit) -> None:
    """Contrast of at least 4.5 of every element's text with the nearest background that is painted."""
    pairs = opened.page.evaluate(
        "[...document.querySelectorAll('body *')].filter(e => e.innerText && e.checkVisibility()).map(e => {"
        " let b = e; while (b && getComputedStyle(b).backgroundColor == 'rgba(0, 0, 0, 0)') b = b.parentElement;"
        " return [getComputedStyle(e).color, b ? getComputedStyle(b).backgroundColor : 'rgb(255, 255, 255)'] })"
    )
    assert len(pairs) > 100
    assert min(contrast(*pair) for pair in set(map(tuple, pairs))) >= 4.5


def test_it_prints_with_the_deck_opened(browser: Any, report: Path, tmp_path: Path) -> None:
    opened = open_report(browser, report)
    data = opened.page.pdf(path=tmp_path / "report.pdf", prefer_css_page_size=True)
    opened.page.close()
    assert data.startswith(b"%PDF")
    assert len(re.findall(rb"/Type\s*/Page\b", data)) >= 5
    if shutil.which("pdftotext"):
        command = ["pdftotext", "-layout", str(tmp_path / "report.pdf"), "-"]
        text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        assert "collapses at 0.5 g, verified" in text
        assert "NO EQUILIBRIUM: the structure does not stand under its dead load" in text
        assert "document.title='evil'" in text.split("Deck\n")[-1]
        assert re.search(r"^ *1 ?/ ?\d+$", text, re.MULTILINE)


# --- views to turn ------------------------------------------------------------------------------------------------


MANY = 7
"""load cases: more than there may be views alive"""
ALIVE = "[data-mbla-ready]"


@pytest.fixture(scope="module")
def with_views(browser: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Visit]:
    pytest.importorskip("plotly")
    results = evil_results()
    first = results.cases[0]
    load_cases = [replace(first.load_case, name=f"push_{i}") for i in range(MANY)]
    results = replace(results, cases=tuple(replace(first, load_case=each) for each in load_cases))
    path = tmp_path_factory.mktemp("views") / "report.html"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(report_module, "case_figures", lambda results, case: ReportFigures(()))
        write_report(results, path)
    found = open_report(browser, path)
    yield found
    found.page.close()


def test_a_view_begins_when_it_is_seen_and_turns(with_views: Visit) -> None:
    page = with_views.page
    assert page.locator(f"#case-{MANY}-view {ALIVE}").count() == 0
    page.locator("#case-1-view").scroll_into_view_if_needed()
    page.wait_for_selector(f"#case-1-view {ALIVE}")
    canvas = page.locator("#case-1-view canvas").first
    before = with_views.pixels("#case-1-view .mbla-view3d-plot")
    assert before.std() > 1  # something is drawn
    box = canvas.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 120, y + 40, steps=4)
    page.mouse.up()
    after = with_views.still("#case-1-view .mbla-view3d-plot", before)
    assert np.abs(before - after).max() > 50


def test_views_ask_for_nothing_and_complain_of_nothing(with_views: Visit) -> None:
    assert with_views.errors == []
    assert all(url.startswith(("data:", "blob:")) for url in with_views.requests)
    assert with_views.page.title().startswith(EVIL)
    sizes = with_views.page.evaluate("[document.documentElement.scrollWidth, window.innerWidth]")
    assert sizes[0] <= sizes[1]
