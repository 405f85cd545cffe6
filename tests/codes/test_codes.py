"""Articles on local mechanisms: the worked example of a facade 8 m high and 0.6 m thick, and limits in closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mbla.codes import circolare2009, ntc2018
from mbla.codes.assess import spectrum_of
from mbla.codes.coefficients import coefficients
from mbla.codes.ntc2018 import Floor, floor_acceleration
from mbla.deck.sections.assessment import SpectrumSection

SITE = ntc2018.spectrum(0.2, 2.4, 0.35, "B")
ACTIVATION = ntc2018.spectral_acceleration(0.075, 1.0, 1.35)
FLOOR = Floor(0.3, 5.0, 1.2, 0.75)


def test_activation_of_the_worked_example() -> None:
    assert pytest.approx(0.5450, abs=5e-5) == ACTIVATION * 9.81
    assert 2.0 * ACTIVATION / ntc2018.floor_demand(SITE, None) == pytest.approx(0.4630, abs=5e-5)
    assert 2.0 * ACTIVATION / circolare2009.demand(SITE, None) == pytest.approx(0.4630, abs=5e-5)


@pytest.mark.parametrize(
    ("state", "d", "a", "period", "demand", "ratio"),
    [("SLV", 0.12, 0.3270, 3.1972, 0.1431, 0.839), ("SLC", 0.18, 0.2180, 4.4533, 0.1332, 1.351)],
)
def test_displacements_of_the_worked_example(
    state: str, d: float, a: float, period: float, demand: float, ratio: float
) -> None:
    assert coefficients("mechanism")[state]["share"] * 0.3 == pytest.approx(d)
    on_the_line = ACTIVATION * 9.81 * (1.0 - coefficients("mechanism")[state]["share"])
    assert on_the_line == pytest.approx(a, abs=5e-5)
    T = ntc2018.secant_period(state, d, on_the_line)
    assert pytest.approx(period, abs=5e-5) == T
    asked = 9.81 * ntc2018.displacement_demand(SITE, None, T, coefficients("mechanism")[state]["damping"])
    assert asked == pytest.approx(demand, abs=5e-5)
    assert d / asked == pytest.approx(ratio, abs=5e-4)


def test_participating_share_of_one_block_and_of_many_stones() -> None:
    assert ntc2018.participating_share(np.array([3.0]), np.array([0.2])) == pytest.approx(1.0)
    many = (np.arange(1000) + 0.5) / 1000
    assert ntc2018.participating_share(np.ones(1000), many) == pytest.approx(0.75, rel=1e-5)
    wall, beam = np.array([2.0, 6.0]), np.array([1.0, 0.5])
    assert ntc2018.participating_share(wall, beam) == pytest.approx(25.0 / (8.0 * 3.5))


def test_spectral_displacement_at_the_centroid_of_one_block_is_its_own() -> None:
    assert ntc2018.spectral_displacement(np.array([5.0]), np.array([0.7]), 0.7) == pytest.approx(1.0)
    assert ntc2018.spectral_displacement(np.array([5.0]), np.array([0.7]), 1.4) == pytest.approx(0.5)  # seen at the top


def test_ground_capacity_is_where_the_demand_is_the_capacity() -> None:
    def demand(a_g: float) -> float:
        return ntc2018.displacement_demand(ntc2018.spectrum(a_g, 2.4, 0.35, "C"), None, 3.0, 8.0)

    found = ntc2018.ground_capacity(demand, 0.01)
    assert demand(found) == pytest.approx(0.01, rel=1e-9)
    assert found != pytest.approx(0.2 * 0.01 / demand(0.2), rel=1e-2)  # S and T_D are those of the a_g that is found


def test_ground_capacity_takes_the_least_where_softer_ground_gives_three() -> None:
    def demand(a_g: float) -> float:
        return ntc2018.floor_demand(ntc2018.spectrum(a_g, 2.4, 0.35, "D"), None)

    found = ntc2018.ground_capacity(demand, 0.38)
    assert demand(found) == pytest.approx(0.38, rel=1e-9)
    assert demand(0.37) < demand(0.34)  # it falls there, and rises again
    assert found < 0.34


def test_ground_capacity_without_end_and_without_knowledge() -> None:
    assert ntc2018.ground_capacity(lambda a_g: 0.0, 1.0) == math.inf
    assert math.isnan(ntc2018.ground_capacity(lambda a_g: math.nan, 1.0))


def test_demand_at_a_height() -> None:
    assert ntc2018.floor_demand(SITE, FLOOR) == pytest.approx(0.2 * 1.2 * 2.4 * 0.9 * math.sqrt(1.01))
    assert ntc2018.floor_demand(SITE, Floor(0.3, 5.0, 1.2, 0.0)) == pytest.approx(0.24)  # not less than on the ground
    assert circolare2009.demand(SITE, FLOOR) == pytest.approx(0.2 * 1.2 * 2.4 * 0.9)
    short = ntc2018.displacement_demand(SITE, FLOOR, 0.2, 8.0)
    assert short == pytest.approx(floor_acceleration(SITE, FLOOR, 0.2, 8.0) * 0.2**2 / (4 * math.pi**2))
    past = [ntc2018.displacement_demand(SITE, FLOOR, period, 8.0) for period in (0.34, 0.4, 0.6)]
    assert min(past) >= floor_acceleration(SITE, FLOOR, 0.3, 8.0) * 0.33**2 / (4 * math.pi**2)


def test_demand_of_a_table_is_the_greatest_up_to_the_period() -> None:
    spectrum = spectrum_of(SpectrumSection(table=[(0.0, 0.2), (0.5, 0.6), (1.0, 0.05), (4.0, 0.01)]))
    peak = ntc2018.displacement_demand(spectrum, None, 0.6, 5.0)
    assert ntc2018.displacement_demand(spectrum, None, 1.0, 5.0) >= peak > 0.05 / (4 * math.pi**2)
    assert math.isnan(ntc2018.displacement_demand(spectrum, None, 4.5, 5.0))
