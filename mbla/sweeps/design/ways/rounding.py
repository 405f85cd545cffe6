"""Values as a person would write them: 0.13, not 0.13000000000000003."""

from __future__ import annotations

import math
from collections.abc import Iterable

from mbla.sweeps.design.ways.way import WayError

DIGITS = 12
"""significant digits that are kept: far more than anybody measures, few enough that the rounding of the arithmetic and
the last digits of mathematical libraries, which differ from machine to machine, do not show"""
EXACT_DIGITS = 15
"""decimal digits that every float holds"""


def rounded(value: float) -> float:
    """A value to DIGITS significant digits."""
    return float(f"{value:.{DIGITS}g}")


def rounded_within(values: Iterable[float], least: float, greatest: float) -> list[float]:
    """Each value rounded, and none thereby beyond its limits.

    Raises
    ------
    WayError
        a value that is larger than numbers are
    """
    found = [rounded(float(value)) for value in values]
    if not all(map(math.isfinite, found)):
        raise WayError("sweep-values", "has values beyond what a number holds")
    return [min(max(value, least), greatest) for value in found]


def decimals_of(start: float, end: float) -> int | None:
    """Decimal places that give DIGITS significant digits of the span, as far as numbers of that size have them.

    None where the span is nothing, or more than a number holds.
    """
    if start == end or not math.isfinite(end - start):
        return None
    of_span = DIGITS - 1 - math.floor(math.log10(abs(end - start)))
    of_size = EXACT_DIGITS - 1 - math.floor(math.log10(max(abs(start), abs(end))))
    return min(of_span, of_size)
