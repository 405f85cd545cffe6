from __future__ import annotations

import pytest

from tests.analytic.dome_slice import least_thickness
from tests.decks.folder import BENCHMARKS, run_deck

DECK = BENCHMARKS["dome_of_slices"]


def test_thin_slices_are_heymans() -> None:
    """0.042 of the radius; a little more with weights at their true centroids."""
    assert least_thickness(60, 1000, 0.01) == pytest.approx(0.042, abs=1e-3)


@pytest.mark.parametrize(("share", "status"), [(0.999, "no_equilibrium"), (1.001, "solved")])
def test_the_dome_falls_and_stands_a_thousandth_off_the_least_thickness(share: float, status: str) -> None:
    thickness = share * least_thickness(10, 8, 0.1)
    case = run_deck(DECK, "--set", f"parameters.t={thickness!r}").record["cases"][0]
    assert case["status"] == status
