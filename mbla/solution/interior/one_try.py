"""One try of the interior scheme: along the path, then down by changes of least cost, then exact steps.

The path is followed as long as it leads down. Near its end, below ``NEAR``, a turning point means that the path winds
on among neighbouring states (domes, vaults): from there the descent goes on. Whenever the residual has fallen by
another decade, steps of the exact law are tried, which end most tries early.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.interior.arc_length import follow
from mbla.solution.interior.central_path import CentralPath, PathVector, central_path, first_point, state_of
from mbla.solution.interior.condensed_matrix import MatrixMap
from mbla.solution.interior.descent import descend
from mbla.solution.interior.polish import STEPS, polished
from mbla.solution.law_state import LawState

EXACT = 1e-9
"""Residual at which a try ends."""

END_OF_PATH = 1e-8
"""Residual of a point beyond which rounding takes over: slacks are differences of velocities."""

NEAR = 5e-3
"""Residual below which a turning point ends the following of the path. Descents from 3e-2 ended ten times higher."""

REACH = 0.1
"""Residual above which a descent is not tried: from there it ends in a local minimum of no meaning."""

FIRST_POLISH = 1e-3
"""Residual from which exact steps are tried, once a decade."""

MOST_DESCENT = 300
"""Factorisations of a descent."""

STALL, GAIN = 60, 0.8
"""A descent ends where the residual has not fallen to this share within so many steps."""


@dataclass(frozen=True)
class Start:
    """One way to begin: pull κ towards the gravity state, size and seed of the noise."""

    kappa: float
    noise: float
    seed: int


@dataclass(frozen=True)
class Moment:
    """Where a try has come to, for the log: factorisations, state, σ, length of the last step."""

    factorizations: int
    state: LawState
    sigma: float
    step: float


@dataclass
class Try:
    """A try under way, with the best it has found.

    watch : called at every step
    late  : whether the time is over
    """

    program: Program
    pattern: MatrixMap
    most: int
    watch: Callable[[Moment], None]
    late: Callable[[], bool]
    factorizations: int = 0
    best: LawState | None = None
    nearest: PathVector | None = None
    started: float = field(default_factory=time.perf_counter)
    nearest_residual: float = float("inf")
    _polish_at: float = FIRST_POLISH

    def over(self) -> bool:
        """Whether the state is exact, or factorisations or time are used up."""
        exact = self.best is not None and self.best.residual <= EXACT
        return exact or self.factorizations >= self.most or self.late()

    def reached(self, point: PathVector, step: float) -> LawState:
        """Take note of a point: keep it where it is the nearest, and try exact steps from it once a decade."""
        state = state_of(self.program, point)
        self.keep(state)
        if state.residual < self.nearest_residual:
            self.nearest, self.nearest_residual = point, state.residual
        self.watch(Moment(self.factorizations, state, float(np.exp(point.log_sigma)), step))
        if state.residual < self._polish_at:
            self._polish_at = state.residual / 10.0
            self.polish(state, STEPS[:1])
        return state

    def keep(self, state: LawState) -> None:
        """Remember the state that fits the law best."""
        if self.best is None or state.residual < self.best.residual:
            self.best = state

    def polish(self, state: LawState, sizes: tuple[float, ...]) -> None:
        """Steps of the exact law from a state."""
        exact, used = polished(self.program, state, sizes)
        self.factorizations += used
        self.keep(exact)


def go(attempt: Try, begin: Start, anchor: FloatArray | None) -> None:
    """Carry out a try; what it finds is kept in ``attempt``."""
    path = central_path(attempt.program, begin.noise, begin.seed, anchor, begin.kappa)
    at_end = _along_the_path(attempt, path)
    nearest = attempt.nearest
    if nearest is None or attempt.over():
        return
    if not at_end and state_of(attempt.program, nearest).residual < REACH:
        _down(attempt, path, nearest)
    if attempt.best is not None and not attempt.over():
        attempt.polish(attempt.best, STEPS)


def _along_the_path(attempt: Try, path: CentralPath) -> bool:
    """Follow the path; true where it led to its end."""
    before, folds = attempt.factorizations, 0
    polishing = 0
    for stage in follow(path, attempt.pattern, first_point(path), attempt.most):
        attempt.factorizations = before + polishing + stage.factorizations
        counted = attempt.factorizations
        state = attempt.reached(stage.point, stage.step)
        polishing += attempt.factorizations - counted
        if state.residual <= END_OF_PATH:
            return True
        if attempt.over() or (stage.folds > folds and attempt.nearest_residual < NEAR):
            return False
        folds = stage.folds
    return False


def _down(attempt: Try, path: CentralPath, first: PathVector) -> None:
    """Descend from a point until nothing is gained any more."""
    lowest, waited = float("inf"), 0
    for point in descend(path, attempt.pattern, first, MOST_DESCENT):
        attempt.factorizations += 1
        state = attempt.reached(point, float("nan"))
        if state.residual <= END_OF_PATH or attempt.over():
            return
        lowest, waited = (state.residual, 0) if state.residual < GAIN * lowest else (lowest, waited + 1)
        if waited > STALL:
            return
