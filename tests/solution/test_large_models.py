"""What is done otherwise on large models, shown on small ones told to be large."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from mbla.arrays import FloatArray
from mbla.solution.proof import claim
from mbla.solution.proof.kinematic_repair import repaired_mechanisms
from mbla.solution.verification.verify_points import verify_points
from tests.line import WALL, line_of, solution_of


def test_a_mechanism_that_proves_its_factor_is_not_repaired_again_on_large_models(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    line = line_of(WALL, "parameters.n=6", "analysis.flow_rule=associative")
    solution, tried = solution_of(line), []

    def counted(*arguments: Any) -> Iterator[FloatArray]:
        for motion in repaired_mechanisms(*arguments):
            tried.append(motion)
            yield motion

    def bounds(large: int, near: float) -> tuple[int, float, float]:
        monkeypatch.setattr(claim, "LARGE", large)
        monkeypatch.setattr(claim, "LARGE_GAP", near)
        tried.clear()
        claimed = claim.with_proof(line.model, line.contacts, line.load_case, solution)
        checks = verify_points(line.model, line.contacts, line.load_case, claimed)
        return len(tried), checks.static_bound, checks.kinematic_bound

    monkeypatch.setattr(claim, "repaired_mechanisms", counted)
    every, static, kinematic = bounds(10**9, 1e-5)
    assert every > 1
    once = bounds(0, 1e-5)
    assert once[0] == 1
    assert once[1:] == pytest.approx((static, kinematic), rel=1e-5)
    assert bounds(0, 0.0)[0] == every  # none is so near
