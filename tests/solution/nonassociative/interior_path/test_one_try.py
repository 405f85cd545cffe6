"""Paths made up: where a try leaves its path, where it descends from, and what it keeps."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.program.program import Program
from mbla.solution.linear_algebra.stiffness import stiffness_of
from mbla.solution.nonassociative.interior_path import one_try
from mbla.solution.nonassociative.interior_path.arc_length import Stage
from mbla.solution.nonassociative.interior_path.central_path import PathVector, central_path, first_point, state_of
from mbla.solution.nonassociative.interior_path.condensed_matrix import matrix_map
from mbla.solution.nonassociative.interior_path.descent import descend
from mbla.solution.nonassociative.interior_path.one_try import Start, Try, go, polished
from mbla.solution.nonassociative.joint_law import LawStep, exact_step
from mbla.solution.nonassociative.law_state import LawState
from tests.line import BLOCK, WALL, line_of

BEGIN = Start(0.0, 0.1, 0)


class Made:
    """A path and a descent whose points carry their residual as σ; takes note of where descents begin."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.program = line_of(BLOCK).program
        self.first = first_point(central_path(self.program, 0.1, 0, None, 0.0))
        self.stages: Iterator[Stage] = iter(())
        self.below: list[PathVector] = []
        self.descents: list[float] = []
        monkeypatch.setattr(one_try, "follow", lambda *arguments: self.stages)
        monkeypatch.setattr(one_try, "descend", self.descend)
        monkeypatch.setattr(one_try, "state_of", self.state)
        monkeypatch.setattr(one_try, "polished", lambda program, stiffness, state, sizes: (state, 0))

    def point(self, residual: float) -> PathVector:
        return replace(self.first, log_sigma=float(np.log(residual)))

    def path(self, *residuals: float, folds: int = 0, each: int = 1) -> None:
        """Points of the path, some factorisations each; the last ones turn."""
        self.stages = iter(
            [
                Stage(self.point(value), self.first, each * (i + 1), max(0, i + 1 + folds - len(residuals)), 0.1)
                for i, value in enumerate(residuals)
            ]
        )

    def state(self, program: Program, point: PathVector) -> LawState:
        return LawState(point.forces, point.velocities, 0.0, float(np.exp(point.log_sigma)))

    def descend(self, path: object, pattern: object, first: PathVector, most: int) -> Iterator[PathVector]:
        self.descents.append(float(np.exp(first.log_sigma)))
        return iter(self.below)

    def tried(self, begin: Start = BEGIN) -> Try:
        stiffness = stiffness_of(self.program)
        attempt = Try(self.program, matrix_map(self.program), stiffness, 10_000, lambda moment: None, lambda: False)
        go(attempt, begin, None)
        return attempt


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> Made:
    return Made(monkeypatch)


def test_a_path_without_points_leaves_nothing(made: Made) -> None:
    attempt = made.tried()
    assert attempt.best is None
    assert attempt.factorizations == 0
    assert not made.descents


def test_from_a_path_that_ends_a_descent_begins_at_its_lowest_point(made: Made) -> None:
    made.path(1e-1, 4e-3, 6e-3)
    made.below = [made.point(2e-3), made.point(1e-3)]
    attempt = made.tried()
    assert made.descents == pytest.approx([4e-3])
    assert attempt.best is not None
    assert attempt.best.residual == pytest.approx(1e-3)
    assert attempt.factorizations == 3 + 2


def test_a_start_that_does_not_descend_ends_with_its_path(made: Made) -> None:
    made.path(1e-1, 4e-3, 6e-3, folds=2)
    attempt = made.tried(replace(BEGIN, descends=False))
    assert not made.descents
    assert attempt.best is not None
    assert attempt.best.residual == pytest.approx(4e-3)


def test_a_path_that_comes_no_lower_is_left(made: Made) -> None:
    """Near the law for long, in factorisations: the points after that are not looked at."""
    low = 0.5 * one_try.NEAR
    made.path(low, 2 * low, 2 * low, 2 * low, each=one_try.PATIENCE)
    attempt = made.tried()
    assert len(list(made.stages)) == 1
    assert made.descents == pytest.approx([low])
    assert attempt.factorizations == 3 * one_try.PATIENCE


def test_exact_steps_are_ended_by_their_number(monkeypatch: pytest.MonkeyPatch) -> None:
    """One step for each size, and the best of them is kept."""
    program = line_of(WALL, "parameters.n=3").program
    path = central_path(program, 0.1, 0, None, 0.0)
    point = min(descend(path, matrix_map(program), first_point(path), 100), key=lambda p: state_of(program, p).residual)
    state = state_of(program, point)
    monkeypatch.setattr(one_try, "MOST_STEPS", 1)
    monkeypatch.setattr(one_try, "POLISHED_RESIDUAL", 0.0)
    steps: list[float] = []

    def step(*arguments: Any) -> LawStep:
        steps.append(arguments[3])
        return exact_step(*arguments)

    monkeypatch.setattr(one_try, "exact_step", step)
    best, count = polished(program, stiffness_of(program), state, one_try.STEPS)
    size = float((state.forces**2).sum())
    assert [rho * size for rho in steps] == pytest.approx(one_try.STEPS)
    assert best.residual < state.residual
    assert count >= len(steps)
