"""Columns that topple down a stepped slope, hardly more than at rest: smoothing must be small against what is left.

Limit equilibrium from the top down (Goodman and Bray 1976): a column of height y and width d passes on the greater of

    P' = (P (M − μ d) + W/2 (y (sin ψ + k) − d cos ψ)) / L     where it topples,
    P' = P − W (μ cos ψ − sin ψ − k)/(1 − μ²)                  where it slides,

M and L the heights at which its neighbours above and below touch; k is the load factor at which the toe has nothing
left.
"""

from __future__ import annotations

import math

import pytest

from tests.line import line_of
from tests.solution.flow.paths import load_factor_of

SLOPE = math.radians(30.0)
BENCHES = [1.1 - 0.1 * i for i in range(12)]
TOPS = [4.24, 4.74, *(4.3 - 0.44 * i for i in range(10))]
WEIGHT = 25.0


def deck(friction: float) -> str:
    blocks = "".join(
        f"  - box: {{group: column, material: rock, min: [{i}, 0, {bench:.9g}], max: [{i + 1}, 1, {top:.9g}]}}\n"
        f"  - box: {{group: bench, material: rock, min: [{i}, 0, -1], max: [{i + 1}, 1, {bench:.9g}]}}\n"
        for i, (bench, top) in enumerate(zip(BENCHES, TOPS, strict=True))
    )
    return (
        "mbla: 1\n"
        "units: {force: kN}\n"
        f"materials: {{rock: {{unit_weight: {WEIGHT}}}}}\n"
        f"joints: {{rough: {{friction: {friction}}}}}\n"
        f"blocks:\n{blocks}"
        "contacts: {joint: rough}\n"
        "supports: [{blocks: bench}]\n"
        "load_cases:\n"
        "  slope:\n"
        '    dead: [{gravity: ["=9.81*sin(30)", 0, "=-9.81*cos(30)"]}]\n'
        "    live: [{acceleration: [1, 0, 0]}]\n"
    )


def left_at_the_toe(factor: float, friction: float) -> float:
    """Force that the last column cannot hold."""
    push = 0.0
    for i, (bench, top) in enumerate(zip(BENCHES, TOPS, strict=True)):
        height = top - bench
        weight = WEIGHT * height
        slides = push - weight * (friction * math.cos(SLOPE) - math.sin(SLOPE) - factor) / (1.0 - friction**2)
        if i + 1 == len(TOPS):
            return slides
        above = min(TOPS[i - 1], top) - bench if i else height
        turns = 0.5 * weight * (height * (math.sin(SLOPE) + factor) - math.cos(SLOPE))
        topples = (push * (above - friction) + turns) / (min(top, TOPS[i + 1]) - bench)
        push = max(topples, slides, 0.0)
    raise AssertionError


def closed_form(friction: float) -> float:
    low, high = -1.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if left_at_the_toe(middle, friction) > 0.0 else (middle, high)
    return low


@pytest.mark.every(3)
@pytest.mark.parametrize("friction", [0.739, 0.738, 0.745])
def test_columns_on_a_slope_start_to_move_at_limit_equilibrium(friction: float) -> None:
    expected = closed_form(friction)
    assert 0.0 < expected < 0.01
    assert load_factor_of(line_of(deck(friction))) == pytest.approx(expected, rel=1e-3)
