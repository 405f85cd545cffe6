"""Non-associative flow with the convex contact model: forces for the motion and motion for the forces, in turn.

The pair of convex programs of :mod:`mbla.solution.nonassociative.alternation`, with the conditions on interfaces. An
interface that slips by ‖η‖ and twists by ω dissipates V ‖η‖ + R (h − ‖η‖), h being the support of its safe curve::

    forces  max (1 − τ) λ − what sliding points and interfaces dissipate     within the true conditions
    motion  least power of the loads and of friction of the given V and R    dual of the ``given_friction_form``

V is linear in the forces. R = min over edges e of R_e is concave: the R_e that is least at the last forces stands for
it, which is never less, so that what the law leaves unexplained falls with every program. Crushing is associative and
stands in both programs as it is. The first pairs are tilted towards lower load factors.

On walls of ten courses, a corner and a gable the pair came to 1e-6 or less in one to twenty pairs, within a tenth of
the time of proximal steps with Newton's method on the law, which had ended at 0.16 on two of them.
"""

from __future__ import annotations

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
from mbla.solution.resultants.convex_associative import KKT_REGULARIZATION, ConvexAssociative
from mbla.solution.resultants.convex_state import state_without_dilatancy
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, ProgramRecord, Status
from mbla.solution.standing.standing import least_forces
from mbla.solution.thresholds import EXACT_RESIDUAL

TILT, TILTED_PAIRS = 0.1, 3
"""τ of the first pairs: a corner of walls carried 0.2081 instead of 0.2281 afterwards, and was nearer to the law."""

MOST_PAIRS = 40
"""Pairs before the scheme is given up."""

PATIENCE = 8
"""Pairs in which the least residual must fall to half of what it was, or the scheme is given up."""

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
        rest = np.maximum(size.total - size.share, 0.0)
        self.motion_solver.update(rhs=self.motion_form.rhs_for(limit, size.share, rest))
        solution = self._solved(self.motion_solver, "motion", -1.0)
        if not _usable(solution):
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
        solution = self._solved(self.forces_solver, "forces", 1.0)
        if not _usable(solution):
            return solution
        return self.forces_form.contact_forces(solution.z), -float(solution.z[0])

    def _dissipated(self, forces: FloatArray, velocities: FloatArray, motions: FloatArray) -> FloatArray:
        """Power of sliding and twisting for a unit of each normal force, (n_points,)."""
        convex, limits = self.convex, self.convex.torsion
        moved = convex.points.equilibrium_matrix.T @ velocities
        own = (moved - convex.resultants.T @ motions.sum(axis=1).ravel()).reshape(-1, 3)
        at_points = convex.points.limits.friction * np.hypot(own[:, 1], own[:, 2])
        motion, size = motions[limits.interfaces, 0], friction_limit(limits, convex.resultants_of(forces))
        slip, twist = np.hypot(motion[:, 1], motion[:, 2]), np.abs(motion[:, 3]) * limits.radii
        beyond_slip = curve_support(slip, twist, limits.thetas) - slip
        of_resultants = slip @ size.of_total + beyond_slip @ size.of_share
        return np.asarray(at_points + (convex.resultants.T @ of_resultants)[::3])

    def _solved(self, solver: InteriorPointSolver, kind: str, sense: float) -> ConeSolution:
        number, scaling = len(self.records) + 1, self.convex.points.scaling
        solution = solver.solve(number, sense * scaling.live)
        factor = scaling.load_factor(sense * solution.objective) if _usable(solution) else np.nan
        self.records.append(solution.record(number, kind, factor))
        return solution


def solve_by_alternation(
    convex: ConvexProgram, associative: ConvexAssociative, settings: SolverSettings, log: Log, unit: float = 1.0
) -> SequenceResult:
    """Run the scheme from the associative forces, or where these lock from the least that carry the dead load.

    unit : of force, in that of the program, in which states are given; of the loads at collapse if it is not 1
    """
    records, states = list(associative.programs), list[LawState]()
    own = replace(settings, tolerance=min(settings.tolerance, TOLERANCE), regularization=KKT_REGULARIZATION)
    found: FloatArray | ConeSolution
    found = least_forces(convex.points, own, log, records) if associative.state is None else associative.state.forces
    if isinstance(found, ConeSolution):
        return broken_off(found, records)
    convex, forces = convex.in_unit_of_force(unit), found / unit
    pair = _Pair.of(convex, own, log, records)
    for count in range(TILTED_PAIRS + MOST_PAIRS):
        motion = pair.motion_for(forces)
        if isinstance(motion, ConeSolution):
            return broken_off(motion, records, _best(states))
        after = pair.forces_for(forces, *motion, tilt=TILT if count < TILTED_PAIRS else 0.0)
        if isinstance(after, ConeSolution):
            return broken_off(after, records, _best(states))
        forces, factor = after
        if count >= TILTED_PAIRS:
            states.append(state_without_dilatancy(convex, forces, *motion, factor))
            if _at_rest(states, settings) or _is_stuck(states):
                break
    return _finished(states, settings, tuple(records))


def _best(states: list[LawState]) -> LawState | None:
    return min(states, key=lambda state: state.residual, default=None)


def _usable(solution: ConeSolution) -> bool:
    return solution.status in WITH_VALUE and bool(np.isfinite(solution.x).all() and np.isfinite(solution.z).all())


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
    """Whether the last pairs have not halved the least residual of states that miss the law."""
    residuals = [state.residual for state in states]
    last = min(residuals[-PATIENCE:])
    return len(residuals) > PATIENCE and last > EXACT and last > 0.5 * min(residuals[:-PATIENCE])


def _finished(states: list[LawState], settings: SolverSettings, records: tuple[ProgramRecord, ...]) -> SequenceResult:
    best = _best(states)
    assert best is not None  # the tilted pairs are fewer than all
    if best.residual <= EXACT_RESIDUAL:
        return SequenceResult(Status.SOLVED, best, "", records)
    if best.residual <= _asked(settings):
        return as_asked(best, best.residual, settings.residual, records)
    words = f"did not converge in {len(states)} iterations: residual of the joint law {best.residual:.2g}"
    return not_at_rest(best, Message("law-missed", words), records, spread_of(best, states))
