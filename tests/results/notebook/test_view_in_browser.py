"""The page of a view in the frame that a notebook makes of it, in a real browser."""

from pathlib import Path
from typing import Any

import pytest

from mbla.results.notebook.run import Run
from tests.browser import visited
from tests.results.synthetic import tower_results

pytestmark = pytest.mark.long


def test_the_view_in_a_frame(browser: Any, tmp_path: Path) -> None:
    view = Run(tower_results())["push_x"].show()
    page = tmp_path / "notebook.html"
    page.write_text(f"<!DOCTYPE html><body>{view._repr_html_()}</body>", encoding="utf-8")
    assert view.save(tmp_path / "view.html").read_text(encoding="utf-8") == view.page
    found = visited(browser, page.as_uri())
    frame = found.page.frame_locator("iframe")
    frame.locator("[data-mbla-ready] canvas").first.wait_for(state="attached")
    assert frame.locator(".mbla-view3d-title").inner_text().startswith("Tower and brick")
    assert (found.errors, [url for url in found.requests if not url.startswith("about:")]) == ([], [])
