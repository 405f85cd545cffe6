"""One force field by rule: of all forces that associative flow allows at collapse, the least.

The load factor is unique, the forces are not. All that carry it belong to the same mechanism, whichever of its
mechanisms was found (complementary slackness), and form a convex set without an inside. The mechanism fixes what has no
inside (:mod:`mbla.program.fixed_mechanism`); among what is left::

    min ½ Σ ‖x_k‖²/a_k    s.t.   A x + f_D + λ f_L = 0,   x compatible with the mechanism

with a_k the area that point k stands for. That is the integral of the square of the traction over all joints, so that
it depends neither on how many points an interface has nor into how many interfaces a surface is cut, beyond the error
with which points represent it. The optimum is strictly convex, hence unique, and the same for every solver. λ is an
unknown, which the mechanism fixes: at the digits of the load factor found there might be no forces at all.

Where a velocity is lost in the noise its point counts as at rest, and λ could fall for the sake of smaller forces;
where every joint moves, rounding in the directions of sliding leaves hardly any forces. In both cases it is ::

    min ½ ε Σ ‖x_k‖²/a_k − λ,      ε = 1e-3 |λ|/Σ ‖x_k‖²/a_k   at the forces first found

where no point is fixed by the mechanism. In linear programs that is exact for small ε (Mangasarian and Meyer 1979,
doi:10.1137/0317052). Smaller ε, which walls from about 1,000 blocks need, are beyond cone solvers: from what they find
Newton's method on the multipliers goes on with them (``least_newton``). Measured on walls of up to 410
blocks in both forms and reductions: the first way agrees to 1e-6 of a mean block load or better, the second to 1e-3.

In a reduced program the area of a point is that of the points it stands for.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.program.fixed_mechanism import PointMotion
from mbla.program.program import Program
from mbla.solution.associative.least_search import Candidate, Search
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.nonassociative.point_motion import point_motion
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord

TOUCHING = 1e-6
"""Velocity, over the largest contact speed, above which a point counts as moving."""

ALL = 0.95
"""Share of the points that move from which on the mechanism alone is not trusted with the forces."""

TOLERANCE, REGULARIZATION = 1e-10, 1e-8
"""Of the cone solver: the set of forces has hardly an inside."""

MOST_ITERATIONS = 60
"""Of a program of the cone solver."""

MOST_POINTS = 40_000
"""Contact points up to which they are sought. On a planar wall of 10,050 blocks, 59,700 points, all three programs took
three times as long as the load factor, 142 iterations, and found nothing."""

SHARE = 1e-3
"""ε, relative: with 1e-2 the load factor of a wall of 410 blocks fell by 1e-4, with 1e-4 the solver ended short."""

SHARES, SMALL_SHARES = (1e-4, 1e-5, 1e-6), (1e-5, 1e-6)
"""ε, relative, in Newton's method: from the forces found with ``SHARE``, and with the mechanism. On a wall of 1,013
blocks the load factor fell by 7e-6 with 1e-3, by 7e-8 with 1e-4, and not with 1e-5."""

SAME_FORCES = 1e-3
"""Relative difference of the objectives of both ways up to which they found the same."""


@dataclass(frozen=True)
class LeastForces:
    """The state with the least forces, or the one it was given, with a remark in words why."""

    state: LawState
    programs: tuple[ProgramRecord, ...]
    remark: Message | None = None


def least_forces(
    program: Program, state: LawState, weights: FloatArray, settings: SolverSettings, log: Log, *, first: int = 1
) -> LeastForces:
    """The least forces at the load factor of an associative state.

    weights : (n_points,) from ``point_weights``
    first   : number of the first program in the sequence of the load case
    """
    if program.n_points > MOST_POINTS:
        return LeastForces(state, (), NOT_SOUGHT)
    iterations = min(settings.max_iterations, MOST_ITERATIONS)
    settings = replace(settings, tolerance=TOLERANCE, regularization=REGULARIZATION, max_iterations=iterations)
    search = Search(program, state, weights, settings, log, first)
    found = _least(search)
    return replace(found, state=search.with_proved_factor(found.state))


def _least(search: Search) -> LeastForces:
    """The least forces by the mechanism, or without it."""
    program, state = search.program, search.state
    motion = point_motion(program, state, TOUCHING, program.limits.friction)
    by_mechanism, all_move = search.solve(motion, 0.0), _all_move(motion)
    if by_mechanism.fits and not all_move:
        return LeastForces(by_mechanism.state, tuple(search.records))
    found = _without_mechanism(search, by_mechanism, all_move)
    if by_mechanism.fits:  # of two candidates that fit the law the smaller one is less wrong
        most = np.inf if found is None else (1.0 + SAME_FORCES) * search.size(found)
        found = by_mechanism.state if search.size(by_mechanism.state) <= most else found
    return LeastForces(found or state, tuple(search.records), NOT_FOUND if found is None else None)


def _without_mechanism(search: Search, by_mechanism: Candidate, all_move: bool) -> LawState | None:
    """Least forces with the load factor in the cost, by Newton's method from those of the mechanism where it can.

    Large structures for which neither finds any soon are given up: on a house and a vault the load factor falls slowly
    with ε, and all that was tried took half of the run and found nothing.
    """
    if by_mechanism.near and not all_move:
        found = search.by_newton(by_mechanism, SMALL_SHARES)
        if found is not None:
            return found
    if search.large and not all_move:
        return None
    at_rest = search.solve(_at_rest(search.program), SHARE)
    if at_rest.fits:
        return at_rest.state
    return search.by_newton(at_rest, SHARES) if at_rest.near else None


NOT_FOUND = Message(
    "least-forces-not-found",
    "contact forces are as the solver left them, not the least ones, which were not found",
)

NOT_SOUGHT = NOT_FOUND.around(after=f": of more than {MOST_POINTS:,} points they are not sought")


def trusted_motion(program: Program, state: LawState) -> PointMotion:
    """What the points do in an associative state; nothing where all of them move."""
    motion = point_motion(program, state, TOUCHING, program.limits.friction)
    return _at_rest(program) if _all_move(motion) else motion


def _all_move(motion: PointMotion) -> bool:
    moves = motion.opens | motion.slides | motion.crushes
    return len(moves) > 0 and float(np.mean(moves)) >= ALL


def _at_rest(program: Program) -> PointMotion:
    """No point moves: forces are bounded by the yield conditions alone."""
    none = np.zeros(program.n_points, dtype=bool)
    return PointMotion(none, none, none, np.zeros((program.n_points, program.components - 1)))


def point_weights(program: Program, areas: FloatArray | None) -> FloatArray:
    """One over the area that each point of a program stands for, mean 1, (n_points,).

    areas : (n_points of the whole model,) share of the interface area; None: all alike

    With x = P y between a program and its reduction Σ ‖x‖²/a is Σ w ‖y‖² with w from the normal components: a point
    that stands for its mirror image counts twice, points one behind the other share their force as their areas.
    """
    maps = []
    while program.reduction is not None:
        maps.append((program.reduction.forces, program.components))
        program = program.reduction.full
    weights = np.ones(program.n_points) if areas is None else 1.0 / areas
    components = program.components
    for forces, smaller in reversed(maps):
        by_component = sp.csr_array(forces.power(2)).T @ np.repeat(weights, components)
        weights, components = np.asarray(by_component)[::smaller], smaller
    return weights / max(float(weights.mean()) if len(weights) else 1.0, 1e-300)
