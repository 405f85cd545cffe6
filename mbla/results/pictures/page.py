"""A picture with its words on a page, as PNG, SVG or PDF (only importer of matplotlib, which pyvista brings along).

The structure is an image in all three formats; in SVG and PDF it has twice the pixels, and words stay words.
"""

from __future__ import annotations

import logging
import textwrap
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from mbla.errors import FileError, UsageError
from mbla.results.pictures.options import DOTS_PER_INCH, PictureOptions, format_of
from mbla.results.pictures.palette import INK

DEFAULT = PictureOptions()

COLUMNS = 120
"""letters in a line of words"""
METADATA: dict[str, dict[str, Any]] = {
    "png": {"Software": "mbla"},
    "svg": {"Date": None},
    "pdf": {"CreationDate": None},
}
"""without dates, so that the same picture gives the same file"""


def write_page(
    path: Path, image: Any, words: Sequence[str], legend: Sequence[Sequence[str]], options: PictureOptions = DEFAULT
) -> None:
    """Write an image (height, width, 3) with words above it and a legend of names and colours at its lower right.

    Raises
    ------
    UsageError
        The extra for pictures is not installed, or the name asks for another format.
    FileError
        The file cannot be written.
    """
    kind = format_of(path)
    quiet_matplotlib()
    try:
        from matplotlib import rc_context
        from matplotlib.figure import Figure
        from matplotlib.patches import Patch
    except ImportError as error:
        raise UsageError("pictures need an extra that is not installed: pip install 'mbla[pictures]'") from error
    with rc_context({"svg.fonttype": "none", "svg.hashsalt": "mbla", "pdf.fonttype": 42}), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph")  # of a script that the font does not have: a box is drawn
        width, height = options.size
        figure = Figure(figsize=(width / DOTS_PER_INCH, height / DOTS_PER_INCH), dpi=options.dpi)
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        axes.imshow(image, aspect="auto", interpolation="none")
        axes.set_axis_off()
        lines = [part for line in words for part in textwrap.wrap(line, COLUMNS)]
        figure.text(0.015, 0.98, "\n".join(lines), va="top", fontsize=14, color=INK, parse_math=False, linespacing=1.4)
        if legend:
            patches = [Patch(color=colour, label=name) for name, colour in legend]
            figure.legend(
                handles=patches, loc="lower right", frameon=False, fontsize=14, handlelength=1, labelcolor=INK
            )
        try:
            figure.savefig(path, format=kind, metadata=METADATA[kind])
        except OSError as error:
            raise FileError(f"{path}: {error.strerror or error}") from error


def quiet_matplotlib() -> None:
    """Remarks on its cache folder do not belong on a user's screen."""
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
