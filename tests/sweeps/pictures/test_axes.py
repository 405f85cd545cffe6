import numpy as np
import pytest

from mbla.sweeps.pictures.view import axis_of, column_by_name, grid_axes, is_sampled
from tests.sweeps.pictures.hand_made import grid, sample, table_of


@pytest.mark.parametrize(
    ("levels", "log"),
    [
        ([1e6, 1e7, 1e8], True),
        (list(np.geomspace(0.1, 0.9, 7)), True),
        ([1.0, 2.0, 4.0], False),  # a list of three that a person writes
        (list(np.linspace(0.1, 0.9, 7)), False),
        ([-1.0, -10.0, -100.0], False),
        ([1.0, 1000.0], False),
    ],
)
def test_equal_ratios_are_a_log_axis(levels: list[float], log: bool) -> None:
    table = grid({"k": levels}, lambda k: k)
    assert axis_of(table, column_by_name(table, "k")).log is log


def test_numbers_ascend_and_texts_keep_the_order_of_the_design() -> None:
    table = grid({"mu": [0.7, 0.5], "bond": ["stack", "running"]}, lambda mu, bond: mu)
    mu, bond = grid_axes(table)
    assert mu.levels == (0.5, 0.7)
    assert mu.place.tolist() == [1, 1, 0, 0]
    assert bond.levels == ("stack", "running")
    assert bond.categorical


def test_parameters_that_change_together_are_one_axis() -> None:
    rows = [{"mu": 0.1 * i, "thickness": 0.2 * i} for i in range(1, 4)]
    table = table_of(rows, lambda mu, thickness: mu, [("zip", 3)], [(i,) for i in range(3)],
                     {"mu": "zip", "thickness": "zip"})  # fmt: skip
    (axis,) = grid_axes(table)
    assert axis.label == "mu, with thickness"


def test_samples_are_no_axis() -> None:
    drawn = {"mu": [0.1, 0.5, 0.3]}
    assert grid_axes(sample(drawn, lambda mu: mu)) == ()
    table = sample(drawn, lambda mu: mu, "sobol", samples="")
    assert is_sampled(table, "sobol")  # of a range without a distribution
    assert not is_sampled(grid({"sobol": [1.0, 2.0]}, lambda sobol: sobol), "sobol")  # a parameter of that name
