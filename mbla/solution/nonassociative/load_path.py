"""The load path: the live load raised from zero step by step, the state of the joints carried along.

After Orduña and Lourenço 2005 II (doi:10.1016/j.ijsolstr.2005.02.048): each step keeps the load factor fixed and looks
for equilibrium by the exact law of joints without dilatancy, from the forces of the step before
(``joint_law``, f_L·u free). Which points open and slide, and in which order, is the path's; the
stiffness of the joints, the same in all directions, is an assumption of the path, and so is its start, the least forces
that carry the dead load.

The path ends where no further step is found, however short. That alone is no collapse: a path also stalls where it
would have to jump, and where the solver fails. It is one where a mechanism that fits the exact law is found at the load
factor reached; it is looked for by steps with a free load factor from the last state
(:mod:`mbla.solution.nonassociative.proximal`). Otherwise the path is said to have stalled.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.sections.analysis import PathScheme
from mbla.program.program import Program
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.linear_algebra.stiffness import stiffness_of
from mbla.solution.nonassociative.interior_joints import exact_law
from mbla.solution.nonassociative.interior_step import interior_step
from mbla.solution.nonassociative.joint_law import exact_step, joint_state
from mbla.solution.nonassociative.law_state import SequenceResult, law_state
from mbla.solution.nonassociative.law_steps import FITS, NEWTON_STEPS, Step, Stepper, continued
from mbla.solution.nonassociative.proximal import SOLVED, ProximalRun, gravity_state, steps_from
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import PathPoint, ProgramRecord, Status

STIFFNESS = 1.0
"""ρ of a step: at a fixed load factor it scales the velocities only."""

SHORTEST = 1e-6
"""Share of the associative load factor below which a step is not shortened."""

MEETS = 1e-4
"""Share of the load factor within which the mechanism must lie at the end of the path."""

FARTHEST = 4
"""Times the steps asked for, after which a path without end is given up."""

LAST_STEPS = 30
"""Steps with a free load factor from the end of the path."""


@dataclass(frozen=True)
class _Path:
    """What was walked so far, and the load factor at which no state was found (inf if none)."""

    last: Step
    points: tuple[PathPoint, ...]
    blocked: float = np.inf


def solve_path(
    program: Program, associative: AssociativeResult, scheme: PathScheme, settings: SolverSettings, log: Log
) -> SequenceResult:
    """Follow the load path without dilatancy; the associative factor over ``scheme.steps`` is the step."""
    stepper = Stepper(stiffness_of(program), np.zeros(program.n_points), settings, log)
    run = ProximalRun(stepper, list(associative.programs), stress_free=associative.stress_free)
    gravity = gravity_state(run)
    if isinstance(gravity, SequenceResult):
        return gravity
    scale = 1.0 if associative.state is None else abs(associative.state.load_factor)
    started = time.perf_counter()
    path = _follow(run, gravity, scale, scheme.steps)
    late = settings.deadline is not None and time.monotonic() > settings.deadline
    if path is None:
        status = Status.TIME_LIMIT if late else Status.NOT_VERIFIED
        reason = "the time limit was reached" if late else "the path stalled: no state was found under the dead load"
        return SequenceResult(status, None, reason, tuple(run.records))
    run.records.append(_record(run, path, time.perf_counter() - started))
    if late:
        return replace(_stalled(run, path, "the time limit was reached"), status=Status.TIME_LIMIT)
    if path.blocked == np.inf:
        return _stalled(run, path, f"the path did not end within {FARTHEST} times the associative load factor")
    return _end_of(run, path, scale)


def _follow(run: ProximalRun, gravity: FloatArray, scale: float, steps: int) -> _Path | None:
    """All steps to the end; None where not even the first state is one of the exact law."""
    first = _step_at(run.stepper, gravity, 0.0, None, 1)
    if first is None:
        return None
    path = _Path(first, (_point(run.stepper, first, 0),))
    length, deadline = scale / steps, run.stepper.settings.deadline
    while len(path.points) <= FARTHEST * steps:
        here = path.last.load_factor
        if path.blocked - here <= SHORTEST * scale or (deadline is not None and time.monotonic() > deadline):
            break
        target = min(here + length, 0.5 * (here + path.blocked))
        step = _step_at(run.stepper, path.last.forces, target, path.last, len(path.points) + 1)
        if step is None:
            path = replace(path, blocked=target)
        else:
            path = replace(path, last=step, points=(*path.points, _point(run.stepper, step, len(path.points))))
    return path


def _step_at(stepper: Stepper, anchor: FloatArray, load_factor: float, before: Step | None, number: int) -> Step | None:
    """The state at a load factor from given forces, None where none is found."""
    start = None if before is None else continued(stepper, before, anchor, fixed_load=load_factor)
    step = None if start is None else _newton(stepper, anchor, start[0], load_factor)
    if step is not None:
        return step
    result = interior_step(
        stepper.stiffness,
        exact_law(stepper.program, stepper.slope),
        anchor,
        STIFFNESS,
        load_factor,
        stepper.log,
        number,
        fixed_load=True,
        deadline=stepper.settings.deadline,
    )
    return _newton(stepper, anchor, result.velocities, load_factor) if result.converged else None


def _newton(stepper: Stepper, anchor: FloatArray, velocities: FloatArray, load_factor: float) -> Step | None:
    step = exact_step(
        stepper.stiffness, stepper.slope, anchor, STIFFNESS, velocities, load_factor, NEWTON_STEPS, fixed_load=True
    )
    if step.residual > FITS:
        return None
    return Step(anchor, STIFFNESS, step.velocities, load_factor, step.forces, True, step.factorizations, step.residual)


def _point(stepper: Stepper, step: Step, number: int) -> PathPoint:
    """Points open and sliding at the end of a step."""
    program = stepper.program
    state = joint_state(stepper.stiffness, stepper.slope, step.anchor, STIFFNESS, step.velocities)
    opens = state.forces[:, 0] <= -program.limits.tension
    return PathPoint(
        step=number,
        load_factor=program.scaling.load_factor(step.load_factor),
        open=int(np.count_nonzero(opens)),
        slide=int(np.count_nonzero(state.slips & ~opens)),
        residual=step.unbalanced,
    )


def _end_of(run: ProximalRun, path: _Path, scale: float) -> SequenceResult:
    """The mechanism at the end of the path, or the path as stalled."""
    found = steps_from(run, path.last.forces, LAST_STEPS)
    reached, live = path.last.load_factor, run.program.scaling.live
    if found.state is None or found.state.residual > max(SOLVED, run.stepper.settings.residual):
        return _stalled(run, path, "no mechanism that fits the law was found there")
    if abs(found.state.load_factor - reached) > MEETS * max(scale, abs(reached)):
        away = f"{found.state.load_factor * live:.6g}"
        if found.state.load_factor < reached:
            return _stalled(run, path, f"it has a peak there, and falls to {away} before a mechanism fits the law")
        return _stalled(run, path, f"the mechanism that fits the law belongs to {away}")
    return replace(found, programs=tuple(run.records), path=path.points)


def _stalled(run: ProximalRun, path: _Path, why: str) -> SequenceResult:
    """The last state of the path with the velocities of its last step, and in words that it is no collapse."""
    last = path.last
    state = law_state(run.program, run.stepper.slope, last.forces, last.velocities, last.load_factor)
    reached = run.program.scaling.load_factor(last.load_factor)
    reason = f"the load path stalled at {reached:.6g}, which is no collapse load: {why}"
    return SequenceResult(Status.NOT_VERIFIED, state, reason, tuple(run.records), path=path.points)


def _record(run: ProximalRun, path: _Path, seconds: float) -> ProgramRecord:
    value = run.program.scaling.load_factor(path.last.load_factor)
    return ProgramRecord(len(run.records) + 1, "load path", Status.SOLVED, value, np.nan, len(path.points), seconds)
