"""Tall walls in running bond have their answer, and the state beside it that a search comes to fits rigid joints."""

from __future__ import annotations

import pytest

from mbla.solution.solution import Status
from tests.line import line_of, verified
from tests.performance.standard_set import DECKS

WALL = (DECKS / "tradeoff" / "wall.yaml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("courses", "associative"),
    [
        pytest.param(40, 0.453068, marks=pytest.mark.long),
        pytest.param(60, 0.437461, marks=pytest.mark.trust),
    ],
)
def test_a_tall_wall_has_its_answer(courses: int, associative: float) -> None:
    solution, checks, status = verified(line_of(WALL, f"parameters.m={courses}", f"parameters.n={courses}"))
    assert status is Status.SOLVED, (solution.reason, checks.failures)
    assert solution.mechanics is not None
    assert checks.elastic_residual < 1e-5
    assert max(checks.yield_violation, checks.equilibrium_residual) < 1e-6
    assert solution.associative is not None
    assert solution.associative.load_factor == pytest.approx(associative, abs=1e-6)
    # where the path ends it still rises: at 300 units of displacement 40 courses are at 0.988
    assert 0.96 * associative < solution.mechanics.load_factor < associative
    assert 0.98 * associative < checks.least_load_factor < associative
