"""Drawn values against the distributions themselves.

A quantile function is right where the distribution function of its values gives the quantiles back. Values are rounded
to 12 significant digits, which is what the tolerances of 1e-9 leave room for: far in a tail the distribution function
changes by more than the value does.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy import stats

from mbla.arrays import FloatArray
from mbla.sweeps.design.ways import WAYS, cut_normal
from mbla.sweeps.file.content import Parameter, way_of
from tests.sweeps.design.hand_made import column, drawn

U = np.array([1e-12, 1e-6, 0.01, 0.2, 0.5, 0.8, 0.99, 1 - 1e-6])


def at(parameter: dict[str, Any], u: FloatArray) -> FloatArray:
    checked = Parameter.model_validate(parameter)
    key = way_of(checked)
    return np.array(WAYS[key].at(getattr(checked, key), u[:, None], None).settings, dtype=float)


def share_of_normal(value: FloatArray, mean: float, deviation: float, least: float, greatest: float) -> FloatArray:
    """Distribution function of what is left between two limits, by its definition."""
    low, high = stats.norm.cdf(least, mean, deviation), stats.norm.cdf(greatest, mean, deviation)
    share: FloatArray = (stats.norm.cdf(value, mean, deviation) - low) / (high - low)
    return share


@pytest.mark.parametrize(
    ("least", "greatest"), [(-math.inf, math.inf), (0.5, math.inf), (-math.inf, 0.7), (0.55, 0.61)]
)
def test_normal(least: float, greatest: float) -> None:
    limits = {key: value for key, value in (("min", least), ("max", greatest)) if math.isfinite(value)}
    found = at({"normal": {"mean": 0.6, "deviation": 0.05, **limits}}, U)
    assert share_of_normal(found, 0.6, 0.05, least, greatest) == pytest.approx(U, rel=1e-9, abs=1e-11)
    assert found.min() >= least
    assert found.max() <= greatest


def test_a_tail_far_from_the_mean_keeps_its_shape() -> None:
    """Ten deviations out, where the distribution function itself is 1 to all digits, the tail is as exp(-10 t)."""
    found = cut_normal((np.arange(2000) + 0.5) / 2000, 0, 1, 10, None)
    assert found.min() >= 10
    assert found.mean() == pytest.approx(stats.norm.pdf(10) / stats.norm.sf(10), rel=1e-4)  # of the midpoint rule
    assert found.mean() - 10 == pytest.approx(0.0981, abs=2e-4)


def test_lognormal_has_the_mean_and_deviation_of_the_value() -> None:
    u = (np.arange(100_000) + 0.5) / 100_000
    found = at({"lognormal": {"mean": 20, "deviation": 5}}, u)
    assert found.mean() == pytest.approx(20, rel=1e-5)
    assert found.std() == pytest.approx(5, rel=1e-3)  # the midpoint rule misses the last of the upper tail
    assert stats.skew(np.log(found)) == pytest.approx(0, abs=1e-3)


def test_lognormal_between_limits() -> None:
    variance = math.log(1 + 0.25**2)
    parts = (math.log(20) - variance / 2, math.sqrt(variance), math.log(15), math.log(30))
    found = at({"lognormal": {"mean": 20, "deviation": 5, "min": 15, "max": 30}}, U)
    assert share_of_normal(np.log(found), *parts) == pytest.approx(U, rel=1e-9, abs=1e-11)
    assert found.min() >= 15
    assert found.max() <= 30


def test_uniform() -> None:
    found = at({"uniform": {"from": -2, "to": 3}}, U)
    assert (found + 2) / 5 == pytest.approx(U, abs=1e-11)


def test_triangular() -> None:
    found = at({"triangular": {"from": 1, "mode": 1.5, "to": 3}}, U)
    rising = (found - 1) ** 2 / (2 * 0.5)
    falling = 1 - (3 - found) ** 2 / (2 * 1.5)
    assert np.where(found <= 1.5, rising, falling) == pytest.approx(U, abs=1e-11)


LARGE: list[tuple[dict[str, Any], Any]] = [
    ({"normal": {"mean": 0.6, "deviation": 0.05}}, stats.norm(0.6, 0.05).cdf),
    ({"lognormal": {"mean": 2, "deviation": 2}}, stats.lognorm(math.sqrt(math.log(2)), scale=math.sqrt(2)).cdf),
    ({"uniform": {"from": 1, "to": 3}}, stats.uniform(1, 2).cdf),
    ({"triangular": {"from": 0, "mode": 1, "to": 4}}, stats.triang(0.25, 0, 4).cdf),
]


@pytest.mark.parametrize("kind", ["random", "latin_hypercube", "sobol"])
@pytest.mark.parametrize(("parameter", "distribution"), LARGE)
def test_large_samples_follow_their_distribution(kind: str, parameter: dict[str, Any], distribution: Any) -> None:
    """Kolmogorov and Smirnov: a random sample is as far off as expected, the others are far nearer."""
    found = column(drawn(parameter, 4096, kind), "x")
    distance = stats.kstest(found, distribution).statistic
    # 1.63/sqrt(n): one random sample in a hundred is further off. A stratified one is within its stratum, 1/n.
    assert distance < (1.63 / 64 if kind == "random" else 1.001 / 4096)
    assert distance > (0.2 / 64 if kind == "random" else 0)
