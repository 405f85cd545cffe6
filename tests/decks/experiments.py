"""What was measured on structures that were built and broken, by deck and load case; kN."""

from __future__ import annotations

from statistics import fmean

MEASURED: dict[str, dict[str, tuple[float, ...]]] = {
    "walls_ws": {"n40": (16.3,), "n100": (39.4,), "n175": (66.5,), "n250": (90.2,)},
    "walls_sw": {"n30": (21.9, 22.9), "n100": (41.5, 48.2), "n200": (71.6, 68.6), "n250": (102.7,)},
}
"""each test, or of WS their mean; sources are in the decks"""
NAMES = {"walls_ws": "WS, dry granite walls", "walls_sw": "SW, dry sandstone walls"}


def mean_of(deck: str, case: str) -> float:
    """Mean of the tests of a load case."""
    return fmean(MEASURED[deck][case])
