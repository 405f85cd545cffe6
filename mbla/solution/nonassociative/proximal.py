"""Non-associative flow by proximal steps of the exact joint law from the gravity state.

1. Gravity state x̄: forces under the dead load alone (:func:`mbla.solution.standing.standing.gravity_forces`).
2. Proximal step: equilibrium at a load factor λ, and the exact law for the part of the motion that the change of the
   forces leaves, v + ρ (x − x̄); x̄ then moves to x. Every point at which the steps stand still is a state of the exact
   law, for any ρ. A step works as a step of the load with joints of stiffness ρ; ρ = ε/‖x̄‖² with ε = 0.03 is free of
   units and of the number of contact points, and so large a step that a few lead to the end
   (``law_steps``). It falls where the forces grow, as they do in joints that dilatancy locks.
3. Where no step of the exact law is found, a convex one is made, with the friction of the forces before::

       max λ − ρ/2 ‖x − x̄‖²   s.t.   A x + f_D + λ f_L = 0,   ‖T‖ ≤ (μ − δ) N̄ + c + δ N,   −f_t ≤ N ≤ f_c

   after which x̄ moves 0.7 of the way; δ is the tangent of the dilatancy angle, zero by default. Where the forces
   hardly change any more, the convex step is repeated from the same x̄ with the friction of its own forces, which leads
   to the exact one.

It starts from the dead load, not from the associative forces: coming down from those, a sequence stays on states in
which joints are locked by forces that nothing but dilatancy would bring about. The load factor is not unique even so.
Measured on walls 1, 3, 5 of Ferris and Tin-Loi: 0.64154, 0.35582, 0.21438, in two steps of 20 to 30 factorisations
together; with convex steps alone 0.64015, 0.35582, 0.21587 in 7 to 13 programs of about 18 iterations. The range of the
load factor for the mechanism is the same on both ways.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, field, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.program.program import Program
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.linear_algebra.stiffness import stiffness_of
from mbla.solution.nonassociative.law_state import (
    NEAR_ZERO,
    LawState,
    SequenceResult,
    as_asked,
    law_state,
    not_at_rest,
    residual_with_closing,
    spread_of,
)
from mbla.solution.nonassociative.law_steps import (
    Step,
    Stepper,
    continuing_step,
    lagged_step,
    moved_by,
    next_step,
    repeated_step,
)
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord, Status
from mbla.solution.standing.standing import gravity_forces
from mbla.solution.standing.weak_spring_continuation import Weakening
from mbla.solution.thresholds import APPROXIMATE_RESIDUAL, EXACT_RESIDUAL, SOLVED_RESIDUAL

STEP = 0.03
"""ε: size of a proximal step relative to the gravity state; 0.01 needs more iterations a step, 0.1 more steps."""

MOVE = 0.7
"""Share of a convex step that the anchor moves."""

EXACT_STEP, CONVEX_STEP = "exact step", "convex step"
"""Kinds of steps as the listing names them."""

CONVEX_STEPS = 4
"""Convex steps after the first before an exact one is looked for again; each ends with a try of Newton's method."""

LITTLE = 2e-2
"""Relative change of the forces by a step after which Newton's method goes on or lagged steps from one anchor do: steps
by the interior-point method on the exact law would mostly have to be shortened then. On a planar wall of 40 by 40 units
such a step took 150 to 200 factorisations, and the forces changed by 1e-5."""

SHORTENED = 0.1
"""Relative change of the forces by an exact step that had to be shortened after which convex steps follow: on the same
wall three such steps had raised the load factor by 7 %, and eight more by 1 %; four convex ones at a fifth of the cost
of those raised it by 3 %."""

EXACT, SETTLED = 1e-12, 1e-9
FITTING, LAST_STEPS = 1e-9, 8
"""Residual and relative change of the load factor at which the steps have come to rest; or a residual, and the steps
after it. Sliding at an angle to friction counts in the residual with the square of the angle, in the load factor with
the angle itself: the residual alone does not tell."""

SOLVED = EXACT_RESIDUAL
WARNED = SOLVED_RESIDUAL
APPROXIMATE = APPROXIMATE_RESIDUAL
"""Residuals up to which a state that did not come to rest is solved, solved with a warning, approximate."""

BELOW_PEAK = 1e-2
"""Share by which the load factor may lie below one that the steps passed through before that is remarked on."""

PATIENCE, PROGRESS, MOVES = 20, 0.5, 1e-3
"""Steps in which the residual must fall to this share, or the load factor move by that one."""

MOST_WORK = 600
"""Factorisations within which an exact step must bring the residual to the share ``PROGRESS`` of the lowest so far; as
many as an interior path takes. On a cross vault of 184 blocks 900 more had brought nothing."""

NO_FORCE = 1e-15
"""Forces below this, in mean loads of a block, are none, but rounding: the unit of the program takes their place."""


@dataclass
class ProximalRun:
    """What a sequence has so far; ``states`` in the order in which they were reached.

    stress_free : state of the stress-free assembly under the dead load where it was found before
    lowest : residual of the exact step that was the last to miss the law by much less than those before
    spent  : factorisations since then
    """

    stepper: Stepper
    records: list[ProgramRecord]
    states: list[LawState] = field(default_factory=list)
    peak: float = -np.inf
    stress_free: Weakening | None = None
    lowest: float = np.inf
    spent: int = 0

    def in_vain(self, step: Step, state: LawState) -> bool:
        """Take note of a step; whether many factorisations have gone since the law was last missed by much less."""
        self.spent += step.work
        if step.exact and state.residual <= PROGRESS * self.lowest:
            self.lowest, self.spent = state.residual, 0
        return self.spent > MOST_WORK and self.lowest <= APPROXIMATE

    @property
    def program(self) -> Program:
        """The program that is solved."""
        return self.stepper.program

    @property
    def best(self) -> LawState | None:
        """The state that fits the law best."""
        return min(self.states, key=lambda state: state.residual, default=None)


def solve_proximal(
    program: Program, associative: AssociativeResult, max_programs: int, settings: SolverSettings, log: Log
) -> SequenceResult:
    """Run the scheme without dilatancy; the associative result gives records and the stress-free state."""
    stepper = Stepper(stiffness_of(program), np.zeros(program.n_points), settings, log)
    run = ProximalRun(stepper, list(associative.programs), stress_free=associative.stress_free)
    gravity = gravity_state(run)
    if isinstance(gravity, SequenceResult):
        return gravity
    return steps_from(run, gravity, max_programs)


def gravity_state(run: ProximalRun) -> FloatArray | SequenceResult:
    """Forces of the gravity state, (n_points, components), or how the scheme ends where there is none."""
    found = gravity_forces(run.program, run.stepper.settings, run.stepper.log, run.records, run.stress_free)
    return _broken_off(run, found) if isinstance(found, ConeSolution) else found


def steps_from(run: ProximalRun, anchor: FloatArray, max_programs: int, before: Step | None = None) -> SequenceResult:
    """Steps from given forces, (n_points, components), until they come to rest; ``before`` led to them."""
    fitting, convex_steps, rho, first = 0, 0, step_size(run.program, anchor), len(run.states)
    deadline = run.stepper.settings.deadline
    for _ in range(max_programs):
        started = time.perf_counter()
        step, kind, convex_steps = _step(run, anchor, rho, before, convex_steps)
        late = deadline is not None and time.monotonic() > deadline
        if step is None:
            return _late(run) if late else finished(run, "no further iteration was found")
        state = _keep(run, kind, step, time.perf_counter() - started)
        fitting += state.residual <= _fits(run)
        if (state.residual <= EXACT and _settled(run.states[first:])) or fitting > LAST_STEPS:
            return finished(run, "")
        if _is_enough(run, run.states[first:]):
            return _as_asked(run, step, rho)
        if _stands_still(run.states[first:]) or run.in_vain(step, state):
            return finished(run, "the iterations came no closer")
        if late:
            return _late(run)
        anchor = step.forces if kind == EXACT_STEP else MOVE * step.forces + (1.0 - MOVE) * anchor
        before, rho = step, min(rho, step_size(run.program, anchor))
    return finished(run, f"did not converge in {max_programs} iterations")


def _fits(run: ProximalRun) -> float:
    """Residual that counts as fitting: that asked for, between those of a state at rest and of a solved one."""
    return max(FITTING, min(run.stepper.settings.residual, SOLVED))


def _late(run: ProximalRun) -> SequenceResult:
    return SequenceResult(Status.TIME_LIMIT, run.best, "the time limit was reached", tuple(run.records))


def _step(
    run: ProximalRun, anchor: FloatArray, rho: float, before: Step | None, convex_steps: int
) -> tuple[Step | None, str, int]:
    """The next step, its kind, and how many convex ones are to be made before an exact one is looked for again."""
    number = len(run.records) + 1
    step = _exact_step(run, anchor, rho, before, number) if convex_steps == 0 else None
    if step is not None:
        return step, EXACT_STEP, _convex_after(step)
    if before is not None and moved_by(before, before.forces) <= LITTLE:
        step = repeated_step(run.stepper, anchor, rho, before, number)
    if step is None:
        step = lagged_step(run.stepper, anchor, rho, number)
    if step is not None and step.exact:
        return step, EXACT_STEP, 0
    if step is not None and before is not None:  # the next exact one need not be looked for among longer ones
        step = replace(step, shorter=before.shorter)
    return step, CONVEX_STEP, convex_steps - 1 if convex_steps > 0 else CONVEX_STEPS


def _exact_step(run: ProximalRun, anchor: FloatArray, rho: float, before: Step | None, number: int) -> Step | None:
    """The next step of the exact law; after one that moved little only if the joints go on as they did."""
    if before is not None and before.exact and moved_by(before, before.forces) <= LITTLE:
        return continuing_step(run.stepper, anchor, rho, before)[0]
    return next_step(run.stepper, anchor, rho, before, number)


def _convex_after(step: Step) -> int:
    """How many convex steps are to follow an exact one: none unless it was shortened and moves little."""
    return CONVEX_STEPS if step.shorter > 0 and moved_by(step, step.forces) <= SHORTENED else 0


def _settled(states: list[LawState]) -> bool:
    """Whether the last step left the load factor where it was."""
    here, before = states[-1].load_factor, states[-2].load_factor if len(states) > 1 else np.inf
    return abs(here - before) <= SETTLED * max(abs(here), abs(before)) or (here == 0.0 and before == 0.0)


def _is_enough(run: ProximalRun, states: list[LawState]) -> bool:
    """Whether a rough state is asked for and here: residual and change of the load factor at most that.

    Below ``SOLVED`` the steps go on until they rest: the last ones, close to the end, cost little.
    """
    wanted = run.stepper.settings.residual
    if wanted <= SOLVED or len(states) < 2 or states[-1].residual > wanted:
        return False
    here, before = states[-1].load_factor, states[-2].load_factor
    near = abs(here - before) <= wanted * abs(here)
    return near and is_rough_enough(run.program, run.stepper.slope, states[-1], wanted)


def _as_asked(run: ProximalRun, last: Step, rho: float) -> SequenceResult:
    """The last state, or the one after it where Newton's method alone leads there: that is often the end itself."""
    started = time.perf_counter()
    further, _ = continuing_step(run.stepper, last.forces, min(rho, step_size(run.program, last.forces)), last)
    state = run.states[-1]
    if further is not None:
        after = _keep(run, EXACT_STEP, further, time.perf_counter() - started)
        state = after if after.residual <= state.residual else state
    return rough_result(run.program, run.stepper.slope, state, run.stepper.settings.residual, tuple(run.records))


def is_rough_enough(program: Program, slope: FloatArray | float, state: LawState, wanted: float) -> bool:
    """Whether a rough state is asked for, by ``wanted`` above ``SOLVED``, and this is one as verification sees it.

    slope : tangent of the dilatancy angle, (n_points,) or one for all
    """
    return wanted > SOLVED and residual_with_closing(program, slope, state) <= wanted


def rough_result(
    program: Program, slope: FloatArray | float, state: LawState, wanted: float, records: tuple[ProgramRecord, ...]
) -> SequenceResult:
    """A state with which a scheme may end, by ``wanted`` above ``SOLVED``, judged by its residual in verification.

    slope : tangent of the dilatancy angle, (n_points,) or one for all
    """
    if state.residual <= SOLVED:
        return SequenceResult(Status.SOLVED, state, "", records)
    return as_asked(state, residual_with_closing(program, slope, state), wanted, records)


def _stands_still(states: list[LawState]) -> bool:
    """Whether the last steps brought nothing: the law does not hold better, and no worse than it must."""
    earlier, later = states[:-PATIENCE], states[-PATIENCE:]
    if not earlier:
        return False
    best = min(state.residual for state in earlier)
    factors = [state.load_factor for state in later]
    if max(factors) - min(factors) > MOVES * max(abs(factor) for factor in factors):
        return False
    return best <= APPROXIMATE and min(state.residual for state in later) > PROGRESS * best


def finished(run: ProximalRun, cause: str) -> SequenceResult:
    """The best state, judged by its residual; ``cause`` says why the steps ended, empty where they came to rest."""
    best, live = run.best, run.program.scaling.live
    if best is None:
        return SequenceResult(Status.NOT_VERIFIED, None, cause, tuple(run.records))
    words = Message("law-missed", f"{cause}: residual of the joint law {best.residual:.2g}" if cause else "")
    remarks: list[Message] = []
    least = NEAR_ZERO * run.program.moved_over_live(best.velocities)
    if run.peak - best.load_factor > BELOW_PEAK * max(abs(run.peak), abs(best.load_factor), least):
        passed = (
            f"the load factor lies below {run.peak * live:.6g}, which the steps passed through: between the two the "
            "structure moves to another state, and may come to rest under a load that it does not survive at first"
        )
        remarks.append(Message("below-passed-load", passed))
    if best.residual <= SOLVED:
        return SequenceResult(Status.SOLVED, best, "", tuple(run.records), remarks=tuple(remarks))
    spread, wanted, slope = spread_of(best, run.states), run.stepper.settings.residual, run.stepper.slope
    if is_rough_enough(run.program, slope, best, wanted):
        rough = rough_result(run.program, slope, best, wanted, tuple(run.records))
        return replace(rough, spread=spread, remarks=(*remarks, *rough.remarks))
    result = not_at_rest(best, words, tuple(run.records), spread)
    return replace(result, remarks=(*remarks, *result.remarks))


def _keep(run: ProximalRun, kind: str, step: Step, seconds: float) -> LawState:
    """Record a step and the state that it reached."""
    state = law_state(run.program, run.stepper.slope, step.forces, step.velocities, step.load_factor)
    before = run.states[-1].load_factor if run.states else np.nan
    change = abs(step.load_factor - before) / max(abs(step.load_factor), 1e-300)
    run.states.append(state)
    if step.exact:
        run.peak = max(run.peak, step.load_factor)
    value = run.program.scaling.load_factor(step.load_factor)
    status = Status.SOLVED if step.exact or kind == CONVEX_STEP else Status.APPROXIMATE
    run.records.append(ProgramRecord(len(run.records) + 1, kind, status, value, change, step.work, seconds))
    return state


def _broken_off(run: ProximalRun, solution: ConeSolution) -> SequenceResult:
    status = solution.status
    if status in (Status.NO_EQUILIBRIUM, Status.UNBOUNDED):  # said of a program of the scheme, not of the structure
        status = Status.NOT_VERIFIED
    reason = f"program {len(run.records)} of the sequence ended without a solution ({solution.verdict})"
    return SequenceResult(status, None, reason, tuple(run.records))


def step_size(program: Program, forces: FloatArray) -> float:
    """ρ of a step from given forces, (n_points, components); the same for a part alone and beside others."""
    size = float((forces**2).sum())
    return STEP * program.own_unit / (size if size > NO_FORCE**2 else 1.0)
