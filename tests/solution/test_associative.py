"""Statuses and load factors of single blocks and walls, all with verified bounds."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mbla.solution.solution import Status
from tests.line import BLOCK, WALL, line_of, load_factor, solution_of, verified


@settings(deadline=None, max_examples=25)
@given(mu=st.floats(0.05, 3.0), slenderness=st.floats(0.1, 10.0))
def test_a_block_slides_or_rocks(mu: float, slenderness: float) -> None:
    factor = load_factor(BLOCK, f"parameters.mu={mu!r}", f"parameters.h={slenderness!r}")
    assert factor == pytest.approx(min(mu, 1.0 / slenderness), rel=1e-6)


@pytest.mark.parametrize("angle", [0, 17, 30, 45, 90, 200])
def test_sliding_strength_is_the_same_in_every_direction(angle: float) -> None:
    """A friction pyramid fails this."""
    direction = f"[{math.cos(math.radians(angle))!r}, {math.sin(math.radians(angle))!r}, 0]"
    live = f"load_cases.push.live=[{{acceleration: {direction}}}]"
    assert load_factor(BLOCK, "parameters.h=0.5", "parameters.mu=0.3", live) == pytest.approx(0.3, rel=1e-7)


@pytest.mark.parametrize("planar", ["true", "false"])
@pytest.mark.parametrize(("accuracy", "error"), [("draft", 1e-6), ("standard", 5e-8), ("reference", 5e-9)])
def test_a_wall_of_twenty_courses(accuracy: str, error: float, planar: str) -> None:
    """20 x 20 units on the ground: the published figure of the wall on a slab, re-solved, is 0.507204."""
    factor = load_factor(
        WALL, "parameters.n=20", f"analysis.accuracy={accuracy}", f"analysis.reductions.planar={planar}"
    )
    assert factor == pytest.approx(0.5072039525, abs=error)


def test_pushing_into_the_ground_never_brings_collapse() -> None:
    solution, checks, status = verified(line_of(BLOCK, "load_cases.push.live=[{acceleration: [0, 0, -1]}]"))
    assert status is Status.UNBOUNDED
    assert solution.mechanics is None
    assert "no mechanism" in solution.reason
    assert checks.verified


def test_a_block_beyond_the_edge_of_its_support_cannot_be_held() -> None:
    text = BLOCK.replace("supports: [{ground: {z: 0}}]", "supports: [{blocks: ledge}]").replace(
        "blocks:\n",
        "blocks:\n  - box: {group: ledge, material: stone, min: [-1, 0, -1], max: [0.4, 1, 0]}\n",
    )
    solution, checks, status = verified(line_of(text))
    assert status is Status.NO_EQUILIBRIUM
    assert checks.verified
    assert solution.certificate is not None
    assert solution.certificate[1, 2] < 0  # it goes down
    assert solution.certificate[1, 4] > 0  # turning about +y, over the edge
    held = text.replace("0.4, 1, 0]", "0.6, 1, 0]")
    assert verified(line_of(held))[2] is Status.SOLVED


def test_equilibrium_only_with_a_live_load_is_no_equilibrium() -> None:
    """A block on a slope of 30 degrees slides down with friction 0.5; a horizontal push would hold it."""
    text = BLOCK.replace("min: [0, 0, 0]", "transform: {rotate: {axis: [0, 1, 0], angle: 30}}, min: [0, 0, 0]").replace(
        "ground: {z: 0}", "ground: {point: [0, 0, 0], normal: [0.5, 0, '=sqrt(3)/2']}"
    )
    _, checks, status = verified(line_of(text, "parameters.h=0.5", "load_cases.push.live=[{acceleration: [-1, 0, 0]}]"))
    assert status is Status.NO_EQUILIBRIUM
    assert checks.verified, checks.failures
    stands = load_factor(
        text, "parameters.h=0.5", "parameters.mu=0.6", "load_cases.push.live=[{acceleration: [-1, 0, 0]}]"
    )
    assert stands == pytest.approx(math.tan(math.radians(30) + math.atan(0.6)), rel=1e-6)


def test_limits_of_iterations_and_time_have_their_own_status() -> None:
    few = solution_of(line_of(WALL, "analysis.max_iterations=3"))
    assert few.status is Status.ITERATION_LIMIT
    assert few.mechanics is None
    late = solution_of(line_of(WALL, "analysis.time_limit=1e-9"))
    assert late.status is Status.TIME_LIMIT
    assert "time limit" in late.reason


@pytest.mark.parametrize("mu", [0.3, 0.5, 0.7, 0.9])
def test_more_friction_never_lowers_the_factor(mu: float) -> None:
    assert load_factor(WALL, f"parameters.mu={mu}") <= load_factor(WALL, f"parameters.mu={mu + 0.1}") * (1 + 1e-7)
