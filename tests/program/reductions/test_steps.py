"""Records of reductions: what was found, what was not allowed, and by whom; sizes of programs that have a load."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.program.reductions.steps import ProgramSize, StepState, size_of, step_of, told_apart
from tests.solution.by_hand import own_points

SMALL, LARGE = ProgramSize(6, 4, 40, 6), ProgramSize(12, 8, 80, 12)


@pytest.mark.parametrize(
    ("allowed", "found", "state"),
    [(True, 3, StepState.APPLIED), (True, 0, StepState.NONE), (False, 0, StepState.OFF)],
)
def test_what_became_of_a_reduction(allowed: bool, found: int, state: StepState) -> None:
    step = step_of("planar", allowed, found, LARGE, SMALL)
    assert (step.name, step.state, step.found, step.before, step.after) == ("planar", state, found, LARGE, SMALL)


def test_what_the_deck_has_on_and_is_off_was_barred() -> None:
    steps = [
        step_of("planar", True, 1, LARGE, SMALL),
        step_of("mirror", False, 0, SMALL, SMALL),
        step_of("points", False, 0, SMALL, SMALL),
        step_of("glued", False, 0, SMALL, SMALL),
    ]
    told = told_apart(steps, switched_on=True)
    assert [step.state for step in told] == [StepState.APPLIED, *[StepState.BARRED] * 3]
    assert [replace(step, state=StepState.OFF) for step in told] == [replace(s, state=StepState.OFF) for s in steps]
    assert told_apart(steps, switched_on=False) == tuple(steps)


def test_programs_without_live_load_do_not_count() -> None:
    loaded = own_points([0, -1.0, 0, -1.0], [1.0, 0, 0, 0])
    larger = own_points([0, -1.0] * 3, [0, 0, 0, 0, 0, 1.0])
    idle = own_points([0, -1.0] * 9, [0.0] * 18)
    assert size_of([loaded, idle, larger]) == ProgramSize(unknowns=10, cones=5, entries=10, largest=6)
    assert size_of([larger, loaded]).largest == 6
    assert size_of([idle]) == ProgramSize(0, 0, 0, 0)
    assert np.count_nonzero(idle.live_load) == 0
