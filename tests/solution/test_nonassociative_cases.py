"""Non-associative cases outside the usual ones: a few small ones each time, all of them among the long tests."""

from __future__ import annotations

import pytest

from mbla.solution.solution import Status
from tests.line import line_of, verified
from tests.solution.nonassociative_cases import CASES, SHORT, solved_case

SHARE_SOLVED = 0.95
"""Which of the hardest ones fail may change with rounding."""


@pytest.mark.long
@pytest.mark.parametrize("name", SHORT)
def test_a_case_is_solved_and_verified(name: str) -> None:
    solution, checks, status = verified(line_of(CASES[name](), "analysis={standing: false}"))
    assert status is Status.SOLVED, (solution.reason, checks.failures)
    assert checks.elastic_residual < 1e-5
    assert checks.equilibrium_residual < 1e-6
    if solution.associative is not None and solution.mechanics is not None:
        assert solution.mechanics.load_factor <= solution.associative.load_factor * (1 + 1e-7)


@pytest.mark.long
def test_most_of_all_cases_are_solved() -> None:
    solved = 0
    for name in CASES:
        result, factor, associative, _ = solved_case(name)
        solved += result.status is Status.SOLVED
        assert not factor > associative * (1 + 1e-6), name  # where associative flow locks there is no such bound
    assert len(CASES) >= 30
    assert solved >= SHARE_SOLVED * len(CASES)
