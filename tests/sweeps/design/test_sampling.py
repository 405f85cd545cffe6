from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import qmc

from mbla.sweeps.design.sampling import quantiles

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


def test_sobol_points_fill_every_box_of_a_power_of_two() -> None:
    """256 points in two dimensions: one in each of the 16 x 16 boxes, which no other design here promises."""
    found = np.floor(quantiles("sobol", 256, 1, ["a", "b"]) * 16).astype(int)
    assert len(np.unique(found, axis=0)) == 256


def test_sobol_is_spread_more_evenly_than_a_latin_hypercube_and_that_than_chance() -> None:
    names = ["a", "b", "c"]
    spread = [np.mean([qmc.discrepancy(quantiles(kind, 256, seed, names)) for seed in range(5)]) for kind in KINDS]
    assert spread[0] > 2 * spread[1] > 4 * spread[2]


@pytest.mark.parametrize("kind", KINDS)
def test_quantiles_lie_strictly_between_0_and_1(kind: str) -> None:
    found = quantiles(kind, 20_000, 1, ["a", "b"])
    assert found.min() > 0
    assert found.max() < 1
