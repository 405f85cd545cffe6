"""What explains a picture: its legend, a bar of a round length, and the directions of axes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from mbla.arrays import FloatArray
from mbla.results.listing.text import number
from mbla.results.pictures.page import INK, Page

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
