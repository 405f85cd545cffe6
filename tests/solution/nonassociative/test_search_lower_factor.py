"""The search for lower load factors: never up, always states of the law, the same for the same seed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.deck.sections.analysis import LowestScheme
from mbla.program.program import Program
from mbla.solution.nonassociative import search_lower_factor as lowest
from mbla.solution.nonassociative.factor_range import factor_range, unbalanced
from mbla.solution.nonassociative.law_state import LawState, SequenceResult, law_state
from mbla.solution.nonassociative.point_motion import Nearness, sparse_mechanism
from mbla.solution.nonassociative.search_lower_factor import search_lower_factor
from mbla.solution.solution import Status
from tests.line import BLOCK, WALL, line_of
from tests.solution.failing_solver import said
from tests.solution.nonassociative.test_factor_range import SETTINGS, opening, solved
from tests.solution.planar import planar_program

FERRIS_5 = opening(1.2, 19, "{from: [0.4, 0.525], to: [0.8, 1.4]}", "{from: [0.4, 1.925], to: [0.8, 2.8]}").replace(
    "courses: 19", "courses: 19, start: half"
)


@pytest.fixture(scope="module")
def wall() -> tuple[Program, LawState]:
    """A wall, five units long and ten courses high, in its plane."""
    program = planar_program(line_of(WALL, "parameters.n=5", "blocks.0.wall.courses=10"))
    return program, solved(program)


def searched(
    program: Program, state: LawState, monkeypatch: pytest.MonkeyPatch, tries: int = 30, seed: int = 1
) -> SequenceResult:
    """The search, ended by tries and not by the clock."""
    monkeypatch.setattr(lowest, "STALE", tries)
    start = SequenceResult(Status.SOLVED, state, "", ())
    result = search_lower_factor(program, start, LowestScheme(seconds=600.0, seed=seed), SETTINGS, lambda record: None)
    assert result.state is not None
    assert result.state.load_factor <= state.load_factor
    assert unbalanced(program, result.state) < 1e-8
    again = law_state(program, 0.0, result.state.forces, result.state.velocities, result.state.load_factor)
    assert again.residual < 1e-7
    return result


def test_it_goes_below_the_range_of_the_mechanism_found(
    wall: tuple[Program, LawState], monkeypatch: pytest.MonkeyPatch
) -> None:
    program, state = wall
    lower = factor_range(program, state, SETTINGS, lambda record: None, 1).lower
    assert lower is not None
    result = searched(program, state, monkeypatch)
    assert result.state is not None
    assert lower.load_factor * program.scaling.live == pytest.approx(0.572503, abs=2e-6)
    assert result.state.load_factor * program.scaling.live == pytest.approx(0.569174, abs=2e-6)
    assert {record.kind for record in result.programs} == {"range, lower", "range, upper", "lowest"}
    assert [record.program for record in result.programs] == list(range(1, len(result.programs) + 1))
    assert result.remarks[-1].identifier == "lowest-search"
    assert "found nothing lower" in result.remarks[-1]


def test_the_same_seed_gives_the_same_result(wall: tuple[Program, LawState], monkeypatch: pytest.MonkeyPatch) -> None:
    first, second = (searched(*wall, monkeypatch, tries=4, seed=3).state for _ in range(2))
    assert first is not None
    assert second is not None
    assert first.load_factor == second.load_factor
    assert np.array_equal(first.forces, second.forces)


@pytest.mark.long
def test_a_published_wall_has_lower_factors_than_a_published_search_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """Wall 5 of Ferris and Tin-Loi 2001: MPEC 0.215, an earlier search of complementary solutions 0.20863."""
    program = planar_program(line_of(FERRIS_5))
    result = searched(program, solved(program), monkeypatch, tries=80)
    assert result.state is not None
    assert result.state.load_factor * program.scaling.live == pytest.approx(0.207973, abs=2e-6)


def test_a_block_that_slides_has_no_lower_factor(monkeypatch: pytest.MonkeyPatch) -> None:
    program = line_of(BLOCK, "parameters.h=0.5").program
    result = searched(program, solved(program), monkeypatch)
    assert result.state is not None
    assert result.state.load_factor * program.scaling.live == pytest.approx(0.5, rel=1e-6)


def test_without_an_exact_state_it_does_not_begin(wall: tuple[Program, LawState]) -> None:
    program, state = wall
    rough = SequenceResult(Status.APPROXIMATE, replace(state, residual=1e-3), "did not converge", ())
    result = search_lower_factor(program, rough, LowestScheme(seconds=600.0), SETTINGS, lambda record: None)
    assert result.state is rough.state
    assert result.remarks[0].identifier == "lowest-search-not-begun"


def test_without_time_it_ends_at_the_lower_end(wall: tuple[Program, LawState]) -> None:
    program, state = wall
    start = SequenceResult(Status.SOLVED, state, "", ())
    scheme = LowestScheme.model_construct(seconds=0.0, seed=1)
    result = search_lower_factor(program, start, scheme, SETTINGS, lambda record: None)
    lower = factor_range(program, state, SETTINGS, lambda record: None, 1).lower
    assert result.state is not None
    assert lower is not None
    assert result.state.load_factor == lower.load_factor
    assert "0 mechanisms tried" in result.remarks[0]


def test_weights_choose_between_sliding_and_rocking() -> None:
    """A block of b/h = mu does either under the same forces, all at its toe: vertices, not mixtures of the two."""
    line = line_of(BLOCK, "parameters.mu=0.5", "parameters.b=1", "parameters.h=2")
    program = line.program
    toe = line.contacts.points[:, 0] > 0.5
    forces = np.where(toe[:, None], solved_at_the_toe(program, toe), 0.0)
    for heavy, rocks in ((toe, True), (~toe, False)):
        weights = np.where(heavy, 1e3, 1.0)
        velocities = sparse_mechanism(program, forces, Nearness(1e-7, 0.0), weights, 1.0, SETTINGS)
        assert velocities is not None
        assert program.live_load @ velocities == pytest.approx(1.0, rel=1e-12)
        assert law_state(program, 0.0, forces, velocities, 0.5 / program.scaling.live).residual < 1e-9
        opening_velocities = (program.equilibrium_matrix.T @ velocities).reshape(-1, 3)[:, 0]
        assert (opening_velocities[~toe].max() > 0.1) == rocks


def solved_at_the_toe(program: Program, toe: np.ndarray) -> np.ndarray:
    """Forces at the limit of friction that balance dead and live load on a single block, the same at each toe point."""
    columns = np.flatnonzero(np.repeat(toe, 3))
    loads = program.dead_load + 0.5 / program.scaling.live * program.live_load
    found = np.zeros(3 * program.n_points)
    found[columns] = np.linalg.lstsq(program.equilibrium_matrix.toarray()[:, columns], -loads, rcond=None)[0]
    return found.reshape(-1, 3)


def test_no_mechanism_fits_forces_inside_their_cones(wall: tuple[Program, LawState]) -> None:
    program, _ = wall
    inside = np.tile([1.0, 0.0], (program.n_points, 1))
    weights = np.ones(program.n_points)
    assert sparse_mechanism(program, inside, Nearness(1e-7, 0.0), weights, 1.0, SETTINGS) is None


# --- single tries, with what the lower end of a mechanism is made up ------------------------------------------------


def search_of(program: Program, state: LawState) -> lowest._Search:
    return lowest._Search(program, state, np.random.default_rng(1), [], lambda record: None)


@pytest.mark.parametrize(
    ("share", "residual", "kept", "best"),
    [
        (0.9, 1e-9, True, 0.9),
        (0.9, 1e-3, False, 1.0),
        (1.1, 1e-9, False, 1.0),
        (1.0 + 1e-6, 1e-9, True, 1.0),
        (1.0 - 1e-6, 1e-9, True, 1.0 - 1e-6),
        (1e-9, 1e-9, False, 1.0),
    ],
)
def test_a_lower_end_is_kept_where_it_is_no_higher_and_fits_the_law(
    share: float, residual: float, kept: bool, best: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What needs no live load is counted and left out; a fall worth a line gets one, a smaller one none."""
    program = line_of(BLOCK, "parameters.h=0.5").program
    state = solved(program)
    search = search_of(program, state)
    made = replace(state, load_factor=share * state.load_factor, residual=residual)
    monkeypatch.setattr(lowest, "law_state", lambda *arguments: made)
    monkeypatch.setattr(lowest, "unbalanced", lambda *arguments: 0.0)
    search.stale = 7
    assert search._descend(state.velocities, state.forces, lowest.SOLVER) is kept
    assert (search.here is made) is kept
    assert search.best.load_factor == pytest.approx(best * state.load_factor, rel=1e-12)
    assert [record.kind for record in search.records] == ["lowest"] * (share == 0.9 and kept)
    assert search.needless == (1 if share == 1e-9 else 0)
    assert search.stale == (0 if share == 0.9 and kept else 7)
    words = search.words(state, LowestScheme())
    assert ("1 of the mechanisms tried needed no live load at all" in words[-1]) is (share == 1e-9)


def test_without_an_answer_a_try_is_in_vain(monkeypatch: pytest.MonkeyPatch) -> None:
    program = line_of(BLOCK, "parameters.h=0.5").program
    state = solved(program)
    search = search_of(program, state)
    monkeypatch.setattr(lowest, "interior_point_solver", said(Status.NUMERICAL_ERROR))
    assert not search._descend(state.velocities, state.forces, lowest.SOLVER)
    assert search._extreme_forces(lowest.SOLVER) is state.forces
    assert search.best is state


def test_the_time_limit_of_the_analysis_ends_the_search() -> None:
    program = line_of(BLOCK, "parameters.h=0.5").program
    start = SequenceResult(Status.SOLVED, solved(program), "", ())
    settings = replace(SETTINGS, deadline=0.0)
    result = search_lower_factor(program, start, LowestScheme(seconds=600.0), settings, lambda record: None)
    assert "0 mechanisms tried" in result.remarks[-1]
    assert result.state is start.state
