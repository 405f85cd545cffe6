"""What a comparison says in words, of two results made by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.results.diff.comparison import ResultComparison, compare_results
from mbla.results.diff.words import comparison_text
from tests.results.synthetic import tower_results


def text_of(comparison: ResultComparison) -> str:
    """In one line, as lines are broken where they are full."""
    return " ".join(comparison_text(comparison, ("a.h5", "b.h5")).split())


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
