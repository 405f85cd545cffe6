"""Following the path: every point lies on it, folds are passed, and what is found does not depend on the step."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from mbla.solution.nonassociative.interior_path import arc_length
from mbla.solution.nonassociative.interior_path.arc_length import Stage, follow
from mbla.solution.nonassociative.interior_path.central_path import (
    CentralPath,
    central_path,
    first_point,
    off_path,
    residuals,
)
from mbla.solution.nonassociative.interior_path.condensed_matrix import matrix_map
from mbla.solution.nonassociative.interior_path.descent import inside, metric_at
from mbla.solution.nonassociative.interior_path.linearisation import linear_step
from tests.line import WALL, line_of
from tests.solution.nonassociative.interior_path.structures import dome


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


def without(monkeypatch: pytest.MonkeyPatch, *numbers: int) -> None:
    """Linear systems that are singular, by their numbers from 1."""
    count = itertools.count(1)
    monkeypatch.setattr(
        arc_length, "linear_step", lambda *arguments: None if next(count) in numbers else linear_step(*arguments)
    )


def test_a_path_whose_first_point_has_no_tangent_is_not_begun(monkeypatch: pytest.MonkeyPatch) -> None:
    path = central_path(line_of(WALL, "parameters.n=3").program, 0.1, 0, None, 0.0)
    without(monkeypatch, 1)
    assert stages_of(path, 40) == []


def test_a_step_into_a_singular_matrix_is_made_shorter(monkeypatch: pytest.MonkeyPatch) -> None:
    path = central_path(line_of(WALL, "parameters.n=3").program, 0.1, 0, None, 0.0)
    whole = stages_of(path, 10)
    without(monkeypatch, 2)
    assert stages_of(path, 10)[0].step == pytest.approx(arc_length.SHRINK * whole[0].step, rel=1e-12)


def test_a_path_on_which_no_step_is_accepted_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is as close as that without a correction."""
    path = central_path(line_of(WALL, "parameters.n=3").program, 0.1, 0, None, 0.0)
    monkeypatch.setattr(arc_length, "CLOSE", 0.0)
    monkeypatch.setattr(arc_length, "MOST_CORRECTIONS", 0)
    assert stages_of(path, 300) == []


@pytest.mark.parametrize("cause", ["singular", "no room"])
def test_a_point_that_cannot_be_brought_nearer_stays(cause: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its tangent is found anew where there is one: the direction at a point of the path is that already."""
    path = central_path(line_of(WALL, "parameters.n=3").program, 0.1, 0, None, 0.0)
    stage = stages_of(path, 10)[-1]
    follower = arc_length._Follower(path, matrix_map(path.program), sense=1.0)
    if cause == "singular":
        without(monkeypatch, 1)
    else:
        monkeypatch.setattr(arc_length, "ON_PATH", 0.0)
        monkeypatch.setattr(arc_length, "room", lambda *arguments: 0.0)
    point, direction = arc_length._refreshed(follower, stage.point, stage.direction)
    assert point is stage.point
    assert (direction is stage.direction) is (cause == "singular")
    assert follower.factorizations == 1
    ahead = abs(direction.log_sigma / stage.direction.log_sigma)
    assert ahead == pytest.approx(1.0, rel=1e-2)


def test_a_tangent_within_the_plane_of_corrections_gives_none() -> None:
    path = central_path(line_of(WALL, "parameters.n=3").program, 0.1, 0, None, 0.0)
    point = first_point(path)
    linear = linear_step(path, matrix_map(path.program), point, residuals(path, point))
    assert linear is not None
    metric = metric_at(path, point)
    across = np.zeros_like(metric.coordinates(linear.tangent))
    correction, size = arc_length._correction(linear, metric, across)
    assert correction is linear.newton
    assert size == np.inf
