"""Statuses and load factors of single blocks and walls, all with verified bounds."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mbla.solution.flow.gravity_step import Gravity, gravity_step
from mbla.solution.flow.settings import RATIOS
from mbla.solution.solution import Standing, Status
from mbla.solution.standing import standing
from tests.decks.folder import BENCHMARKS
from tests.line import BLOCK, WALL, line_of, line_of_file, load_factor, solution_of, verified

NO_STANDING = "analysis.standing=false"

every_reduction = pytest.mark.parametrize("reductions", ["analysis.reductions=true", "analysis.reductions=false"])


@settings(max_examples=25)
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


@pytest.mark.every(4)
@pytest.mark.parametrize("planar", ["true", "false"])
@pytest.mark.parametrize(("accuracy", "error"), [("draft", 1e-6), ("standard", 5e-8), ("reference", 5e-9)])
def test_a_wall_of_twenty_courses(accuracy: str, error: float, planar: str) -> None:
    """20 x 20 units on the ground: the published figure of the wall on a slab, re-solved, is 0.507204."""
    factor = load_factor(WALL, "parameters.n=20", f"analysis.accuracy={accuracy}", f"analysis.reductions={planar}")
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


@pytest.mark.every(4)
@pytest.mark.parametrize(
    ("mu", "limit"), [(310, 0.199653 - 6.2013e-6), (350, 0.152920 - 4.07515e-5), (380, 0.122192 - 5.32489e-5)]
)
@pytest.mark.parametrize("above", [1e-4, 1e-6, 1e-9])
def test_arches_close_to_their_least_thickness(mu: int, limit: float, above: float) -> None:
    """The load factor goes to zero with the distance; a solver's tolerance is absolute, so it is solved for again.

    The limits are those of arches of 86 voussoirs, up to 6e-5 below those published for joints everywhere.
    """
    deck = BENCHMARKS[f"cocchetti_rizzi_mu_{mu}_stands"]
    line = line_of_file(deck, f"parameters.t={limit + above!r}", "analysis.flow_rule=associative", NO_STANDING)
    solution, checks, status = verified(line)
    if above < 1e-8:  # the limit is known to 1e-10: either side of it may come out, no breakdown
        assert status in (Status.SOLVED, Status.NO_EQUILIBRIUM), (status, solution.reason, checks.failures)
        return
    assert status is Status.SOLVED, (status, solution.reason, checks.failures)
    assert checks.gap <= 1e-5
    assert 0.5 * above < checks.static_bound <= checks.kinematic_bound < 2.0 * above
    assert checks.kinematic_bound == pytest.approx(checks.static_bound, rel=1e-3)


@pytest.mark.parametrize("reach", [1 - 1e-3, 1 - 1e-7])
def test_a_stack_close_to_its_greatest_overhang(reach: float) -> None:
    """The load at the tip that a harmonic stack bears is its weight times (1 − s)/s, however small."""
    text = BENCHMARKS["overhang"].read_text(encoding="utf-8")
    override = (f"parameters.s={reach!r}", "analysis.flow_rule=associative", NO_STANDING)
    assert load_factor(text, *override) == pytest.approx((1 - reach) / reach, rel=1e-4)


TWO = (
    BLOCK.replace("stone: {density: 2000}", "stone: {density: 2000}, feather: {density: '=2000*r'}")
    .replace("parameters: {", "parameters: {r: 1, ")
    .replace("supports", "  - box: {group: top, material: feather, min: [0, 0, '=h'], max: [1, 1, '=h+3']}\nsupports")
)
"""A slender block of another density on a block."""


@every_reduction
@pytest.mark.parametrize("share", [1e-10, 1e-8, 1e-4, 1e4, 1e8])
def test_neighbours_of_very_different_weight(share: float, reductions: str) -> None:
    """Light, the upper block rocks on the lower, at 1/3; heavy, both rock on the ground, with their common centroid."""
    factor = load_factor(TWO, f"parameters.r={share!r}", "parameters.h=1", "parameters.mu=0.8", reductions, NO_STANDING)
    together = 0.5 * (1 + 3 * share) / (0.5 + 2.5 * 3 * share)
    assert factor == pytest.approx(min(1 / 3, together), rel=1e-6)


@every_reduction
@pytest.mark.parametrize("mu", [1e-6, 1e-3, 1e3, 1e4, 1e6])
def test_friction_from_almost_none_to_far_too_much(mu: float, reductions: str) -> None:
    factor = load_factor(BLOCK, f"parameters.mu={mu}", reductions, NO_STANDING)
    assert factor == pytest.approx(min(mu, 0.5), rel=1e-6)


@pytest.mark.parametrize("force", [1e-9, 1e9])
def test_live_loads_tiny_and_huge_against_the_dead_load(force: float) -> None:
    text = BLOCK.replace("acceleration: [1, 0, 0]", f"force: [{force!r}, 0, 0], on: block, at: [0.5, 0.5, 1]")
    assert load_factor(text) == pytest.approx(0.5 * 2 * 2000 * 9.81 / force, rel=1e-8)


def test_without_any_dead_load_there_is_the_strength_of_the_joints() -> None:
    text = BLOCK.replace("push: {live", "push: {dead: [{gravity: none}], live")
    assert load_factor(text, NO_STANDING) == 0.0
    bonded = ("parameters.c=1000", "parameters.ft=500", NO_STANDING)
    # rocking about an edge, f_t on each of the two far corners and the near ones at their edge: f_t b/2 = λ W h/2
    assert load_factor(text, *bonded) == pytest.approx(0.5 * 500 / (2 * 2000 * 9.81), rel=1e-6)


@pytest.mark.parametrize("rule", ["associative", "non_associative"])
def test_where_standing_is_asked_its_forces_prove_that_the_dead_load_is_carried(
    rule: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is found once, by a step for each ratio of stiffness, for every question about the dead load."""
    steps = []

    def counted(*arguments: Any) -> Gravity:
        steps.append(arguments)
        return gravity_step(*arguments)

    monkeypatch.setattr(standing, "gravity_step", counted)
    solution, _, status = verified(line_of(WALL, "parameters.n=6", f"analysis.flow_rule={rule}"))
    assert status is Status.SOLVED
    assert solution.standing is not None
    assert solution.standing.verdict is Standing.YES
    assert "reverse" not in [program.kind for program in solution.programs]
    assert len(steps) == len(RATIOS)


def test_where_the_gravity_step_decides_nothing_the_reversed_live_load_does(monkeypatch: pytest.MonkeyPatch) -> None:
    def undecided(*arguments: Any) -> Gravity:
        return replace(gravity_step(*arguments), settled=False, carried=False)

    monkeypatch.setattr(standing, "gravity_step", undecided)
    solution = solution_of(line_of(WALL, "parameters.n=4"))
    assert "reverse" in [program.kind for program in solution.programs]
    assert solution.standing is not None
    assert solution.standing.verdict is Standing.DOUBTFUL


def test_with_a_time_limit_the_programs_come_before_the_standing() -> None:
    """What standing takes cannot be foreseen: it must not take the load factor's time."""
    solution = solution_of(line_of(WALL, "parameters.n=4", "analysis.time_limit=60"))
    assert [program.kind for program in solution.programs][:2] == ["associative", "reverse"]
    assert solution.standing is not None
    assert solution.standing.verdict is Standing.YES


@every_reduction
def test_the_claim_lies_between_bounds_whatever_the_accuracy(reductions: str) -> None:
    for accuracy, gap in (("draft", 5e-6), ("standard", 3e-7), ("reference", 5e-8)):
        line = line_of(WALL, "parameters.n=8", f"analysis.accuracy={accuracy}", reductions, NO_STANDING)
        solution, checks, status = verified(line)
        assert solution.mechanics is not None
        assert status is Status.SOLVED
        assert checks.gap <= 1.01 * gap
        assert checks.static_bound * (1 - 1e-9) <= solution.mechanics.load_factor <= checks.kinematic_bound
        assert checks.equilibrium_residual < 1e-9
