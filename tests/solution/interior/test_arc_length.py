"""Following the path: every point lies on it, folds are passed, and what is found does not depend on the step."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.solution.interior import arc_length
from mbla.solution.interior.arc_length import Stage, follow
from mbla.solution.interior.central_path import CentralPath, central_path, first_point, off_path, residuals
from mbla.solution.interior.condensed_matrix import matrix_map
from mbla.solution.interior.relative_changes import inside
from tests.line import WALL, line_of
from tests.solution.interior.structures import dome


def stages_of(path: CentralPath, most: int) -> list[Stage]:
    return list(follow(path, matrix_map(path.program), first_point(path), most))


def test_every_point_lies_on_the_path() -> None:
    program = line_of(WALL, "parameters.n=3").program
    path = central_path(program, 0.1, 0, None, 0.0)
    stages = stages_of(path, 40)
    assert len(stages) > 8
    for stage in stages:
        assert inside(path, stage.point)
        assert off_path(path, stage.point, residuals(path, stage.point)) < 1e-2
    sigma = [stage.point.log_sigma for stage in stages]
    assert all(np.diff(sigma) < 0.0)
    assert stages[-1].folds == 0


def test_a_shorter_step_follows_the_same_path(monkeypatch: pytest.MonkeyPatch) -> None:
    """Load factor over ln σ, interpolated: a step that jumped to another stretch would leave the curve."""
    program = line_of(WALL, "parameters.n=3").program
    path = central_path(program, 0.1, 0, None, 0.0)
    long = stages_of(path, 45)
    monkeypatch.setattr(arc_length, "SHARE_OF_ROOM", 0.3)
    short = stages_of(path, 200)
    assert len(short) > 2 * len(long)
    curve = np.array([(stage.point.log_sigma, stage.point.load_factor) for stage in short])[::-1]
    for stage in long[2:]:
        if stage.point.log_sigma > curve[0, 0]:
            expected = float(np.interp(stage.point.log_sigma, curve[:, 0], curve[:, 1]))
            assert stage.point.load_factor == pytest.approx(expected, abs=5e-3)


def test_folds_are_passed() -> None:
    """A dome of 24 voussoirs: σ rises between turning points, and the path goes on below the lowest of them."""
    program = line_of(dome(3, 8, 60.0)).program
    path = central_path(program, 0.1, 1, None, 0.0)
    stages = stages_of(path, 200)
    sigma = np.array([stage.point.log_sigma for stage in stages])
    rising = np.flatnonzero(np.diff(sigma) > 0.0)
    assert stages[-1].folds >= 2
    assert len(rising)
    assert sigma[-1] < sigma[rising[0]] - 1.0
