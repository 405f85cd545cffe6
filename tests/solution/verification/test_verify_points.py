"""Verification must notice every kind of wrong answer: each test spoils one thing of a right one."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.cli import main
from mbla.solution.proof.claim import with_proof
from mbla.solution.solution import Mechanics, Solution, Status
from mbla.solution.verification.verify import verify
from mbla.solution.verification.verify_points import verified_status, verify_points
from tests.line import BLOCK, WALL, Line, line_of, solution_of
from tests.solution.convex_structures import DECKS, TWIST, convex


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


@pytest.mark.parametrize("tolerance", [1e-4, *(pytest.param(each, marks=pytest.mark.long) for each in (1e-6, 1e-8))])
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


def test_a_certificate_that_is_nearly_compatible_is_mended() -> None:
    """Joints closed by 1e-5 of the speed prove nothing as they are; the motion beside them does."""
    text = BLOCK.replace("supports: [{ground: {z: 0}}]", "supports: [{blocks: ledge}]").replace(
        "blocks:\n", "blocks:\n  - box: {group: ledge, material: stone, min: [-1, 0, -1], max: [0.4, 1, 0]}\n"
    )
    line = line_of(text)
    solution = solution_of(line)
    assert solution.certificate is not None
    motion = solution.certificate.copy()
    motion[np.abs(motion).max(axis=1) > 0, 2] -= 1e-5
    near = replace(solution, certificate=motion)
    assert judged(line, near)[0] is Status.NOT_VERIFIED
    mended = with_proof(line.model, line.contacts, line.load_case, near)
    assert judged(line, mended)[0] is Status.NO_EQUILIBRIUM
    still = replace(solution, certificate=np.zeros_like(solution.certificate))
    assert judged(line, still)[0] is Status.NOT_VERIFIED


# Answers of the convex contact model that are spoiled are found out.


def test_forces_beyond_the_torsional_strength_are_found() -> None:
    """The concave solution is in equilibrium and within the cones of its points, and twists too much."""
    line = line_of(TWIST, "parameters.e1=0.3")
    solution, checks = convex(line)
    assert checks.verified
    assert checks.gap < 1e-7
    mechanics, corners = solution.mechanics, solution_of(line).associative
    assert mechanics is not None
    assert corners is not None
    claim = replace(corners, resultants=mechanics.resultants, interface_motions=mechanics.interface_motions)
    checks = verify(line.assembly, line.load_case, replace(solution, mechanics=claim, associative=claim))
    assert checks.yield_violation > 0.1
    assert not checks.verified


@pytest.mark.every(2)
@pytest.mark.parametrize("deck", ["torque_convex", "eccentric_compression_convex"])
def test_result_file_is_verified_without_solver(deck: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(DECKS / f"{deck}.yaml"), "-o", str(tmp_path / "out"), "--expected"]) == 0
    assert main(["verify", str(tmp_path / "out" / f"{deck}.h5")]) == 0
    assert "agrees" in capsys.readouterr().out
