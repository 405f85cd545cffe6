"""Non-associative flow by a sequence of associative programs, as published.

Portioli, Casapulla, Gilbert and Cascini 2014 (doi:10.1016/j.compstruc.2014.07.010), after Gilbert, Casapulla and Ahmed
2006 (doi:10.1016/j.compstruc.2006.02.005): each program has the yield line of a fictitious joint through the point
(N̄, μ N̄) that the true line has at the normal force N̄ of the programs before, but with a small slope::

    ‖T‖ ≤ c + c̄ + α μ N,    c̄ = (1 − α) μ N̄,    N̄ ← β N + (1 − β) N̄

so that sliding at N = N̄ needs the true shear while normality gives the dilatancy α μ only. The sequence starts from the
associative forces. Parameters: α ``slope`` (share of the friction slope that is kept), β ``averaging``, ``tolerance``,
``max_programs``. With a dilatancy angle ψ in the joints the slope is tan ψ where that is the larger.

Published runs take α slightly above zero and stop when the load factor settles. Measured on the walls of Ferris and
Tin-Loi: with α = 0.01 the load factor settles near 0.643, 0.402, 0.232 while single forces go on jumping and exceed
their true friction by up to half a block's weight; any α > 0 is a dilatancy, which locks confined joints. With α = 0
and β = 0.6 forces settle too, on solutions of the exact law (0.6415, 0.3731, 0.2197). So α = 0 is the default here, and
the sequence stops only when load factor and forces have both settled; the solution it finds is one of many.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.types import PublishedScheme
from mbla.program.kinematic import KinematicForm, kinematic_form
from mbla.program.program import Program
from mbla.program.yield_conditions import YieldLimits, yield_violation
from mbla.solution.associative import AssociativeResult, Log
from mbla.solution.clarabel_adapter import ClarabelProgram, ConeSolution
from mbla.solution.mechanics import mechanics_of
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Mechanics, ProgramRecord, Status

SPREAD_PROGRAMS = 10
"""Programs at the end of a sequence that did not settle, over which its spread is reported."""


DAMPING = 0.9
"""On the averaging weight whenever the load factor turns back by more than the tolerance: without it wall 5 goes to
and fro between two states for ever."""

FLOOR = 1e-9
"""Least fictitious cohesion, in mean block loads: without it the sliding multiplier of an open point has no cost and
no bound."""


@dataclass(frozen=True)
class SequenceResult:
    """Last program of the sequence; status SOLVED where it converged, APPROXIMATE where it did not."""

    status: Status
    mechanics: Mechanics | None
    reason: str
    programs: tuple[ProgramRecord, ...]


def solve_published(
    program: Program,
    associative: AssociativeResult,
    scheme: PublishedScheme,
    dilatancy: FloatArray,
    settings: SolverSettings,
    log: Log,
) -> SequenceResult:
    """Run the sequence from a solved associative program.

    dilatancy : (n_points,) tangent of the dilatancy angle, zero for non-associative flow
    """
    assert associative.mechanics is not None
    limits = program.limits
    scale = max(abs(program.scaling.live), 1e-300)
    slope = np.minimum(limits.friction, np.maximum(scheme.slope * limits.friction, dilatancy))
    normal = np.maximum(associative.mechanics.contact_forces[:, 0], 0.0) / program.scaling.force
    form = kinematic_form(program, _fictitious(limits, slope, normal), reduce_dry=False)
    solver = ClarabelProgram(form.cone_program, settings, log)

    weight = scheme.averaging
    records = list(associative.programs)
    factors = [associative.mechanics.load_factor]
    best: tuple[KinematicForm, ConeSolution] | None = None
    for _ in range(scheme.max_programs):
        number = len(records) + 1
        solver.update(cost=form.cost_for(_fictitious(limits, slope, normal)))
        solution = solver.solve(number, program.scaling.live)
        if solution.status not in (Status.SOLVED, Status.APPROXIMATE):
            return _broken_off(program, best, solution, records)
        best = (form, solution)
        factors.append(program.scaling.load_factor(solution.objective))
        change = abs(factors[-1] - factors[-2]) / max(abs(factors[-1]), 1e-12 * scale)
        records.append(_record(number, solution, factors[-1], change))
        forces = form.contact_forces(solution.z).reshape(-1, 3)
        excess = yield_violation(forces, limits).max(initial=0.0)
        mismatch = _friction_mismatch(form, solution, forces[:, 0], normal)
        if max(change, excess, mismatch) <= scheme.tolerance and solution.status is Status.SOLVED:
            return SequenceResult(Status.SOLVED, _mechanics(program, best), "", tuple(records))
        turned_back = len(factors) > 2 and (factors[-1] - factors[-2]) * (factors[-2] - factors[-3]) < 0
        if turned_back and max(change, mismatch) > scheme.tolerance:
            weight *= DAMPING
        normal = weight * np.maximum(forces[:, 0], 0.0) + (1 - weight) * normal
    last = factors[-SPREAD_PROGRAMS:]
    if solution.status is Status.APPROXIMATE:
        ended = f"(clarabel: {solution.solver_status})"
        reason = f"the programs of the sequence end short of the solver's tolerance {ended}"
        return SequenceResult(Status.APPROXIMATE, best and _mechanics(program, best), reason, tuple(records))
    reason = (
        f"the sequence did not settle in {scheme.max_programs} programs: the last {len(last)} load factors lie between "
        f"{min(last):.6g} and {max(last):.6g}, and forces exceed their friction by up to {excess:.2g} mean block loads"
    )
    return SequenceResult(Status.APPROXIMATE, best and _mechanics(program, best), reason, tuple(records))


def _fictitious(limits: YieldLimits, slope: FloatArray, normal: FloatArray) -> YieldLimits:
    """Yield lines of the next program: slope reduced, cohesion raised so that they meet the true ones at N̄."""
    return replace(
        limits, friction=slope, cohesion=limits.cohesion + np.maximum((limits.friction - slope) * normal, FLOOR)
    )


def _friction_mismatch(form: KinematicForm, solution: ConeSolution, normal: FloatArray, assumed: FloatArray) -> float:
    """Share of the power balance by which friction of the assumed normal forces misses that of the present ones."""
    program = form.program
    velocity = (program.equilibrium_matrix.T @ form.velocities(solution.x)).reshape(-1, 3)
    sliding = program.limits.friction * np.hypot(velocity[:, 1], velocity[:, 2])
    balance = max(abs(solution.objective), float(sliding @ np.abs(normal)), 1e-300)
    return float(sliding @ np.abs(normal - assumed)) / balance


def _mechanics(program: Program, best: tuple[KinematicForm, ConeSolution]) -> Mechanics:
    form, solution = best
    return mechanics_of(program, solution.objective, form.contact_forces(solution.z), form.velocities(solution.x))


def _record(number: int, solution: ConeSolution, load_factor: float, change: float) -> ProgramRecord:
    return ProgramRecord(
        number, "published", solution.status, load_factor, change, solution.iterations, solution.seconds
    )


def _broken_off(
    program: Program,
    best: tuple[KinematicForm, ConeSolution] | None,
    solution: ConeSolution,
    records: list[ProgramRecord],
) -> SequenceResult:
    number = len(records) + 1
    records.append(_record(number, solution, np.nan, np.nan))
    status = (
        solution.status if solution.status in (Status.TIME_LIMIT, Status.ITERATION_LIMIT) else Status.NUMERICAL_ERROR
    )
    reason = f"program {number} of the sequence ended without a solution (clarabel: {solution.solver_status})"
    return SequenceResult(status, best and _mechanics(program, best), reason, tuple(records))
