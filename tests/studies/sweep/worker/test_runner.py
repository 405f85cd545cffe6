"""One point, from the task to its outcome."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.studies.sweep.outcome import DONE
from mbla.studies.sweep.plan import Task
from mbla.studies.sweep.worker.runner import PointRunner
from tests.line import BLOCK
from tests.studies.sweep.small_plan import plan_over


def test_a_point_is_solved_where_expectations_of_the_deck_are_not_defined(tmp_path: Path) -> None:
    """The logarithm holds for the deck's own friction 0.5; the load factor of a block that slides is its friction."""
    expected = (
        'expected: {push: {load_factor: "=0.5 + log(2*mu)/log(mu - 0.2)", source: "closed form", tolerance: 1.}}\n'
    )
    outcome = PointRunner(plan_over(tmp_path, BLOCK + expected)).run(Task("key", 1, {"parameters.mu": 0.1}))
    assert (outcome.state, outcome.exit_code, outcome.reason) == (DONE, 0, "")
    assert outcome.results["load_factor"] == pytest.approx(0.1, rel=1e-6)
