"""One part of a structure: what the flow rule says where associative flow locks, and a part that nothing loads."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mbla.solution.nonassociative.factor_range import FactorRange

from mbla.errors import Message
from mbla.program.program import Program
from mbla.solution import part
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.nonassociative import schemes
from mbla.solution.nonassociative.law_state import LawState, SequenceResult
from mbla.solution.nonassociative.locking import Boundedness, BoundednessResult
from mbla.solution.nonassociative.schemes import NOT_PUBLISHED, NOT_REACHED, solve_nonassociative
from mbla.solution.part import NEEDS_NOTHING, _lower_of, solve_part
from mbla.solution.part_result import PartResult
from mbla.solution.settings import solver_settings
from mbla.solution.solution import Status
from tests.line import BLOCK, line_of, line_of_file, solution_of
from tests.solution.standing_structures import deck, plane, prism

KERB = Path(__file__).parents[2] / "decks" / "regressions" / "block_at_a_kerb.yaml"
ALONG = "load_cases.push.live=[{acceleration: [0, 1, 0]}]"


def wedge(friction: float) -> str:
    """A wedge in a groove of two planes at 30 degrees, pushed along it: with normality it locks from 1.732 on."""
    c, s = math.cos(math.radians(30)), 0.5
    outline = [(0, 0), (1, s / c), (-1, s / c)]
    return deck(prism(outline, 4.0), plane(0, 0, -s, c) + plane(0, 0, s, c), f"friction: {friction}")


def result_of(text: str, *overrides: str) -> PartResult:
    line = line_of(text, *overrides)
    return solve_part(line.program, solver_settings(line.deck.analysis), lambda record: None)


def test_livesleys_correction_needs_associative_forces() -> None:
    result = result_of(wedge(2.0), ALONG, "analysis.flow_rule=livesley")
    assert result.status is Status.UNBOUNDED
    assert result.sequence is None


@pytest.mark.parametrize("dilatancy", [5, 10, 50])
def test_a_wedge_with_less_dilatancy_than_friction_may_slide_where_that_locks(dilatancy: float) -> None:
    """mu / (s cos b - mu w sin^2 b), see ``test_default_scheme``."""
    b, mu, rise = math.radians(30), 2.0, math.tan(math.radians(dilatancy))
    result = result_of(wedge(mu), ALONG, "analysis.flow_rule=dilatancy", f"joints.dry.dilatancy={dilatancy}")
    assert result.associative.status is Status.UNBOUNDED
    assert result.status is Status.SOLVED
    w = rise / math.sqrt(math.cos(b) ** 2 - (rise * math.sin(b)) ** 2)
    s = math.hypot(1.0, w * math.sin(b))
    assert result.state is not None
    factor = result.program.scaling.load_factor(result.state.load_factor)
    assert factor == pytest.approx(mu / (s * math.cos(b) - mu * w * math.sin(b) ** 2), rel=1e-7)


@pytest.mark.parametrize("dilatancy", [60.5, 62])
def test_a_wedge_whose_dilatancy_locks_it_has_no_load_factor(dilatancy: float) -> None:
    """Steps of the law end at factors of a million there, which are none."""
    result = result_of(wedge(2.0), ALONG, "analysis.flow_rule=dilatancy", f"joints.dry.dilatancy={dilatancy}")
    assert result.status is Status.UNBOUNDED
    assert result.sequence is None
    assert result.associative.reason == part.NO_MECHANISM_AT_DILATANCY


def test_a_wedge_for_which_no_state_with_dilatancy_is_found_stays_locked(monkeypatch: pytest.MonkeyPatch) -> None:
    nothing = SequenceResult(Status.APPROXIMATE, None, "did not come to rest", ())
    monkeypatch.setattr(part, "solve_nonassociative", lambda *arguments: nothing)
    result = result_of(wedge(2.0), ALONG, "analysis.flow_rule=dilatancy", "joints.dry.dilatancy=10")
    assert result.status is Status.UNBOUNDED
    assert result.sequence is None


@pytest.mark.parametrize("found", [True, False])
def test_what_may_lock_without_dilatancy_too_is_answered_by_a_state_of_the_law_alone(
    found: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The doubt is told beside it; a wedge of friction 2 slides at mu / cos b."""
    doubtful = BoundednessResult(
        Boundedness.DOUBTFUL, None, Message("locking-doubtful", "whether it locks is doubtful")
    )
    monkeypatch.setattr(part, "non_associative_bounded", lambda *arguments: doubtful)
    if not found:
        nothing = SequenceResult(Status.APPROXIMATE, None, "did not come to rest", ())
        monkeypatch.setattr(part, "solve_nonassociative", lambda *arguments: nothing)
    result = result_of(wedge(2.0), ALONG)
    if not found:
        assert result.status is Status.NOT_VERIFIED
        assert result.reason == "whether it locks is doubtful"
        assert result.sequence is None
        return
    assert result.status is Status.SOLVED
    assert result.state is not None
    factor = result.program.scaling.load_factor(result.state.load_factor)
    assert factor == pytest.approx(2.0 / math.cos(math.radians(30)), rel=1e-7)
    assert result.sequence is not None
    assert "locking-doubtful" in {remark.identifier for remark in result.sequence.remarks}


@pytest.mark.parametrize("weight", [0.0, 1.0])
def test_a_part_without_live_load_has_only_to_stand(weight: float) -> None:
    line = line_of(BLOCK)
    program = line.program
    unloaded = replace(program, live_load=np.zeros_like(program.live_load), dead_load=weight * program.dead_load)
    result = solve_part(unloaded, solver_settings(line.deck.analysis), lambda record: None)
    assert not result.loaded
    assert result.status is Status.UNBOUNDED
    assert result.reason == ("no live load acts on it" if weight else "")
    assert bool(result.programs) is bool(weight)


@pytest.mark.parametrize("overrides", [(), ("analysis.search=0",)])
def test_a_small_structure_falls_where_it_turns_over_the_edge_of_a_kerb(overrides: tuple[str, ...]) -> None:
    """A state of the law lies 3 % higher: a look at the load path finds the right one."""
    line = line_of_file(KERB, *overrides)
    settings = solver_settings(line.deck.analysis)
    result = solve_part(line.program, settings, lambda record: None)
    assert result.status is Status.SOLVED
    assert result.state is not None
    assert line.program.scaling.load_factor(result.state.load_factor) == pytest.approx(0.9 / 0.47, rel=1e-5)


def test_no_lower_end_is_given_for_a_mechanism_that_needs_no_live_load(monkeypatch: pytest.MonkeyPatch) -> None:
    def at_nothing(program: Program, state: LawState, *_: object) -> FactorRange:
        return FactorRange(replace(state, load_factor=0.0), replace(state, load_factor=0.9), ())

    monkeypatch.setattr(part, "factor_range", at_nothing)
    result = result_of(BLOCK, "analysis.flow_rule=non_associative")
    assert result.range is not None
    assert result.range.lower is None
    assert result.range.reason == Message("range-not-found", NEEDS_NOTHING)
    assert result.state is not None
    assert result.state.load_factor > 0.0


@pytest.mark.parametrize("change", ["settles", "published"])
def test_where_no_load_path_means_anything_none_is_followed(change: str) -> None:
    """A support gives way: factors count from a reaction that was chosen. Published figures stay what they are."""
    line = line_of_file(KERB, *(["analysis.scheme=published"] if change == "published" else []))
    program = replace(line.program, settles=change == "settles")
    result = solve_part(program, solver_settings(line.deck.analysis), lambda record: None)
    assert result.state is not None
    assert "load path" not in [record.kind for record in result.programs]


def test_another_scheme_than_the_published_one_is_said_to_have_been_used() -> None:
    line = line_of(BLOCK, "analysis.flow_rule=non_associative", "analysis.scheme=published")
    locked = AssociativeResult(Status.UNBOUNDED, None, None, "", ())
    settings = replace(solver_settings(line.deck.analysis), tolerance=1e-8)
    result = solve_nonassociative(line.program, locked, settings, lambda record: None)
    assert NOT_PUBLISHED in result.remarks
    assert result.state is not None
    assert line.program.scaling.load_factor(result.state.load_factor) == pytest.approx(0.5, rel=1e-8)


def test_a_state_of_the_law_is_kept_though_a_sharper_one_was_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    """What was missed is said."""
    line = line_of(BLOCK, "analysis.flow_rule=non_associative", "analysis.residual=1e-9")
    state = LawState(np.zeros((0, 3)), np.zeros(0), 0.5, 4e-8)
    found = SequenceResult(Status.SOLVED, state, "", ())
    monkeypatch.setattr(schemes, "solve_by_default", lambda *arguments: found)
    monkeypatch.setattr(schemes, "sharpened", lambda *arguments: arguments[-1])  # the state has no forces to look at
    nothing = AssociativeResult(Status.SOLVED, None, None, "", ())
    settings = replace(solver_settings(line.deck.analysis), tolerance=1e-10, residual=1e-9)
    result = solve_nonassociative(line.program, nothing, settings, lambda record: None)
    assert result.state is state
    assert result.remarks == (NOT_REACHED.format(4e-8, 1e-9),)


CORNER = """mbla: 1
materials: {stone: {density: 2200}}
joints: {dry: {friction: 0.7}}
blocks:
  - walls: {group: a, material: stone, unit: [0.5, 0.25, 0.25], courses: 4, plan: [[0, 0], [2, 0], [2, 1.5]]}
  - wall:
      group: b
      material: stone
      unit: [0.5, 0.25, 0.25]
      length: 1.5
      courses: 4
      transform: [{translate: [2, 0, 0]}]
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
load_cases: {c: {live: [{acceleration: [-1, 0, 0]}]}}
analysis: {flow_rule: non_associative}
"""
"""Three walls that meet at a corner; one that falls by itself does at t/H = 0.25."""


@pytest.mark.long
def test_a_search_in_space_comes_to_no_more_than_was_known_without_it() -> None:
    """The load path leads to a state whose mechanism has 0.25; a search from higher ones came to 0.2564."""
    plain, searched = (solution_of(line_of(CORNER, *more)) for more in ((), ("analysis.search=2",)))
    assert plain.lower is not None
    assert searched.lower is not None
    assert plain.lower.load_factor == pytest.approx(0.25, rel=1e-4)
    assert searched.lower.load_factor <= plain.lower.load_factor * (1.0 + 1e-4)


def test_the_lower_of_two_results_counts() -> None:
    """Whichever of state and lower end of its range is the least; sharper or not."""
    program = line_of(BLOCK, "parameters.h=0.5").program
    state = LawState(np.zeros((program.n_points, 3)), np.zeros(len(program.dead_load)), 0.5, 0.0)
    associative = AssociativeResult(Status.SOLVED, state, None, "", ())

    def found_at(load_factor: float, lower: float | None = None) -> PartResult:
        sequence = SequenceResult(Status.SOLVED, replace(state, load_factor=load_factor), "", ())
        end = None if lower is None else replace(state, load_factor=lower, residual=1.0)
        return PartResult(program, associative, sequence, loaded=True, range=FactorRange(end, None, ()))

    assert _lower_of(found_at(0.4, 0.2), found_at(0.3), 0.0).range.lower.load_factor == 0.2  # type: ignore[union-attr]
    for plain, searched in ((found_at(0.4, 0.3), found_at(0.3)), (found_at(0.4), found_at(0.35, 0.2))):
        assert _lower_of(plain, searched, 0.0) is searched


def test_why_a_peak_was_not_examined_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    """By the number of contact points, though the accuracy asks for peaks; with peak: true in the deck it is."""
    monkeypatch.setattr(part, "FEW_POINTS", 3)
    monkeypatch.setattr(part, "SUSPECT", 2.0)
    text = (BLOCK, "analysis.flow_rule=non_associative", "parameters.h=0.5")
    assert "more than 3, the load path is followed only" in str(result_of(*text).remarks)
    assert "not examined" not in str(result_of(*text, "analysis.peak=true").remarks)
