"""A regular motion is the same however the structure lies, in any units, and in any order of its blocks."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from mbla.arrays import FloatArray
from tests.solution.time_history.followed import followed

BOXES = (
    ((0.0, 0.0, 0.0), (0.5, 0.4, 0.5)),
    ((0.02, 0.0, 0.5), (0.5, 0.36, 0.9)),
    ((0.05, 0.03, 0.9), (0.45, 0.4, 1.4)),
)
"""m; a pile that rocks and slides a little without a hit"""
DIRECTION = (0.9, 0.35, 0.0)

MIRRORED = tuple(((-high[0], low[1], low[2]), (-low[0], high[1], high[2])) for low, high in BOXES)


def deck(
    boxes: tuple[tuple[tuple[float, ...], tuple[float, ...]], ...] = BOXES,
    direction: tuple[float, ...] = DIRECTION,
    turn: float = 0.0,
    millimetres: bool = False,
) -> str:
    """The pile: turned about z by degrees, or in mm, kN and t."""
    length = 1000.0 if millimetres else 1.0
    lines = [
        f"  - box: {{material: stone, min: {[length * x for x in low]}, max: {[length * x for x in high]}, "
        f"transform: {{rotate: {{axis: [0, 0, 1], angle: {turn}}}}}}}"
        for low, high in boxes
    ]
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    along = [float(c * direction[0] - s * direction[1]), float(s * direction[0] + c * direction[1]), 0.0]
    units = "units: {length: mm, force: kN, mass: t}" if millimetres else ""
    stiffness, density = (1e-2, 2e-9) if millimetres else (1e10, 2000.0)
    return "\n".join(
        [
            "mbla: 1",
            units,
            f"materials: {{stone: {{density: {density!r}}}}}",
            f"joints: {{dry: {{friction: 0.5, stiffness: {{normal: {stiffness!r}}}}}}}",
            "blocks:",
            *lines,
            "contacts: {joint: dry}",
            "supports: [{ground: {z: 0}, joint: dry}]",
            "load_cases:",
            "  case:",
            "    time_history:",
            f'      motion: {{pulse: half_sine, amplitude: "0.7 g", duration: 0.2, direction: {along}}}',
            "      step: 0.002",
            "      duration: 0.3",
        ]
    )


@cache
def built() -> FloatArray:
    """Greatest displacements of the blocks as they stand."""
    return moved(deck())


def moved(text: str) -> FloatArray:
    """Greatest displacements of the blocks of a deck."""
    found, _, _ = followed(text)
    assert found.peaks is not None
    return found.peaks.displacements


def test_it_moves() -> None:
    assert built().max() > 0.01


def test_seen_in_a_mirror() -> None:
    assert moved(deck(MIRRORED, (-DIRECTION[0], *DIRECTION[1:]))) == pytest.approx(built(), rel=1e-6)


def test_turned_by_17_degrees() -> None:
    """Its pattern of points has another order: iterations end elsewhere within their tolerance."""
    assert moved(deck(turn=17.0)) == pytest.approx(built(), rel=1e-5)


def test_in_millimetres_kilonewtons_and_tonnes() -> None:
    assert moved(deck(millimetres=True)) / 1000.0 == pytest.approx(built(), rel=1e-6)


def test_blocks_in_another_order() -> None:
    assert moved(deck(BOXES[::-1]))[::-1] == pytest.approx(built(), rel=1e-6)
