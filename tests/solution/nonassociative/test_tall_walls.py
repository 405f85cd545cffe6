"""Tall walls in running bond come to the joint law; without emphasized joints 60 courses rest at a residual of 4e-4."""

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
    overrides = (f"parameters.m={courses}", f"parameters.n={courses}", "analysis.search=0")
    solution, checks, status = verified(line_of(WALL, *overrides))
    assert status is Status.SOLVED, (solution.reason, checks.failures)
    assert solution.mechanics is not None
    assert max(checks.complementarity_residual, checks.yield_violation, checks.equilibrium_residual) < 1e-6
    assert solution.associative is not None
    assert solution.associative.load_factor == pytest.approx(associative, abs=1e-6)
    assert 0.99 * associative < solution.mechanics.load_factor < associative
