"""Non-associative flow with the convex contact model: forces for the motion and motion for the forces, in turn.

The pair of convex programs of :mod:`mbla.solution.nonassociative.alternation`, with the conditions on interfaces. An
interface that slips by ‖η‖ and twists by ω dissipates V ‖η‖ + R (h − ‖η‖), h being the support of its safe curve::

    forces  max (1 − τ) λ − what sliding points and interfaces dissipate     within the true conditions
    motion  least power of the loads and of friction of the given V and R    the ``given_friction_form``

V is linear in the forces. R = min over edges e of R_e is concave: the R_e that is least at the last forces stands for
it, which is never less, so that what the law leaves unexplained falls with every program. Crushing is associative and
stands in both programs as it is. Pairs may come to rest off the law: each of the best for the other. Several starts,
tilted at first towards lower load factors, follow each other until one comes to the law.

A gable came to 1e-7 in one pair, in a tenth of the time of proximal steps with Newton's method on the law; on a corner
of walls, where such steps ended at residuals of 0.15, three of four cases come below 1e-6.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain, repeat

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.program.kinematic import KinematicForm
from mbla.program.resultants import ConvexProgram, convex_form
from mbla.program.resultants.assemble import given_friction, given_friction_cost, given_friction_form
from mbla.program.resultants.friction_limit import FrictionLimit, curve_support, friction_limit
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.nonassociative.alternation import FLOOR, Alternation
from mbla.solution.nonassociative.law_state import (
    LawState,
    SequenceResult,
    as_asked,
    broken_off,
    not_at_rest,
)
from mbla.solution.resultants.convex_associative import KKT_REGULARIZATION, ConvexAssociative, unbalanced
from mbla.solution.resultants.convex_state import state_without_dilatancy
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord, Status
from mbla.solution.standing.standing import least_forces
from mbla.solution.thresholds import EXACT_RESIDUAL

TILTS = (0.5, 0.4, 0.3, 0.2, 0.1, 0.05)
"""τ of the first pairs of a start: where pairs come to rest off the law, others that begin so come to the law, and to
lower load factors. Of thirteen random assemblies that crush and stayed above 1e-4 with three pairs of 0.1 from the
associative forces, three came below 1e-7 so, and four more from the forces of the dead load with these tilts or none;
with all starts eleven came below 1e-4."""

HOPS, WIDTHS, HOP_TILTS = 12, (0.3, 1.0, 3.0), (0.1, 0.05)
"""Starts near the best state where all others rest off the law: half-way to associative forces and to those under the
dead load, then made uneven by factors of these spreads (of their logarithms), two without tilts and two with them in
turn. Of thirteen random assemblies that crush and had come to rest between 1e-4 and 1.6, ten come below 1e-5 so."""

MOST_PAIRS = 40
"""Pairs of a start behind the tilted ones before it is given up."""

PATIENCE, LESS = 4, 0.7
"""Pairs in which the least residual of a start must fall to this share, or the start is given up."""

EXACT = 1e-7
"""Residual, and change of the load factor by one pair, at which no better state is looked for. The residual is a power,
of second order in the direction of sliding: of a block in a groove 4e-10 left 6e-5 of the load factor."""

TOLERANCE = 1e-9
"""Of the programs: forces of one are limits of the next."""


@dataclass
class ConvexAlternation(Alternation):
    """Both programs with the conditions on interfaces; velocities are those of the blocks and of the conditions."""

    convex: ConvexProgram = field(kw_only=True)

    @cached_property
    def _frictionless(self) -> ConvexProgram:
        return given_friction(self.convex)

    def forces_form(self) -> KinematicForm:
        """The associative program."""
        return convex_form(self.convex)

    def motion_form(self) -> KinematicForm:
        """The program of the motion against given friction."""
        return given_friction_form(self._frictionless)

    def motion_cost(self, form: KinematicForm, normal: FloatArray) -> FloatArray:
        """Cost of the motion program, (n_unknowns,), with the friction of normal forces, (n_points,)."""
        limits, size = self.convex.points.limits, self._size_at(normal)
        limit = np.maximum(limits.friction * normal + limits.cohesion, FLOOR)
        share, rest = np.maximum(size.share, FLOOR), np.maximum(size.rest, FLOOR)
        return given_friction_cost(form, self._frictionless, limit, share, rest)

    def weight(self, velocities: FloatArray) -> FloatArray:
        """Power of sliding and twisting for a unit of each normal force, (n_points,), by velocities, (n_rows,)."""
        convex, limits = self.convex, self.convex.torsion
        motions = self._frictionless.flows(velocities)
        moved = (convex.points.equilibrium_matrix.T @ velocities[: convex.n_block_rows]).reshape(-1, 3)
        own = convex.own_velocities(moved, motions)
        at_points = convex.points.limits.friction * np.hypot(own[:, 1], own[:, 2])
        motion, size = motions[limits.interfaces, 0], self._size_at(self.given)
        slip, twist = np.hypot(motion[:, 1], motion[:, 2]), np.abs(motion[:, 3]) * limits.radii
        beyond_slip = curve_support(slip, twist, limits.thetas) - slip
        of_resultants = slip @ size.of_total + beyond_slip @ size.of_share
        return np.asarray(at_points + (convex.resultants.T @ of_resultants)[::3])

    def state(self, forces: FloatArray, velocities: FloatArray, load_factor: float) -> LawState:
        """The state of forces, (n_points, 3), and velocities, (n_rows,), with its residual."""
        blocks, motions = velocities[: self.convex.n_block_rows], self._frictionless.flows(velocities)
        state = state_without_dilatancy(self.convex, forces, blocks, motions, load_factor)
        return replace(state, residual=max(state.residual, unbalanced(self.convex, state)))

    def _size_at(self, normal: FloatArray) -> FrictionLimit:
        """Sizes of the sets of shear and torsion, which follow from normal forces alone."""
        forces = np.column_stack([normal, np.zeros((len(normal), 2))])
        return friction_limit(self.convex.torsion, self.convex.resultants_of(forces))


def solve_by_alternation(
    convex: ConvexProgram, associative: ConvexAssociative, settings: SolverSettings, log: Log, unit: float = 1.0
) -> SequenceResult:
    """Run the scheme from the associative forces, and from those that carry the dead load, until a state fits the law.

    unit : of force, in that of the program, in which states are given; of the loads at collapse if it is not 1
    """
    records, states = list(associative.programs), list[LawState]()
    own = replace(settings, tolerance=min(settings.tolerance, TOLERANCE), regularization=KKT_REGULARIZATION)
    in_unit = convex.in_unit_of_force(unit)
    with_dilatancy = _associative(in_unit, associative, unit)
    if with_dilatancy is not None and with_dilatancy.residual <= EXACT:  # nothing slides, or it opens nothing
        return SequenceResult(Status.SOLVED, with_dilatancy, "", tuple(records))
    gravity = least_forces(convex.points, own, log, records)
    if isinstance(gravity, ConeSolution):
        return broken_off(gravity, records)
    points = in_unit.points
    pair = ConvexAlternation(points, np.zeros(points.n_points), own, log, records, convex=in_unit)
    above = dead = gravity[:, 0] / unit
    starts: list[tuple[FloatArray, tuple[float, ...]]] = [(dead, ()), (dead, TILTS)]
    if associative.state is not None:
        above = associative.state.forces[:, 0] / unit
        starts.insert(0, (above, TILTS))
    for normal, tilts in chain(starts, _hops(above, dead, states)):
        pair.ended = None
        states += _run(pair, normal, tilts, settings)
        if pair.late:
            break
        least = min((state.residual for state in states), default=np.inf)
        if least <= max(EXACT_RESIDUAL, _asked(settings)):
            return _finished(states, settings, tuple(records))
    if pair.ended is not None and (pair.late or not states):
        return broken_off(pair.ended, records, _best(states))
    return _finished(states, settings, tuple(records))


def _associative(convex: ConvexProgram, associative: ConvexAssociative, unit: float) -> LawState | None:
    """The associative state, judged by the law without dilatancy."""
    state = associative.state
    if state is None or state.motions is None:
        return None
    power = float(convex.points.live_load @ state.velocities)
    if not power > 0.0:
        return None
    velocities, motions = state.velocities / power, state.motions / power
    return state_without_dilatancy(convex, state.forces / unit, velocities, motions, state.load_factor / unit)


def _hops(
    above: FloatArray, gravity: FloatArray, states: list[LawState]
) -> Iterator[tuple[FloatArray, tuple[float, ...]]]:
    """Normal forces to start from near the best of the states found so far, (n_points,), and tilts of the first pairs.

    above, gravity : (n_points,) of associative flow and of the dead load
    """
    random = np.random.default_rng(0)
    for hop in range(HOPS):
        best = _best(states)
        normal = gravity if best is None else best.forces[:, 0]
        factors = np.exp(WIDTHS[hop % len(WIDTHS)] * random.standard_normal(len(normal)))
        near = 0.5 * (normal + (above, gravity)[hop]) if hop < 2 else normal * factors
        yield near, HOP_TILTS if hop // 2 % 2 else ()


def _run(
    pair: ConvexAlternation, normal: FloatArray, tilts: Sequence[float], settings: SolverSettings
) -> list[LawState]:
    """States of pairs from normal forces, (n_points,), behind the tilted ones."""
    states = list[LawState]()
    for tilt, state in zip((*tilts, *[0.0] * MOST_PAIRS), pair.states(normal, chain(tilts, repeat(0.0))), strict=False):
        if tilt == 0.0:
            states.append(state)
            if _at_rest(states, settings) or _is_stuck(states):
                break
    return states


def _best(states: list[LawState]) -> LawState | None:
    return min(states, key=lambda state: state.residual, default=None)


def _asked(settings: SolverSettings) -> float:
    """Residual of a rough state where one is asked for."""
    return settings.residual if settings.residual > EXACT_RESIDUAL else 0.0


def _at_rest(states: list[LawState], settings: SolverSettings) -> bool:
    """Whether the last state fits the law, or as well as was asked for, and the pair no longer moves it."""
    wanted, last = max(EXACT, _asked(settings)), states[-2:]
    if len(last) < 2 or last[1].residual > wanted:
        return False
    return abs(last[1].load_factor - last[0].load_factor) <= wanted * abs(last[1].load_factor)


def _is_stuck(states: list[LawState]) -> bool:
    """Whether the last pairs have not lessened the residual of states that miss the law."""
    residuals = [state.residual for state in states]
    last = min(residuals[-PATIENCE:])
    return len(residuals) > PATIENCE and last > EXACT and last > LESS * min(residuals[:-PATIENCE])


def _finished(states: list[LawState], settings: SolverSettings, records: tuple[ProgramRecord, ...]) -> SequenceResult:
    best = _best(states)
    assert best is not None  # every start ends with a state, or early
    if best.residual <= EXACT_RESIDUAL:
        return SequenceResult(Status.SOLVED, best, "", records)
    if best.residual <= _asked(settings):
        return as_asked(best, best.residual, settings.residual, records)
    words = f"did not converge in {len(states)} iterations: residual of the joint law {best.residual:.2g}"
    return not_at_rest(best, Message("law-missed", words), records)
