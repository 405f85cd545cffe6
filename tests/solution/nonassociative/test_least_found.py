"""The least state of rigid joints that is found: published walls, closed forms with dilatancy, what is a state."""

from __future__ import annotations

import math
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.yield_conditions import yield_violation
from mbla.solution.nonassociative.collapse_state import CollapseState
from mbla.solution.nonassociative.least_found import least_found, looks_lower
from mbla.solution.nonassociative.search import NEEDLESS, Search
from mbla.solution.settings import SolverSettings, solver_settings
from mbla.solution.solution import ProgramRecord, Status
from tests.line import BLOCK, WALL, line_of, line_of_file, solution_of
from tests.solution.failing_solver import said
from tests.solution.nonassociative.structures import (
    FERRIS_1,
    FERRIS_3,
    LEAST,
    SETTINGS,
    associative_of,
    by_path,
    groove,
    in_the_groove,
    least_of,
    unbalanced,
    with_share,
)
from tests.solution.planar import planar_program

TWO_LEAVES = Path("decks/tutorials/two_leaf_walls.yaml")
SLIDES = "parameters.h=0.5"


def factor_of(program: Program, slope: FloatArray | float = 0.0, settings: SolverSettings = SETTINGS) -> float:
    """Load factor of the least state, which must fit the law of rigid joints."""
    state = least_of(program, slope, settings)
    assert state.residual < 1e-6
    assert unbalanced(program, state) < 1e-6
    assert yield_violation(state.forces, program.limits).max() < 1e-6
    return program.scaling.load_factor(state.load_factor)


# --- published walls, closed forms ----------------------------------------------------------------------------------


@pytest.mark.parametrize(("text", "least"), LEAST.items(), ids=["1", "3", "5"])
def test_the_least_states_known_of_published_walls(text: str, least: float) -> None:
    """The published ones are 0.640, 0.356 and 0.215, of complementarity programs started many times over.

    A state below one of these figures would be a find, and is a change of the figure; one above it is a failure.
    """
    program = planar_program(line_of(text))
    found = factor_of(program)
    assert found == pytest.approx(least, abs=1e-6)
    assert found < by_path(program)[0] * (1.0 + 1e-6)


@pytest.mark.parametrize("share", [0.0, 0.02, 0.1, 0.5, 0.9, 1.0])
def test_a_wedge_in_a_groove_lifts_by_its_dilatancy(share: float) -> None:
    mu, slope = 0.84, math.radians(30)
    rise = math.tan(share * math.atan(mu))
    program = with_share(line_of(groove(mu, slope)).program, share)
    assert factor_of(program, rise) == pytest.approx(in_the_groove(mu, slope, rise), rel=1e-8)


@pytest.mark.parametrize(
    ("share", "least"), [(0.1, 0.402487), (1.0, 0.403694104)], ids=["a little locks confined joints", "associative"]
)
def test_dilatancy_raises_the_least_of_wall_3(share: float, least: float) -> None:
    """From 0.3558 without: the search knows nothing of the associative program, and is a second way to its factor."""
    program = with_share(planar_program(line_of(FERRIS_3)), share)
    assert factor_of(program, program.limits.dilatancy) == pytest.approx(least, abs=1e-6)


def test_a_search_ends_where_nothing_holds_a_block() -> None:
    """Its load factor is zero or a rounding of it of either sign, than which there is always a lower one."""
    assert factor_of(line_of(BLOCK, "joints.dry.friction=0").program) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.long
def test_in_space_a_search_begins_far_from_the_law() -> None:
    """Smaller penalties alone end at 0.2833 of g, where more stretchers slide along the through-stones."""
    least = solution_of(line_of_file(TWO_LEAVES, "analysis.search=1", case=1)).least
    assert least is not None
    assert least.load_factor <= 0.27668


@pytest.mark.long
def test_nothing_depends_on_clock_or_chance() -> None:
    program = planar_program(line_of(FERRIS_3))
    assert np.array_equal(least_of(program).forces, least_of(program).forces)


def test_it_is_found_where_the_path_is_all_there_is_to_start_from() -> None:
    """Associative flow locks this wedge; without dilatancy it slides at mu / cos b."""
    program = line_of(groove(2.0, math.radians(30))).program
    assert associative_of(program).state is None
    assert factor_of(program) == pytest.approx(2.0 / math.cos(math.radians(30)), rel=1e-8)


# --- where one is looked for, and for how long ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("overrides", "looks"),
    [
        ((), True),
        (("analysis.flow_rule=dilatancy",), True),
        (("analysis.search=0",), False),
        (("analysis.scheme=published",), False),
        (("analysis.flow_rule=associative",), False),
        (("analysis.flow_rule=livesley",), False),
    ],
)
def test_it_is_looked_for_in_the_plane_beside_the_path(overrides: tuple[str, ...], looks: bool) -> None:
    line = line_of(WALL, "analysis.flow_rule=non_associative", *overrides)
    program, settings = planar_program(line), solver_settings(line.deck.analysis)
    assert looks_lower(program, settings) is looks
    assert not looks_lower(replace(program, facts=replace(program.facts, settling_support=True)), settings)


@pytest.mark.parametrize(("overrides", "looks"), [((), False), (("analysis.search=0.5",), True)])
def test_in_space_it_is_looked_for_where_the_deck_says_how_far(overrides: tuple[str, ...], looks: bool) -> None:
    line = line_of(WALL, "analysis.flow_rule=non_associative", *overrides)
    assert looks_lower(line.program, solver_settings(line.deck.analysis)) is looks


def test_beyond_the_time_limit_it_does_not_go_on() -> None:
    program, records = planar_program(line_of(FERRIS_1)), list[ProgramRecord]()
    associative = associative_of(program)
    assert associative.state is not None
    late = replace(SETTINGS, deadline=time.monotonic())
    slope = np.zeros(program.n_points)
    found = least_found(program, slope, associative.state, associative, late, lambda record: None, records)
    assert found is None
    assert {record.status for record in records} == {Status.TIME_LIMIT}


# --- states that count ----------------------------------------------------------------------------------------------


def search_with(states: list[tuple[float, float]]) -> Search:
    """A search that has come to states of a sliding block of the given load factors and residuals."""
    program = line_of(BLOCK, SLIDES).program
    search = Search(program, np.zeros(program.n_points), SETTINGS, lambda record: None, [])
    found = associative_of(program).state
    assert found is not None
    search.found += [replace(found, load_factor=factor, residual=missed) for factor, missed in states]
    return search


@pytest.mark.parametrize(
    ("states", "answer"),
    [
        ([(0.5, 1e-9), (0.4, 1e-8), (0.3, 1e-3)], 0.4),
        ([(0.5, 1e-5), (0.4, 9e-5), (0.3, 2e-4)], 0.4),
        ([(0.5, 2e-3), (0.4, 9e-3)], 0.5),
    ],
    ids=["exact", "nearly", "none"],
)
def test_the_answer_is_the_lowest_of_the_states_that_fit_the_law(
    states: list[tuple[float, float]], answer: float
) -> None:
    """To 1e-6, or nearly as well as the best; of states that miss it the one that does so least."""
    found = search_with(states).answer
    assert found is not None
    assert found.load_factor == answer


def test_a_mechanism_that_needs_no_live_load_is_no_collapse() -> None:
    search = search_with([(0.5, 1e-9)])
    search.keep(replace(search.found[0], load_factor=0.5 * NEEDLESS * search.program.dead_over_live))
    assert [state.load_factor for state in search.found] == [0.5]


def test_programs_without_a_solution_leave_no_state(monkeypatch: pytest.MonkeyPatch) -> None:
    program, records = line_of(BLOCK, SLIDES).program, list[ProgramRecord]()
    associative = associative_of(program)
    assert associative.state is not None
    monkeypatch.setattr("mbla.solution.nonassociative.alternation.cone_solver", said(Status.NUMERICAL_ERROR))
    slope = np.zeros(program.n_points)
    found = least_found(program, slope, associative.state, associative, SETTINGS, lambda record: None, records)
    assert found is None
    assert {record.status for record in records} == {Status.NUMERICAL_ERROR}


def test_states_that_miss_the_law_are_not_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    program = line_of(BLOCK, SLIDES).program
    associative = associative_of(program)
    assert associative.state is not None

    def rough(search: Search, state: CollapseState) -> None:
        search.found.append(replace(state, residual=1e-2))

    monkeypatch.setattr(Search, "keep", rough)
    slope = np.zeros(program.n_points)
    assert least_found(program, slope, associative.state, associative, SETTINGS, lambda record: None, []) is None
