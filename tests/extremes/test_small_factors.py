"""Load factors as small as the rounding of forces: the bounds stay bounds."""

from __future__ import annotations

import pytest

from tests.extremes.outcome import outcome_of
from tests.extremes.scenes import all_scenes

pytestmark = pytest.mark.long

WALLS = {scene.name: scene for scene in all_scenes() if scene.family == "friction" and "wall, assoc" in scene.name}


@pytest.mark.parametrize("friction", ["1.0e-12", "1.0e-9", "1.0e-6"])
def test_bounds_of_a_wall_that_hardly_rubs(friction: str) -> None:
    """Uncharged for what its forces leave unbalanced, the static bound at 1e-12 was 1.2e-12.

    The least forces alone carried 9.93e-13 there, below the bound: the load factor is the one that was proved.
    """
    outcome = outcome_of(WALLS[f"wall, associative, friction {friction}"])
    assert outcome.static is not None
    assert outcome.kinematic is not None
    assert outcome.static <= float(friction) <= outcome.kinematic
    assert outcome.got is not None
    assert outcome.static <= outcome.got <= outcome.kinematic
