"""One try of the interior scheme: along the path, down by changes of least cost, exact steps; and on along the path.

The path is followed as long as it leads down. Below ``NEAR``, a turning point means that it winds on among
neighbouring states (domes, vaults): from its lowest point the descent goes on. Where the descent ends in a local
minimum the path is taken up again, until it has led to a third of the residual and turns again, or for ``PATIENCE``
factorisations. Whenever the residual has fallen by another decade, steps of the exact law are tried, which end most
tries early.

From a point near the end of the path it is one ``polish`` to a state of the exact law. A point of the path keeps a
small force at every open joint and a small slip at every sticking one. Steps of the exact law (``joint_law``) anchored
at its forces close what is left: where the path has come close enough they converge within a few factorisations, to
rounding.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.linear_algebra.stiffness import Stiffness
from mbla.solution.nonassociative.interior_path.arc_length import Stage, follow
from mbla.solution.nonassociative.interior_path.central_path import (
    CentralPath,
    central_path,
    first_point,
    state_of,
    with_balance,
)
from mbla.solution.nonassociative.interior_path.descent import descend
from mbla.solution.nonassociative.joint_equations import Iterate
from mbla.solution.nonassociative.joint_law import LawProblem, exact_step
from mbla.solution.nonassociative.law_state import LawState, law_state
from mbla.solution.thresholds import EXACT_RESIDUAL

EXACT = 1e-9
"""Residual at which a try ends, unless a rougher or a sharper one is asked for."""

END_OF_PATH = 1e-8
"""Residual of a point beyond which rounding takes over: slacks are differences of velocities."""

NEAR = 5e-3
"""Residual below which a turning point ends the following of the path. Descents from 3e-2 ended ten times higher."""

REACH = 0.1
"""Residual above which a descent is not tried: from there it ends in a local minimum of no meaning."""

LOWER = 1.0 / 3.0
"""Share of the residual of the last descent's first point to which the path must lead before the next."""

PATIENCE = 300
"""Factorisations along the path without a lower point after which it is given up."""

SOLVED = EXACT_RESIDUAL
"""Residual of a state of the exact law."""

FIRST_POLISH = 1e-3
"""Residual from which exact steps are tried, once a decade."""

MOST_DESCENT = 300
"""Factorisations of a descent."""

STALL, GAIN = 60, 0.8
"""A descent ends where the residual has not fallen to this share within so many steps."""


@dataclass(frozen=True)
class Start:
    """One way to begin: pull κ towards the gravity state, size and seed of the noise.

    descends : whether a descent follows where the path turns; else the try ends there
    """

    kappa: float
    noise: float
    seed: int
    descends: bool = True


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

    watch  : called at every step
    late   : whether the time is over
    wanted : residual of a state with which the path is not taken up again, and above ``SOLVED`` not followed further
    sharp  : residual of a state with which the path is not followed further, where that is below ``EXACT``
    """

    stiffness: Stiffness
    most: int
    watch: Callable[[Moment], None]
    late: Callable[[], bool]
    wanted: float = SOLVED
    sharp: float = EXACT
    factorizations: int = 0
    best: LawState | None = None
    started: float = field(default_factory=time.perf_counter)
    _polish_at: float = FIRST_POLISH

    def over(self) -> bool:
        """Whether the state is exact, or factorisations or time are used up."""
        enough = self.wanted if self.wanted > SOLVED else min(EXACT, self.sharp)
        exact = self.best is not None and self.best.residual <= enough
        return exact or self.factorizations >= self.most or self.late()

    def solved(self) -> bool:
        """Whether a state of the exact law has been found, or one as rough as asked for."""
        return self.best is not None and self.best.residual <= self.wanted

    def reached(self, path: CentralPath, point: Iterate, step: float) -> LawState:
        """Take note of a point, and try exact steps from it once a decade; the state it stands for."""
        state = state_of(path, point)
        self.keep(state)
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
        exact, used = polished(self.stiffness, state, sizes)
        self.factorizations += used
        self.keep(exact)


@dataclass
class _Walk:
    """The path on which a try is, where it is lowest, the residual of the last descent's start, and what was spent."""

    stages: Iterator[Stage]
    lowest: Iterate | None = None
    residual: float = float("inf")
    descended: float = float("inf")
    folds: int = 0
    factorizations: int = 0


@np.errstate(over="ignore", divide="ignore", invalid="ignore")  # what is not finite is seen and given up
def go(attempt: Try, begin: Start, anchor: FloatArray | None) -> None:
    """Carry out a try; what it finds is kept in ``attempt``.

    anchor : (n_points, components)  forces, non-dimensional, compression positive; None: no pull towards any
    """
    path = central_path(attempt.stiffness, begin.noise, begin.seed, anchor, begin.kappa)
    walk = _Walk(follow(path, first_point(path), attempt.most))
    near = NEAR if begin.descends else float("inf")
    while _goes_on(attempt, path, walk, near) and begin.descends:
        _descent(attempt, path, walk)
        if attempt.over() or attempt.solved():
            break
        near = LOWER * walk.residual
    else:  # the path has come to an end, whichever
        if begin.descends and not attempt.over() and not attempt.solved():
            _descent(attempt, path, walk)
    if attempt.best is not None and not attempt.over():
        attempt.polish(attempt.best, STEPS)


def _goes_on(attempt: Try, path: CentralPath, walk: _Walk, near: float) -> bool:
    """Follow the path to a turning point where the residual has been below ``near``; false where it ends before."""
    since = walk.factorizations
    for stage in walk.stages:
        attempt.factorizations += stage.factorizations - walk.factorizations
        walk.factorizations = stage.factorizations
        state = attempt.reached(path, stage.point, stage.step)
        turned, walk.folds = stage.folds > walk.folds, stage.folds
        if state.residual < walk.residual:
            walk.lowest, walk.residual, since = stage.point, state.residual, stage.factorizations
        if state.residual <= END_OF_PATH or attempt.over():
            return False
        if turned and walk.residual < near:
            return True
        if walk.residual < NEAR and stage.factorizations - since > PATIENCE:
            return False
    return False


def _descent(attempt: Try, path: CentralPath, walk: _Walk) -> None:
    """Descend from the lowest point of the path until nothing is gained any more."""
    if walk.lowest is None or walk.residual > REACH or walk.residual >= walk.descended:
        return
    walk.descended = walk.residual
    lowest, waited = float("inf"), 0
    for point in descend(path, walk.lowest, MOST_DESCENT):
        attempt.factorizations += 1
        state = attempt.reached(path, point, float("nan"))
        if state.residual <= END_OF_PATH or attempt.over():
            return
        lowest, waited = (state.residual, 0) if state.residual < GAIN * lowest else (lowest, waited + 1)
        if waited > STALL:
            return


STEPS = (1e-2, 1e-1, 1.0)
"""ρ ‖x̄‖² of the exact steps, tried in turn: the smaller, the further a step may move."""

MOST_STEPS = 6
MOST_FACTORIZATIONS = 30
POLISHED_RESIDUAL = 1e-12
"""Residual at which nothing is left to gain."""

IMPROVES = 1e-1
"""A step that does not reduce the residual to this share of the one before is the last with its ρ."""


def polished(stiffness: Stiffness, state: LawState, sizes: tuple[float, ...]) -> tuple[LawState, int]:
    """The best state that exact steps reach from a state, itself where none is better; and the factorisations.

    sizes : ρ ‖x̄‖² to try in turn
    """
    program, best, count = stiffness.program, state, 0
    slope = np.zeros(program.n_points)
    for size in sizes:
        current, reached = state, float("inf")
        for _ in range(MOST_STEPS):
            anchor = current.forces
            rho = size / max(float((anchor**2).sum()), 1e-300)
            law = LawProblem(stiffness, slope, anchor, rho)
            step = exact_step(law, current.velocities, current.load_factor, MOST_FACTORIZATIONS)
            count += step.factorizations
            current = with_balance(program, law_state(program, 0.0, step.forces, step.velocities, step.load_factor))
            if current.residual < best.residual:
                best = current
            if best.residual <= POLISHED_RESIDUAL or current.residual > IMPROVES * reached:
                break
            reached = current.residual
        if best.residual <= POLISHED_RESIDUAL:
            break
    return best, count
