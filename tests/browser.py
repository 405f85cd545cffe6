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
"""milliseconds before a picture is taken, and how many are taken until nothing moves any more"""
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

    def still(self, selector: str, unlike: Any = None, count: int = 0) -> Any:
        """The same when it looks twice alike, and in more than so many pixels unlike an earlier picture, if given.

        A busy machine draws late, and is waited for; AssertionError where it is not so in the end.
        """
        last = self.pixels(selector)
        for _ in range(PICTURES):
            self.page.wait_for_timeout(PAUSE)
            before, last = last, self.pixels(selector)
            if not different(before, last) and (unlike is None or different(unlike, last) > count):
                return last
        raise AssertionError(f"{selector} still moves, or has not changed in more than {count} pixels")


def different(one: Any, other: Any) -> int:
    """Pixels of two pictures of one size that an eye tells apart."""
    assert one.shape == other.shape
    return int((np.abs(one - other).max(axis=2) > VISIBLE).sum())


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
