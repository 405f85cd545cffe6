"""Vehicles that stand; how their axles land is tested with the loads that spread in fill."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.model.fill.test_dispersal import ROW, law_up_to, model, shares


def test_a_vehicle_stands_or_travels(tmp_path: Path) -> None:
    """Standing where it travels it is the same load; each axle is a line of its width."""
    stands = model(tmp_path, "vehicle: {name: lorry, at: [6.3, 1, 9]}", *ROW, width=", width: 1.8")
    travels = model(
        tmp_path, "travel: {vehicle: lorry, path: [[3.3, 1, 9], [6.3, 1, 9]], positions: 3}", *ROW, width=", width: 1.8"
    )
    assert travels.load_cases[1].live_load == pytest.approx(stands.load_cases[0].live_load)
    each = [np.diff(law_up_to("boussinesq", np.arange(11) - x, 1.2)) for x in (6.3, 3.3)]
    assert shares(stands) == pytest.approx(60 * each[0] + 40 * each[1], rel=1e-8, abs=1e-6)
    assert "through fill soil" in travels.load_cases[1].live_words[0]
