"""The sheet that every picture is drawn on: colours, sizes, fonts and files (only importer of matplotlib's figures).

Colours never stand alone: hinges are dots, sliding is an arrow pair or a thick line, opening is filled or hatched.

Words stay words in SVG and PDF. The same picture gives the same file.
"""

from __future__ import annotations

import logging
import math
import textwrap
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

from mbla.arrays import FloatArray
from mbla.errors import FileError, UsageError
from mbla.results.disk import writing_complete
from mbla.results.listing.text import number
from mbla.results.pictures.options import DOTS_PER_INCH, PictureOptions, format_of, is_single

ORANGE, SKY, GREEN = "#E69F00", "#56B4E9", "#009E73"
BLUE, VERMILION, PURPLE, BLACK = "#0072B2", "#D55E00", "#CC79A7", "#000000"

INK = "#222222"
"""outlines and words"""
GHOST = "#8A8A8A"
"""the structure before it moved"""
GROUND, SLAB = "#595959", "#C4C4C4"
FIXED_BLOCK, GUIDED_BLOCK = "#9E9E9E", "#C4BBA6"
REST = "#EDE6D4"
"""blocks that do not move"""
SLOW = "#C5DE8F"
"""blocks that move, but in none of the few parts that stand for the mechanism: less than these"""
SOIL = "#DCC7A3"
"""soil of cells, at rest or moving: slip lines tell its parts"""
HINGE, SLIDE, OPEN, CRUSH = VERMILION, GREEN, PURPLE, BLACK
DEAD_LOAD, LIVE_LOAD, FILL = "#7A7A7A", BLUE, "#9A6B3F"
THRUST, RESULTANT, OTHER_END = "#0A2FD0", "#5B1A8B", "#B8860B"
"""dark, to be seen through pale blocks"""
WARNING = "#B00020"
"""marks figures that are no result"""

GROUPS = ("#F2C36B", "#A6D3F0", "#7CC7AE", "#F4EE9B", "#7FB2D6", "#EDAE86", "#E3BAD1", "#D9D9D9")
"""light tints of the eight, for groups of blocks in their order; what follows begins again"""


def rgb(colour: str) -> tuple[float, float, float]:
    """Red, green and blue of ``#RRGGBB``, 0 to 1."""
    red, green, blue = (int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return red, green, blue


def group_colours(groups: tuple[str, ...]) -> dict[str, str]:
    """Colour of each group, in the order in which they first appear."""
    return {name: GROUPS[i % len(GROUPS)] for i, name in enumerate(dict.fromkeys(groups))}


CASES = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, BLACK)
"""live loads of several load cases"""


# --- Pages of pictures ----------------------------------------------------------------------------------------------


COLUMNS = 120
"""letters in a line of words of the usual size"""
LETTER = 14.0
"""points of letters on a page of the usual width"""
USUAL_WIDTH = 1600
LEAST_LETTER, SMALL = 8.0, 0.85
"""points of the smallest letters, and size of those at axes against those of the words"""
METADATA: dict[str, dict[str, Any]] = {
    "png": {"Software": "mbla"},
    "svg": {"Date": None},
    "pdf": {"CreationDate": None},
}
"""without dates, so that the same picture gives the same file"""
EDGE = 0.015
"""margin of words, share of the width"""


def matplotlib_parts() -> Any:
    """The library matplotlib with its figures; raises UsageError where the extra is not installed."""
    logging.getLogger("matplotlib").setLevel(logging.ERROR)  # remarks on its cache folder are not for users
    try:
        import matplotlib.backends.backend_agg
        import matplotlib.figure
    except ImportError as error:
        raise UsageError(
            "extra-missing", "pictures need an extra that is not installed: pip install 'mbla[pictures]'"
        ) from error
    return matplotlib


@dataclass(frozen=True)
class Page:
    """An open page.

    scale : of letters and lines against those of the usual width
    """

    parts: Any
    figure: Any
    options: PictureOptions
    scale: float

    @property
    def letter(self) -> float:
        """Size of letters, points."""
        return LETTER * self.scale

    @property
    def small(self) -> float:
        """Size of letters at axes and in legends, points."""
        return max(LEAST_LETTER, SMALL * self.letter)

    def line(self, label: str, **style: Any) -> Any:
        """An entry of a legend: a line or marker."""
        return self.parts.lines.Line2D([], [], label=label, **style)

    def box(self, label: str, **style: Any) -> Any:
        """An entry of a legend: a filled box."""
        return self.parts.patches.Patch(label=label, **style)

    def height_of(self, artist: Any) -> float:
        """Height of words or a legend, share of the page."""
        return float(self.extent_of(artist).height / (self.figure.dpi * self.figure.get_figheight()))

    def width_of(self, artist: Any) -> float:
        """Width of words or a legend, share of the page."""
        return float(self.extent_of(artist).width / (self.figure.dpi * self.figure.get_figwidth()))

    def extent_of(self, artist: Any) -> Any:
        """Box of words or a legend in pixels."""
        return artist.get_window_extent(self.figure.canvas.get_renderer())


@contextmanager
def open_page(path: Path, options: PictureOptions) -> Iterator[Page]:
    """A page that is written when the block ends without an error.

    Raises
    ------
    UsageError
        The extra for pictures is not installed, or the name asks for another format.
    FileError
        The file cannot be written.
    """
    kind = format_of(path)
    with open_frames(options) as page:
        yield page
        drawn = BytesIO()  # matplotlib reports a PDF that it cannot write in words of its own
        page.figure.savefig(drawn, format=kind, metadata=METADATA[kind])
        try:
            path.write_bytes(drawn.getbuffer())
        except OSError as error:
            raise FileError("file-not-written", f"{path}: {error.strerror or error}") from error


@contextmanager
def open_frames(options: PictureOptions) -> Iterator[Page]:
    """A page that goes to no file by itself; its figure is drawn as often as wanted.

    Raises UsageError where the extra for pictures is not installed.
    """
    parts = matplotlib_parts()
    style = {"svg.fonttype": "none", "svg.hashsalt": "mbla", "pdf.fonttype": 42, "hatch.linewidth": 0.6}
    with parts.rc_context(style), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph")  # of a script that the font does not have: a box is drawn
        width, height = options.size
        figure = parts.figure.Figure(figsize=(width / DOTS_PER_INCH, height / DOTS_PER_INCH), dpi=options.dpi)
        parts.backends.backend_agg.FigureCanvasAgg(figure)
        yield Page(parts, figure, options, min(max(width / USUAL_WIDTH, LEAST_LETTER / LETTER), 2.0))


def add_words(page: Page, words: Sequence[str], mark: str = "") -> float:
    """Write words at the top, the first line bold, a mark in red after it; the share of the height they take."""
    aspect = page.options.size[0] / USUAL_WIDTH / page.scale
    columns = max(20, int(COLUMNS * aspect))
    lines = [part for line in words for part in textwrap.wrap(line, columns)]
    style = {"va": "top", "color": INK, "parse_math": False, "linespacing": 1.4}
    gap = EDGE * page.options.size[0] / page.options.size[1]
    used = gap
    first = len(textwrap.wrap(words[0], columns)) if words else 0
    for part, weight in ((lines[:first], "bold"), (lines[first:], "normal")):
        if part:
            text = page.figure.text(EDGE, 1 - used, "\n".join(part), fontsize=page.letter, weight=weight, **style)
            used += page.height_of(text) + gap / 4
    if mark:
        style["color"] = WARNING
        text = page.figure.text(EDGE, 1 - used - gap / 2, mark, fontsize=page.letter, weight="bold", **style)
        used += gap / 2 + page.height_of(text)
        frame = page.parts.patches.Rectangle((0, 0), 1, 1, fill=False, edgecolor=WARNING, linewidth=8 * page.scale)
        page.figure.add_artist(frame)
    return used + gap / 2


# --- Legend, scale and axes ------------------------------------------------------------------------------------------

ARM = 0.05
"""length of an axis over the height of the page"""
TICK = 0.008
"""half height of the ends of a bar"""
SEEN = 0.15
"""length of an axis as seen over its true one below which it is a dot"""


def add_legend(page: Page, handles: Sequence[Any], *, bottom: float = 0.0, corner: bool = False) -> float:
    """A legend along the lower edge, in as many columns as fit; where it ends above, share of the height.

    bottom : where it begins
    corner : at the right, with room for bar and axes at the left
    """
    if not handles:
        return bottom
    style: dict[str, Any] = {"loc": "lower right" if corner else "lower center", "frameon": False, "labelcolor": INK}
    style |= {"fontsize": 0.9 * page.letter, "bbox_to_anchor": (0.995 if corner else 0.5, bottom), "borderaxespad": 0.2}
    if corner:
        style |= {"handlelength": 1, "handletextpad": 0.4, "columnspacing": 1.2}
    for columns in range(len(handles), 0, -1):
        legend = page.figure.legend(handles=handles, ncols=columns, **style)
        for text in legend.get_texts():
            text.set_parse_math(False)
        if columns == 1 or page.width_of(legend) <= (0.7 if corner else 0.98):
            break
        legend.remove()
    return bottom + page.height_of(legend)


def round_length(most: float) -> float:
    """The largest of 1, 2 and 5 times a power of ten that is not above ``most``."""
    power = 10.0 ** math.floor(math.log10(most))
    return max(step * power for step in (1.0, 2.0, 5.0) if step * power <= most * (1 + 1e-9))


def add_bar(page: Page, metres_per_inch: float, unit: str, left: float, level: float) -> list[Any]:
    """A bar of a round length with its words; its artists.

    left, level : where it begins, shares of width and height of the page
    """
    width = page.figure.get_figwidth()
    length = round_length(0.14 * width * metres_per_inch)
    right = left + length / metres_per_inch / width
    line = page.parts.lines.Line2D(
        [left, left, right, right], [level + TICK, level, level, level + TICK], color=INK, linewidth=2.0 * page.scale
    )
    words = {"color": INK, "fontsize": page.small, "parse_math": False, "ha": "center", "va": "bottom"}
    text = page.figure.text((left + right) / 2, level + 1.5 * TICK, f"{number(length)} {unit}", **words)
    return [page.figure.add_artist(line), text]


def add_axes(page: Page, names: Sequence[str], ways: FloatArray, left: float, level: float) -> None:
    """Directions of axes from one point; one towards the viewer is a dot.

    ways : (n, 2) of unit axes on the page
    """
    shape = page.figure.get_figheight() / page.figure.get_figwidth()
    words = {"color": INK, "fontsize": page.small, "parse_math": False, "ha": "center", "va": "center"}
    for name, (across, up) in zip(names, ways.tolist(), strict=True):
        if math.hypot(across, up) < SEEN:
            dot = {"marker": "o", "markersize": 0.45 * page.letter, "color": INK, "fillstyle": "none"}
            page.figure.add_artist(page.parts.lines.Line2D([left], [level], **dot))
            page.figure.text(left - 0.01, level - 0.022, name, **words)
            continue
        step = ARM * across * shape, ARM * up
        arrow = page.parts.patches.FancyArrowPatch(
            (left, level), (left + step[0], level + step[1]), arrowstyle="-|>", mutation_scale=0.8 * page.letter,
            color=INK, linewidth=1.5 * page.scale, shrinkA=0, shrinkB=0, transform=page.figure.transFigure,
        )  # fmt: skip
        page.figure.add_artist(arrow)
        page.figure.text(left + 1.35 * step[0], level + 1.35 * step[1], name, **words)


# --- Files ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class PictureFile:
    """One file to make: the end of its name after the stem, and what writes it."""

    name: str
    write: Callable[[Path], None]


def write_pictures(pictures: Sequence[PictureFile], target: Path, stem: str, ending: str, choice: str) -> list[Path]:
    """Pictures put in place each in one go; the paths written.

    target : a file for a single picture; else a folder, created if missing, for ``STEM`` and their names
    choice : options that choose one of them

    Raises
    ------
    UsageError
        Several pictures for one file.
    FileError
        A picture or the folder cannot be written.
    """
    paths = [target / f"{stem}{picture.name}.{ending}" for picture in pictures]
    if is_single(target):
        if len(pictures) > 1:
            raise UsageError(
                "several-pictures-one-file",
                f"{target}: one file for {len(pictures)} pictures; name one with {choice}, or a folder",
            )
        paths = [target]
    for picture, path in zip(pictures, paths, strict=True):
        with writing_complete(path) as temporary:
            picture.write(temporary)
    return paths
