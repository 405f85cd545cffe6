"""One part of a structure: what the flow rule says where associative flow locks, and a part that nothing loads."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.nonassociative.schemes import NOT_PUBLISHED, solve_nonassociative
from mbla.solution.parts import part
from mbla.solution.parts.part import SEARCH_BROKE_DOWN
from mbla.solution.parts.part_context import PartContext
from mbla.solution.parts.part_result import PartResult
from mbla.solution.settings import solver_settings
from mbla.solution.solution import Status
from mbla.solution.solve import solve_part
from tests.line import BLOCK, WALL, line_of, solution_of
from tests.reached import BELOW, reaches
from tests.solution.nonassociative.structures import in_the_groove
from tests.solution.planar import planar_program
from tests.solution.standing_structures import deck, plane, prism

ALONG = "load_cases.push.live=[{acceleration: [0, 1, 0]}]"

STEEP = 6e-3
"""Share by which a wedge that climbs at 50 degrees may lie below its closed form: it carries eight times its weight,
and slides long until its planes have taken that up."""


def wedge(friction: float) -> str:
    """A wedge in a groove of two planes at 30 degrees, pushed along it: with normality it locks from 1.732 on."""
    c, s = math.cos(math.radians(30)), 0.5
    outline = [(0, 0), (1, s / c), (-1, s / c)]
    return deck(prism(outline, 4.0), plane(0, 0, -s, c) + plane(0, 0, s, c), f"friction: {friction}")


def result_of(text: str, *overrides: str) -> PartResult:
    line = line_of(text, *overrides)
    return solve_part(line.program, PartContext(solver_settings(line.deck.analysis), lambda record: None))


def test_livesleys_correction_needs_associative_forces() -> None:
    result = result_of(wedge(2.0), ALONG, "analysis.flow_rule=livesley")
    assert result.status is Status.UNBOUNDED
    assert result.flow is None


@pytest.mark.parametrize(("dilatancy", "below"), [(0, BELOW), (5, BELOW), (10, BELOW), (50, STEEP)])
def test_a_wedge_with_less_dilatancy_than_friction_may_slide_where_that_locks(dilatancy: float, below: float) -> None:
    rise = math.tan(math.radians(dilatancy))
    result = result_of(wedge(2.0), ALONG, "analysis.flow_rule=dilatancy", f"joints.dry.dilatancy={dilatancy}")
    assert result.associative.status is Status.UNBOUNDED
    assert result.status is Status.SOLVED
    assert result.state is not None
    factor = result.program.scaling.load_factor(result.state.load_factor)
    assert reaches(factor, in_the_groove(2.0, math.radians(30), rise), below)


@pytest.mark.parametrize("dilatancy", [60.5, 62])
def test_a_wedge_whose_dilatancy_locks_it_has_no_load_factor(dilatancy: float) -> None:
    """Steps of the law end at factors of a million there, which are none."""
    result = result_of(wedge(2.0), ALONG, "analysis.flow_rule=dilatancy", f"joints.dry.dilatancy={dilatancy}")
    assert result.status is Status.UNBOUNDED
    assert result.flow is None
    assert result.associative.reason == part.NO_MECHANISM_AT_DILATANCY


@pytest.mark.parametrize("weight", [0.0, 1.0])
def test_a_part_without_live_load_has_only_to_stand(weight: float) -> None:
    line = line_of(BLOCK)
    program = line.program
    unloaded = replace(program, live_load=np.zeros_like(program.live_load), dead_load=weight * program.dead_load)
    result = solve_part(unloaded, PartContext(solver_settings(line.deck.analysis), lambda record: None))
    assert not result.loaded
    assert result.status is Status.UNBOUNDED
    assert result.reason == ("no live load acts on it" if weight else "")
    assert bool(result.programs) is bool(weight)


def test_another_scheme_than_the_published_one_is_said_to_have_been_used() -> None:
    line = line_of(BLOCK, "analysis.flow_rule=non_associative", "analysis.scheme=published")
    locked = AssociativeResult(Status.UNBOUNDED, None, None, "", ())
    settings = replace(solver_settings(line.deck.analysis), tolerance=1e-8)
    result = solve_nonassociative(line.program, locked, settings, lambda record: None)
    assert NOT_PUBLISHED in result.remarks
    assert result.state is not None
    assert line.program.scaling.load_factor(result.state.load_factor) == pytest.approx(0.5, rel=1e-5)


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
def test_a_search_in_space_finds_the_wall_that_falls_by_itself() -> None:
    least = solution_of(line_of(CORNER, "analysis.search=2")).least
    assert least is not None
    assert least.load_factor <= 0.25 * (1.0 + 1e-4)


def in_the_plane(*overrides: str) -> PartResult:
    line = line_of(WALL, "parameters.n=4", "analysis.flow_rule=non_associative", *overrides)
    return solve_part(planar_program(line), PartContext(solver_settings(line.deck.analysis), lambda record: None))


def test_what_a_search_finds_stands_beside_the_load_factor_of_the_path() -> None:
    searched, alone = in_the_plane(), in_the_plane("analysis.search=0")
    assert searched.least is not None
    assert alone.least is None
    assert searched.state is not None
    assert alone.state is not None
    assert searched.state.load_factor == alone.state.load_factor
    kinds = [record.kind for record in alone.programs]
    assert [record.kind for record in searched.programs[: len(kinds)]] == kinds
    assert {record.kind for record in searched.programs[len(kinds) :]} == {"motion", "forces"}


def test_a_search_that_breaks_down_takes_nothing_away(monkeypatch: pytest.MonkeyPatch) -> None:
    def breaks_down(*arguments: object) -> None:
        raise np.linalg.LinAlgError("Singular matrix")

    monkeypatch.setattr(part, "least_found", breaks_down)
    result = in_the_plane()
    assert (result.status, result.least) == (Status.SOLVED, None)
    assert SEARCH_BROKE_DOWN.format("singular matrix") in result.remarks
