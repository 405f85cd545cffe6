"""States of the joint law by pairs of programs (``alternation``), and from each of them states of lower load factors.

A descent is a sequence of pairs whose penalty on the load factor falls.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.nonassociative.alternation import Alternation
from mbla.solution.nonassociative.collapse_state import CollapseState
from mbla.solution.nonassociative.imbalance import imbalance
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord
from mbla.solution.thresholds import EXACT_RESIDUAL, NEAR_ZERO, SOLVED_RESIDUAL

MOST_PAIRS, PATIENCE, PROGRESS = 12, 4, 0.7
"""Pairs of programs from one start at most; given up where so many in a row have not brought the residual to this share
of what it was."""

PENALTIES = ((0.1, 2), (0.03, 2), (0.01, 3))
"""Penalties on the load factor in turn, and pairs of programs with each."""

WIDE, COMES_BACK = ((0.5, 3), *PENALTIES), 2e-3
"""Penalties in space, the first of them larger; residual beyond which a descent begins anew without that."""

NOTABLE = 1e-4
"""Relative fall of the load factor by a round of the search after which another one is made."""

LEAST_WORK, SMALL_WORK = 300, 2e5
"""Iterations that a search may always make for its first state, and again from there, and iterations times contact
points, whichever allows more."""

FEWEST_PAIRS = 4
"""Pairs of programs for which there must be work left for a descent to begin: cut short it ends off the law."""

NEEDLESS = 1e-6
"""Load factor, over dead load over live load of the blocks that move, of a mechanism that needs no live load: in space
a block can turn about the one contact point that carries all its force. That fits the law and says nothing of a
collapse, unless the associative load factor, which is no less, is as small."""

UNBALANCED = 1e-3
"""Unbalanced force of a block, over what it carries, with which a state is none: beside blocks of 1e8 times its weight
the programs do not see a block."""

NEAR_BEST = 10.0
"""States within so many times the least residual count as fitting, where none fits the law exactly."""


def is_zero_load_mechanism(program: Program, state: CollapseState, most: float) -> bool:
    """Whether the mechanism of a state needs no live load, though the associative load factor ``most`` is greater."""
    needless = NEEDLESS * program.moved_over_live(state.velocities)
    return state.load_factor <= needless < most and not program.facts.settling_support


@dataclass
class Search:
    """States found so far, and what was spent on them: factorisations of the run, iterations of programs.

    most   : associative load factor, infinite where there is none
    """

    program: Program
    slope: FloatArray
    settings: SolverSettings
    log: Log
    records: list[ProgramRecord]
    most: float = np.inf
    found: list[CollapseState] = field(default_factory=list)
    limit: float = field(init=False)
    alternation: Alternation = field(init=False)

    def __post_init__(self) -> None:
        self.alternation = Alternation(self.program, self.slope, self.settings, self.log, self.records)
        self.limit = self.always

    @property
    def always(self) -> float:
        """Work that is always allowed."""
        return max(LEAST_WORK, SMALL_WORK / self.program.n_points)

    @property
    def wanted(self) -> float:
        """Residual that was asked for; at least that of an exact state."""
        return max(self.settings.residual, EXACT_RESIDUAL)

    @property
    def late(self) -> bool:
        """Whether the time limit has passed."""
        deadline = self.settings.deadline
        return self.alternation.late or (deadline is not None and time.monotonic() > deadline)

    @property
    def work(self) -> int:
        """Iterations of the programs so far."""
        return self.alternation.work

    @property
    def over(self) -> bool:
        """Whether the time limit has passed, or the work of a search is done."""
        return self.late or self.work >= self.limit

    @property
    def has_work_left(self) -> bool:
        """Whether another descent of a search may begin."""
        pair = 2.0 * self.alternation.work / max(self.alternation.programs, 1)
        return not self.late and self.limit - self.work >= FEWEST_PAIRS * pair

    @property
    def least_residual(self) -> float:
        """Of the states found so far."""
        return min((state.residual for state in self.found), default=np.inf)

    @property
    def answer(self) -> CollapseState | None:
        """The state of the least load factor among those that fit the law, or do so nearly as well as the best.

        The residual is a power, of second order in how far a state is from one of the law, and the load factor is of
        first: of states that differ in it by less than the root of the residual the sharpest is taken.
        """
        if not self.found:
            return None
        least = self.least_residual
        limit = max(self.wanted, min(NEAR_BEST * least, SOLVED_RESIDUAL), least)
        fitting = [state for state in self.found if state.residual <= limit]
        lowest = min(fitting, key=lambda state: state.load_factor)
        same = lowest.load_factor + np.sqrt(lowest.residual) * abs(lowest.load_factor)
        return min((state for state in fitting if state.load_factor <= same), key=lambda state: state.residual)

    def keep(self, state: CollapseState) -> None:
        """Remember a state, unless its mechanism needs no live load or a light block is not in balance."""
        if not self.program.guided and imbalance(self.program, state) > UNBALANCED:
            return
        if not is_zero_load_mechanism(self.program, state, self.most):
            self.found.append(state)

    def approach(self, normal: FloatArray, velocities: FloatArray | None = None) -> FloatArray:
        """Pairs of programs from normal forces, (n_points,), until one fits the law or they stall; the last ones.

        velocities : (n_rows,) of the motion program for these forces, if they are known
        """
        velocities = self.alternation.motion_for(normal) if velocities is None else velocities
        residuals: list[float] = []
        for state in self.alternation.states_from(velocities):
            self.keep(state)
            normal = state.forces[:, 0]
            residuals.append(state.residual)
            before = min(residuals[:-PATIENCE], default=np.inf)
            if state.residual <= self.wanted or min(residuals) > PROGRESS * before:
                break
            if len(residuals) >= MOST_PAIRS or self.over:
                break
        return normal

    def descend(self, normal: FloatArray, penalties: Sequence[tuple[float, int]] = PENALTIES) -> None:
        """Pairs with penalties in turn from normal forces, (n_points,), until a state fits the law."""
        first = velocities = self.alternation.motion_for(normal)
        for penalty, pairs in penalties:
            factor = np.inf
            for _ in range(pairs):
                found = None if velocities is None else self.alternation.pair(velocities, penalty)
                if found is None:
                    break
                state, velocities = found
                self.keep(state)
                normal = state.forces[:, 0]
                before, factor = factor, state.load_factor
                if state.residual > COMES_BACK and penalty > PENALTIES[0][0]:
                    velocities = first
                    break
                if self.over or (state.residual <= self.wanted and factor > (1.0 - NOTABLE) * before):
                    return
        self.approach(normal, velocities)

    def lower(self, normals: list[FloatArray]) -> None:
        """Descents from the lowest state as long as they lead lower, then from normal forces, within the work."""
        self.limit = self.work + max(self.settings.search * self.work, self.always)
        planar = self.program.components == 2
        if self.answer is not None and planar:  # the lower end of its mechanism first: work may not be left for more
            self.descend(self.answer.forces[:, 0], PENALTIES[-1:])
        here, falls = self.answer, True
        while here is not None and falls and self.has_work_left:
            before = here.load_factor
            self.descend(here.forces[:, 0], PENALTIES if planar else WIDE)
            here = self.answer
            size = max(abs(before), NEAR_ZERO * self.program.dead_over_live)  # next to zero it may have either sign
            falls = here is not None and here.load_factor < before - NOTABLE * size
        for normal in normals:
            if self.has_work_left:
                self.descend(normal, PENALTIES if planar else WIDE)
