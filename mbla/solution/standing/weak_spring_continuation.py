"""Whether an assembly carries a load from its stress-free state: continuation in springs that hold every block.

On springs of κ times the size of each block's load the assembly always finds an equilibrium
(``spring_state``). As κ goes to zero, the largest share s of a block's load that its spring carries

- goes to zero in proportion to κ where the joints carry the load;
- stays where they do not: the block falls, and the springs hold it.

Each state starts from the one before. Where s falls in proportion, κ is reduced to its last value in one go. Where no
joint has to open or slide, as in most walls, the state is linear in the load: one step finds it on the weakest springs.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from enum import Enum, auto
from typing import Literal

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.program.program import Program
from mbla.program.yield_conditions.limits import YieldLimits
from mbla.solution.settings import SolverSettings
from mbla.solution.standing.spring_problem import (
    LatePattern,
    SpringProblem,
    balanced,
    joints_at,
    spring_problem,
)
from mbla.solution.standing.spring_state import newton_step, newtons_method, spring_state

SHEAR_STIFFNESSES = (1.0, 0.4)
"""Shear over normal stiffness of a joint. How forces share between joints before anything slides depends on it, and so
does what is near a threshold; 1 and the 0.4 of a layer of isotropic stone, 1/(2 (1 + ν)), must agree."""

CARRIED_SHARE = 1e-6
"""Share of a block's load on its spring below which joints carry the load."""

AIMED_SHARE = 1e-7
"""Target share for κ once the share falls in proportion to it."""

WEAKEST = 1e-12
"""Least κ; columns of a thousand blocks settle by 1e5 units under their weight, all else by less."""

PLATEAU_FROM = 1e-5
"""κ from which on a share that stays counts: with stiffer springs tall structures lean on them."""

STAYS = 0.9
"""Least ratio of shares two decades apart on a plateau."""

DECADE, CLOSEST_RATIO = 0.1, 0.8
"""Ratio of one κ to the one before, and the ratio closest to 1 that is tried where no state is found; in between each
is the square root of the one before."""

LENGTHENING = 1.5
"""Power of a ratio that is the next one after a state was found."""

MOST_FAILURES = 5
"""Failed attempts at a state before giving up: each costs some 200 factorisations."""

KAPPA_ROUNDING = 1e-9
"""Relative, in comparisons of one κ with another."""

PROPORTION = 1.25
"""Largest ratio of shares over ratio of κ that counts as falling in proportion."""


DEPENDS_ON_STIFFNESS = "it depends on how stiff the joints are in shear against compression"

ALIKE = 1 - 1e-6
"""Ratio of shares that counts as equal: of blocks that fall alike the first is named, whatever the rounding."""


class Outcome(Enum):
    """How the load was carried as the springs got weaker."""

    CARRIED = auto()
    FALLS = auto()
    UNDECIDED = auto()


@dataclass(frozen=True)
class Weakening:
    """What was found.

    block  : of the model, the one with the greatest share of its load on its spring
    share  : that share
    reason : why nothing was decided
    forces : (n_points, components) in the joints on the weakest springs, non-dimensional; None where there is no load
    displacements : (n_rows,) that go with them
    """

    outcome: Outcome
    block: int | None
    share: float
    reason: str = ""
    forces: FloatArray | None = field(default=None, repr=False)
    displacements: FloatArray | None = field(default=None, repr=False)

    @property
    def depends_on_stiffness(self) -> bool:
        """Whether nothing was decided because the load is carried with one ratio of stiffness and not with another."""
        return self.reason == DEPENDS_ON_STIFFNESS


Load = Literal["dead_load", "live_load"]


def weaken_springs(
    program: Program, load: Load, limits: YieldLimits, settings: SolverSettings, *, live: float = 0.0
) -> Weakening:
    """Decide whether the stress-free assembly carries the dead load, or the live load alone, within given limits.

    Both ratios of stiffness must say the same; a load that is zero is carried.

    live : multiple of the live load that acts as well, and by which the springs are sized too: a light block that is
           pushed with many times its weight moves far on a spring of its weight, which nothing holds it back from
    """
    if not np.any(getattr(program, load)):
        return Weakening(Outcome.CARRIED, None, 0.0)
    blocks = _Blocks(*springs_of(program, load, live))
    acting = getattr(program, load) + live * program.live_load
    basis = spring_problem(program.equilibrium_matrix, acting, limits, blocks.springs, settings.deadline)
    if program.n_points and is_diagonal(blocks.springs):
        basis = replace(basis, pattern=LatePattern(program))
    found: list[Weakening] = []
    last = before = _State(1.0, np.zeros(len(program.dead_load)), np.nan, -1)
    for ratio in SHEAR_STIFFNESSES:
        problem, start = replace(basis, shear_stiffness=ratio), last
        if before is not last:
            near, u = newtons_method(problem, last.kappa, last.displacements)
            # else the one before the last leap (house: 1 s, by dashpots from the last one 6)
            start = replace(last, displacements=u) if near else before
        outcome, state, earlier = _weaken(problem, blocks, start.kappa, start.displacements)
        forces = joints_at(problem, 0.0, state.displacements).state.forces
        found.append(replace(outcome, forces=forces, displacements=state.displacements))
        if outcome.outcome is Outcome.CARRIED:  # only where nothing moved on is a state a start for the next
            last, before = state, earlier
        if outcome.outcome is Outcome.UNDECIDED:
            return found[-1]
    return agreed(*found)


def is_diagonal(matrix: sp.csr_array) -> bool:
    """Whether all entries of a matrix off its diagonal, (n, n), are zeros."""
    return bool(matrix.count_nonzero() == np.count_nonzero(matrix.diagonal()))


def agreed(first: Weakening, second: Weakening) -> Weakening:
    """Outcome of two ratios of stiffness together: undecided where they differ."""
    if first.outcome is second.outcome:
        return first
    falls = first if first.outcome is Outcome.FALLS else second
    return replace(falls, outcome=Outcome.UNDECIDED, reason=DEPENDS_ON_STIFFNESS)


@dataclass(frozen=True)
class _Blocks:
    """Springs W of the program, (n_rows, n_rows), and velocities of the model's blocks from those of the program.

    index : (n_free,) block of the model to which each six rows of the full program belong
    """

    springs: sp.csr_array
    way_back: sp.csr_array
    index: IntArray

    def shares(self, kappa: float, u: FloatArray) -> FloatArray:
        """Share of its own load that the spring of each block carries, (n_free,): W cancels."""
        return np.asarray(kappa * np.linalg.norm((self.way_back @ u).reshape(-1, 6), axis=1))


def springs_of(program: Program, load: Load, live: float = 0.0) -> tuple[sp.csr_array, sp.csr_array, IntArray]:
    """W by the size of each block's load, the mean of the others' where it has none; see ``_Blocks``.

    live : multiple of the live load that acts as well; sizes are added, so that opposite loads leave no block without

    Returned are W, (n_rows, n_rows), the way back to velocities of the model's free blocks, (6 n_free, n_rows), and the
    numbers of these blocks, (n_free,).
    """
    way_back = sp.csr_array(sp.eye_array(len(program.dead_load), format="csr"))
    while program.reduction is not None:
        way_back = sp.csr_array(program.reduction.velocities @ way_back)
        program = program.reduction.full
    sizes = np.linalg.norm(getattr(program, load).reshape(-1, 6), axis=1)
    if live != 0.0:
        sizes = sizes + abs(live) * np.linalg.norm(program.live_load.reshape(-1, 6), axis=1)
    sizes = np.where(sizes > 0, sizes, sizes[sizes > 0].mean())
    springs = way_back.T @ sp.diags_array(np.repeat(sizes, 6)) @ way_back
    squares = way_back.power(2)
    own = float(squares.sum(axis=0).max(initial=0.0)) or 1.0  # in the unit of force of a part, as if it were alone
    if load == "dead_load":
        mine = squares.sum(axis=1).reshape(-1, 6).any(axis=1)
        own *= float(sizes[mine].mean()) if mine.any() else 1.0
    return sp.csr_array(springs / own), sp.csr_array(way_back / own), program.free


@dataclass(frozen=True)
class _State:
    """Equilibrium on springs κ: displacements (n_rows,), the greatest share of a load on its spring, and its block."""

    kappa: float
    displacements: FloatArray
    share: float
    block: int


def _weaken(
    problem: SpringProblem, blocks: _Blocks, kappa: float, start: FloatArray
) -> tuple[Weakening, _State, _State]:
    """Weaken the springs, from κ on, until the outcome is clear; the outcome with the last state and the one before."""
    last = _State(kappa, start, np.nan, -1)
    elastic = None if problem.late or np.any(start) else _elastic_state(problem, blocks)
    if elastic is not None:
        return _outcome(Outcome.CARRIED, elastic), elastic, elastic
    states: list[_State] = []
    step, leaps, failures = DECADE, True, 0
    while True:
        state = _state_at(problem, blocks, kappa, states or [last])
        leapt = bool(states) and kappa < step * (1 - KAPPA_ROUNDING) * last.kappa
        if leapt and not problem.late and (state is None or state.share >= CARRIED_SHARE):
            kappa, leaps = step * last.kappa, False  # too early: how the share develops decides
            continue
        if state is None:
            step, failures = float(np.sqrt(step)), failures + 1
            if problem.late or not states or step > CLOSEST_RATIO or failures > MOST_FAILURES:
                why = "the time limit was reached" if problem.late else "no state on weak springs was found"
                return _outcome(Outcome.UNDECIDED, last, why), last, last
            kappa = step * last.kappa
            continue
        last = state
        states.append(state)
        if state.share < CARRIED_SHARE:
            return _outcome(Outcome.CARRIED, state), state, states[-2:][0]
        if _on_plateau(states):
            return _outcome(Outcome.FALLS, state), state, state
        if kappa <= WEAKEST:
            why = "springs went on carrying part of the load as they got weaker"
            return _outcome(Outcome.UNDECIDED, state, why), state, state
        step = max(step**LENGTHENING, DECADE)
        kappa = max(_next(states, step, leaps), WEAKEST)


def _outcome(outcome: Outcome, state: _State, reason: str = "") -> Weakening:
    return Weakening(outcome, None if state.block < 0 else state.block, state.share, reason)


def _elastic_state(problem: SpringProblem, blocks: _Blocks) -> _State | None:
    """The state in which every joint sticks and is closed, if that carries the load; None where it does not.

    It is the first step of Newton's method from where nothing has moved. A continuation from another state has none.
    """
    u = np.zeros(len(problem.load))
    step = newton_step(problem, WEAKEST, joints_at(problem, WEAKEST, u))
    if step is None or not balanced(problem, WEAKEST, step, joints_at(problem, WEAKEST, step)):
        return None
    state = _state(blocks, WEAKEST, step)
    return state if state.share < CARRIED_SHARE else None


def _state_at(problem: SpringProblem, blocks: _Blocks, kappa: float, states: list[_State]) -> _State | None:
    """The state on springs κ, from the last one or from where the last two point.

    That is u = a + b/κ, which what stands and what falls both follow. States that decide nothing need not be balanced
    well.
    """
    starts = [states[-1].displacements]
    if len(states) > 1:
        before, last = states[-2:]
        share = (1 / kappa - 1 / last.kappa) / (1 / last.kappa - 1 / before.kappa)
        starts.append(last.displacements + share * (last.displacements - before.displacements))
    on_the_way = replace(problem, on_the_way=kappa > PLATEAU_FROM * (1 + KAPPA_ROUNDING))
    u = spring_state(on_the_way, kappa, starts)
    if u is not None and on_the_way.on_the_way and blocks.shares(kappa, u).max() < CARRIED_SHARE:
        u = spring_state(problem, kappa, [u])  # it is the last
    return None if u is None else _state(blocks, kappa, u)


def _state(blocks: _Blocks, kappa: float, u: FloatArray) -> _State:
    """The state with displacements u on springs κ; the first block of those with the greatest share."""
    shares = blocks.shares(kappa, u)
    worst = int(np.flatnonzero(shares >= ALIKE * shares.max())[0])
    return _State(kappa, u, float(shares[worst]), int(blocks.index[worst]))


def _on_plateau(states: list[_State]) -> bool:
    """Whether the share stayed over the last two decades of springs that are weak enough."""
    last = states[-1]
    weak = [
        state
        for state in states
        if 100 * (1 - KAPPA_ROUNDING) * last.kappa <= state.kappa <= PLATEAU_FROM * (1 + KAPPA_ROUNDING)
    ]
    return bool(weak) and last.share >= STAYS * weak[-1].share


def _next(states: list[_State], step: float, leaps: bool) -> float:
    """The next κ: a step on, or where the share has come down to its aim if it falls in proportion."""
    last = states[-1]
    if leaps and step <= DECADE and len(states) > 1:
        before = states[-2]
        if last.share / before.share <= PROPORTION * last.kappa / before.kappa:
            return last.kappa * min(AIMED_SHARE / last.share, step)
    return step * last.kappa
