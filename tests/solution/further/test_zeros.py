"""The zero of functions of one variable: how near, in how many evaluations, and what is said of jumps."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import pytest

from mbla.solution.further.zeros.samples import Zero
from mbla.solution.further.zeros.zeros import MOST, find_zeros, is_level, scan

NAN = math.nan
Function = Callable[[float], tuple[float, float]]


@dataclass(frozen=True)
class Point:
    """A sample."""

    x: float
    y: float
    slope: float
    uncertainty: float = 0.0
    scatter: float = 0.0


def sampled(
    function: Function, slopes: bool, seen: list[Point], uncertainty: float, scatter: float = 0.0
) -> Callable[[float], Point]:
    def at(x: float) -> Point:
        y, slope = function(x)
        seen.append(Point(x, y, slope if slopes else NAN, uncertainty, scatter))
        return seen[-1]

    return at


def zeros(
    function: Function,
    low: float,
    high: float,
    *,
    slopes: bool,
    steps: int = 1,
    uncertainty: float = 0.0,
    scatter: float = 0.0,
) -> tuple[list[Zero[Point]], int]:
    """Zeros, and the number of evaluations."""
    seen: list[Point] = []
    at = sampled(function, slopes, seen, uncertainty, scatter)
    return find_zeros(scan(low, high, steps, at), at, 1e-9), len(seen)


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


@pytest.mark.parametrize(("low", "high"), [(0, 1), (0.29, 0.31), (-1000, 1000)])
@pytest.mark.parametrize("size", [1.0, 1e-3])
def test_a_jump_between_two_finite_values(low: float, high: float, size: float) -> None:
    """Whatever the values at the bounds are, and with them the largest that is seen."""
    (found,), _ = zeros(
        lambda x: (x - 0.3 + size if x > 0.3 else 2 * (x - 0.3) - size, NAN), low, high, slopes=False, scatter=1e-4
    )
    assert found.complete
    assert found.jumps


@pytest.mark.parametrize(("low", "high"), [(0, 1), (0.499, 0.502), (-10, 30)])
def test_steps_up_to_the_scatter_are_no_jump_and_end_the_search(low: float, high: float) -> None:
    """A line that scatters by 4e-4 within 1e-6: zero is known to about that over its slope."""
    (found,), evaluations = zeros(
        lambda x: (2 * x - 1 + 4e-4 * math.sin(1e7 * x), NAN), low, high, slopes=False, scatter=1e-3
    )
    assert found.complete
    assert not found.jumps
    assert abs(found.best.x - 0.5) <= found.error <= 2e-3
    assert evaluations <= 12


@pytest.mark.parametrize("function", [ROOT, FALLS])
def test_a_smooth_function_is_followed_to_the_tolerance_whatever_it_may_scatter(function: Function) -> None:
    (found,), _ = zeros(function, 0.1, 3, slopes=False, scatter=1e-2)
    assert found.best.x == pytest.approx(0.25 if function is ROOT else 1.0, abs=1e-8)


def test_a_value_that_is_not_known_ends_it() -> None:
    (found,), evaluations = zeros(lambda x: (x - 0.7, NAN) if abs(x - 0.5) > 0.4 else (NAN, NAN), 0, 1, slopes=False)
    assert not found.complete
    assert evaluations == 3


def test_several_zeros_by_a_scan() -> None:
    wave: Function = lambda x: (math.sin(7 * x), 7 * math.cos(7 * x))  # noqa: E731
    found, _ = zeros(wave, 0.1, 1.5, slopes=True, steps=10)
    assert [each.best.x for each in found] == pytest.approx([math.pi / 7, 2 * math.pi / 7, 3 * math.pi / 7], abs=1e-8)
    assert zeros(lambda x: (x + 1, 1.0), 0, 1, slopes=True)[0] == []


CAPPED: Function = lambda x: (min(x, 0.5) - 0.5 + 1e-10 * x, float(x < 0.5))  # noqa: E731
STEPS: Function = lambda x: (round(x) - 3.0, 0.0)  # noqa: E731
TOUCHING: Function = lambda x: (-abs(x - 0.5), math.copysign(1.0, 0.5 - x))  # noqa: E731


def test_a_stretch_up_to_the_last_sample() -> None:
    """What is above zero by less than its uncertainty does not end it."""
    (found,), evaluations = zeros(CAPPED, 0, 2, slopes=True, uncertainty=1e-9)
    assert found.stretch is not None
    assert [each.x for each in found.stretch] == pytest.approx([0.5, 2], abs=2e-9)
    assert found.complete
    assert 0.0 < found.error <= 1e-9
    assert evaluations <= 4


@pytest.mark.parametrize("slopes", [True, False])
@pytest.mark.parametrize("steps", [1, 3, 12])
def test_a_stretch_between_samples_on_both_sides(slopes: bool, steps: int) -> None:
    (found,), _ = zeros(STEPS, 0, 7, slopes=slopes, steps=steps, uncertainty=1e-9)
    assert found.stretch is not None
    assert [each.x for each in found.stretch] == pytest.approx([2.5, 3.5], abs=1e-9)
    assert found.complete


def test_without_slopes_one_look_next_to_the_end_of_a_long_stretch_is_enough() -> None:
    (found,), evaluations = zeros(lambda x: (0.0 if x > 0.3 else -1.0, NAN), 0, 1, slopes=False, uncertainty=1e-9)
    assert found.best.x == pytest.approx(0.3, abs=1e-9)
    assert evaluations <= 3 + math.ceil(math.log2(1e9))


def test_a_stretch_from_bound_to_bound_takes_a_look_in_its_middle() -> None:
    (found,), evaluations = zeros(CAPPED, 0.5, 2, slopes=True, uncertainty=1e-9)
    assert found.stretch is not None
    assert [each.x for each in found.stretch] == [0.5, 2.0]
    assert (found.error, evaluations) == (0.0, 3)


def test_a_value_that_is_only_touched() -> None:
    (found,), _ = zeros(TOUCHING, 0, 1, slopes=False, steps=2, uncertainty=1e-12)
    assert found.stretch == (found.best, found.best)
    assert found.best.x == 0.5


@pytest.mark.parametrize(("low", "high"), [(0.5, 2.0), (-1.0, 0.5)])
def test_a_zero_at_a_bound(low: float, high: float) -> None:
    (found,), evaluations = zeros(LINE, low, high, slopes=True, uncertainty=1e-12)
    assert (found.best.x, found.stretch, found.rises, evaluations) == (0.5, None, True, 2)


def test_two_zeros_with_slopes_next_to_each_other_are_no_stretch() -> None:
    found, _ = zeros(lambda x: (x * (x - 1), 2 * x - 1), 0, 1, slopes=True, uncertainty=1e-12)
    assert [(each.best.x, each.stretch, each.rises) for each in found] == [(0.0, None, False), (1.0, None, True)]


def test_without_slopes_values_next_to_a_zero_tell_that_it_is_no_stretch() -> None:
    (found,), evaluations = zeros(LINE, 0, 1, slopes=False, uncertainty=1e-12)
    assert (found.best.x, found.stretch, evaluations) == (0.5, None, 5)
    assert 0.0 < found.error <= 1e-9


def test_an_error_is_no_less_than_what_the_function_may_be_off() -> None:
    (found,), _ = zeros(LINE, 0, 1, slopes=True, uncertainty=1e-4)
    assert found.error == pytest.approx(0.5e-4)


def test_a_stretch_next_to_what_is_not_known_is_not_complete() -> None:
    (found,), _ = zeros(lambda x: (0.0 if x > 0 else NAN, 0.0), -1, 1, slopes=True, uncertainty=1e-9)
    assert not found.complete
    assert found.stretch == (found.best, found.best)


def test_what_drifts_from_step_to_step_is_not_level() -> None:
    at = sampled(lambda x: (x, NAN), False, [], 0.01)
    assert not is_level(scan(0, 1, 200, at))
    assert is_level(scan(0, 0.01, 2, at))
