"""The zero of functions of one variable: how near, in how many evaluations, and what is said of jumps."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import pytest

from mbla.solution.limits.zeros import MOST, Zero, changes, find_zero, scan

NAN = math.nan
Function = Callable[[float], tuple[float, float]]


@dataclass(frozen=True)
class Point:
    """A sample."""

    x: float
    y: float
    slope: float


def sampled(function: Function, slopes: bool, seen: list[Point]) -> Callable[[float], Point]:
    def at(x: float) -> Point:
        y, slope = function(x)
        seen.append(Point(x, y, slope if slopes else NAN))
        return seen[-1]

    return at


def zeros(
    function: Function, low: float, high: float, *, slopes: bool, steps: int = 1
) -> tuple[list[Zero[Point]], int]:
    """Zeros, and the number of evaluations."""
    seen: list[Point] = []
    at = sampled(function, slopes, seen)
    return [find_zero(*pair, at, 1e-9) for pair in changes(scan(low, high, steps, at))], len(seen)


LINE: Function = lambda x: (2 * x - 1, 2.0)  # noqa: E731
ROOT: Function = lambda x: (math.sqrt(x) - 0.5, 0.5 / math.sqrt(x))  # noqa: E731
CONVEX: Function = lambda x: (math.exp(3 * x) - 9, 3 * math.exp(3 * x))  # noqa: E731
ROOF: Function = lambda x: (4 * x - 1, 4.0) if x < 0.26 else (0.04 - 0.001 * (x - 0.26), -0.001)  # noqa: E731
FALLS: Function = lambda x: (1 - x**3, -3 * x**2)  # noqa: E731


@pytest.mark.parametrize(
    ("function", "low", "high", "zero", "most"),
    [
        (LINE, 0, 1, 0.5, 3),
        (ROOT, 0.01, 4, 0.25, 7),
        (CONVEX, 0, 2, math.log(9) / 3, 10),
        (ROOF, 0, 1, 0.25, 3),
        (FALLS, 0.1, 5, 1, 9),
    ],
)
def test_with_slopes(function: Function, low: float, high: float, zero: float, most: int) -> None:
    (found,), evaluations = zeros(function, low, high, slopes=True)
    assert found.best.x == pytest.approx(zero, abs=1e-9)
    assert found.complete
    assert not found.jumps
    assert evaluations <= most


@pytest.mark.parametrize(
    ("function", "low", "high", "zero", "most"),
    [(LINE, 0, 1, 0.5, 3), (ROOT, 0.01, 4, 0.25, 13), (CONVEX, 0, 2, math.log(9) / 3, 16), (FALLS, 0.1, 5, 1, 20)],
)
def test_without_slopes(function: Function, low: float, high: float, zero: float, most: int) -> None:
    (found,), evaluations = zeros(function, low, high, slopes=False)
    assert found.best.x == pytest.approx(zero, abs=1e-8)
    assert evaluations <= most


@pytest.mark.parametrize("slopes", [True, False])
def test_an_end_without_size(slopes: bool) -> None:
    """Below 0.3 the structure does not stand."""
    (found,), _ = zeros(lambda x: (x - 0.7, 1.0) if x > 0.3 else (-math.inf, NAN), 0, 1, slopes=slopes)
    assert found.best.x == pytest.approx(0.7, abs=1e-9)


def test_a_jump() -> None:
    (found,), evaluations = zeros(lambda x: (x + 0.7, 1.0) if x > 0.3 else (-math.inf, NAN), 0, 1, slopes=True)
    assert found.complete
    assert found.jumps
    assert sorted(each.x for each in found.bracket) == pytest.approx([0.3, 0.3], abs=1e-9)
    assert evaluations < MOST


def test_a_jump_between_two_finite_values() -> None:
    (found,), _ = zeros(lambda x: (x + 0.7 if x > 0.3 else x - 2, NAN), 0, 1, slopes=False)
    assert found.complete
    assert found.jumps


def test_a_value_that_is_not_known_ends_it() -> None:
    (found,), evaluations = zeros(lambda x: (x - 0.7, NAN) if abs(x - 0.5) > 0.4 else (NAN, NAN), 0, 1, slopes=False)
    assert not found.complete
    assert evaluations == 3


def test_several_zeros_by_a_scan() -> None:
    wave: Function = lambda x: (math.sin(7 * x), 7 * math.cos(7 * x))  # noqa: E731
    found, _ = zeros(wave, 0.1, 1.5, slopes=True, steps=10)
    assert [each.best.x for each in found] == pytest.approx([math.pi / 7, 2 * math.pi / 7, 3 * math.pi / 7], abs=1e-8)
    assert zeros(lambda x: (x + 1, 1.0), 0, 1, slopes=True)[0] == []
