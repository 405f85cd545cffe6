"""Structures far from the usual, by the condensed method: the known answer, or a status that says what is wrong."""

from __future__ import annotations

import pytest
from _pytest.mark import ParameterSet

from mbla.solution.solution import Status
from tests.decks.folder import BENCHMARKS
from tests.line import BLOCK, WALL, line_of, line_of_file, load_factor, solution_of, verified
from tests.solution.associative.test_solve_associative import TWO

OWN = ("analysis.solver=mbla", "analysis.standing=false")

every_form = pytest.mark.parametrize("reductions", ["analysis.reductions=true", "analysis.reductions=false"])


@every_form
@pytest.mark.parametrize("mu", [1e-6, 1e-3, 0.3, 10.0, 1e3, 1e6])
def test_friction_from_almost_none_to_far_too_much(mu: float, reductions: str) -> None:
    assert load_factor(BLOCK, f"parameters.mu={mu}", reductions, *OWN) == pytest.approx(min(mu, 0.5), rel=1e-6)


@every_form
def test_without_friction_the_least_push_brings_collapse(reductions: str) -> None:
    solution, checks, status = verified(line_of(BLOCK, "parameters.mu=0", reductions, *OWN))
    assert status is Status.SOLVED, (solution.reason, checks.failures)
    assert solution.mechanics is not None
    assert abs(solution.mechanics.load_factor) <= 1e-9


@every_form
@pytest.mark.parametrize("share", [1e-8, 1e8])
def test_neighbours_a_hundred_million_times_as_heavy(share: float, reductions: str) -> None:
    factor = load_factor(TWO, f"parameters.r={share!r}", "parameters.h=1", "parameters.mu=0.8", reductions, *OWN)
    together = 0.5 * (1 + 3 * share) / (0.5 + 2.5 * 3 * share)
    assert factor == pytest.approx(min(1 / 3, together), rel=1e-6)


LIMITS = {310: 0.199653 - 6.2013e-6, 350: 0.152920 - 4.07515e-5, 380: 0.122192 - 5.32489e-5}
"""Least thickness of arches of 86 voussoirs over their mean radius, by friction in thousandths; known to 1e-10."""


def some_long(shown: int) -> list[ParameterSet]:
    """The frictions of LIMITS, all but one only in long runs."""
    return [pytest.param(mu, marks=() if mu == shown else pytest.mark.long) for mu in LIMITS]


@pytest.mark.parametrize("mu", some_long(350))
@pytest.mark.parametrize("above", [1e-4, 1e-6, 1e-8])
def test_arches_just_above_their_least_thickness(mu: int, above: float) -> None:
    deck = BENCHMARKS[f"cocchetti_rizzi_mu_{mu}_stands"]
    line = line_of_file(deck, f"parameters.t={LIMITS[mu] + above!r}", "analysis.flow_rule=associative", *OWN)
    solution, checks, status = verified(line)
    assert status is Status.SOLVED, (solution.reason, checks.failures)
    share = 0.5 if above > 1e-7 else 0.4  # the limit's own last digit
    assert share * above < checks.static_bound <= checks.kinematic_bound < above / share
    apart = 1e-3 if above > 1e-7 else 2e-2  # of 1e-8: the forces of the arch are of the size of one
    assert checks.kinematic_bound == pytest.approx(checks.static_bound, rel=apart)


@pytest.mark.parametrize("mu", some_long(310))
@pytest.mark.parametrize("below", [1e-4, 1e-6, 1e-8])
def test_arches_just_below_their_least_thickness(mu: int, below: float) -> None:
    deck = BENCHMARKS[f"cocchetti_rizzi_mu_{mu}_stands"]
    line = line_of_file(deck, f"parameters.t={LIMITS[mu] - below!r}", "analysis.flow_rule=associative", *OWN)
    solution, checks, status = verified(line)
    assert status is Status.NO_EQUILIBRIUM, (status, solution.reason)
    assert checks.verified, checks.failures


@pytest.mark.parametrize("reach", [1 - 1e-3, 1 - 1e-5])
def test_a_stack_close_to_its_greatest_overhang(reach: float) -> None:
    text = BENCHMARKS["overhang"].read_text(encoding="utf-8")
    override = (f"parameters.s={reach!r}", "analysis.flow_rule=associative", *OWN)
    assert load_factor(text, *override) == pytest.approx((1 - reach) / reach, rel=1e-4)


def test_a_stack_that_is_too_close_for_a_proof_has_no_false_one() -> None:
    """At 1e-7 of the greatest overhang the forces found cannot be mended; what is claimed is on the right side.

    With ``solver: auto`` the load factor is found and proved (``test_solve_associative.py``).
    """
    reach = 1 - 1e-7
    text = BENCHMARKS["overhang"].read_text(encoding="utf-8")
    solution, checks, status = verified(
        line_of(text, f"parameters.s={reach!r}", "analysis.flow_rule=associative", *OWN)
    )
    truth = (1 - reach) / reach
    if status is not Status.SOLVED:
        assert status is Status.NOT_VERIFIED
        assert "could not be brought together" in solution.reason
    assert not checks.static_bound > truth * (1 + 1e-4)
    assert checks.kinematic_bound > truth * (1 - 1e-4)


@pytest.mark.parametrize("force", [1e-9, 1e9])
def test_live_loads_tiny_and_huge_against_the_dead_load(force: float) -> None:
    text = BLOCK.replace("acceleration: [1, 0, 0]", f"force: [{force!r}, 0, 0], on: block, at: [0.5, 0.5, 1]")
    assert load_factor(text, *OWN) == pytest.approx(0.5 * 2 * 2000 * 9.81 / force, rel=1e-8)


@pytest.mark.parametrize("gravity", [1e-12, 1e12])
def test_dead_loads_tiny_and_huge_against_the_live_load(gravity: float) -> None:
    dead = f"load_cases.push.dead=[{{gravity: [0, 0, {-9.81 * gravity!r}]}}]"
    assert load_factor(BLOCK, dead, *OWN) == pytest.approx(0.5 * gravity, rel=1e-8)


def test_a_push_into_the_ground_and_gravity_upside_down() -> None:
    for override, expected in (
        ("load_cases.push.live=[{acceleration: [0, 0, -1]}]", Status.UNBOUNDED),
        ("load_cases.push.dead=[{gravity: [0, 0, 9.81]}]", Status.NO_EQUILIBRIUM),
    ):
        solution, checks, status = verified(line_of(BLOCK, override, *OWN))
        assert status is expected, (solution.reason, checks.failures)
        assert checks.verified


TOWER = "  - box: {{group: block, material: stone, min: [{x}, 0, 0], max: [{x1}, 1, 2]}}\n"


@pytest.mark.parametrize(
    ("least", "reductions"),
    [(0.5, "analysis.reductions=true"), (0.5 - 1e-7, "analysis.reductions=true"), (0.5, "analysis.reductions=false")],
)
def test_many_mechanisms_at_once(least: float, reductions: str) -> None:
    """Nine towers that cannot touch, eight alike: as many mechanisms at one load factor, or almost at one."""
    towers = "".join(TOWER.format(x=3.0 * i, x1=3.0 * i + (2.0 * least if i == 4 else 1.0)) for i in range(9))
    text = BLOCK[: BLOCK.index("  - box")] + towers + BLOCK[BLOCK.index("supports") :]
    factor = load_factor(text, "parameters.mu=0.9", reductions, *OWN)
    assert factor == pytest.approx(least, rel=1e-7)


def test_walls_apart_collapse_where_the_weaker_does() -> None:
    """Two mechanisms in one program that is not taken apart."""
    apart = WALL.replace(
        "supports:",
        "  - wall: {group: far, material: stone, unit: [0.4, 0.2, 0.175], length: 0.8, courses: 5,\n"
        "           transform: {translate: [20, 0, 0]}}\nsupports:",
    )
    alone = WALL.replace('length: "=0.4*n", courses: "=n"', "length: 0.8, courses: 5")
    overrides = ("analysis.reductions=false", *OWN)
    both, first = load_factor(apart, "parameters.n=5", *overrides), load_factor(alone, *overrides)
    assert both == pytest.approx(first, rel=1e-6)


def test_limits_of_iterations_and_time_have_their_own_status() -> None:
    few = solution_of(line_of(WALL, "analysis.max_iterations=3", *OWN))
    assert few.status is Status.ITERATION_LIMIT
    assert few.mechanics is None
    late = solution_of(line_of(WALL, "analysis.time_limit=1e-9", *OWN))
    assert late.status is Status.TIME_LIMIT
    assert "time limit" in late.reason


@pytest.mark.trust
def test_twenty_thousand_planar_blocks() -> None:
    """141 by 141 units, 60,000 unknowns, in some 70 iterations: solved, with bounds 5e-7 apart.

    The factor was recorded from another run of the method, with bounds of its own: the two pairs enclose it.
    """
    line = line_of(WALL, "parameters.n=141", *OWN)
    assert len(line.model.free) > 19_900
    _, checks, status = verified(line)
    assert status is Status.SOLVED
    assert checks.gap <= 1e-6
    assert checks.static_bound <= 0.422675503 <= checks.kinematic_bound
