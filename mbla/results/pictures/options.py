"""What a user may choose about pictures, and how it is read from the texts of the command line."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from mbla.errors import UsageError

KINDS = ("model", "mechanism", "forces", "history", "curve")
"""kinds of pictures, in the order in which they are made"""
USUAL_KINDS = ("model", "mechanism", "forces")
"""those made unless others are asked for"""
FORMATS = ("png", "svg", "pdf")
VIEWS = {
    "front": (-90.0, 0.0),
    "back": (90.0, 0.0),
    "left": (180.0, 0.0),
    "right": (0.0, 0.0),
    "top": (-90.0, 90.0),
    "below": (-60.6, -30.0),
    "iso": (-60.6, 24.8),
}
"""azimuth and elevation of the eye in degrees: from +x towards +y about the vertical, and above the horizontal"""
DOTS_PER_INCH = 100
"""at which the size of a picture is given"""
LEAST_SIDE, MOST_SIDE = 200, 20_000
"""pixels of a side of a picture"""


LEAST_DPI, MOST_DPI = 20, 1200


@dataclass(frozen=True)
class PictureOptions:
    """How pictures are made.

    kinds  : of ``KINDS``
    animate: ``gif`` or ``mp4``: moving pictures of the mechanisms instead of pictures that stand still
    case   : name of the only load case to draw; None for all
    view   : azimuth and elevation of the eye in degrees as in ``VIEWS``; None: what suits the structure
    scale  : displacements as drawn, as a multiple of the usual ones (the farthest corner moves by a tenth of the
             size of what can move); 1 where the user leaves it to the program
    size   : width and height in hundredths of an inch: the pixels of a PNG at 100 dots per inch
    dpi    : dots per inch of a PNG
    format : of pictures that go to a folder, one of ``FORMATS``
    """

    kinds: tuple[str, ...] = USUAL_KINDS
    animate: str | None = None
    case: str | None = None
    view: tuple[float, float] | None = None
    scale: float = 1.0
    size: tuple[int, int] = (1600, 1000)
    dpi: int = DOTS_PER_INCH
    format: str = "png"

    @property
    def pixels(self) -> tuple[int, int]:
        """Width and height of a PNG."""
        width, height = self.size
        return round(width * self.dpi / DOTS_PER_INCH), round(height * self.dpi / DOTS_PER_INCH)


def page_options(arguments: Any) -> PictureOptions:
    """Size, dots per inch and format from the command line; raises UsageError for invalid text."""
    if not LEAST_DPI <= arguments.dpi <= MOST_DPI:
        raise UsageError("picture-option", f"--dpi {arguments.dpi}: {LEAST_DPI} to {MOST_DPI} dots per inch")
    return PictureOptions(size=parse_size(arguments.size), dpi=arguments.dpi, format=arguments.format)


def picture_options(arguments: Any) -> PictureOptions:
    """All of them, texts or None by their names; UsageError for what is not among them.

    A single file without a kind is that of the mechanism.
    """
    output = vars(arguments).get("output")
    usual = ("mechanism",) if output is not None and is_single(output) else USUAL_KINDS
    return replace(
        page_options(arguments),
        kinds=parse_kinds(arguments.kind) if arguments.kind else usual,
        animate=arguments.animate,
        case=arguments.case,
        view=parse_view(arguments.view),
        scale=parse_scale(arguments.scale),
    )


def is_single(target: Path) -> bool:
    """Whether a path names one picture rather than a folder for them."""
    return bool(target.suffix) and not target.is_dir()


def parse_kinds(text: str, known: Sequence[str] = KINDS) -> tuple[str, ...]:
    """``model,forces`` or ``all``, in the order of the known ones; raises UsageError for others."""
    asked = [part.strip() for part in text.split(",") if part.strip()]
    if asked == ["all"]:
        return tuple(known)
    if not asked or set(asked) - set(known):
        raise UsageError(
            "picture-option", f"--kind {text}: there are {', '.join(known)}, or all; several with commas between them"
        )
    return tuple(kind for kind in known if kind in asked)


def parse_view(text: str) -> tuple[float, float] | None:
    """Name of a view, ``AZIMUTH,ELEVATION`` in degrees, or ``auto`` for None; raises UsageError for others."""
    if text == "auto":
        return None
    if text in VIEWS:
        return VIEWS[text]
    try:
        azimuth, elevation = (float(part) for part in text.split(","))
    except ValueError:
        azimuth = elevation = math.nan
    if not (math.isfinite(azimuth) and -90 <= elevation <= 90):
        names = ", ".join((*VIEWS, "auto"))
        raise UsageError(
            "picture-option", f"--view {text}: there are {names}, or AZIMUTH,ELEVATION in degrees, as -60,25"
        )
    return azimuth, elevation


LARGEST_SCALE = 1000.0
"""multiple of displacements of a tenth of the structure: numbers without bounds overflow where axes are laid out"""


def parse_scale(text: str) -> float:
    """A multiple of the usual displacements, 0 to ``LARGEST_SCALE``; ``auto`` is 1. Raises UsageError for others."""
    try:
        value = 1.0 if text == "auto" else float(text)
    except ValueError:
        value = math.nan
    if not 0 <= value <= LARGEST_SCALE:
        raise UsageError(
            "picture-option",
            f"--scale {text}: auto, or a multiple of the displacements that auto draws, as 0.5, to {LARGEST_SCALE:g}",
        )
    return value


def parse_size(text: str) -> tuple[int, int]:
    """``1600x1000``; raises UsageError for others."""
    try:
        width, height = (int(part) for part in text.lower().split("x"))
    except ValueError:
        width = height = 0
    if not all(LEAST_SIDE <= side <= MOST_SIDE for side in (width, height)):
        raise UsageError(
            "picture-option", f"--size {text}: width x height in pixels, {LEAST_SIDE} to {MOST_SIDE} each, as 1600x1000"
        )
    return width, height


def format_of(path: Path) -> str:
    """``png``, ``svg`` or ``pdf`` by the name of a file; raises UsageError for any other."""
    suffix = path.suffix.lower().removeprefix(".")
    if suffix not in FORMATS:
        raise UsageError("output-format", f"{path}: pictures are written as PNG, SVG or PDF, by the name of the file")
    return suffix
