"""Spectra of NTC 2018 and EN 1998-1, tables, and spectra at a height of a building."""

from __future__ import annotations

import math

import pytest

from mbla.codes import en1998, ntc2018
from mbla.codes.assess import spectrum_of
from mbla.codes.ntc2018 import (
    Floor,
    floor_acceleration,
    floor_amplification,
    participation,
    peak_floor_acceleration,
)
from mbla.codes.spectrum import Spectrum, damping_factor, ground_acceleration
from mbla.deck.sections.assessment import EurocodeSpectrum, NtcSpectrum, SpectrumSection

SITE = ntc2018.spectrum(0.2, 2.4, 0.35, "B")
FLOOR = Floor(0.3, 5.0, participation(2), 0.75)


def test_corners_of_the_worked_example() -> None:
    corners = SITE.S, SITE.T_B, SITE.T_C, SITE.T_D
    assert corners == pytest.approx((1.2, 0.15832, 0.47495, 2.4), abs=5e-5)


@pytest.mark.parametrize(
    ("soil", "a_g", "factor"), [("A", 0.3, 1.0), ("C", 0.3, 1.268), ("C", 0.1, 1.5), ("D", 0.3, 1.32), ("E", 0.4, 1.0)]
)
def test_soil_factor_depends_on_the_acceleration_within_its_limits(soil: str, a_g: float, factor: float) -> None:
    flat, ridge = (ntc2018.spectrum(a_g, 2.4, 0.3, soil, site) for site in ("T1", "T4"))
    assert pytest.approx([factor, 1.4 * factor]) == [flat.S, ridge.S]


@pytest.mark.parametrize("spectrum", [SITE, en1998.spectrum(0.2, 1, "C"), en1998.spectrum(0.1, 2, "D")])
@pytest.mark.parametrize("damping", [5.0, 8.0, 10.0])
def test_branches_meet_and_have_their_laws(spectrum: Spectrum, damping: float) -> None:
    T_B, T_C, T_D = spectrum.T_B, spectrum.T_C, spectrum.T_D

    def at(period: float) -> float:
        return ground_acceleration(spectrum, period, damping)

    for corner in (T_B, T_C, T_D):
        assert at(corner * (1 - 1e-9)) == pytest.approx(at(corner * (1 + 1e-9)), rel=1e-7)
    rock, plateau = spectrum.a_g * spectrum.S, spectrum.a_g * spectrum.S * damping_factor(damping) * spectrum.F_0
    assert at(0.0) == pytest.approx(rock)
    assert at(T_B / 2) == pytest.approx((rock + plateau) / 2)
    assert at((T_B + T_C) / 2) == pytest.approx(plateau)
    assert at(T_C * 1.5) == pytest.approx(plateau / 1.5)
    assert at(2 * T_D) == pytest.approx(plateau * T_C / T_D / 4)


def test_rows_of_the_eurocode_table() -> None:
    one, two = en1998.spectrum(0.2, 1, "D"), en1998.spectrum(0.2, 2, "C")
    assert (one.S, one.T_B, one.T_C, one.T_D) == (1.35, 0.2, 0.8, 2.0)
    assert (two.S, two.T_B, two.T_C, two.T_D) == (1.5, 0.1, 0.25, 1.2)


def test_damping_factor_has_a_least_value() -> None:
    assert damping_factor(5.0) == 1.0
    assert damping_factor(8.0) == pytest.approx(math.sqrt(10 / 13))
    assert damping_factor(50.0) == 0.55


def test_a_table_is_read_between_its_points_and_scaled_by_the_ground() -> None:
    table = SpectrumSection(table=[(0.0, 0.2), (0.2, 0.5), (1.0, 0.1)])
    spectrum = spectrum_of(table)
    assert spectrum.a_g * spectrum.S == 0.2
    assert ground_acceleration(spectrum, 0.1) == pytest.approx(0.35)
    assert ground_acceleration(spectrum, 0.1, 8.0) == pytest.approx(0.35 * damping_factor(8.0))
    assert ground_acceleration(spectrum_of(table, 0.4), 0.6) == pytest.approx(2 * 0.3)
    assert math.isnan(ground_acceleration(spectrum, 1.01))


def test_spectra_of_the_deck_take_another_ground_acceleration() -> None:
    ntc = SpectrumSection(ntc_2018=NtcSpectrum(a_g=0.2, F_0=2.4, T_C_star=0.35, soil="B"))
    eurocode = SpectrumSection(en_1998=EurocodeSpectrum(a_g=0.2, type=1, soil="B"))
    assert spectrum_of(ntc) == SITE
    assert spectrum_of(ntc, 0.4) == ntc2018.spectrum(0.4, 2.4, 0.35, "B")  # with the S and the T_D of 0.4 g
    assert spectrum_of(eurocode, 0.1) == en1998.spectrum(0.1, 1, "B")


# --- At a height ----------------------------------------------------------------------------------------------------


def test_the_peak_of_a_floor_is_at_the_period_of_the_building() -> None:
    peak = floor_acceleration(SITE, FLOOR, FLOOR.period)
    assert peak == pytest.approx(floor_amplification(FLOOR, 5.0) * peak_floor_acceleration(SITE, FLOOR))
    others = [floor_acceleration(SITE, FLOOR, period) for period in (0.0, 0.05, 0.2, 0.35, 0.5, 1.0, 3.0)]
    assert max(others) < peak
    for corner in (0.8 * FLOOR.period, 1.1 * FLOOR.period):
        below, above = (floor_acceleration(SITE, FLOOR, corner * (1 + side)) for side in (-1e-9, 1e-9))
        assert below == pytest.approx(above, rel=1e-6)


def test_a_rigid_body_on_a_floor_has_the_acceleration_of_the_floor() -> None:
    assert floor_acceleration(SITE, FLOOR, 0.0) == pytest.approx(peak_floor_acceleration(SITE, FLOOR))


def test_damping_is_a_ratio_where_per_cent_would_put_the_peak_below_the_floor() -> None:
    assert floor_amplification(FLOOR, 5.0) == pytest.approx(1.1 / math.sqrt(0.05))
    assert floor_amplification(FLOOR, 5.0) > 1.0 > 1.1 * 5.0**-0.5
    share = peak_floor_acceleration(SITE, FLOOR) / ground_acceleration(SITE, 0.3) / (1.2 * 0.75)
    assert share == pytest.approx(math.sqrt(1.01))  # √(1 + 4ξ²), the transmissibility of ξ = 0.05


@pytest.mark.parametrize("period", [0.31, 0.6, 1.0, 3.0])
def test_beyond_the_first_period_a_floor_is_not_below_the_ground(period: float) -> None:
    on_the_ground = Floor(0.3, 5.0, 1.2, 0.0)
    assert floor_acceleration(SITE, on_the_ground, period) == ground_acceleration(SITE, period)
    assert floor_acceleration(SITE, FLOOR, period, 8.0) >= ground_acceleration(SITE, period, 8.0)


def test_participation_of_one_and_of_many_storeys() -> None:
    assert participation(1) == 1.0
    assert participation(1000) == pytest.approx(1.5, rel=1e-3)
