"""What was measured on structures that were built and broken, by deck and load case; kN."""

from __future__ import annotations

from itertools import pairwise
from statistics import fmean
from typing import Any

MEASURED: dict[str, dict[str, tuple[float, ...]]] = {
    "walls_ws": {"n40": (16.3,), "n100": (39.4,), "n175": (66.5,), "n250": (90.2,)},
    "walls_sw": {"n30": (21.9, 22.9), "n100": (41.5, 48.2), "n200": (71.6, 68.6), "n250": (102.7,)},
    "prestwood": {"strip": (228.0,)},
    "prestwood_strips": {"strip": (228.0,)},
}
"""each test, or of WS their mean; sources are in the decks"""
NAMES = {
    "walls_ws": "WS, dry granite walls",
    "walls_sw": "SW, dry sandstone walls",
    "prestwood": "Prestwood bridge in soil",
    "prestwood_strips": "the same, strips of soil",
}


def mean_of(deck: str, case: str) -> float:
    """Mean of the tests of a load case."""
    return fmean(MEASURED[deck][case])


def words_of(case: str) -> str:
    """How page and picture call a load case: of walls the vertical load."""
    return case.removeprefix("n")


def cut_walls(tensile_strength: float, vertical_load: float) -> dict[str, Any]:
    """Deck of a wall SW whose units are cut in their middles by joints of a tensile strength, kN/m2.

    Halves of every other unit of a course are of groups L0 and R0, those between of L1 and R1.
    """
    boxes = []
    for course in range(9):
        cuts = [0.0, *([0.1] if course % 2 else [])]
        while cuts[-1] < 0.99:
            cuts.append(round(min(cuts[-1] + 0.2, 1.0), 3))
        for number, (start, end) in enumerate(pairwise(cuts)):
            middle, kind = round((start + end) / 2, 3), number % 2
            if end - start > 0.15:
                boxes += [(f"L{kind}", start, middle, course), (f"R{kind}", middle, end, course)]
            else:
                boxes.append((f"{'L' if number else 'R'}{kind}", start, end, course))
    wall = [
        {"group": group, "material": "sandstone", "min": [start, 0, course / 10], "max": [end, 0.2, (course + 1) / 10]}
        for group, start, end, course in boxes
    ]
    beam = {"group": "beam", "material": "beam", "min": [0, 0, 0.9], "max": [1, 0.2, 1.1]}
    dry = {"friction": 0.62, "compressive_strength": 57000}
    return {
        "mbla": 1,
        "units": {"force": "kN"},
        "materials": {"sandstone": {"unit_weight": 24}, "beam": {"unit_weight": 2}},
        "joints": {
            "dry": dry,
            "stone": dry | {"tensile_strength": tensile_strength, "cohesion": 0.63 * tensile_strength},
        },
        "blocks": [{"box": box} for box in (*wall, beam)],
        "contacts": {
            "joint": "dry",
            "overrides": [
                {"between": [f"L{kind}", f"R{kind}"], "orientation": "head", "joint": "stone"} for kind in (0, 1)
            ],
        },
        "supports": [{"ground": {"z": 0}}],
        "analysis": {"path": {"ratio": 0.8}},
        "load_cases": {
            "push": {
                "dead": [{"force": [0, 0, 0.08 - vertical_load], "on": "beam", "at": [0.5, 0.1, 1.1]}],
                "live": [{"force": [1, 0, 0], "on": "beam", "at": [0, 0.1, 1.0]}],
            }
        },
    }
