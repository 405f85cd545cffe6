"""Non-associative flow by a sequence of associative programs, as published.

Portioli, Casapulla, Gilbert and Cascini 2014 (doi:10.1016/j.compstruc.2014.07.010), after Gilbert, Casapulla and Ahmed
2006 (doi:10.1016/j.compstruc.2006.02.005): each program has the yield line of a fictitious joint through the point
(N̄, μ N̄) that the true line has at the normal force N̄ of the programs before, but with a small slope::

    ‖T‖ ≤ c + c̄ + α μ N,    c̄ = (1 − α) μ N̄,    N̄ ← β N + (1 − β) N̄

so that sliding at N = N̄ needs the true shear while normality gives the dilatancy α μ only. The sequence starts from the
associative forces. Parameters: α ``slope`` (share of the friction slope that is kept), β ``averaging``, ``tolerance``,
``max_programs``. With a dilatancy angle ψ in the joints the slope is tan ψ where that is the larger.

Published runs take α slightly above zero and stop when the load factor settles. Any α > 0 is a dilatancy, which locks
confined joints, and single forces go on jumping beyond their true friction. With α = 0 and β = 0.6 forces settle as
well, on solutions of the exact law. So α = 0 is the default here, and the sequence stops only when the load factor has
settled and forces and velocities fit the scheme's own law. Forces that jump along self-stresses are averaged over the
last programs: the mean balances the mean load factor and lies closer to the true cones. The solution is one of many.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.sections.analysis import PublishedScheme
from mbla.program.kinematic import kinematic_form
from mbla.program.program import Program
from mbla.program.yield_conditions import YieldLimits
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.cone_solvers.choice import cone_solver
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.nonassociative.collapse_state import CollapseState, FlowResult, broken_off, collapse_state
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, ProgramRecord, Status

SPREAD_PROGRAMS = 10
"""Last programs of a sequence over which forces are averaged, and its spread is reported where it did not settle."""

DAMPING = 0.9
"""Factor on the averaging weight whenever the load factor turns back by more than the tolerance: without it wall 5 goes
to and fro between two states for ever."""

FLOOR = 1e-9
"""Least fictitious cohesion, in mean block loads: without it the sliding multiplier of an open point has no cost and
no bound."""


def solve_published(
    program: Program,
    associative: AssociativeResult,
    scheme: PublishedScheme,
    dilatancy: FloatArray,
    settings: SolverSettings,
    log: Log,
) -> FlowResult:
    """Run the sequence from a solved associative program.

    dilatancy : (n_points,) tangent of the dilatancy angle, zero for non-associative flow
    """
    assert associative.state is not None
    limits, live = program.limits, program.scaling.live
    slope = np.minimum(limits.friction, np.maximum(scheme.slope * limits.friction, dilatancy))
    normal = associative.state.forces[:, 0]
    form = kinematic_form(program, _fictitious(limits, slope, normal), reduce_dry=False)
    solver = cone_solver(form.cone_program, settings, log)

    weight, best = scheme.averaging, None
    records, factors = list(associative.programs), [associative.state.load_factor]
    recent: list[tuple[FloatArray, float]] = []
    for _ in range(scheme.max_programs):
        number = len(records) + 1
        solver.update(cost=form.cost_for(_fictitious(limits, slope, normal)))
        solution = solver.solve(number, live)
        if solution.status not in WITH_VALUE:
            return _broken_off(best, solution, records)
        factors.append(solution.objective)
        change = abs(factors[-1] - factors[-2]) / max(abs(factors[-1]), 1e-12)
        records.append(solution.record(number, "published", program.scaling.load_factor(factors[-1]), change))
        forces, velocities = form.contact_forces(solution.z), form.all_velocities(solution.x)
        normal = weight * forces[:, 0] + (1 - weight) * normal
        recent = [*recent, (forces, factors[-1])][-SPREAD_PROGRAMS:]
        now = min(_states(program, slope, recent, velocities), key=lambda state: state.residual)
        if max(change, now.residual) <= scheme.tolerance and solution.status is Status.SOLVED:
            return FlowResult(Status.SOLVED, now, "", tuple(records))
        best = now if best is None or now.residual < best.residual else best
        turned_back = len(factors) > 2 and (factors[-1] - factors[-2]) * (factors[-2] - factors[-3]) < 0
        if turned_back and change > scheme.tolerance:
            weight *= DAMPING
    assert best is not None  # there is at least one program
    reason = _unsettled(program, scheme, factors, best, solution)
    return FlowResult(Status.APPROXIMATE, best, reason, tuple(records))


def _unsettled(
    program: Program, scheme: PublishedScheme, factors: list[float], best: CollapseState, solution: ConeSolution
) -> str:
    """Why a sequence that ran to its end is no answer, in words; ``solution`` is that of its last program."""
    last = [program.scaling.load_factor(factor) for factor in factors[-SPREAD_PROGRAMS:]]
    reason = (
        f"the sequence did not settle in {scheme.max_programs} programs: the last {len(last)} load factors lie between "
        f"{min(last):.6g} and {max(last):.6g}, and the best forces miss the law by {best.residual:.2g}"
    )
    if solution.status is Status.APPROXIMATE:
        reason = f"its programs end short of the solver's tolerance ({solution.verdict}); " + reason
    return reason


def _fictitious(limits: YieldLimits, slope: FloatArray, normal: FloatArray) -> YieldLimits:
    """Yield lines of the next program: slope reduced, cohesion raised so that they meet the true ones at N̄."""
    fictitious = np.maximum((limits.friction - slope) * normal, FLOOR)
    return replace(limits, friction=slope, cohesion=limits.cohesion + fictitious)


def _states(
    program: Program, slope: FloatArray, recent: list[tuple[FloatArray, float]], velocities: FloatArray
) -> list[CollapseState]:
    """The newest forces, and means over the last 2, 3, ... programs: each mean balances the mean load factor."""
    states = []
    for count in range(1, len(recent) + 1):
        forces = np.mean([forces for forces, _ in recent[-count:]], axis=0)
        factor = float(np.mean([factor for _, factor in recent[-count:]]))
        states.append(collapse_state(program, slope, forces, velocities, factor))
    return states


def _broken_off(best: CollapseState | None, solution: ConeSolution, records: list[ProgramRecord]) -> FlowResult:
    number = len(records) + 1
    records.append(solution.record(number, "published", np.nan, np.nan))
    if solution.status not in (Status.NO_EQUILIBRIUM, Status.UNBOUNDED):
        return broken_off(solution, records, best)
    what = "carry the dead load" if solution.status is Status.NO_EQUILIBRIUM else "give way to the live load"
    reason = (
        f"in program {number} of the sequence the friction that belongs to the forces before does not {what}; "
        "the structure may stand only by friction that something has locked in"
    )
    return broken_off(solution, records, best, reason)
