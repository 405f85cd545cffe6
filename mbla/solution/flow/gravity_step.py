"""One implicit step of the dead load on the stress-free assembly: where the path of elastic joints begins.

The dead load acts at once on joints without stress, and each block is held where it stands by a very weak spring::

    A x + f_D − ε S u = 0,   S the diagonal of A Aᵀ

Springs keep blocks in place that nothing pushes, and make a solution exist always. What they carry of a structure that
stands is next to nothing, and falls in proportion with ε; of one that falls it is a share of its weight whatever ε is.
The products of the law fall tenfold after every step that goes most of its way, once they are even, so that balance and
law are reached together: with larger ones joints push each other apart, and a history is remembered that nothing has
caused.

A support that settles later is held, f_L·u = 0, and λ is its reaction: from R0 of the program, in units of f_L.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from mbla.solution.flow.peak_step import EXACT, PeakStep, centred, solved_peak
from mbla.solution.flow.renewed_springs import Renewed, are_light, renewed_springs
from mbla.solution.law.elastic_joints import ElasticJoints, Memory, StepState
from mbla.solution.law.exact_law import forces_by_law
from mbla.solution.law.joint_equations import JointStep, residual_of
from mbla.solution.law.joint_step import direction_of, length_of
from mbla.solution.law.newton import by_newton
from mbla.solution.nonassociative.collapse_state import CollapseState
from mbla.solution.nonassociative.imbalance import imbalance

NEWTON, NEAR = 20, (1e-3, 1e-5, 1e-8)
"""Iterations of Newton's method at most, and products over n₀² with whose states it begins, where it came to nothing
from joints without stress."""

STEPS = 100
"""At most; 10 to 25 are usual where a dead load is carried."""

SHORT, BLOCKED = 0.03, 2
"""Reach of a direction that leads nowhere, and how many in a row block the way."""

BACK, HIGHEST, SLOWER = 1e4, 1e4, 0.3
"""Factor on the products of a way that is blocked, which goes on from the central path of its forces, their greatest
over n₀², and factor on them from there on."""

HELD, WEAKER = (1e-8, 1e-5), 1e-4
"""ε over the mean stiffness of a joint, tried in turn until the step is solved, then factor on it."""

FITS, SHARP = 1e-7, 1e-11
"""Misfit of the law with which a state of points is accepted where the forces of the law carry every block, a tenth of
what a verification allows; and the misfit with which it is accepted however light its blocks are."""

FALL, LONG, WHOLE, LEAST = 0.1, 0.5, 0.9, 1e-8
"""Factor on the products after a step of sufficient length, that length relative to the full one, the same where
interfaces have a law of their own, whose bounds are curved, and least products over n₀²."""

BALANCED, COMPATIBLE, EVEN = 1e-6, 1e-6, 30.0
"""Unbalanced force in mean loads of a block, incompatible velocity over the largest, and largest product N y over that
wanted, with which a state is taken."""

RELIEFS = 4
"""Times that springs let go at most."""

SMALL = 1e-12
"""Products over n₀² with which a state by renewed springs is taken at most."""

CARRIED, STANDS = 1e-6, 2e-5
"""Greatest force of the springs of a structure that stands: of a block over its load, and, where interfaces have a law
of their own, in mean loads of a block."""

LIGHTER, STAYS = 0.3, 0.5
"""Factor on the springs where the step was not solved with much weaker ones, and share of their force that remains in
a structure that falls."""


@dataclass(frozen=True)
class Gravity:
    """The structure at rest under its dead load.

    state   : forces and displacements (as velocities over a time of 1)
    memory  : what the joints remember of it
    force   : n₀, the mean dead load of a point
    settled : whether the step was solved
    carried : whether the joints carry the dead load
    steps   : factorisations
    step    : that was solved
    """

    state: StepState
    memory: Memory
    force: float
    settled: bool
    carried: bool
    steps: int
    step: JointStep


def gravity_step(joints: ElasticJoints, least_force: float = 0.0, memory: Memory | None = None) -> Gravity:
    """The dead load in one step.

    least_force : n₀ of a structure without weight; 1 where that is none
    memory      : what joints of points alone remember from before; none: they are without stress
    """
    program, n = joints.program, joints.program.n_points
    force = float(np.abs(program.dead_load).sum()) / max(n, 1) or least_force or 1.0
    held = program.facts.settling_support and bool(np.any(program.live_load))
    fresh = Memory.stress_free(joints) if memory is None else memory
    step = JointStep(joints, fresh, 1.0, driven=held, work=0.0, held=WEAKER * HELD[0] * joints.matrix.size)
    exact, spent = _of_points(joints, least_force) if joints.laws else _exactly(step)
    if exact is not None:
        return _relieved(step, exact, force, spent)
    for share in HELD:
        step = JointStep(joints, fresh, 1.0, driven=held, work=0.0, held=share * joints.matrix.size)
        weaker = replace(step, held=WEAKER * step.held)
        state, settled, more, exact = _solved(step, force, exactly=None if joints.laws else partial(_exactly, weaker))
        spent += more
        if exact is not None:
            return _relieved(weaker, exact, force, spent)
        if settled:
            break
    begun = (step, state) if settled else None
    if settled:
        close, fits, more, _ = _solved(weaker, force, state)
        spent += more
        if not fits:
            lighter = replace(step, held=LIGHTER * step.held)
            there, fits, more, _ = _solved(lighter, force, state)
            settled, spent = fits and _stays(step, state, lighter, there), spent + more
        elif not _stays(step, state, weaker, close):
            least = WEAKER * share * force**2  # with larger products springs hold joints open that nothing has opened
            wanted, good = EXACT if joints.laws else SHARP, partial(_carries, least=least)
            start = PeakStep(weaker, LEAST * force**2, close, 0.0)
            sharp, more = solved_peak(start, force, lambda found: found.misfit <= wanted, good)
            spent += more
            if sharp.is_solved and _is_carried(joints, sharp.state):
                return _relieved(weaker, sharp.state, force, spent)
            settled = False
    if begun is not None and not settled:
        found = _renewed(*begun, force)
        spent += found.spent
        if found.state is not None:
            return _at_rest(found.step, found.state, force, spent)
    return replace(_at_rest(step, state, force, spent), settled=settled, carried=False)


def _renewed(step: JointStep, state: StepState, force: float) -> Renewed:
    """Where the structure rests by springs that are renewed from a state on."""
    return renewed_springs(step, state, lambda *near: _solved(near[0], force, near[1])[:3], partial(_rest, force=force))


def _relieved(step: JointStep, state: StepState, force: float, spent: int) -> Gravity:
    """What is carried, with springs that let go where they carry more than a block of little weight allows."""
    for _ in range(RELIEFS):
        if step.joints.laws or are_light(step, state):
            break
        anew = replace(step, holds_at=state.u)
        exact = by_newton(anew, state.u, state.factor, most=NEWTON)
        spent += exact.iterations
        if exact.is_solved:
            step, state = anew, exact.state_of(anew)
        elif state.opening.any():  # not of Newton's method
            found = _renewed(step, state, force)
            step, state = (step, state) if found.state is None else (found.step, found.state)
            return _at_rest(step, state, force, spent + found.spent)
        else:
            break
    return _at_rest(step, state, force, spent)


def _rest(step: JointStep, state: StepState, force: float) -> tuple[StepState | None, int]:
    """The state at rest near one in which springs carry nothing, None where they carry a share; factorisations."""
    joints = step.joints
    if not _is_carried(joints, state) or not are_light(step, state):
        return None, 0
    good = partial(_carries, least=SMALL * force**2)
    enough = (lambda found: found.misfit <= EXACT) if joints.laws else good
    sharp, spent = solved_peak(PeakStep(step, LEAST * force**2, state, 0.0), force, enough, good)
    return (sharp.state if sharp.is_solved and _is_carried(joints, sharp.state) else None), spent


def _of_points(joints: ElasticJoints, least_force: float) -> tuple[StepState | None, int]:
    """The state of the points alone where it keeps within the laws of the interfaces, so that none of them moves; None
    where it does not; factorisations.
    """
    found = gravity_step(joints.without_laws, least_force)
    state = found.state
    laws = [rows.at_rest(state.normal, state.shear) for rows in joints.rows] if found.carried else [None]
    within = tuple(one for of_rows in laws if of_rows is not None for one in of_rows)
    if len(within) < len(joints.laws):
        return None, found.steps
    still = np.zeros(len(joints.program.dead_load) - len(state.u))
    return replace(state, u=np.append(state.u, still), interfaces=within), found.steps


def _at_rest(step: JointStep, state: StepState, force: float, spent: int) -> Gravity:
    joints = step.joints
    memory = step.memory.after(joints, joints.velocities(state.u), state.normal, joints.motions(state.u))
    return Gravity(state, replace(memory, shear=state.shear), force, True, True, spent, step)


def _exactly(step: JointStep, near: StepState | None = None) -> tuple[StepState | None, int]:
    """The state by Newton's method, None where that comes to none that carries the dead load; factorisations.

    near : a state to begin from; else joints without stress
    """
    joints = step.joints
    u, factor = (np.zeros(len(joints.program.dead_load)), 0.0) if near is None else (near.u, near.factor)
    found = by_newton(step, u, factor, most=NEWTON)
    state = found.state_of(step)
    solved = found.is_solved and _is_carried(joints, state)
    return state if solved else None, found.iterations


def _stays(step: JointStep, state: StepState, weaker: JointStep, close: StepState) -> bool:
    """Whether what springs carry stays as they get weaker: of what falls."""
    before, after = (float(np.abs(one.held * at.u).max(initial=0.0)) for one, at in ((step, state), (weaker, close)))
    return after > STAYS * before


def _carries(found: PeakStep, least: float) -> bool:
    """Whether a state is as near to the law as the verdict on it needs: its products are small, at most ``least``, and
    the forces of the law itself carry every block. Those of the state rest on products, which may hold a light one.
    """
    step, state, joints = found.step, found.state, found.step.joints
    if joints.laws or found.misfit > FITS or found.sigma > least:
        return False
    forces = forces_by_law(step, state.u)
    return _is_carried(joints, replace(state, normal=forces.normal, shear=forces.shear))


def _is_carried(joints: ElasticJoints, state: StepState) -> bool:
    """Whether the forces of a state carry the dead load without springs, block by block."""
    if not np.any(joints.program.dead_load):
        return True
    if joints.laws:
        return float(np.abs(joints.unbalanced(state)).max(initial=0.0)) <= STANDS
    return imbalance(joints.program, CollapseState(state.forces, state.u, state.factor, 0.0)) <= CARRIED


def _solved(
    step: JointStep,
    force: float,
    near: StepState | None = None,
    exactly: Callable[[StepState], tuple[StepState | None, int]] | None = None,
) -> tuple[StepState, bool, int, StepState | None]:
    """The state of the step, whether it solves it, factorisations, and the state that Newton's method made of it.

    near    : a state that is near; else all joints are pressed alike
    exactly : Newton's method from a state
    """
    sigma, spent, blocked, fall = force**2, 0, 0, FALL
    least = LEAST * force**2
    nearer = list(NEAR)
    state, sigma = (_start(step.joints, force, sigma), sigma) if near is None else (near, least)
    while True:
        residual = residual_of(step, state)
        even = float(residual.products.normal.max(initial=0.0)) < EVEN * sigma
        settled = even and sigma <= least and residual.unbalanced < BALANCED
        settled = settled and residual.incompatible(step.joints, state) < COMPATIBLE
        if exactly is not None and nearer and even and sigma <= nearer[0] * force**2:
            exact, more = exactly(state)
            spent, nearer = spent + more, [each for each in nearer if each * force**2 < sigma]
            if exact is not None:
                return state, True, spent, exact
        found = None if settled or spent >= STEPS else direction_of(step, state, residual, sigma)
        if found is None:
            return state, settled, spent, None
        direction, reach = found
        spent, blocked = spent + 1, blocked + 1 if reach < SHORT else 0
        state = state.plus(direction, length_of(reach))
        if blocked == BLOCKED:
            sigma, blocked, fall = min(BACK * sigma, HIGHEST * force**2), 0, SLOWER
            state = centred(step.joints, state, sigma, 0.95)
        elif reach > (WHOLE if step.joints.laws else LONG) and even:
            sigma = max(fall * sigma, least)


def _start(joints: ElasticJoints, force: float, sigma: float) -> StepState:
    """All joints pressed alike."""
    program, limits = joints.program, joints.program.limits
    none = np.zeros((program.components - 1, program.n_points))
    normal = force * np.sqrt(joints.normal)
    middle = 0.5 * (limits.compression - limits.tension)[joints.crushable]
    normal[joints.crushable] = np.minimum(normal[joints.crushable], middle)
    return StepState(
        u=np.zeros(len(program.dead_load)),
        factor=0.0,
        normal=normal,
        opening=sigma / (normal + limits.tension),
        shear=none,
        slip=none.copy(),
        speed=sigma / joints.limit(normal),
        crushing=sigma / joints.room(normal),
        interfaces=tuple(law.start(normal, sigma) for law in joints.laws),
    )
