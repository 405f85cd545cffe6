"""The load path by standing: it ends where a closed form says, and is followed closely enough to miss no fall."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mbla.solution.standing.standing_path import FARTHEST, FINE, StandingPath

from mbla.solution.settings import SolverSettings
from mbla.solution.standing import standing_path
from mbla.solution.standing.weak_spring_continuation import DEPENDS_ON_STIFFNESS, Outcome, Weakening, weaken_springs
from tests.line import BLOCK, line_of, line_of_file

SETTINGS = SolverSettings(1e-8)


def path_of(*overrides: str) -> StandingPath:
    return StandingPath.from_dead_load(line_of(BLOCK, *overrides).program, SETTINGS)


def end_of(path: StandingPath) -> float:
    """The last load factor that is carried, as that of the model."""
    return path.program.scaling.load_factor(path.last.load_factor)


@pytest.mark.every(3)
@pytest.mark.parametrize(
    ("overrides", "factor"),
    [
        (("parameters.h=0.5",), 0.5),
        (("parameters.h=4", "parameters.mu=0.9"), 0.25),
        (("parameters.h=0.5", "parameters.c=1000"), 0.5 + 1000 / (2000 * 9.81 * 0.5)),
        (("parameters.mu=0",), 0.0),
    ],
    ids=["slides", "turns over", "cohesion", "no friction"],
)
@pytest.mark.parametrize("ahead", [None, 3.0], ids=["from small loads on", "from far beyond"])
def test_one_block_falls_where_it_slides_or_turns_over(
    overrides: tuple[str, ...], factor: float, ahead: float | None
) -> None:
    path = path_of(*overrides)
    if ahead is None:
        path.follow_on(0.05 * path.unit, np.inf)
    else:
        path.follow(ahead)
    assert end_of(path) == pytest.approx(factor, rel=3 * FINE, abs=1e-5)
    assert path.end is not None
    assert path.end is path.fall
    assert path.end.load_factor > path.last.load_factor


def test_what_is_pressed_on_the_ground_has_no_end() -> None:
    path = path_of("load_cases.push.live=[{acceleration: [0, 0, -1]}]")
    path.follow_on(0.1, np.inf)
    assert path.goes_on
    assert path.last.load_factor >= FARTHEST * path.unit
    assert path.looks < 60


def test_it_is_followed_no_further_than_asked() -> None:
    path = path_of("parameters.h=0.5")
    path.follow(0.3)
    path.follow(0.2)
    assert path.goes_on
    assert path.last.load_factor == 0.3


def test_without_weight_the_live_load_alone_decides() -> None:
    line = line_of(BLOCK, "load_cases.push.live=[{acceleration: [0.4, 0, -1]}]", "parameters.h=0.5")
    weightless = replace(line.program, dead_load=np.zeros_like(line.program.dead_load))
    path = StandingPath.from_dead_load(weightless, SETTINGS)
    path.follow_on(0.1, 10.0)
    assert path.goes_on
    steep = line_of(BLOCK, "load_cases.push.live=[{acceleration: [0.6, 0, -1]}]", "parameters.h=0.5").program
    path = StandingPath.from_dead_load(replace(steep, dead_load=np.zeros_like(steep.dead_load)), SETTINGS)
    path.follow(1.0)
    assert path.last.load_factor == pytest.approx(0.0, abs=1e-4)


def test_a_fall_on_the_way_is_seen_where_it_stands_again_beyond(monkeypatch: pytest.MonkeyPatch) -> None:
    """Between 0.2 and 0.24, on a way of which no two states have the same joints open and sliding."""

    def weaken(*arguments: object, live: float = 0.0) -> Weakening:
        found = weaken_springs(*arguments, live=live)  # type: ignore[arg-type]
        return replace(found, outcome=Outcome.FALLS) if 0.2 < live < 0.24 else found

    monkeypatch.setattr(standing_path, "weaken_springs", weaken)
    monkeypatch.setattr(StandingPath, "_alike", lambda *states: False)
    path = path_of("parameters.h=0.5")
    path.follow(0.3)
    assert path.last.load_factor == pytest.approx(0.2, rel=3 * FINE)


def test_what_depends_on_the_stiffness_is_a_fall_and_what_is_not_known_is_none() -> None:
    def end(reason: str, outcome: Outcome = Outcome.UNDECIDED) -> standing_path.PathState:
        return standing_path.PathState(1.0, Weakening(outcome, 0, 0.1, reason))

    assert end(DEPENDS_ON_STIFFNESS).falls
    assert end("", Outcome.FALLS).falls
    assert not end("no state on weak springs was found").falls
    assert not end("", Outcome.CARRIED).falls


SHARES = (0.3, 0.6, 0.9)
"""Of the associative load factor of the deck below, 1.04333, with 0.95 of which as dead load it stands."""


@pytest.mark.parametrize("turn", ["", "blocks.0.mesh.transform"], ids=["as drawn", "turned"])
def test_a_light_block_pushed_with_many_times_its_weight_stands(turn: str) -> None:
    """As it does with the same loads given as dead load; turned about the vertical with its live load alike."""
    deck = "decks/regressions/light_block_pushed.yaml"
    line = line_of_file(Path(deck))
    program = line.program
    if turn:
        live = "load_cases.c.live.0"
        x, y, z = 3941.69167416901, 3158.265336659025, -1094.6279638010606
        a, b, c = 0.09795671800399358, 0.7591685872581575, 1.5423040003046864
        over = (
            f"{turn}={{rotate: {{axis: [0, 0, 1], angle: 90}}}}",
            f"{live}.force=[{-y}, {x}, {z}]",
            f"{live}.at=[{-b}, {a}, {c}]",
        )
        program = line_of_file(Path(deck), *over).program
    path = StandingPath.from_dead_load(program, SETTINGS)
    for share in SHARES:
        load_factor = 1.04333 * share / program.scaling.live
        given = replace(program, dead_load=program.dead_load + load_factor * program.live_load)
        assert path.look(load_factor).stands
        assert weaken_springs(given, "dead_load", given.limits, SETTINGS).outcome is Outcome.CARRIED
