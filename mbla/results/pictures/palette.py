"""Colours that every picture uses: after Okabe and Ito (2008), which the colour-blind can tell apart.

Colours never stand alone: hinges are dots, sliding is an arrow pair or a thick line, opening is filled or hatched.
"""

from __future__ import annotations

ORANGE, SKY, GREEN = "#E69F00", "#56B4E9", "#009E73"
BLUE, VERMILION, PURPLE, BLACK = "#0072B2", "#D55E00", "#CC79A7", "#000000"

INK = "#222222"
"""outlines and words"""
GHOST = "#8A8A8A"
"""the structure before it moved"""
GROUND = "#595959"
FIXED_BLOCK = "#9E9E9E"
REST = "#EDE6D4"
"""blocks that do not move"""
HINGE, SLIDE, OPEN, CRUSH = VERMILION, GREEN, PURPLE, BLACK
DEAD_LOAD, LIVE_LOAD, SETTLEMENT = "#7A7A7A", BLUE, BLUE
THRUST = BLACK
WARNING = "#B00020"
"""marks figures that are no result"""

GROUPS = ("#F2C36B", "#A6D3F0", "#7CC7AE", "#F4EE9B", "#7FB2D6", "#EDAE86", "#E3BAD1", "#D9D9D9")
"""light tints of the eight, for groups of blocks in their order; what follows begins again"""


def rgb(colour: str) -> tuple[float, float, float]:
    """Red, green and blue of ``#RRGGBB``, 0 to 1."""
    red, green, blue = (int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return red, green, blue


def pale(colour: str) -> str:
    """The colour with two thirds of white in it."""
    return "#" + "".join(f"{round(255 * (part + 2) / 3):02X}" for part in rgb(colour))


def group_colours(groups: tuple[str, ...]) -> dict[str, str]:
    """Colour of each group, in the order in which they first appear."""
    return {name: GROUPS[i % len(GROUPS)] for i, name in enumerate(dict.fromkeys(groups))}


FORCE_SHADES = ("#9ECAE1", "#08306B")
"""of the least force and of the largest"""


def shade(share: float) -> tuple[float, float, float]:
    """Colour of a force by its share of the largest, 0 to 1."""
    light, dark = rgb(FORCE_SHADES[0]), rgb(FORCE_SHADES[1])
    red, green, blue = ((1 - share) * a + share * b for a, b in zip(light, dark, strict=True))
    return red, green, blue


CASES = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, BLACK)
"""live loads of several load cases"""
