"""What a comparison says in words, of two results made by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.model.model import Ground
from mbla.results.diff.comparison import Comparison, compare_results
from mbla.results.diff.matching import factors_between, match_models
from mbla.results.diff.words import comparison_text
from tests.results.synthetic import tower_results


@pytest.fixture(scope="module")
def same() -> Comparison:
    """Of a result with itself."""
    results = tower_results()
    return compare_results(results, results)


def text_of(comparison: Comparison) -> str:
    """In one line, as lines are broken where they are full."""
    return " ".join(comparison_text(comparison, ("a.h5", "b.h5")).split())


def with_case(same: Comparison, **changes: object) -> Comparison:
    return replace(same, cases=(replace(same.cases[0], **changes), *same.cases[1:]))  # type: ignore[arg-type]


def test_without_a_motion_there_is_no_angle() -> None:
    """A case without equilibrium for which no motion was found, and a mechanism of which nothing moves."""
    results = tower_results()
    solution = replace(results.cases[1].solution, certificate=None)
    without = replace(results, cases=(results.cases[0], replace(results.cases[1], solution=solution)))
    found = compare_results(results, without)
    assert "mechanisms not compared: B has no motion without equilibrium that is a result" in text_of(found)
    mechanics = results.cases[0].solution.mechanics
    assert mechanics is not None
    still = replace(mechanics, mechanism=np.zeros((3, 6)))
    case = replace(results.cases[0], solution=replace(results.cases[0].solution, mechanics=still))
    found = compare_results(results, replace(results, cases=(case, results.cases[1])))
    assert found.cases[0].mechanism.angle is None
    assert "mechanisms not compared: a motion is zero" in text_of(found)


def test_grounds_are_matched_by_their_planes() -> None:
    """In another order, each once; one that lies 2 cm higher, more than places may differ, has no match."""
    model = tower_results().model
    level, wall = model.grounds
    other = Ground(np.zeros(3), np.array([0.0, 1.0, 0.0]), "dry", None, "ground y = 0")
    turned = replace(model, grounds=(other, wall, level))
    factors = factors_between(model.units, model.units)
    assert match_models(model, turned, factors).bodies.tolist() == [0, 1, 2, 5, 4]
    raised = replace(level, point=level.point + np.array([0.0, 0.0, 0.02]))
    assert match_models(model, replace(model, grounds=(raised, wall)), factors).bodies.tolist() == [0, 1, 2, -1, 4]
