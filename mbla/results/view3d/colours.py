"""Ways to colour the blocks: by group, by part, by displacement, by eccentricity."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.model import Model

PALETTE = ("#E69F00", "#56B4E9", "#009E73", "#F0E442", "#CC79A7", "#0072B2", "#D55E00", "#B8B8B8")
"""after Okabe and Ito; of more than these every round is paler than the one before"""
REST, FIXED, NO_VALUE = "#EDE5D4", "#9E9E9E", "#C8C8C8"
STRONGEST = {"displacement": "#1A5E9B", "eccentricity": "#B2182B"}
MOST_NAMES = 12
"""entries of a legend; the others are counted"""


@dataclass(frozen=True)
class Colouring:
    """Colour of every block.

    colours : as #RRGGBB
    rows    : (n_blocks,) rows of ``colours``
    legend  : names and colours, for the reader
    """

    name: str
    colours: tuple[str, ...]
    rows: IntArray
    legend: tuple[tuple[str, str], ...]


def by_group(model: Model) -> Colouring:
    """Groups in alphabetical order."""
    names = sorted(set(model.blocks.groups))
    row = {name: i for i, name in enumerate(names)}
    return _by_name("group", np.array([row[group] for group in model.blocks.groups]), names, palette(len(names)))


def by_part(model: Model, parts: IntArray) -> Colouring:
    """Parts that move together; what rests is pale, what is fixed grey."""
    count = int(parts.max(initial=0))
    names = ["fixed", "at rest", *(f"part {i}" for i in range(1, count + 1))]
    rows = np.where(model.fixed, 0, parts + 1)
    used = np.unique(rows)
    colours = (FIXED, REST, *palette(count))
    rows = np.searchsorted(used, rows)
    return _by_name("part", rows, [names[i] for i in used], tuple(colours[i] for i in used.tolist()))


def by_value(model: Model, name: str, values: FloatArray, low: str, high: str, steps: int = 32) -> Colouring:
    """Values from 0 to 1 in steps, (n_blocks,), nan for none; ``low`` and ``high`` name 0 and 1."""
    ramp = tuple(mixed(REST, STRONGEST[name], i / (steps - 1)) for i in range(steps))
    rows = np.rint(np.nan_to_num(np.clip(values, 0.0, 1.0)) * (steps - 1)).astype(np.int64)
    rows = np.where(np.isnan(values), steps, rows)
    rows = np.where(model.fixed & (name == "displacement"), steps + 1, rows)
    legend = [(low, ramp[0]), (high, ramp[-1])]
    legend += [("none", NO_VALUE)] if (rows == steps).any() else []
    legend += [("fixed", FIXED)] if (rows == steps + 1).any() else []
    return Colouring(name, (*ramp, NO_VALUE, FIXED), rows, tuple(legend))


def _by_name(name: str, rows: IntArray, names: Sequence[str], colours: tuple[str, ...]) -> Colouring:
    legend = list(zip(names, colours, strict=True))
    if len(legend) > MOST_NAMES:
        legend = [*legend[: MOST_NAMES - 1], (f"and {len(legend) - MOST_NAMES + 1} more", "")]
    return Colouring(name, colours, rows, tuple(legend))


def palette(count: int) -> tuple[str, ...]:
    """That many colours."""
    rounds = [1 - 0.6 ** (i // len(PALETTE)) for i in range(count)]
    return tuple(mixed(PALETTE[i % len(PALETTE)], "#FFFFFF", pale) for i, pale in enumerate(rounds))


def mixed(first: str, second: str, share: float) -> str:
    """The colour at a share of the way from the first to the second."""
    a, b = (np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)]) for colour in (first, second))
    red, green, blue = np.rint(a + share * (b - a)).astype(int).tolist()
    return f"#{red:02X}{green:02X}{blue:02X}"
