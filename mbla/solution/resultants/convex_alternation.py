"""Non-associative flow with the convex contact model: forces for the motion and motion for the forces, in turn.

The pair of convex programs of :mod:`mbla.solution.nonassociative.alternation`, with the conditions on interfaces. An
interface that slips by ‖η‖ and twists by ω dissipates V ‖η‖ + R (h − ‖η‖), h being the support of its safe curve::

    forces  max (1 − τ) λ − what sliding points and interfaces dissipate     within the true conditions
    motion  least power of the loads and of friction of the given V and R    dual of the ``given_friction_form``

V is linear in the forces. R = min over edges e of R_e is concave: the R_e that is least at the last forces stands for
it, which is never less, so that what the law leaves unexplained falls with every program. Crushing is associative and
stands in both programs as it is. Pairs may come to rest off the law: each of the best for the other. Several starts,
tilted at first towards lower load factors, follow each other until one comes to the law.

A gable came to 1e-7 in one pair, in a tenth of the time of proximal steps with Newton's method on the law; on a corner
of walls, where such steps ended at residuals of 0.15, three of four cases come below 1e-6.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.program.kinematic import KinematicForm
from mbla.program.resultants import ConvexProgram, convex_form
from mbla.program.resultants.friction_limit import curve_support, friction_limit
from mbla.program.resultants.static import ConvexStaticForm, given_friction_form
from mbla.solution.cone_solvers.choice import interior_point_solver
from mbla.solution.cone_solvers.cone_solution import ConeSolution, InteriorPointSolver, Log
from mbla.solution.nonassociative.law_state import (
    LawState,
    SequenceResult,
    as_asked,
    broken_off,
    not_at_rest,
    spread_of,
)
from mbla.solution.resultants.convex_associative import KKT_REGULARIZATION, ConvexAssociative, unbalanced
from mbla.solution.resultants.convex_state import state_without_dilatancy
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord, Status
from mbla.solution.standing.standing import least_forces
from mbla.solution.thresholds import EXACT_RESIDUAL, SOLVED_RESIDUAL

TILTS = (0.5, 0.4, 0.3, 0.2, 0.1, 0.05)
"""τ of the first pairs of a start: where pairs come to rest off the law, others that begin so come to the law, and to
lower load factors. Of thirteen random assemblies that crush and stayed above 1e-4 with three pairs of 0.1 from the
associative forces, three came below 1e-7 so, and four more from the forces of the dead load with these tilts or none;
with all starts eleven came below 1e-4."""

SEEDS = 3
"""Starts from forces under the dead load that are made uneven, where the others leave more than ``SOLVED_RESIDUAL``."""

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
class _Pair:
    """Both programs of one structure, held by solvers that start near their last solutions."""

    convex: ConvexProgram
    forces_form: KinematicForm
    forces_solver: InteriorPointSolver
    motion_form: ConvexStaticForm
    motion_solver: InteriorPointSolver
    records: list[ProgramRecord]

    @classmethod
    def of(cls, convex: ConvexProgram, settings: SolverSettings, log: Log, records: list[ProgramRecord]) -> _Pair:
        forces, motion = convex_form(convex), given_friction_form(convex)
        solvers = [interior_point_solver(form.cone_program, settings, log) for form in (forces, motion)]
        return cls(convex, forces, solvers[0], motion, solvers[1], records)

    def motion_for(self, forces: FloatArray) -> tuple[FloatArray, FloatArray] | ConeSolution:
        """Velocities, (n_rows,), and motions of the interfaces, (n_interfaces, 2, 6), or what ended without them.

        forces : (n_points, 3) whose normal forces limit friction
        """
        convex, limits = self.convex, self.convex.points.limits
        size = friction_limit(convex.torsion, convex.resultants_of(forces))
        limit = np.maximum(limits.friction * forces[:, 0] + limits.cohesion, 0.0)
        self.motion_solver.update(rhs=self.motion_form.rhs_for(limit, size.share, size.rest))
        solution = self.motion_solver.solve(len(self.records) + 1, -convex.points.scaling.live)
        self._record(solution, "motion", -solution.objective)
        if not solution.usable:
            return solution
        velocities = self.motion_form.velocities(solution.z)
        power = float(convex.points.live_load @ velocities)
        return velocities / power, self.motion_form.motions(solution.z) / power

    def forces_for(
        self, before: FloatArray, velocities: FloatArray, motions: FloatArray, tilt: float
    ) -> tuple[FloatArray, float] | ConeSolution:
        """Forces, (n_points, 3), and load factor for a motion, or what ended without them.

        before : (n_points, 3) the last forces
        """
        weight = self._dissipated(before, velocities, motions)
        rhs = np.zeros(self.forces_form.cone_program.matrix.shape[0])
        of_points = self.forces_form.rhs_for(weight, live_power=1.0 - tilt)
        rhs[: len(of_points)] = of_points
        self.forces_solver.update(rhs=rhs)
        solution = self.forces_solver.solve(len(self.records) + 1, self.convex.points.scaling.live)
        factor = -float(solution.z[0])  # the objective is what the law leaves unexplained
        self._record(solution, "forces", factor)
        return (self.forces_form.contact_forces(solution.z), factor) if solution.usable else solution

    def _dissipated(self, forces: FloatArray, velocities: FloatArray, motions: FloatArray) -> FloatArray:
        """Power of sliding and twisting for a unit of each normal force, (n_points,)."""
        convex, limits = self.convex, self.convex.torsion
        moved = (convex.points.equilibrium_matrix.T @ velocities).reshape(-1, 3)
        own = convex.own_velocities(moved, motions)
        at_points = convex.points.limits.friction * np.hypot(own[:, 1], own[:, 2])
        motion, size = motions[limits.interfaces, 0], friction_limit(limits, convex.resultants_of(forces))
        slip, twist = np.hypot(motion[:, 1], motion[:, 2]), np.abs(motion[:, 3]) * limits.radii
        beyond_slip = curve_support(slip, twist, limits.thetas) - slip
        of_resultants = slip @ size.of_total + beyond_slip @ size.of_share
        return np.asarray(at_points + (convex.resultants.T @ of_resultants)[::3])

    def _record(self, solution: ConeSolution, kind: str, factor: float) -> None:
        value = self.convex.points.scaling.load_factor(factor) if solution.usable else np.nan
        self.records.append(solution.record(len(self.records) + 1, kind, value))


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
    pair = _Pair.of(in_unit, own, log, records)
    starts = [(gravity, ()), (gravity, TILTS), *((uneven, TILTS) for uneven in _uneven(gravity))]
    if associative.state is not None:
        starts.insert(0, (associative.state.forces, TILTS))
    ended: ConeSolution | None = None
    for forces, tilts in starts:
        found, ended = _run(pair, forces / unit, tilts, settings)
        states += found
        if ended is not None and ended.status is Status.TIME_LIMIT:
            break
        least = min((state.residual for state in states), default=np.inf)
        if least <= max(EXACT_RESIDUAL, _asked(settings)) or (tilts and least <= SOLVED_RESIDUAL):
            return _finished(states, settings, tuple(records))
    if ended is not None:
        return broken_off(ended, records, _best(states))
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


def _uneven(gravity: FloatArray) -> Iterator[FloatArray]:
    for seed in range(SEEDS):
        yield gravity * np.exp(np.random.default_rng(seed).standard_normal((len(gravity), 1)))


def _run(
    pair: _Pair, forces: FloatArray, tilts: Sequence[float], settings: SolverSettings
) -> tuple[list[LawState], ConeSolution | None]:
    """States of pairs from forces, (n_points, 3), behind the tilted ones, and the program that ended them early."""
    states = list[LawState]()
    for tilt in (*tilts, *[0.0] * MOST_PAIRS):
        motion = pair.motion_for(forces)
        if isinstance(motion, ConeSolution):
            return states, motion
        after = pair.forces_for(forces, *motion, tilt=tilt)
        if isinstance(after, ConeSolution):
            return states, after
        forces, factor = after
        if tilt == 0.0:
            state = state_without_dilatancy(pair.convex, forces, *motion, factor)
            states.append(replace(state, residual=max(state.residual, unbalanced(pair.convex, state))))
            if _at_rest(states, settings) or _is_stuck(states):
                break
    return states, None


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
    return not_at_rest(best, Message("law-missed", words), records, spread_of(best, states))
