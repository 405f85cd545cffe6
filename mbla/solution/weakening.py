"""Whether an assembly carries a load from its stress-free state: springs that hold every block are made weaker.

On springs of κ times the size of each block's load the assembly always finds an equilibrium
(:mod:`mbla.solution.spring_state`). As κ goes to zero, the largest share s of a block's load that its spring carries

- goes to zero in proportion to κ where the joints carry the load;
- stays where they do not: the block falls, and the springs hold it.

Each state starts from the one before. Where s falls in proportion, κ is reduced to its last value in one go.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum, auto
from itertools import pairwise
from typing import Literal

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.program.program import Program
from mbla.program.yield_conditions.limits import YieldLimits
from mbla.solution.settings import SolverSettings
from mbla.solution.spring_state import SpringProblem, joint_forces, spring_problem, spring_state

SHEAR_STIFFNESSES = (1.0, 0.4)
"""Shear over normal stiffness of a joint. How forces share between joints before anything slides depends on it, and so
does what is near a threshold; 1 and the 0.4 of a layer of isotropic stone, 1/(2 (1 + ν)), must agree."""

CARRIED_SHARE = 1e-6
"""Share of a block's load on its spring below which joints carry the load."""

AIMED_SHARE = 1e-7
"""What κ is chosen for once the share falls in proportion to it."""

WEAKEST = 1e-12
"""Least κ; columns of a thousand blocks settle by 1e5 units under their weight, all else by less."""

PLATEAU_FROM = 1e-5
"""κ from which on a share that stays counts: with stronger springs tall structures lean on them."""

STAYS = 0.9
"""Least ratio of shares one decade apart on a plateau; two in a row make one."""

PROPORTION = 1.25
"""Largest ratio of shares over ratio of κ that counts as falling in proportion."""


ALIKE = 1 - 1e-6
"""Ratio of shares that counts as equal: of blocks that fall alike the first is named, whatever the rounding."""


class Outcome(Enum):
    """What became of the load as the springs got weaker."""

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
    forces: FloatArray | None = None
    displacements: FloatArray | None = None


Load = Literal["dead_load", "live_load"]


def weaken_springs(program: Program, load: Load, limits: YieldLimits, settings: SolverSettings) -> Weakening:
    """Decide whether the stress-free assembly carries the dead load, or the live load alone, within given limits.

    Both ratios of stiffness must say the same; a load that is zero is carried.
    """
    if not np.any(getattr(program, load)):
        return Weakening(Outcome.CARRIED, None, 0.0)
    blocks = _Blocks(*springs_of(program, load))
    whole = spring_problem(
        program.equilibrium_matrix, getattr(program, load), limits, blocks.springs, settings.deadline
    )
    found: list[Weakening] = []
    kappa, u = 1.0, np.zeros(len(program.dead_load))
    for ratio in SHEAR_STIFFNESSES:
        problem = replace(whole, shear_stiffness=ratio)
        outcome, kappa, u = _weaken(problem, blocks, kappa, u)
        found.append(replace(outcome, forces=joint_forces(problem, u), displacements=u))
        if outcome.outcome is not Outcome.CARRIED:  # only where nothing moved on is the state a start for the next
            kappa, u = 1.0, np.zeros_like(u)
        if outcome.outcome is Outcome.UNDECIDED:
            return found[-1]
    return agreed(*found)


def agreed(first: Weakening, second: Weakening) -> Weakening:
    """What two ratios of stiffness say together: nothing where they differ."""
    if first.outcome is second.outcome:
        return first
    falls = first if first.outcome is Outcome.FALLS else second
    reason = "it depends on how stiff the joints are in shear against compression"
    return Weakening(Outcome.UNDECIDED, falls.block, falls.share, reason)


@dataclass(frozen=True)
class _Blocks:
    """Springs W of the program, (n_rows, n_rows), and velocities of the model's blocks from those of the program.

    index : (n_free,) block of the model to which each six rows of the whole program belong
    """

    springs: sp.csr_array
    way_back: sp.csr_array
    index: IntArray

    def shares(self, kappa: float, u: FloatArray) -> FloatArray:
        """Share of its own load that the spring of each block carries, (n_free,): W cancels."""
        return np.asarray(kappa * np.linalg.norm((self.way_back @ u).reshape(-1, 6), axis=1))


def springs_of(program: Program, load: Load) -> tuple[sp.csr_array, sp.csr_array, IntArray]:
    """W by the size of each block's load, the mean of the others' where it has none; see ``_Blocks``."""
    way_back = sp.csr_array(sp.eye_array(len(program.dead_load), format="csr"))
    while program.reduction is not None:
        way_back = sp.csr_array(program.reduction.velocities @ way_back)
        program = program.reduction.full
    sizes = np.linalg.norm(getattr(program, load).reshape(-1, 6), axis=1)
    sizes = np.where(sizes > 0, sizes, sizes[sizes > 0].mean())
    springs = way_back.T @ sp.diags_array(np.repeat(sizes, 6)) @ way_back
    return sp.csr_array(springs), way_back, program.free


def _weaken(
    problem: SpringProblem, blocks: _Blocks, kappa: float, u: FloatArray
) -> tuple[Weakening, float, FloatArray]:
    """Weaken the springs from a state at κ until the outcome is clear; the outcome with the last state."""
    history: list[tuple[float, float]] = []
    block, share, leaps = None, np.nan, True
    while True:
        leapt = bool(history) and kappa < 0.1 * (1 - 1e-9) * history[-1][0]
        state = spring_state(problem, kappa, u)
        if leapt and not problem.late and (state is None or blocks.shares(kappa, state).max() >= CARRIED_SHARE):
            kappa = 0.1 * history[-1][0]  # it was too early to leap: what the share does on the way decides
            leaps = False
            continue
        if state is None:
            why = "the time limit was reached" if problem.late else "no state on weak springs was found"
            return Weakening(Outcome.UNDECIDED, block, share, why), kappa, u
        u, shares = state, blocks.shares(kappa, state)
        worst = int(np.flatnonzero(shares >= ALIKE * shares.max())[0])
        block, share = int(blocks.index[worst]), float(shares[worst])
        history.append((kappa, share))
        if share < CARRIED_SHARE:
            return Weakening(Outcome.CARRIED, block, share), kappa, u
        if _on_plateau(history):
            return Weakening(Outcome.FALLS, block, share), kappa, u
        if kappa <= WEAKEST:
            why = "springs went on carrying part of the load as they got weaker"
            return Weakening(Outcome.UNDECIDED, block, share, why), kappa, u
        kappa = max(_next(history, leaps), WEAKEST)


def _on_plateau(history: list[tuple[float, float]]) -> bool:
    """Whether the share stayed over the last two decades of springs that are weak enough."""
    last = history[-3:]
    weak = len(last) == 3 and last[0][0] <= PLATEAU_FROM * (1 + 1e-9)
    decades = all(after[0] <= 0.1 * (1 + 1e-9) * before[0] for before, after in pairwise(last))
    return weak and decades and all(after[1] >= STAYS * before[1] for before, after in pairwise(last))


def _next(history: list[tuple[float, float]], leaps: bool) -> float:
    """The next κ: a decade on, or where the share has come down to its aim if it falls in proportion."""
    kappa, share = history[-1]
    if leaps and len(history) > 1:
        before, more = history[-2]
        if share / more <= PROPORTION * kappa / before:
            return kappa * min(AIMED_SHARE / share, 0.1)
    return 0.1 * kappa
