"""A sheet of the plane with one drawing alone, for tests of what is drawn."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import open_page
from mbla.results.pictures.plane.flat import Flat, flat_of
from mbla.results.pictures.plane.sheet import Sheet, new_sheet
from mbla.results.pictures.scene import Scene

OPTIONS = PictureOptions()


@contextmanager
def drawn_alone(folder: Path, scene: Scene, draw: Callable[[Sheet, Flat, Scene], None]) -> Iterator[Sheet]:
    """The sheet as it is after the drawing, while its page is open."""
    flat = flat_of(scene, OPTIONS)
    assert flat is not None
    with open_page(folder / "page.svg", OPTIONS) as page:
        sheet = new_sheet(page, scene.size)
        draw(sheet, flat, scene)
        yield sheet
