"""A browser of the machine for tests, without a window; a test that needs it is skipped where there is none."""

from __future__ import annotations

import io
import os
import shutil
from dataclasses import dataclass, field
from typing import Any

import numpy as np

NAMES = (os.environ.get("MBLA_BROWSER", ""), "chromium", "chromium-browser", "google-chrome")
CHROMIUM = next((path for path in map(shutil.which, filter(None, NAMES)) if path), None)
"""the browser that MBLA_BROWSER names, else the first of the usual ones"""
ARGUMENTS = ("--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
"""without a sandbox, as tests may run as root; WebGL by software"""

PATIENCE = 120_000
"""milliseconds for a page to load or to show what is waited for"""
PAUSE, PICTURES = 300, 100
"""milliseconds before a picture is taken, and how many are taken until something has changed"""
VISIBLE = 30
"""of 255: what is more is a change of colour"""


@dataclass
class Visit:
    """A page with what it did: addresses asked for besides its own, errors and complaints of its scripts."""

    page: Any
    requests: list[str] = field(default_factory=list)
    errors: list[str] = field(default_factory=list)

    def pixels(self, selector: str) -> Any:
        """What an element looks like, (height, width, 3)."""
        from PIL import Image

        with Image.open(io.BytesIO(self.page.locator(selector).first.screenshot())) as image:
            return np.asarray(image)[..., :3].astype(int)

    def changed(self, selector: str, before: Any, count: int) -> Any:
        """The same after more than so many of its pixels have changed; a busy machine draws late, and is waited for."""
        picture = before
        for _ in range(PICTURES):
            self.page.wait_for_timeout(PAUSE)
            picture = self.pixels(selector)
            if (np.abs(before - picture).max(axis=2) > VISIBLE).sum() > count:
                return picture
        raise AssertionError(f"{selector} has not changed in more than {count} pixels")


def visited(browser: Any, address: str, width: int = 900, height: int = 800) -> Visit:
    """A page that was loaded from an address."""
    page = browser.new_page(viewport={"width": width, "height": height})
    page.set_default_timeout(PATIENCE)
    visit = Visit(page)
    page.on("request", lambda request: visit.requests.append(request.url))
    page.on("pageerror", lambda error: visit.errors.append(str(error)))
    page.on("console", lambda said: visit.errors.append(said.text) if said.type == "error" else None)
    page.goto(address)
    visit.requests.remove(address)
    return visit
