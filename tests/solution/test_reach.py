"""Strengths and capacities that are meant as no limit give the answer that they have without one, proved."""

from __future__ import annotations

import pytest

from mbla.solution.solution import Status
from tests.line import case_of

WALL = """mbla: 1
materials: {{stone: {{density: 2000}}}}
joints: {{dry: {{friction: 0.6{law}}}}}
blocks:
  - wall: {{group: wall, material: stone, unit: [0.5, 0.25, 0.25], length: 2.0, courses: 5}}
  - box: {{group: cap, material: stone, min: [0, 0, 1.25], max: [2, 0.25, 1.5]}}
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}}}]
{ties}
load_cases: {{push: {{live: [{{acceleration: [1, 0, 0]}}]}}}}
analysis: {{flow_rule: {flow}}}
"""
TIE = "ties: [{{through: [[0, 0.1, 1.375], [-2, 0.1, 1.375]], on: [cap, ground], capacity: {0}, acts: {1}}}]"


def factor_of(flow: str, law: str = "", ties: str = "") -> float:
    _, case = case_of(WALL.format(flow=flow, law=law, ties=ties))
    assert case.status is Status.SOLVED
    assert case.solution.mechanics is not None
    return case.solution.mechanics.load_factor


@pytest.mark.long
@pytest.mark.parametrize("flow", ["associative", "non_associative"])
@pytest.mark.parametrize("acts", ["tension", "both"])
def test_ties(flow: str, acts: str) -> None:
    """A wall whose top is held by a tie falls below it, whatever the tie could carry."""
    held = factor_of(flow, ties=TIE.format("1.e+6", acts))
    for capacity in ("1.e+12", "1.e+30"):
        assert factor_of(flow, ties=TIE.format(capacity, acts)) == pytest.approx(held, rel=2e-5)


@pytest.mark.parametrize("flow", ["associative", "non_associative"])
def test_cohesion_without_tension(flow: str) -> None:
    """It turns about its corner and does not slide."""
    for cohesion in ("1.e+12", "1.e+30"):
        expected = 1.0 / 0.75  # half the length over the height of the centroid
        assert factor_of(flow, f", cohesion: {cohesion}") == pytest.approx(expected, rel=1e-5)


def test_a_strength_that_is_reached_counts() -> None:
    """In a wall that holds together by its tensile strength alone the load factor grows with that."""
    found = [factor_of("associative", f", cohesion: {each}, tensile_strength: {each}") for each in ("1.e+9", "1.e+10")]
    assert found[1] == pytest.approx(10.0 * found[0], rel=1e-3)
