"""Forces for a mechanism and a mechanism for forces, in turn: two convex programs whose common solution fits the law.

Forces x in balance with the loads at λ within their yield conditions, and a motion u with f_L·u = 1 that closes no
joint, fit the law with dilatancy δ = tan ψ ≤ μ where their power says so. With s the sliding speeds::

    G(x, u) = −f_D·u − λ + Σ ((μ − δ) N + c) s + f_t y + f_c z  ≥  0,      0 where x and u fit the law

G is convex, even linear, in the forces for a given motion and convex in the motion for given forces. Each in turn is a
cone program of the kind of the associative one::

    forces  max (1 − τ) λ − Σ (μ − δ) s N       within the true cones: the associative matrix, w = (μ − δ) s on its rhs
    motion  min  −f_D·u + Σ ((μ − δ) N̄ + c) s   sliding against the friction of given normal forces: a cost

so that G falls with every program (alternate convex search: Gorski, Pfeuffer and Klamroth 2007,
doi:10.1007/s00186-007-0161-1). The motion program alone, with averaged normal forces, is the published procedure
(``published``), which chooses forces that happen to belong to a motion, not those that fit it best.

The penalty τ > 0 on the load factor prefers lower ones. G is an exact penalty: for small τ the forces are still those
of a state of the law, and the ones of the least load factor for its mechanism; for larger τ the pair leaves the law a
little, and comes back to it at another, lower mechanism.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.kinematic import KinematicForm, kinematic_form
from mbla.program.program import Program
from mbla.program.yield_conditions import YieldLimits
from mbla.solution.cone_solvers.choice import cone_solver
from mbla.solution.cone_solvers.cone_solution import ConeSolution, ConeSolver, Log
from mbla.solution.nonassociative.collapse_state import CollapseState, collapse_state
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord, Status

FLOOR = 1e-9
"""Least shear limit of the motion program, in mean block loads: without it the sliding speed of an open point has no
cost and no bound."""


@dataclass
class Alternation:
    """Both programs of one structure, each built on first use, with solvers that start from their last solution.

    slope   : (n_points,) tangent of the dilatancy angle
    records : a line for every program
    work, programs : iterations so far, and programs
    late    : whether one of them ran into the time limit
    """

    program: Program
    slope: FloatArray
    settings: SolverSettings
    log: Log
    records: list[ProgramRecord]
    work: int = 0
    programs: int = 0
    late: bool = False

    @cached_property
    def _forces(self) -> tuple[KinematicForm, ConeSolver]:
        form = self.forces_form()
        return form, cone_solver(form.cone_program, self.settings, self.log)

    @cached_property
    def _motion(self) -> tuple[KinematicForm, ConeSolver]:
        form = self.motion_form()
        return form, cone_solver(form.cone_program, self.settings, self.log)

    def forces_form(self) -> KinematicForm:
        """The associative program, whose dual variables are the forces."""
        return kinematic_form(self.program, self.program.limits)

    def motion_form(self) -> KinematicForm:
        """The program of the motion against given friction."""
        return kinematic_form(self.program, self._lagged(np.zeros(self.program.n_points)), reduce_dry=False)

    def states_from(self, velocities: FloatArray | None) -> Iterator[CollapseState]:
        """States of pairs of programs from velocities, (n_rows,), until one of them has no solution; none from None."""
        while velocities is not None and (found := self.pair(velocities, 0.0)) is not None:
            state, velocities = found
            yield state

    def pair(self, velocities: FloatArray, penalty: float) -> tuple[CollapseState, FloatArray | None] | None:
        """The state of the forces for velocities, (n_rows,), and the velocities for these forces, if there are any.

        None without forces.
        """
        found = self.forces_for(velocities, penalty)
        if found is None:
            return None
        forces, load_factor = found
        after = self.motion_for(forces[:, 0])
        motions = (velocities,) if after is None else (velocities, after)
        return min((self.state(forces, u, load_factor) for u in motions), key=lambda state: state.residual), after

    def state(self, forces: FloatArray, velocities: FloatArray, load_factor: float) -> CollapseState:
        """The state of forces, (n_points, components), and velocities, (n_rows,), with its residual."""
        return collapse_state(self.program, self.slope, forces, velocities, load_factor)

    def motion_for(self, normal: FloatArray) -> FloatArray | None:
        """Velocities, (n_rows,), against the friction of normal forces, (n_points,); None without a solution."""
        form, solver = self._motion
        solver.update(cost=self.motion_cost(form, normal))
        solution = self._solved(solver, "motion")
        if solution is None:
            return None
        u = form.velocities(solution.x)
        return np.asarray(u / float(form.program.live_load @ u))

    def motion_cost(self, form: KinematicForm, normal: FloatArray) -> FloatArray:
        """Cost of the motion program, (n_unknowns,), with the friction of normal forces, (n_points,)."""
        return form.cost_for(self._lagged(normal))

    def forces_for(self, velocities: FloatArray, penalty: float) -> tuple[FloatArray, float] | None:
        """Forces, (n_points, components), and load factor for velocities, (n_rows,); None without a solution."""
        form, solver = self._forces
        rhs, own = np.zeros(len(form.cone_program.rhs)), form.rhs_for(self.weight(velocities), live_power=1.0 - penalty)
        rhs[: len(own)] = own
        solver.update(rhs=rhs)
        solution = self._solved(solver, "forces")
        return None if solution is None else (form.contact_forces(solution.z), -float(solution.z[0]))

    def weight(self, velocities: FloatArray) -> FloatArray:
        """Power of sliding beyond dilatancy for a unit of each normal force, (n_points,).

        velocities : (n_rows,)
        """
        sliding = np.linalg.norm(self.program.contact_velocities(velocities)[:, 1:], axis=1)
        return np.asarray((self.program.limits.friction - self.slope) * sliding)

    def _solved(self, solver: ConeSolver, kind: str) -> ConeSolution | None:
        number, live = len(self.records) + 1, self.program.scaling.live
        solution = solver.solve(number, live)
        self.work += solution.iterations
        self.programs += 1
        self.late = self.late or solution.status is Status.TIME_LIMIT
        value = -float(solution.z[0]) * live if solution.usable else np.nan
        self.records.append(solution.record(number, kind, value))
        return solution if solution.usable else None

    def _lagged(self, normal: FloatArray) -> YieldLimits:
        """Friction beyond the dilatancy as given normal forces leave it, (n_points,)."""
        limits = self.program.limits
        held = np.maximum((limits.friction - self.slope) * normal + limits.cohesion, FLOOR)
        return replace(limits, friction=self.slope, cohesion=held)


def no_mechanism(program: Program, settings: SolverSettings, log: Log) -> bool:
    """Whether no motion without dilatancy gains work from the live load, as the solver finds: every joint would close.

    Normal forces alone carry every multiple of the live load then, whatever the friction.
    """
    none = np.zeros(program.n_points)
    alternation = Alternation(program, none, settings, log, [])
    return alternation.motion_for(none) is None and alternation.records[-1].status is Status.UNBOUNDED
