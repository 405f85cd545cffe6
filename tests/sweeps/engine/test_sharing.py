"""What is handed on to the next point changes no bit of any answer, whatever was solved before."""

from __future__ import annotations

import random

import pytest

from mbla.solution.flow.gravity_step import Gravity, gravity_step
from mbla.solution.flow.settings import RATIOS
from mbla.solution.law.elastic_joints import ElasticJoints
from mbla.solution.standing import standing
from mbla.solution.standing.standing import MOST_STATES, StressFreeStates
from mbla.sweeps.engine.child import PointRunner
from mbla.sweeps.plan import Plain, Plan, Task
from tests.sweeps.engine.sharing_decks import ARCH, DECKS, SMALL_ARCH, VARIED, Settings, solved

DIRECTIONS: tuple[list[Plain], ...] = ([1, 0, 0], [0.6, 0.8, 0])
POINTS = [(deck, settings) for deck, variants in VARIED.items() for settings in variants]


def in_random_order(points: list[tuple[str, Settings]], seed: int) -> list[tuple[str, Settings]]:
    order = [*points, *points]
    random.Random(seed).shuffle(order)
    return order


def differing(points: list[tuple[str, Settings]], states: StressFreeStates) -> list[str]:
    """Points whose answer with the states known is another one, or another error, than from scratch."""
    alone: dict[str, str] = {}
    different = []
    for deck, settings in points:
        name = f"{deck} {settings}"
        if name not in alone:
            alone[name] = solved(deck, settings)
        if solved(deck, settings, states) != alone[name]:
            different.append(name)
    return different


@pytest.mark.parametrize(
    "seed", [pytest.param(seed, marks=pytest.mark.trust if seed else pytest.mark.long) for seed in range(3)]
)
def test_every_kind_of_deck_and_setting_is_answered_as_from_scratch(seed: int) -> None:
    states = StressFreeStates()
    assert not differing(in_random_order(POINTS, seed), states)
    assert 1 < len(states.known) <= MOST_STATES


@pytest.mark.long
def test_points_of_an_arch_are_answered_as_from_scratch() -> None:
    friction_and_direction: list[tuple[str, Settings]] = [
        (ARCH, {**SMALL_ARCH, "parameters.mu": mu, "load_cases.push_x.live.0.acceleration": direction})
        for mu in (0.6, 0.5)
        for direction in DIRECTIONS
    ]
    too_thin = (ARCH, {**SMALL_ARCH, "parameters.t": 0.02})
    points = [*friction_and_direction, too_thin, *reversed(friction_and_direction)]
    assert not differing(points, StressFreeStates())


def test_points_of_one_dead_load_have_one_state_of_the_stress_free_assembly(monkeypatch: pytest.MonkeyPatch) -> None:
    steps: list[ElasticJoints] = []

    def counted(joints: ElasticJoints) -> Gravity:
        steps.append(joints)
        return gravity_step(joints)

    monkeypatch.setattr(standing, "gravity_step", counted)
    states = StressFreeStates()
    for direction in (*DIRECTIONS, *DIRECTIONS):
        solved(ARCH, {**SMALL_ARCH, "load_cases.push_x.live.0.acceleration": direction}, states)
    assert len(steps) == len(RATIOS) * len(states.known)
    assert len(states.known) == len(DIRECTIONS), "in the plane of the arch, and out of it"


def runner_of_an_arch() -> PointRunner:
    results = ("load_factor", "mechanism.hinges", "reason")
    return PointRunner(Plan(str(DECKS / ARCH), "", (), ("push_x",), results, "none", "", None, None, ""))


def test_faults_name_the_settings_of_their_own_point() -> None:
    runner = runner_of_an_arch()
    assert runner.run(Task("1", 1, SMALL_ARCH)).state == "done"
    outcome = runner.run(Task("2", 2, {**SMALL_ARCH, "parameters.mu": -1, "supports": [{"blocks": "pier"}]}))
    assert (outcome.state, outcome.exit_code) == ("failed", 3)
    assert "--set:2:1 parameters.mu = -1" in outcome.reason or "--set:3" in outcome.reason, outcome.reason
    assert runner.run(Task("3", 3, SMALL_ARCH)).results["mechanism.hinges"] == 4
