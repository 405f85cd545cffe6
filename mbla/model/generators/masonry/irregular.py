"""Random units: lengths of units and heights of courses, the same on every machine.

The numbers are those of numpy's PCG64 generator, whose stream numpy keeps fixed: uniform doubles made of integers, no
transcendental function.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.items.masonry import Irregular, Masonry

HEIGHTS = 0
"""stream of the heights of courses; the walls of an item have streams 1, 2, ..."""


def stream(irregular: Irregular, number: int) -> np.random.Generator:
    """Random numbers of one wall of an item."""
    return np.random.Generator(np.random.PCG64([irregular.seed, number]))


def random_levels(item: Masonry, fixed: Sequence[int]) -> FloatArray:
    """Heights of bed joints, (courses + 1,) [length]; those numbered ``fixed`` stay where equal courses have them."""
    levels = item.unit[2] * np.arange(item.courses + 1, dtype=np.float64)
    if item.irregular is None or item.irregular.heights == 0:
        return levels
    uniform = stream(item.irregular, HEIGHTS).random(item.courses)
    heights = 1 + item.irregular.heights * (2 * uniform - 1)
    kept = sorted({0, item.courses, *fixed})
    for low, high in pairwise(kept):
        share = np.cumsum(heights[low : high - 1]) / heights[low:high].sum()
        levels[low + 1 : high] = levels[low] + share * (levels[high] - levels[low])
    return levels


def random_joints(
    item: Masonry, left: float, right: float, avoid: FloatArray, numbers: np.random.Generator
) -> FloatArray:
    """Joints between two ends, each a random length after the one before, and off the joints of other courses.

    avoid : places that joints keep the overlap from, ascending

    A joint too close to one of them goes to the nearest place where it is not. None is nearer than the overlap to the
    ends; where no place is left the last unit is longer.
    """
    assert item.irregular is not None
    unit, variation = item.unit[0], item.irregular.variation
    overlap = item.irregular.overlap * unit
    least = max(0.5 * (1 - variation) * unit, overlap)
    joints: list[float] = []
    at = left
    while True:
        wanted = at + unit * (1 + variation * (2 * float(numbers.random()) - 1))
        found = _nearest_free(wanted, at + least, right - overlap, avoid, overlap)
        if found is None or wanted > right - overlap:
            return np.array(joints)
        joints.append(found)
        at = found


def _nearest_free(wanted: float, low: float, high: float, avoid: FloatArray, overlap: float) -> float | None:
    """The place between low and high nearest to one that is wanted and at least the overlap from those to avoid."""
    candidates = np.concatenate([[wanted, low], avoid - overlap, avoid + overlap])
    candidates = candidates[(candidates >= low) & (candidates <= high)]
    if len(avoid):
        off = np.abs(candidates[:, None] - avoid).min(axis=1, initial=np.inf)
        candidates = candidates[off >= overlap * (1 - 1e-9)]
    if not len(candidates):
        return None
    return float(candidates[np.argmin(np.abs(candidates - wanted))])
