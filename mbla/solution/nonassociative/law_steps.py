"""Steps of the exact joint law from one state to the next: what the proximal scheme and the load path are made of.

A step of size 1/ρ from forces x̄ is the exact law for joints of stiffness ρ (see ``joint_law``). It is
tried in turn by

1. Newton's method from the tangents of the step before: the joints go on as they do, found by one factorisation; where
   that went well the next step is longer, as forces only creep along their solutions then;
2. where the forces hardly changed, the interior-point method (``interior_step``) for a longer step,
   from a start close to the motion before, polished by 1;
3. the same for a step of the usual length, from a start less close;
4. the same for shorter steps, of 1/8 of the length each time; the next step begins with 8 times the length that went.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.linear_algebra.stiffness import Stiffness
from mbla.solution.nonassociative.interior_step import InteriorResult, interior_step
from mbla.solution.nonassociative.joint_equations import InteriorLaw, exact_law, lagged_law
from mbla.solution.nonassociative.joint_law import LawProblem, LawStep, exact_step
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.settings import SolverSettings

FITS = 1e-9
"""Unbalanced force, in mean block loads, at which a step counts as one of the exact law."""

NEWTON_STEPS = 10
"""Factorisations of one attempt by Newton's method; close by it takes one to three, far away it leads nowhere."""

LONGER = 4.0
CREEPING, START_SHARE = 1e-2, 0.1
"""Relative change of the forces by a step after which the next one is longer too where Newton's method fails, and the
share of the usual products that it starts from. On a spatial wall of 1,012 blocks four steps of 54 to 67 factorisations
became one of 35, of 60 from the usual products; smaller walls never come to it."""

REPEATS = 6
"""Lagged steps from one anchor. On a planar wall of 40 by 40 units Newton's method found the exact step after one to
five, of 40 factorisations the first and 20 each other one, where shortened exact steps of 150 to 200 led a hundredth as
far; with three at most the wall took a quarter longer."""

SHORTER = 8.0
SHORTEST, AFTER_CONVEX = 4, 2
"""Lengths that are tried before the exact law is given up from a state, and from one that convex steps led to: still
shorter ones lead back from there. On a planar wall of 60 by 60 units three of them, of 110 to 200 factorisations, left
the residual at 0.2 to 0.9 and undid what four convex steps of 150 had gained in the load factor."""


@dataclass(frozen=True)
class Stepper:
    """What all steps of a sequence share.

    slope : (n_points,) tangent of the dilatancy angle
    log   : called once per iteration of an interior-point method
    """

    stiffness: Stiffness
    slope: FloatArray
    settings: SolverSettings
    log: Log

    @property
    def program(self) -> Program:
        """The program that is stepped through."""
        return self.stiffness.program

    def law(self, anchor: FloatArray, rho: float) -> LawProblem:
        """The exact law of a step from forces, (n_points, components)."""
        return LawProblem(self.stiffness, self.slope, anchor, rho)


@dataclass(frozen=True)
class Step:
    """One step that was made.

    anchor : (n_points, components) forces that it started from
    exact  : whether the exact law holds to ``FITS``; else as far as the interior-point method got, or a lagged step
    unbalanced : unbalanced force, in mean block loads, of an exact step
    by_continuation : whether Newton's method went on from the step before
    shorter : times that the step was shortened
    work   : factorisations
    """

    anchor: FloatArray
    rho: float
    velocities: FloatArray
    load_factor: float
    forces: FloatArray
    exact: bool
    work: int
    unbalanced: float = 0.0
    by_continuation: bool = False
    shorter: int = 0


def next_step(stepper: Stepper, anchor: FloatArray, rho: float, before: Step | None, number: int) -> Step | None:
    """The next step of the exact law, or a shorter one; None where there is none in reach.

    anchor : (n_points, components)  forces, non-dimensional, compression positive
    before : the step that led to ``anchor``
    number : of the step in the sequence, for the log
    """
    step, work = continuing_step(stepper, anchor, rho, before)
    if step is not None:
        return step
    law = exact_law(stepper.program, stepper.slope)
    first = 0 if before is None else max(before.shorter - 1, 0)
    if before is not None and before.exact and moved_by(before, anchor) < CREEPING:
        result = _interior(stepper, law, anchor, before.rho / LONGER, before, number, START_SHARE)
        work += result.iterations
        if result.converged:
            return _polished(stepper, anchor, before.rho / LONGER, result, work)
        first = before.shorter  # the next longer one is longer than the one just tried in vain
    shortest = SHORTEST if before is None or before.exact else AFTER_CONVEX
    for shorter in range(min(first, shortest - 1), shortest):
        size = rho * SHORTER**shorter
        result = _interior(stepper, law, anchor, size, before, number)
        work += result.iterations
        if result.converged:
            step_made = _polished(stepper, anchor, size, result, work)
            return replace(step_made, shorter=shorter)
    return None


def continuing_step(stepper: Stepper, anchor: FloatArray, rho: float, before: Step | None) -> tuple[Step | None, int]:
    """The step that Newton's method finds where the joints go on as before, None where it finds none; its work.

    anchor : (n_points, components)  forces, non-dimensional, compression positive
    """
    start = None if before is None or not before.exact else continued(stepper, before, anchor)
    if before is None or start is None:
        return None, 0
    work = 1
    for size in _sizes_that_go_on(before, rho):
        step = exact_step(stepper.law(anchor, size), *start, NEWTON_STEPS)
        work += step.factorizations
        if step.residual <= FITS:
            return replace(_step_of(anchor, size, step, work), by_continuation=True), work
    return None, work


def step_near(stepper: Stepper, state: LawState, rho: float) -> Step | None:
    """The step from the forces of a state that Newton's method finds near its motion, None where it finds none."""
    step = exact_step(stepper.law(state.forces, rho), state.velocities, state.load_factor, 3 * NEWTON_STEPS)
    return _step_of(state.forces, rho, step, step.factorizations) if step.residual <= FITS else None


def _sizes_that_go_on(before: Step, rho: float) -> tuple[float, ...]:
    """ρ to try where the joints go on as before: longer after a step that went so, else the same and shorter ones."""
    if not before.by_continuation:
        return (rho,)
    shorter = (before.rho * LONGER,) if before.rho < rho else ()
    return (before.rho / LONGER, before.rho, *shorter)


def lagged_step(stepper: Stepper, anchor: FloatArray, rho: float, number: int) -> Step | None:
    """A step with the friction of the anchor's normal forces: convex, and there is always one.

    Near the end the exact step is close to it, and is returned instead.

    anchor : (n_points, components)  forces, non-dimensional, compression positive
    """
    result = _interior(stepper, lagged_law(stepper.program, stepper.slope, anchor), anchor, rho, None, number)
    return _polished(stepper, anchor, rho, result, result.iterations) if result.converged else None


def repeated_step(stepper: Stepper, anchor: FloatArray, rho: float, before: Step, number: int) -> Step | None:
    """Lagged steps from one and the same anchor, each with the friction of the forces of the one before.

    What they come to is the exact step; it is returned once Newton's method finds it from there. Where that is not so
    after ``REPEATS`` the last one is, and None where there is none. To be tried close to ``before`` only.

    anchor : (n_points, components)  forces, non-dimensional, compression positive
    """
    last, forces, near, work = None, anchor, before, 0
    for _ in range(REPEATS):
        law = lagged_law(stepper.program, stepper.slope, forces)
        result = _interior(stepper, law, anchor, rho, near, number, START_SHARE)
        work += result.iterations
        if not result.converged:
            break
        last = near = _polished(stepper, anchor, rho, result, work)
        if last.exact:
            break
        forces, work = last.forces, last.work
    return last


def moved_by(before: Step, anchor: FloatArray) -> float:
    """Change of the forces from the anchor of a step to ``anchor``, (n_points, components), relative."""
    return float(np.linalg.norm(anchor - before.anchor)) / max(float(np.linalg.norm(anchor)), 1e-300)


def _polished(stepper: Stepper, anchor: FloatArray, rho: float, result: InteriorResult, work: int) -> Step:
    """The exact step that Newton's method finds from the result of another, that result where it finds none."""
    polished = exact_step(stepper.law(anchor, rho), result.velocities, result.load_factor, NEWTON_STEPS)
    work += polished.factorizations
    return _step_of(anchor, rho, polished if polished.residual <= FITS else result, work)


def continued(stepper: Stepper, before: Step, anchor: FloatArray) -> tuple[FloatArray, float] | None:
    """Velocities and load factor if every joint goes on as at the end of a step, open, sliding or sticking.

    Velocities are (n_rows,), forces of the anchor (n_points, components), non-dimensional. None where the
    tangent cannot be factorised or the answer is not finite.
    """
    program, law = stepper.program, stepper.law(before.anchor, before.rho)
    solve = law.factorized(law.joints(before.velocities))
    if solve is None:
        return None
    unbalanced = program.equilibrium_matrix @ anchor.ravel() + program.dead_load
    answer = solve(np.append(-unbalanced, 1.0))
    return (answer[:-1], float(answer[-1])) if np.isfinite(answer).all() else None


def _interior(
    stepper: Stepper,
    law: InteriorLaw,
    anchor: FloatArray,
    rho: float,
    before: Step | None,
    number: int,
    share: float = 1.0,
) -> InteriorResult:
    return interior_step(
        stepper.stiffness,
        law,
        anchor,
        rho,
        0.0 if before is None else before.load_factor,
        stepper.log,
        number,
        velocities=None if before is None else before.velocities,
        deadline=stepper.settings.deadline,
        start_share=share,
    )


def _step_of(anchor: FloatArray, rho: float, result: LawStep | InteriorResult, work: int) -> Step:
    exact = isinstance(result, LawStep)
    unbalanced = result.residual if isinstance(result, LawStep) else 0.0
    return Step(anchor, rho, result.velocities, result.load_factor, result.forces, exact, work, unbalanced)
