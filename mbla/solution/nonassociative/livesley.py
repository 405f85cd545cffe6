"""Livesley's correction: the friction pyramid replaced by a prism, once.

Livesley 1978, Int. J. Numer. Meth. Eng. 12, 1853-1871, doi:10.1002/nme.1620121207. The mechanism of associative flow
opens every joint that slides. In a second program the limit of shear at each point stays what it was under the normal
forces just found, so that sliding no longer opens::

    ‖T‖ ≤ c + μ N̄      instead of      ‖T‖ ≤ c + μ N,        N̄ from the associative program

The associative forces x̄ are within the new limits, so that its load factor λ₁ is never below the associative λ₀. Where
they are equal, the new mechanism belongs to x̄ and both together fit the exact law: λ₀ is then a load factor without
dilatancy too. Where λ₁ is above λ₀ no mechanism without dilatancy belongs to x̄: λ₀ overstates what the structure bears
for sure, and λ₁ all the more. The correction tells the one from the other; it does not find the lower load factor. It
depends on which of the associative forces, that are not unique, it starts from.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.program.kinematic import kinematic_form
from mbla.program.program import Program
from mbla.program.yield_conditions import YieldLimits
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.cone_solvers.choice import cone_solver
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.nonassociative.collapse_state import CollapseState, FlowResult, broken_off, collapse_state
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, ProgramRecord, Status
from mbla.solution.thresholds import APPROXIMATE_RESIDUAL, SOLVED_RESIDUAL

NO_LIMIT = 1e-9
"""Limit of shear, in mean block loads, below which an open point has none: its normal force is the solver's noise."""


def solve_livesley(program: Program, associative: AssociativeResult, settings: SolverSettings, log: Log) -> FlowResult:
    """The second program, from a solved associative one.

    The state has the corrected mechanism, with the associative forces and load factor or with those of the second
    program, whichever fits the exact law better.
    """
    before = associative.state
    assert before is not None
    form = kinematic_form(program, _prism(program.limits, before.forces[:, 0]))
    number, live = len(associative.programs) + 1, program.scaling.live
    solution = cone_solver(form.cone_program, settings, log).solve(number, live)
    valued = solution.status in WITH_VALUE
    change = (solution.objective - before.load_factor) / max(abs(before.load_factor), 1e-300) if valued else np.nan
    records = (*associative.programs, _record(number, solution, live, change))
    if not valued:
        return broken_off(solution, records)
    velocities = form.all_velocities(solution.x)
    candidates = (
        collapse_state(program, 0.0, before.forces, velocities, before.load_factor),
        collapse_state(program, 0.0, form.contact_forces(solution.z), velocities, solution.objective),
    )
    state = min(candidates, key=lambda found: found.residual)
    status, reason = _claim(state)
    remark = _remark(before.load_factor * live, solution.objective * live, state)
    return FlowResult(status, state, reason, records, remarks=(remark,))


def _prism(limits: YieldLimits, normal: FloatArray) -> YieldLimits:
    """Shear limits as the given normal forces leave them, whatever the normal forces of the next program."""
    limit = limits.cohesion + limits.friction * normal
    return replace(limits, friction=np.zeros_like(limit), cohesion=np.where(limit > NO_LIMIT, limit, 0.0))


def _claim(state: CollapseState) -> tuple[Status, str]:
    reason = f"one correction violates the joint law without dilatancy: residual {state.residual:.2g}"
    if state.residual <= SOLVED_RESIDUAL:
        return Status.SOLVED, ""
    return (Status.APPROXIMATE if state.residual <= APPROXIMATE_RESIDUAL else Status.NOT_VERIFIED), reason


def _remark(before: float, after: float, state: CollapseState) -> Message:
    figures = f"Livesley's correction changes the load factor from {before:.6g} to {after:.6g}"
    if state.residual <= SOLVED_RESIDUAL:
        return Message("livesley-confirms", f"{figures}: the associative forces bear a mechanism without dilatancy too")
    return Message(
        "livesley-overstates",
        f"{figures}: no mechanism without dilatancy belongs to the associative forces found, so that the associative "
        "load factor may overstate, and the corrected one all the more; flow_rule: non_associative finds a lower one",
    )


def _record(number: int, solution: ConeSolution, live: float, change: float) -> ProgramRecord:
    value = solution.objective * live if np.isfinite(change) else np.nan
    return solution.record(number, "livesley", value, abs(change))
