from __future__ import annotations

import numpy as np
import pytest

from mbla.program.assemble import LIGHT, own_units

FIXED = -1


@pytest.mark.parametrize(
    ("loads", "bodies", "units"),
    [
        ([1, 1e-12], [(FIXED, 0), (0, 1)], [1, 1e-12]),
        ([1, 1e-12], [(FIXED, 0), (1, 0), (0, 1)], [1, 1e-12]),
        ([1, 2 * LIGHT], [(FIXED, 0), (0, 1)], [1, 1]),
        ([1e-12, 1], [(FIXED, 0), (0, 1)], [1, 1]),  # light below heavy
        ([1, 1e-12, 1], [(FIXED, 0), (0, 1), (1, 2)], [1, 1, 1]),
        ([1, 1e-12, 1e-10], [(FIXED, 0), (0, 1), (1, 2)], [1, 1e-10, 1e-10]),  # a pile has the unit of its largest load
        ([1, 1e-12, 1e-10], [(FIXED, 0), (0, 1), (0, 2)], [1, 1e-12, 1e-10]),
        ([1, 1e-12, 1e-10], [(FIXED, 0), (0, 1), (1, 2), (FIXED, 2)], [1, 1, 1]),
        ([1, 1e-12], [(FIXED, 0), (FIXED, 1)], [1, 1e-12]),
        ([1, 0], [(FIXED, 0), (0, 1)], [1, 1]),  # without a load there is nothing to measure by
        ([1, 1], [(FIXED, 0), (0, 1)], [1, 1]),
    ],
)
def test_units(loads: list[float], bodies: list[tuple[int, int]], units: list[float]) -> None:
    assert own_units(np.array(loads, dtype=np.float64), np.array(bodies)).tolist() == units
