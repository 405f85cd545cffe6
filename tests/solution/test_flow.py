"""What a scheme does where the associative flow rule gives it nothing to start from."""

from __future__ import annotations

import pytest

from mbla.solution.associative import AssociativeResult
from mbla.solution.flow import NOT_PUBLISHED, Flow, solve_flow
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from tests.line import BLOCK, line_of


def test_another_scheme_than_the_published_one_is_said_to_have_been_used() -> None:
    line = line_of(BLOCK, "analysis.flow_rule=non_associative", "analysis.scheme=published")
    locked = AssociativeResult(Status.UNBOUNDED, None, None, "", ())
    settings = SolverSettings(1e-8)
    result = solve_flow(Flow(line.program, locked, line.deck.analysis, settings, lambda record: None))
    assert NOT_PUBLISHED in result.remarks
    assert result.state is not None
    assert line.program.scaling.load_factor(result.state.load_factor) == pytest.approx(0.5, rel=1e-9)
