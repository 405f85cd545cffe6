"""Verification must notice every kind of wrong answer: each test spoils one thing of a right one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.solution.solution import Mechanics, Solution, Status
from mbla.solution.verification.verify_points import verified_status, verify_points
from tests.line import BLOCK, WALL, Line, line_of, solution_of


@pytest.fixture(scope="module")
def wall() -> tuple[Line, Solution]:
    line = line_of(WALL, "parameters.n=10")  # 0.593: below the friction, so that sliding alone is not the mechanism
    return line, solution_of(line)


def judged(line: Line, solution: Solution) -> tuple[Status, str]:
    checks = verify_points(line.model, line.contacts, line.load_case, solution)
    return verified_status(solution, checks), "; ".join(checks.failures)


def with_mechanics(solution: Solution, mechanics: Mechanics) -> Solution:
    return replace(solution, mechanics=mechanics, associative=mechanics)


def mechanics_of(solution: Solution) -> Mechanics:
    assert solution.mechanics is not None
    return solution.mechanics


def test_a_right_answer_passes_with_tight_bounds(wall: tuple[Line, Solution]) -> None:
    line, solution = wall
    checks = verify_points(line.model, line.contacts, line.load_case, solution)
    assert checks.verified, checks.failures
    factor = mechanics_of(solution).load_factor
    assert checks.static_bound <= factor * (1 + 1e-7)
    assert checks.kinematic_bound >= factor * (1 - 1e-7)
    assert checks.static_bound <= checks.kinematic_bound * (1 + 1e-12)
    assert checks.gap < 1e-6
    assert checks.live_power == pytest.approx(1.0, abs=1e-9)
    assert checks.power_balance < 1e-6


def test_a_wrong_load_factor(wall: tuple[Line, Solution]) -> None:
    line, solution = wall
    wrong = replace(mechanics_of(solution), load_factor=1.01 * mechanics_of(solution).load_factor)
    status, failures = judged(line, with_mechanics(solution, wrong))
    assert status is not Status.SOLVED
    assert "equilibrium residual" in failures


def test_forces_beyond_their_friction(wall: tuple[Line, Solution]) -> None:
    line, solution = wall
    forces = mechanics_of(solution).contact_forces.copy()
    loaded = int(np.argmax(forces[:, 0]))
    forces[loaded, 1] = forces[loaded, 0]
    status, failures = judged(line, with_mechanics(solution, replace(mechanics_of(solution), contact_forces=forces)))
    assert status is Status.NOT_VERIFIED
    assert "yield violation" in failures


def test_a_mechanism_that_closes_joints(wall: tuple[Line, Solution]) -> None:
    line, solution = wall
    mechanism = mechanics_of(solution).mechanism.copy()
    mechanism[0, 2] -= 0.1 * np.abs(mechanism).max()
    status, failures = judged(line, with_mechanics(solution, replace(mechanics_of(solution), mechanism=mechanism)))
    assert status is Status.NOT_VERIFIED
    assert "penetration" in failures


def test_a_mechanism_of_another_size(wall: tuple[Line, Solution]) -> None:
    line, solution = wall
    mechanism = 2.0 * mechanics_of(solution).mechanism
    status, failures = judged(line, with_mechanics(solution, replace(mechanics_of(solution), mechanism=mechanism)))
    assert status is not Status.SOLVED
    assert "live power" in failures


def test_a_mechanism_of_another_load(wall: tuple[Line, Solution]) -> None:
    """Compatible but not the collapse mechanism: it gives a kinematic bound, and the gap shows that it is not tight."""
    line, solution = wall
    mechanism = np.zeros_like(mechanics_of(solution).mechanism)
    top = len(mechanism) - 1
    mechanism[top, :3] = [1.0, 0.0, 0.65]
    mechanism /= (line.load_case.live_load * mechanism).sum()
    status, failures = judged(line, with_mechanics(solution, replace(mechanics_of(solution), mechanism=mechanism)))
    assert status is Status.NOT_VERIFIED
    assert "lie further apart" in failures


def test_non_associative_flow_is_not_claimed_for_dilatant_velocities() -> None:
    line = line_of(BLOCK, "parameters.h=0.5")
    claimed = replace(solution_of(line), flow_rule="non_associative")
    status, failures = judged(line, claimed)
    assert status is Status.NOT_VERIFIED
    assert "complementarity" in failures


def test_a_certificate_that_proves_nothing_is_noticed() -> None:
    line = line_of(BLOCK)
    up = np.array([[0.0, 0, 1, 0, 0, 0]])
    claimed = replace(solution_of(line), status=Status.NO_EQUILIBRIUM, mechanics=None, associative=None, certificate=up)
    status, failures = judged(line, claimed)
    assert status is Status.NOT_VERIFIED
    assert "does no work" in failures
    down = replace(claimed, certificate=-up)
    status, failures = judged(line, down)
    assert status is Status.NOT_VERIFIED
    assert "closes joints" in failures


def test_an_almost_solved_program_is_not_solved(wall: tuple[Line, Solution]) -> None:
    line, solution = wall
    status, _ = judged(line, replace(solution, status=Status.APPROXIMATE, reason="ended short"))
    assert status is Status.APPROXIMATE


@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-8])
def test_bounds_hold_whatever_the_tolerance_of_the_solver(tolerance: float) -> None:
    line = line_of(WALL, "parameters.n=20", f"analysis.tolerance={tolerance}")
    checks = verify_points(line.model, line.contacts, line.load_case, solution_of(line))
    exact = 0.50720395
    assert checks.static_bound <= exact + 1e-8
    assert checks.kinematic_bound >= exact - 1e-8


@pytest.mark.parametrize("share", [1e-3, 1e-7, 1e-10])
def test_a_light_block_that_falls_is_not_lost_in_the_mean(share: float) -> None:
    """Its weight may be below the solver's tolerance; the structure is never called solved."""
    light = "  - box: {group: light, material: feather, min: [5, 0, 1], max: [6, 1, 2]}\n"
    text = BLOCK.replace("blocks:\n", f"blocks:\n{light}").replace(
        "stone: {density: 2000}", f"stone: {{density: 2000}}, feather: {{density: {2000 * share!r}}}"
    )
    line = line_of(text)
    status, _ = judged(line, solution_of(line))
    assert status in (Status.NO_EQUILIBRIUM, Status.APPROXIMATE, Status.NOT_VERIFIED)


@pytest.fixture(scope="module")
def sliding() -> tuple[Line, Solution]:
    """A block that slides without dilatancy: the law fits to rounding."""
    line = line_of(BLOCK, "parameters.h=0.5", "analysis.flow_rule=non_associative")
    return line, solution_of(line)


@pytest.mark.parametrize(
    ("closing", "expected"),
    [
        (1e-8, Status.SOLVED),
        (2e-5, Status.SOLVED),
        (2e-4, Status.APPROXIMATE),
        (2e-3, Status.APPROXIMATE),
        (5e-2, Status.NOT_VERIFIED),
    ],
)
def test_without_normality_the_largest_residual_decides(
    closing: float, expected: Status, sliding: tuple[Line, Solution]
) -> None:
    """A block that sinks by a share of its sliding speed: friction 0.5 makes twice that of the power unexplained."""
    line, solution = sliding
    found = mechanics_of(solution)
    mechanism = found.mechanism.copy()
    mechanism[0, 2] -= closing * mechanism[0, 0]
    checks = verify_points(
        line.model, line.contacts, line.load_case, replace(solution, mechanics=replace(found, mechanism=mechanism))
    )
    assert checks.penetration == pytest.approx(closing, rel=1e-2)
    assert checks.complementarity_residual == pytest.approx(2 * closing, rel=1e-2)
    assert checks.slip_residual < 1e-8
    claimed = replace(solution, mechanics=replace(found, mechanism=mechanism))
    assert verified_status(claimed, checks) is expected
    assert checks.verified == (expected is Status.SOLVED)


def test_a_claim_outside_its_bounds(wall: tuple[Line, Solution]) -> None:
    """Too small to unbalance the forces by 1e-5, too large to lie between bounds 1e-8 apart."""
    line, solution = wall
    wrong = replace(mechanics_of(solution), load_factor=mechanics_of(solution).load_factor * (1 + 2e-5))
    checks = verify_points(line.model, line.contacts, line.load_case, with_mechanics(solution, wrong))
    assert not checks.verified
    status = verified_status(with_mechanics(solution, wrong), checks)
    assert status is not Status.SOLVED


def test_a_factor_above_the_associative_one_is_no_result(sliding: tuple[Line, Solution]) -> None:
    line, solution = sliding
    found = mechanics_of(solution)
    checks = verify_points(line.model, line.contacts, line.load_case, solution)
    higher = replace(solution, mechanics=replace(found, load_factor=1.02 * checks.kinematic_bound))
    status, failures = judged(line, higher)
    assert status is Status.NOT_VERIFIED
    assert "exceeds the kinematic bound" in failures


def test_tension_and_slip_are_told_apart(sliding: tuple[Line, Solution]) -> None:
    line, solution = sliding
    found = mechanics_of(solution)
    forces = found.contact_forces.copy()
    forces[0, 0] = -0.05 * forces[:, 0].sum()
    checks = verify_points(
        line.model, line.contacts, line.load_case, replace(solution, mechanics=replace(found, contact_forces=forces))
    )
    assert checks.tension_violation > 0.04
    turned = found.mechanism[:, [1, 0, 2, 3, 4, 5]]
    checks = verify_points(
        line.model, line.contacts, line.load_case, replace(solution, mechanics=replace(found, mechanism=turned))
    )
    assert checks.slip_residual == pytest.approx(1.0, rel=1e-6)
    assert checks.tension_violation == 0.0


def test_a_certificate_that_is_nearly_compatible_is_mended() -> None:
    """Joints closed by 1e-6 of the speed prove nothing as they are; the motion beside them does."""
    text = BLOCK.replace("supports: [{ground: {z: 0}}]", "supports: [{blocks: ledge}]").replace(
        "blocks:\n", "blocks:\n  - box: {group: ledge, material: stone, min: [-1, 0, -1], max: [0.4, 1, 0]}\n"
    )
    line = line_of(text)
    solution = solution_of(line)
    assert solution.certificate is not None
    motion = solution.certificate.copy()
    motion[np.abs(motion).max(axis=1) > 0] += 1e-6 * np.random.default_rng(7).normal(size=6)
    near = replace(solution, certificate=motion)
    assert judged(line, near)[0] is Status.NO_EQUILIBRIUM
    still = replace(solution, certificate=np.zeros_like(solution.certificate))
    assert judged(line, still)[0] is Status.NOT_VERIFIED
