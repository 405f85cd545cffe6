"""What a scheme does where the associative flow rule gives it nothing to start from."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.solution import flow_rules as flow_module
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.flow_rules import NOT_FOLLOWED, NOT_PUBLISHED, NOT_REACHED, Flow, solve_flow
from mbla.solution.nonassociative import proximal
from mbla.solution.nonassociative.interior_path import solve_interior as interior_module
from mbla.solution.nonassociative.law_state import LawState, SequenceResult
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


def test_a_state_of_the_law_is_kept_though_a_sharper_one_was_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    """Another scheme would lead to another state, at many times the cost; what was missed is said."""
    line = line_of(BLOCK, "analysis.flow_rule=non_associative", "analysis.residual=1e-9")
    state = LawState(np.zeros((0, 3)), np.zeros(0), 0.5, 4e-8)
    found = SequenceResult(Status.SOLVED, state, "", ())

    def elsewhere(*arguments: object, **more: object) -> SequenceResult:
        raise AssertionError("the interior scheme was begun")

    monkeypatch.setattr(flow_module, "solve_proximal", lambda *arguments: found)
    monkeypatch.setattr(interior_module, "solve_interior", elsewhere)
    monkeypatch.setattr(
        flow_module, "sharpened", lambda *arguments: arguments[-1]
    )  # the state has no forces to look at
    nothing = AssociativeResult(Status.SOLVED, None, None, "", ())
    settings = SolverSettings(1e-10, residual=1e-9)
    result = solve_flow(Flow(line.program, nothing, line.deck.analysis, settings, lambda record: None))
    assert result.state is state
    assert result.remarks == (NOT_REACHED.format(4e-8, 1e-9),)


@pytest.mark.parametrize(("large", "miss", "followed"), [(0, 3e-5, False), (0, 3e-2, False), (10_000, 3e-5, True)])
def test_no_interior_path_is_followed_unasked_on_large_structures(
    monkeypatch: pytest.MonkeyPatch, *, large: int, miss: float, followed: bool
) -> None:
    """What the steps came to is kept, and that nothing else was tried is said."""
    line = line_of(BLOCK, "analysis.flow_rule=non_associative")
    near = SequenceResult(Status.SOLVED, LawState(np.zeros((0, 3)), np.zeros(0), 0.5, miss), "", ())
    exact = SequenceResult(Status.SOLVED, LawState(np.zeros((0, 3)), np.zeros(0), 0.4, 0.0), "", ())
    monkeypatch.setattr(flow_module, "LARGE", large)
    monkeypatch.setattr(flow_module, "solve_proximal", lambda *arguments: near)
    monkeypatch.setattr(interior_module, "solve_interior", lambda *arguments, **more: exact)
    monkeypatch.setattr(flow_module, "sharpened", lambda *arguments: arguments[-1])
    nothing = AssociativeResult(Status.SOLVED, None, None, "", ())
    settings = SolverSettings(1e-9, residual=1e-6)
    result = solve_flow(Flow(line.program, nothing, line.deck.analysis, settings, lambda record: None))
    assert result.state is (exact.state if followed else near.state)
    assert (NOT_FOLLOWED in result.remarks) is not followed


@pytest.mark.parametrize(("closing", "followed"), [(4e-3, False), (1.1e-2, True)])
def test_a_rough_state_is_enough_if_verification_sees_it_so(
    closing: float, followed: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a dome steps ended at 3.3e-3, which with the normal forces of closing joints are 1.1e-2: no result."""
    line = line_of(BLOCK, "analysis.flow_rule=non_associative")
    near = SequenceResult(Status.APPROXIMATE, LawState(np.zeros((0, 3)), np.zeros(0), 0.5, 3.3e-3), "", ())
    exact = SequenceResult(Status.SOLVED, LawState(np.zeros((0, 3)), np.zeros(0), 0.4, 0.0), "", ())
    monkeypatch.setattr(proximal, "residual_with_closing", lambda *arguments: closing)
    monkeypatch.setattr(flow_module, "solve_proximal", lambda *arguments: near)
    monkeypatch.setattr(interior_module, "solve_interior", lambda *arguments, **more: exact)
    nothing = AssociativeResult(Status.SOLVED, None, None, "", ())
    settings = SolverSettings(1e-9, residual=5e-3)
    result = solve_flow(Flow(line.program, nothing, line.deck.analysis, settings, lambda record: None))
    assert result.state is (exact.state if followed else near.state)
