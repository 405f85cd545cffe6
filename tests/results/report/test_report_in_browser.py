"""The report in a real browser: what it loads, how wide it is, that it opens, and what it prints."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from mbla.results.pictures.space import can_draw
from mbla.results.records.json_record import results_json
from mbla.results.report.report import write_report
from mbla.results.results import Results
from mbla.results.words.text import number
from tests.results.synthetic import tower_results

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

WIDTHS = (1280, 390)
EVIL = "<img src=x onerror=document.title='evil'><script>document.title='evil'</script>"


@dataclass
class Opened:
    """A page, and what it did."""

    page: Page
    requests: list[str] = field(default_factory=list)
    errors: list[str] = field(default_factory=list)


def open_report(browser: Browser, path: Path, width: int = 1280) -> Opened:
    opened = Opened(browser.new_page(viewport={"width": width, "height": 800}))
    page = opened.page
    page.on("request", lambda request: opened.requests.append(request.url))
    page.on("console", lambda message: opened.errors.append(message.text) if message.type == "error" else None)
    page.on("pageerror", lambda error: opened.errors.append(str(error)))
    page.goto(path.resolve().as_uri())
    return opened


def evil_results() -> Results:
    """Text that would run if it were not text, in everything that has a name; a long name in a table."""
    results = tower_results()
    blocks = replace(results.model.blocks, groups=(EVIL, "tower" * 30, "brick"))
    deck = replace(results.deck, sources=(("tower.yaml", f"# {EVIL}\n" + "x" * 400),))
    return replace(results, model=replace(results.model, title=EVIL, blocks=blocks), deck=deck)


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("report") / "evil.html"
    write_report(evil_results(), path, view=False)
    return path


@pytest.fixture(params=WIDTHS)
def opened(browser: Browser, report: Path, request: pytest.FixtureRequest) -> Iterator[Opened]:
    found = open_report(browser, report, request.param)
    yield found
    found.page.close()


def test_no_errors_and_no_request_leaves_the_page(opened: Opened, report: Path) -> None:
    opened.page.wait_for_timeout(100)
    assert opened.errors == []
    assert opened.requests[0] == report.resolve().as_uri()
    assert all(url.startswith("data:") for url in opened.requests[1:])


def test_text_from_elsewhere_does_not_run(opened: Opened) -> None:
    assert opened.page.title().startswith(EVIL)
    assert opened.page.locator("h1").inner_text() == EVIL


def test_the_page_is_never_wider_than_the_screen(opened: Opened) -> None:
    sizes = opened.page.evaluate("[document.documentElement.scrollWidth, window.innerWidth]")
    assert sizes[0] <= sizes[1]
    tables = opened.page.evaluate(
        "[...document.querySelectorAll('.scroll')].map(box => [box.scrollWidth, box.clientWidth, "
        "getComputedStyle(box).overflowX])"
    )
    assert all(overflow == "auto" for _, _, overflow in tables)
    if sizes[1] == min(WIDTHS):
        assert any(inner > outer for inner, outer, _ in tables)  # so that something was there to overflow


def test_the_sections_have_the_figures_of_the_record(opened: Opened) -> None:
    page, record = opened.page, results_json(evil_results())
    cells = page.locator("#verdicts tbody tr").nth(0).locator("th, td").all_inner_texts()
    case = record["cases"][0]
    assert cells[:3] == [case["name"], case["status"], number(case["load_factor"])]
    assert cells[5] == f"{case['static_bound']:.8g}"
    for name in ("results", "case-1", "case-2", "model", "warnings", "deck", "provenance"):
        assert page.locator(f"section#{name}").is_visible()
    assert number(record["model"]["total_weight"]) in page.locator("#model").inner_text()


def test_the_deck_opens(opened: Opened) -> None:
    text = opened.page.locator("#deck pre").first
    assert not text.is_visible()
    opened.page.locator("#deck summary").first.click()
    assert text.is_visible()
    assert EVIL in text.inner_text()


def test_the_contents_lead_to_their_sections(opened: Opened) -> None:
    opened.page.locator("nav a", has_text="Deck").click()
    assert opened.page.url.endswith("#deck")
    top = opened.page.locator("#deck").bounding_box()
    assert top is not None
    assert -1 <= top["y"] < 800


def contrast(first: str, second: str) -> float:
    """Contrast of two colours, https://www.w3.org/TR/WCAG21/#dfn-contrast-ratio."""

    def luminance(colour: str) -> float:
        parts = np.array([float(part) for part in re.findall(r"[\d.]+", colour)[:3]]) / 255
        linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
        return float(linear @ [0.2126, 0.7152, 0.0722])

    light, dark = sorted((luminance(first), luminance(second)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def test_all_text_can_be_read(opened: Opened) -> None:
    """Contrast of at least 4.5 of every element's text with the nearest background that is painted."""
    pairs = opened.page.evaluate(
        "[...document.querySelectorAll('body *')].filter(e => e.innerText && e.checkVisibility()).map(e => {"
        " let b = e; while (b && getComputedStyle(b).backgroundColor == 'rgba(0, 0, 0, 0)') b = b.parentElement;"
        " return [getComputedStyle(e).color, b ? getComputedStyle(b).backgroundColor : 'rgb(255, 255, 255)'] })"
    )
    assert len(pairs) > 100
    assert min(contrast(*pair) for pair in set(map(tuple, pairs))) >= 4.5


def test_it_prints_with_the_deck_opened(browser: Browser, report: Path, tmp_path: Path) -> None:
    opened = open_report(browser, report)
    data = opened.page.pdf(path=tmp_path / "report.pdf", prefer_css_page_size=True)
    opened.page.close()
    assert data.startswith(b"%PDF")
    assert len(re.findall(rb"/Type\s*/Page\b", data)) >= 5
    if shutil.which("pdftotext"):
        command = ["pdftotext", "-layout", str(tmp_path / "report.pdf"), "-"]
        text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        assert "collapses at 0.5 g, verified" in text
        assert "document.title='evil'" in text.split("Deck\n")[-1]
        assert re.search(r"^ *1 ?/ ?\d+$", text, re.MULTILINE)


@pytest.mark.skipif(not can_draw(), reason="the machine has no OpenGL")
def test_pictures_are_painted(browser: Browser, report: Path) -> None:
    pytest.importorskip("pyvista")
    opened = open_report(browser, report)
    widths = opened.page.evaluate("[...document.images].map(image => image.naturalWidth)")
    opened.page.close()
    assert len(widths) >= 2
    assert min(widths) >= 800
