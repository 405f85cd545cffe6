"""What tests of several folders share: a browser, and a line at the end that says whether there was one."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import Browser

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
BROWSER_TESTS = "_in_browser.py"
"""end of the names of files whose tests drive a browser"""
OPTIONS = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
"""a browser in a container has no sandbox, and no graphics card: WebGL is drawn in software"""


def find_browser() -> str | None:
    """The browser that MBLA_BROWSER names, else the first of the usual ones; None without any."""
    names = (os.environ.get("MBLA_BROWSER", ""), *BROWSERS)
    return next((path for path in map(shutil.which, filter(None, names)) if path), None)


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """A headless browser; tests that want one are skipped where there is none."""
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    path = find_browser()
    if path is None:
        pytest.skip(f"no browser: none of {', '.join(BROWSERS)}, and MBLA_BROWSER names none")
    with playwright.sync_playwright() as driver:
        running = driver.chromium.launch(executable_path=path, args=OPTIONS)
        yield running
        running.close()


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """``tests in a browser: 8 passed, 0 skipped (/usr/bin/chromium)``, where any were asked for."""
    counts = {
        outcome: sum(BROWSER_TESTS in report.nodeid for report in terminalreporter.stats.get(outcome, []))
        for outcome in ("passed", "failed", "error", "skipped")
    }
    if any(counts.values()):
        shown = ", ".join(f"{count} {outcome}" for outcome, count in counts.items() if count)
        terminalreporter.write_line(f"tests in a browser: {shown} ({find_browser() or 'no browser found'})")
