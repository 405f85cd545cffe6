"""The page of diagrams: words above, a legend below, axes between that leave each other the room that they need."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mbla.errors import UsageError
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import INK, Page, add_legend, add_words, open_page

LEAST_ROOM = 0.2
"""share of the height that words and legend must leave"""
NO_ROOM = "constrained_layout not applied"
"""how matplotlib begins to say that names and figures leave a diagram nothing"""
SCALE = "viridis"
"""colours of values: the colour-blind tell them apart, and they darken evenly in grey"""
DARK_END, LIGHT_END = 0.0, 0.88
"""part of the scale that lines use: its last colours are too light on white"""


@dataclass
class Diagrams:
    """An open page with room for diagrams between ``bottom`` and ``top``, shares of its height."""

    page: Page
    bottom: float
    top: float

    @property
    def small(self) -> float:
        """Points of letters at axes."""
        return self.page.small

    def frames(self, count: int, *, columns: int = 0, **options: Any) -> Any:
        """Axes in rows and columns, (rows, columns), the first ``count`` to be drawn in.

        columns : that many; 0 for diagrams about half as wide again as high
        options : of ``Figure.subplots``
        """
        rows, columns = (-(-count // columns), columns) if columns else self.places(count)
        self.page.figure.set_layout_engine("constrained", rect=self._rect, w_pad=0.06, h_pad=0.06)
        frames = self.page.figure.subplots(rows, columns, squeeze=False, **options)
        for axes in frames.flat[count:]:
            axes.set_axis_off()
        return frames

    def places(self, count: int) -> tuple[int, int]:
        """Rows and columns of diagrams that are about half as wide again as high, no row empty."""
        width, height = self.page.options.size
        shape = width / (1.5 * height * max(self.top - self.bottom, 0.2))
        columns = min(count, max(1, round(math.sqrt(count * shape))))
        rows = -(-count // columns)
        return rows, -(-count // rows)

    @property
    def _rect(self) -> tuple[float, float, float, float]:
        return 0.01, self.bottom, 0.98, self.top - self.bottom

    def add_legend(self, handles: Sequence[Any]) -> None:
        """A legend below diagrams that are drawn."""
        self.bottom = 0.01 + add_legend(self.page, handles)
        self.page.figure.get_layout_engine().set(rect=self._rect)

    def add_bar(self, colours: Any, frames: Any, label: str) -> Any:
        """A bar of colours next to diagrams."""
        bar = self.page.figure.colorbar(colours, ax=frames, fraction=0.04, pad=0.01, aspect=40)
        bar.ax.tick_params(labelsize=self.small)
        bar.set_label(label, fontsize=self.small, parse_math=False)
        return bar


@contextmanager
def open_diagrams(
    path: Path,
    options: PictureOptions,
    words: Sequence[str],
    mark: str = "",
    handles: Callable[[Page], Sequence[Any]] | None = None,
) -> Iterator[Diagrams]:
    """A page that is written when the block ends without an error.

    words, mark : above the diagrams, as of ``add_words``
    handles     : of a legend that is known before anything is drawn

    Raises
    ------
    UsageError
        The extra for pictures is not installed, the name asks for another format, or the page is too small.
    FileError
        The file cannot be written.
    """
    with _refused_without_room(options), open_page(path, options) as page:
        top = 1 - add_words(page, words, mark)
        bottom = 0.01 + add_legend(page, handles(page) if handles else ())
        if top - bottom < LEAST_ROOM - 0.01:
            raise UserWarning(NO_ROOM)
        yield Diagrams(page, bottom, top)


@contextmanager
def _refused_without_room(options: PictureOptions) -> Iterator[None]:
    try:
        with warnings.catch_warnings():
            warnings.filterwarnings("error", message=NO_ROOM)
            yield
    except UserWarning as error:
        width, height = options.size
        raise UsageError(
            "picture-option", f"--size {width}x{height}: words and legend leave no room; choose a larger one"
        ) from error


def dress(page: Page, axes: Any, x: str = "", y: str = "", title: str = "") -> None:
    """Letters, grid and names of a diagram."""
    axes.tick_params(labelsize=page.small, colors=INK)
    axes.grid(visible=True, color="#DDDDDD", linewidth=0.6, zorder=0)
    axes.set_axisbelow(True)
    if "top" in axes.spines:
        axes.spines[["top", "right"]].set_visible(False)
    style = {"fontsize": page.small, "color": INK, "parse_math": False}
    axes.set_xlabel(x, **style)
    axes.set_ylabel(y, **style)
    axes.set_title(title, **style)


def tint(page: Page, number: int, count: int) -> Any:
    """Colour of a line by its place among ``count``."""
    return page.parts.colormaps[SCALE](DARK_END + (LIGHT_END - DARK_END) * number / max(count - 1, 1))


def hollow(page: Page, marker: str, colour: str) -> dict[str, Any]:
    """Style of markers that are no values: outlines alone, without a line."""
    return {
        "linestyle": "none", "marker": marker, "markerfacecolor": "none", "markeredgecolor": colour,
        "markeredgewidth": 1.5 * page.scale, "markersize": 8.0 * page.scale,
    }  # fmt: skip
