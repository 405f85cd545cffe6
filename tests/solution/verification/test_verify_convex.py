"""Answers of the convex contact model that are spoiled are found out."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from mbla.cli import main
from mbla.solution.verification.verify import verify
from tests.line import line_of, solution_of
from tests.solution.convex_structures import DECKS, TWIST, convex


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
    checks = verify(line.model, line.contacts, line.load_case, replace(solution, mechanics=claim, associative=claim))
    assert checks.yield_violation > 0.1
    assert not checks.verified


@pytest.mark.parametrize("deck", ["torque_convex", "eccentric_compression_convex"])
def test_result_file_is_verified_without_solver(deck: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(DECKS / f"{deck}.yaml"), "-o", str(tmp_path / "out"), "--expected"]) == 0
    assert main(["verify", str(tmp_path / "out" / f"{deck}.h5")]) == 0
    assert "agrees" in capsys.readouterr().out
