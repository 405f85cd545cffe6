"""Values that are drawn: quantiles, and the distributions that they fill."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy import stats

from mbla.arrays import FloatArray
from mbla.sweeps.design.sampling import quantiles
from mbla.sweeps.design.ways import cut_normal, filled
from mbla.sweeps.file.content import Parameter
from tests.sweeps.design.hand_made import column, drawn

KINDS = ("random", "latin_hypercube", "sobol")
RANDOM = [0.6856908585525251, 0.7196460261664678]
LATIN_HYPERCUBE = [0.6961492598344967, 0.16312757888272433]
SOBOL = [0.543235067236306, 0.34270213912233727]


@pytest.mark.parametrize("kind", KINDS)
def test_the_same_seed_gives_the_same_numbers(kind: str) -> None:
    first, again, other = (quantiles(kind, 64, seed, ["a", "b"]) for seed in (1, 1, 2))
    assert np.array_equal(first, again)
    assert not np.any(first == other)


@pytest.mark.parametrize("kind", ["random", "latin_hypercube"])
def test_a_further_name_does_not_change_the_others(kind: str) -> None:
    assert np.array_equal(quantiles(kind, 33, 5, ["a", "b"]), quantiles(kind, 33, 5, ["new", "a", "b"])[:, 1:])


def test_numbers_are_those_of_every_machine() -> None:
    """Kept as they are: other numbers here are other points for sweeps that were begun before.

    scipy 1.13 and 1.17 give these same bits.
    """
    assert quantiles("random", 2, 1, ["mu"])[:, 0].tolist() == RANDOM
    assert quantiles("latin_hypercube", 2, 1, ["mu"])[:, 0].tolist() == LATIN_HYPERCUBE
    assert quantiles("sobol", 2, 1, ["mu"])[:, 0].tolist() == SOBOL


@pytest.mark.parametrize("points", [1, 7, 100])
def test_a_latin_hypercube_has_one_point_in_each_stratum(points: int) -> None:
    found = np.floor(quantiles("latin_hypercube", points, 1, ["a", "b"]) * points).astype(int)
    assert np.array_equal(np.sort(found, axis=0), np.tile(np.arange(points)[:, None], 2))


@pytest.mark.parametrize("kind", KINDS)
def test_quantiles_lie_strictly_between_0_and_1(kind: str) -> None:
    found = quantiles(kind, 20_000, 1, ["a", "b"])
    assert found.min() > 0
    assert found.max() < 1


U = np.array([1e-12, 1e-6, 0.01, 0.2, 0.5, 0.8, 0.99, 1 - 1e-6])


def at(parameter: dict[str, Any], u: FloatArray) -> FloatArray:
    return np.array(filled(Parameter.model_validate(parameter), u[:, None], None)[1], dtype=float)


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
