"""Non-associative factors where the associative one has no bound: closed forms, and structures that do lock."""

from __future__ import annotations

import math

import pytest
from mbla.solution.standing.standing_path import PathState, StandingPath

from mbla.program.program import Program
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.nonassociative.locking import (
    DOUBTFUL,
    ENDS,
    Boundedness,
    BoundednessResult,
    non_associative_bounded,
)
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from mbla.solution.standing.weak_spring_continuation import Outcome, Weakening
from tests.decks.folder import BENCHMARKS
from tests.line import line_of
from tests.solution.nonassociative.structures import sequence_of
from tests.solution.standing_structures import bar, box, deck, groove, plane, plug

SETTINGS = SolverSettings(tolerance=1e-8)
GROOVE = BENCHMARKS["groove"]


def pushed(text: str, direction: str) -> Program:
    """Program of a deck with another live load."""
    return line_of(text, f"load_cases.push.live=[{{acceleration: {direction}}}]").program


@pytest.mark.parametrize(
    ("friction", "status"), [(1.7, Status.SOLVED), (1.8, Status.UNBOUNDED), (5.0, Status.UNBOUNDED)]
)
def test_a_wedge_in_a_groove_slides_where_dilatancy_would_lock_it(friction: float, status: Status) -> None:
    """With normality the wedge locks from mu = 1/tan b = 1.732 on; without it slides at mu/cos b for every mu."""
    expected = "expected.along={load_factor: 1, source: replaced}"  # the deck's expressions are not defined here
    program = line_of(GROOVE.read_text(), f"parameters.mu={friction}", expected).program
    associative = solve_associative(program, SETTINGS, lambda record: None)
    assert associative.status is status
    assert non_associative_bounded(StandingPath.from_dead_load(program, SETTINGS)).verdict is Boundedness.BOUNDED
    sequence = sequence_of(program, SETTINGS)
    assert sequence.status is Status.SOLVED
    assert sequence.state is not None
    assert program.scaling.load_factor(sequence.state.load_factor) == pytest.approx(
        friction / math.cos(math.radians(30)), rel=1e-6
    )


BEAM = bar("friction: 0.5", below=plane(0, 1, 0, 1))

LOCKED = {
    "wedge pushed into its groove": (groove(0.5), "[0, 0, -1]"),
    "wedge pushed into a smooth groove": (groove(0), "[0, 0, -1]"),
    "bar pushed against a wall": (BEAM, "[1, 0, 0]"),
    "block pressed on the ground, askew within its friction": (deck(box(0, 1, 0, 1)), "[0.4, 0.2, -1]"),
    "block pressed down, cohesion beside the point": (
        deck(box(0, 1, 0, 1), joint="friction: 0.5, cohesion: 1.e4"),
        "[0, 0, -1]",
    ),
}

FREE = {
    "bar drawn along the walls that it touches": (BEAM, "[0, 1, 0]", 0),
    "plug drawn out of the narrow end": (plug(10, 0.5), "[0, 0, -1]", 0),
    "block pressed on ground that crushes": (
        deck(box(0, 1, 0, 1), joint="friction: 0.5, compressive_strength: 1.e6"),
        "[0, 0, -1]",
        0,
    ),
    "block pressed askew beyond its friction": (deck(box(0, 1, 0, 1)), "[0.6, 0, -1]", 0),
    "cohesion does not last": (deck(box(0, 1, 0, 1), joint="friction: 0.5, cohesion: 1.e9"), "[1, 0, 0]", 0),
}


@pytest.mark.every(2)
@pytest.mark.parametrize(("text", "direction"), LOCKED.values(), ids=LOCKED)
def test_what_locks_without_dilatancy_too(text: str, direction: str) -> None:
    result = non_associative_bounded(StandingPath.from_dead_load(pushed(text, direction), SETTINGS))
    assert result.verdict is Boundedness.UNBOUNDED
    assert result.block is None


@pytest.mark.parametrize(("text", "direction", "block"), FREE.values(), ids=FREE)
def test_what_does_not(text: str, direction: str, block: int) -> None:
    result = non_associative_bounded(StandingPath.from_dead_load(pushed(text, direction), SETTINGS))
    assert (result.verdict, result.block) == (Boundedness.BOUNDED, block)


def test_what_does_not_stand_without_the_live_load_is_in_doubt() -> None:
    """A plug that falls out of the wide end under its weight, and locks once it is pushed in hard enough."""
    result = non_associative_bounded(StandingPath.from_dead_load(pushed(plug(10, 0.5), "[0, 0, 1]"), SETTINGS))
    assert result.verdict is Boundedness.DOUBTFUL
    assert "not seen to stand under its dead load" in result.reason


def test_what_locks_under_the_live_load_alone_may_give_way_on_the_way_there() -> None:
    """A block pressed on the ground, of which it was seen before that it falls under a part of that."""
    path = StandingPath.from_dead_load(
        pushed(*LOCKED["block pressed on the ground, askew within its friction"]), SETTINGS
    )
    path.end = path.fall = PathState(2.0, Weakening(Outcome.FALLS, 0, 0.5))
    assert non_associative_bounded(path) == BoundednessResult(Boundedness.BOUNDED, 0, ENDS)
    path.end, path.fall = PathState(2.0, Weakening(Outcome.UNDECIDED, 0, 0.5, "out of time")), None
    assert non_associative_bounded(path) == BoundednessResult(
        Boundedness.DOUBTFUL, 0, DOUBTFUL.around(after=": out of time")
    )
