"""Load factors without dilatancy of blocks that weigh next to nothing beside their neighbours."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.nonassociative.imbalance import misfit
from mbla.solution.nonassociative.law_state import SequenceResult
from mbla.solution.nonassociative.refine_equilibrium import sharpened
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Standing, Status
from mbla.solution.verification.verify import verify
from mbla.solution.verification.verify_points import verified_status
from tests.extremes.structures_margin import OVERHANG
from tests.extremes.weights import SIDE_BY_SIDE, TOWER
from tests.line import BLOCK, line_of, line_of_file, load_factor, verified

LARGE_CUBE = Path(__file__).parents[3] / "decks" / "regressions" / "block_on_a_large_cube.yaml"
HEAVY_IN_THE_MIDDLE = ("parameters.heavy=1", "parameters.light=1.0e4")
LIGHT_ON_HEAVY = ("parameters.a=1.0e4", "parameters.b=1", "parameters.c=1")
FAR_APART = [
    (SIDE_BY_SIDE, ("parameters.heavy=1", "parameters.light=1.0e8")),
    (TOWER, ("parameters.a=1.0e8", "parameters.b=1", "parameters.c=1")),
]


@pytest.mark.parametrize(
    ("deck", "weights", "expected"), [(SIDE_BY_SIDE, HEAVY_IN_THE_MIDDLE, 0.4), (TOWER, LIGHT_ON_HEAVY, 0.6)]
)
def test_blocks_of_1e4_times_the_weight_beside_do_not_blur_the_load_factor(
    deck: str, weights: tuple[str, ...], expected: float
) -> None:
    solution, checks, status = verified(line_of(deck, *weights))
    assert status is Status.SOLVED
    assert solution.mechanics is not None
    assert solution.mechanics.load_factor == pytest.approx(expected, rel=1e-6)
    assert checks.equilibrium_residual <= 1e-8


@pytest.mark.parametrize(("deck", "weights"), FAR_APART)
def test_blocks_of_1e8_times_the_weight_beside_leave_it_in_doubt(deck: str, weights: tuple[str, ...]) -> None:
    solution, _, status = verified(line_of(deck, *weights))
    assert status is not Status.SOLVED
    assert solution.standing is None or solution.standing.verdict in (Standing.YES, Standing.DOUBTFUL)


@pytest.mark.every(4)
@pytest.mark.parametrize("rule", ["associative", "non_associative"])
@pytest.mark.parametrize("supports", ["[{ground: {z: '=-a'}}]", "[{blocks: cube}]"], ids=["free", "fixed"])
@pytest.mark.parametrize(("size", "friction", "expected"), [(1e3, 0.8, 0.5), (1e4, 0.3, 0.3), (1e5, 0.8, 0.5)])
def test_a_block_on_a_cube_many_times_its_size(
    size: float, friction: float, expected: float, supports: str, rule: str
) -> None:
    overrides = (f"parameters.a={size!r}", f"parameters.mu={friction}", f"supports={supports}")
    for case in (0, 1):
        line = line_of_file(LARGE_CUBE, *overrides, f"analysis.flow_rule={rule}", case=case)
        solution, checks, status = verified(line)
        assert status is Status.SOLVED, checks.failures
        assert solution.mechanics is not None
        assert solution.mechanics.load_factor == pytest.approx(expected, rel=1e-6)


def test_a_light_block_under_a_guide_carries_what_presses_on_it() -> None:
    """A block on a rail with 1e-12 of the weight of the one that is pressed against it."""
    text = """mbla: 1
materials: {heavy: {density: 2000}, light: {density: 2.e-9}}
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: heavy, material: heavy, min: [0, 0, 0], max: [1, 1, 0.5]}
  - box: {group: rail, material: light, min: [1, 0, 0], max: [2, 1, 0.5]}
contacts: {joint: dry}
supports: [{ground: {z: 0}, blocks: heavy}, {blocks: rail, slide: [0, 1, 0]}]
load_cases: {push: {dead: [{force: [1000, 0, 0], on: heavy}], live: [{force: [0, 1000, 0], on: rail}]}}
analysis: {flow_rule: associative}
"""
    heavy_too = load_factor(text, "materials.light.density=2000")  # the guide takes the weight of the rail
    assert load_factor(text) == pytest.approx(heavy_too, rel=1e-6)


def test_an_unbalanced_light_block_is_not_solved() -> None:
    """1.1e-4 of the load factor leaves 2e-5 of what the light block carries, 1e-9 of the mean load."""
    line = line_of(SIDE_BY_SIDE, *HEAVY_IN_THE_MIDDLE)
    solution, _, _ = verified(line)
    assert solution.mechanics is not None
    off = replace(solution.mechanics, load_factor=solution.mechanics.load_factor * (1.0 - 1.1e-4))
    spoilt = replace(solution, mechanics=off)
    checks = verify(line.assembly, line.load_case, spoilt)
    assert any("equilibrium residual" in failure for failure in checks.failures)
    assert verified_status(spoilt, checks) is Status.APPROXIMATE


def test_a_rough_state_beside_an_associative_one_that_fits() -> None:
    """A block that rocks: spoilt forces are mended, or those of associative flow taken."""
    program = line_of(BLOCK, "parameters.mu=5").program
    answer = solve_associative(program, SolverSettings(tolerance=1e-9), lambda record: None)
    assert answer.state is not None
    spoilt = replace(answer.state, forces=1.1 * answer.state.forces, residual=1e-2)
    sequence = SequenceResult(Status.APPROXIMATE, spoilt, "did not come to rest", ())
    found = sharpened(program, answer, 0.0, sequence)
    assert found.status is Status.SOLVED
    assert found.reason == ""
    assert found.state is not None
    assert misfit(program, found.state) <= 1e-6
    assert found.state.load_factor == pytest.approx(answer.state.load_factor, rel=1e-6)


@pytest.mark.long
def test_a_pile_that_overhangs_as_far_as_it_can_has_no_margin() -> None:
    """Any of its upper parts may tip: no path ends in a state of the law, and the associative state is one.

    The residual of a load factor of zero is relative to a thousandth of dead over live load.
    """
    line = line_of(OVERHANG, "parameters.n=50", f"parameters.tip={sum(1 / k for k in range(1, 50)) / 2!r}")
    solution, _, status = verified(line)
    assert status is Status.SOLVED
    assert solution.mechanics is not None
    assert abs(solution.mechanics.load_factor) < 1e-9
