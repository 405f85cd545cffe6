"""How far the load factor can range for one mechanism of a flow rule without normality.

Without normality the static theorem does not hold: the same mechanism belongs to many systems of forces, and they to
different load factors. For a given mechanism those forces form a convex set (:mod:`mbla.program.static`), so
that the least and the greatest load factor are two cone programs. Each end is a state of the exact law of its own: its
forces with the velocities of the mechanism. On the walls of Ferris and Tin-Loi the range did not depend on how the
mechanism was found, nor on the number of contact points in a joint, while the load factor itself did. Elsewhere another
mechanism has another range: on a wall of 10 by 10 a solution of 0.5765 has 0.57202 ... 0.58853, one of 0.5791, found
with larger steps, 0.57472 ... 0.59115.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.program.kinematic import ConeProgram
from mbla.program.program import Program
from mbla.program.static import StaticForm, fixed_mechanism_form
from mbla.solution.cone_solvers.choice import cone_solver
from mbla.solution.cone_solvers.cone_solution import ConeSolution, ConeSolver, Log
from mbla.solution.nonassociative.law_state import LawState, law_state, point_motion
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, ProgramRecord, Status
from mbla.solution.thresholds import EXACT_RESIDUAL

TOUCHING = (1e-6, 1e-8, 1e-10)
"""Velocities, over the largest contact speed, below which a point counts as at rest; the next one where the ends found
with it miss the law. States are exact to 1e-9 and better, so that noise stays below the first."""

END_RESIDUAL = EXACT_RESIDUAL
"""Residual up to which an end is a state of the law; that of the state found where that is larger."""

NOISE = 10.0
"""Velocities of points at rest, over the largest, reached ten times the residual of a state."""

TOLERANCE = 1e-10
"""Of the cone solver: at 1e-7 the ends were off by up to 4e-6 of the load factor, at 1e-9 by 6e-8."""

REGULARIZATION = 1e-8
"""Static regularisation: the set of forces has hardly an inside, and with 1e-11 the solver ends short."""

ITERATIONS = 80
"""An end that is found takes 10 to 50; programs without an inside may go on for hundreds and find nothing."""

ROUNDING = 1e-7
"""Share of the load factor (at least of dead load over live load) by which an end may lie beyond the factor found."""


@dataclass(frozen=True)
class FactorRange:
    """Least and greatest load factor for a mechanism, as states with its velocities.

    lower, upper : None where the end could not be found
    reason       : why an end is missing; None where none is
    """

    lower: LawState | None
    upper: LawState | None
    programs: tuple[ProgramRecord, ...]
    reason: Message | None = None


def factor_range(
    program: Program,
    state: LawState,
    settings: SolverSettings,
    log: Log,
    first_program: int,
    slope: FloatArray | float = 0.0,
) -> FactorRange:
    """Range of the load factor for the mechanism of a state.

    first_program : number of the first cone program in the records
    slope         : dilatancy of the flow rule (tangent), (n_points,) or one for all, zero without
    """
    search = _Search(program, state, slope, first_program)
    most = min(settings.max_iterations, ITERATIONS)
    settings = replace(settings, tolerance=TOLERANCE, regularization=REGULARIZATION, max_iterations=most)
    form: StaticForm | None = None
    for rest in dict.fromkeys(max(touching, NOISE * state.residual) for touching in TOUCHING):
        before, form = form, fixed_mechanism_form(program, point_motion(program, state, rest, slope))
        if before is not None and _are_same(before.cone_program, form.cone_program):
            continue
        solver: ConeSolver | None = None
        for kind in [*search.pending]:
            if kind not in search.pending:
                break
            cone_program = replace(form.cone_program, cost=SIGNS[kind] * form.cone_program.cost)
            number = first_program + len(search.records)
            if solver is None or solver.settings != settings:  # one that fell back on easier settings keeps these
                solver = cone_solver(cone_program, settings, log, has_inside=False)
            else:
                solver.update(cost=cone_program.cost)
            search.add(kind, form, solver.solve(number, SIGNS[kind] * program.scaling.live))
        if not search.pending:
            break
    lower, upper = (search.ends.get(kind) for kind in SIGNS)
    missing = "; ".join(f"{kind} end of the range: {why}" for kind, why in search.missing.items())
    reason = Message("range-not-found", missing) if missing else None
    return FactorRange(lower, upper, tuple(search.records), reason)


def _are_same(one: ConeProgram, other: ConeProgram) -> bool:
    """Whether two programs would have the same answer, bit for bit."""
    if one.matrix.shape != other.matrix.shape or not np.array_equal(one.rhs, other.rhs):
        return False
    return bool((one.matrix - other.matrix).count_nonzero() == 0 and np.array_equal(one.cost, other.cost))


SIGNS = {"lower": 1.0, "upper": -1.0}
"""Sign of the load factor in the cost of each end's program."""


@dataclass
class _Search:
    """Ends found so far, in words why others were not, and those still to be looked for."""

    program: Program
    state: LawState
    slope: FloatArray | float
    first_program: int
    ends: dict[str, LawState] = field(default_factory=dict)
    missing: dict[str, str] = field(default_factory=dict)
    pending: list[str] = field(default_factory=lambda: list(SIGNS))
    records: list[ProgramRecord] = field(default_factory=list)

    def add(self, kind: str, form: StaticForm, solution: ConeSolution) -> None:
        """Take what a program says of one end; it stays pending where its forces miss the law."""
        found = solution.status in WITH_VALUE
        status = STATIC_STATUS.get(solution.status, solution.status)
        self._record(kind, status, form, solution, found)
        if not found:  # where no forces fit, there is no other end either
            for none in tuple(self.pending) if status is Status.NO_EQUILIBRIUM else (kind,):
                self.missing[none] = NOT_FOUND.get(status, f"the solver ended without it ({status})")
                self.pending.remove(none)
            return
        factor = form.load_factor(solution.x)
        end = law_state(self.program, self.slope, form.forces(solution.x), self.state.velocities, factor)
        miss = max(end.residual, unbalanced(self.program, end))
        if miss > max(END_RESIDUAL, self.state.residual):
            self.missing[kind] = f"the forces found for it violate the joint law: residual {miss:.2g}"
            return
        self.pending.remove(kind)
        self.missing.pop(kind, None)
        self._keep(kind, end)

    def _keep(self, kind: str, end: LawState) -> None:
        """The end, or the state found where the end is not beyond it: that one fits the mechanism too."""
        program, found = self.program, self.state
        short = SIGNS[kind] * (end.load_factor - found.load_factor)
        size = max(abs(found.load_factor), program.dead_over_live)
        if short > max(ROUNDING, found.residual) * size:
            value = program.scaling.load_factor(end.load_factor)
            self.missing[kind] = f"the solver ended at {value:.6g}, on the wrong side of the factor found"
        else:
            self.ends[kind] = end if short <= 0.0 else found

    def _record(self, kind: str, status: Status, form: StaticForm, solution: ConeSolution, found: bool) -> None:
        value = self.program.scaling.load_factor(form.load_factor(solution.x)) if found else np.nan
        number = self.first_program + len(self.records)
        self.records.append(replace(solution.record(number, f"range, {kind}", value), status=status))


def unbalanced(program: Program, state: LawState) -> float:
    """Largest unbalanced force of a state, in mean block loads."""
    loads = program.dead_load + state.load_factor * program.live_load
    return float(np.abs(program.equilibrium_matrix @ state.forces.ravel() + loads).max(initial=0.0))


STATIC_STATUS = {Status.UNBOUNDED: Status.NO_EQUILIBRIUM, Status.NO_EQUILIBRIUM: Status.UNBOUNDED}
"""The adapter names verdicts for programs in velocities; in forces, infeasible and unbounded change places."""

NOT_FOUND = {
    Status.NO_EQUILIBRIUM: "no forces fit the mechanism closely enough",
    Status.UNBOUNDED: "there is none: forces that fit the mechanism carry any multiple",
}
