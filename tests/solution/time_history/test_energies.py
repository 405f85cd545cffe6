"""Energies of a step add up to the last digits, whatever happens in it."""

from __future__ import annotations

import pytest

from tests.solution.time_history.followed import followed, out_of_balance
from tests.solution.time_history.random_scenes import random_scene


@pytest.mark.parametrize("seed", [4, 7])
def test_energies_balance_in_every_step(seed: int) -> None:
    """In a plane, and in space."""
    found, _, _ = followed(random_scene(seed, 0.3))
    assert found.rows is not None
    assert found.peaks is not None
    assert found.peaks.peak > 10.0 * found.sag  # it does move
    assert out_of_balance(found.rows) < 1e-12
    assert (found.rows.friction[1:] - found.rows.friction[:-1] > -1e-3 * found.rows.kinetic.max()).all()
