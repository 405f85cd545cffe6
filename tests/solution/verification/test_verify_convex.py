"""Answers of the convex contact model that are spoiled are found out."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from mbla.cli import main
from mbla.solution.solution import Checks, Mechanics, Solution
from mbla.solution.verification.verify import verify
from tests.line import Line, line_of, solution_of
from tests.solution.convex_structures import DECKS, TWIST, convex


def twisted() -> tuple[Line, Solution, Mechanics]:
    line = line_of(TWIST, "parameters.e1=0.3")
    solution, checks = convex(line)
    assert checks.verified
    assert checks.gap < 1e-7
    assert solution.mechanics is not None
    return line, solution, solution.mechanics


def failures_with(line: Line, solution: Solution, mechanics: Mechanics) -> Checks:
    changed = replace(solution, mechanics=mechanics, associative=mechanics)
    return verify(line.model, line.contacts, line.load_case, changed)


def test_forces_beyond_the_torsional_strength_are_found() -> None:
    """The concave solution is in equilibrium and within the cones of its points, and twists too much."""
    line, solution, mechanics = twisted()
    program_solution = solution_of(line)
    corners = program_solution.associative
    assert corners is not None
    claim = replace(corners, resultants=mechanics.resultants, interface_motions=mechanics.interface_motions)
    checks = failures_with(line, solution, claim)
    assert checks.yield_violation > 0.1
    assert not checks.verified


def test_motions_that_do_not_open_enough_are_found() -> None:
    line, solution, mechanics = twisted()
    assert mechanics.interface_motions is not None
    closed = mechanics.interface_motions.copy()
    closed[:, 0, 0] = 0.0
    checks = failures_with(line, solution, replace(mechanics, interface_motions=closed))
    assert checks.complementarity_residual > 0.1
    assert not checks.verified


def test_a_mechanism_without_its_motions_proves_nothing() -> None:
    line, solution, mechanics = twisted()
    checks = failures_with(line, solution, replace(mechanics, interface_motions=None))
    assert not checks.verified
    assert checks.kinematic_bound > 1.5 * mechanics.load_factor  # that of the contact points at best


def test_wrong_resultants_are_found() -> None:
    line, solution, mechanics = twisted()
    assert mechanics.resultants is not None
    checks = failures_with(line, solution, replace(mechanics, resultants=mechanics.resultants * 1.001))
    assert any("resultants" in failure for failure in checks.failures)


def test_too_high_a_load_factor_is_found() -> None:
    line, solution, mechanics = twisted()
    checks = failures_with(line, solution, replace(mechanics, load_factor=1.01 * mechanics.load_factor))
    assert not checks.verified


@pytest.mark.parametrize("deck", ["torque_convex", "eccentric_compression_convex"])
def test_result_file_is_verified_without_solver(deck: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(DECKS / f"{deck}.yaml"), "-o", str(tmp_path / "out"), "--expected"]) == 0
    assert main(["verify", str(tmp_path / "out" / f"{deck}.h5")]) == 0
    assert "agrees" in capsys.readouterr().out
