"""States of the exact law made sharp for blocks that carry little beside others.

The schemes without normality stop when the unbalanced force is nothing beside the mean load of a block. For a block a
hundred million times lighter than its neighbour that may be a share of all it carries, and of the load factor at which
it falls. Such a state is taken further, by

1. its own forces, repaired to balance every block: a light block between two of 1e6 times its weight, out of balance by
   1.6e-5 of what it carries, comes to 1e-16;
2. steps of the exact law (:mod:`mbla.solution.law.newton`) from its own forces, to the rounding of the forces instead
   of that of the mean load. Measured on a block of weight 1 that is pushed past one of 1e8: 0.399956 becomes 0.4;
3. the associative state, where forces and mechanism fit this law as they are: nothing slides in it that would have to
   lift. On a light block upon a heavy one, 1e8 apart, the steps break down, and blocks rock at the associative factor.

What fits best is kept, judged block by block. The same is tried where a sequence fell short of the law: a pile of 50
blocks that overhang exactly as far as they can, where any of 49 upper parts may tip, has no path to one of them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.associative.bounds import ZERO_FACTOR
from mbla.solution.associative.repair import repaired_forces
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.law.elastic_joints import ElasticJoints, Memory, together
from mbla.solution.law.joint_equations import JointStep
from mbla.solution.law.newton import by_newton
from mbla.solution.nonassociative.imbalance import misfit
from mbla.solution.nonassociative.law_state import LawState, SequenceResult, law_state
from mbla.solution.solution import Status
from mbla.solution.thresholds import EXACT_RESIDUAL, SOLVED_RESIDUAL

SHARP = 1e-12
"""Residual, and unbalanced force over what the block carries, that need no sharpening. On a light block upon one of 1e6
times its weight 9e-8 of the latter were worth 9e-7 of the load factor, and on wedges in a groove residuals of 1e-9, of
the convex programs, up to 1e-5."""

NEAR = 1e-5
"""Relative difference of load factors up to which the associative state is the same but sharper."""

FELL_SHORT = (Status.APPROXIMATE, Status.NOT_VERIFIED)
"""Of sequences that ended without a state of the law."""

MENDS = 0.5
"""Share of what was wrong after the step before that a step may leave and still be followed by another. The first may
leave more than there was: of what the convex programs end with the residual is small, but the load factor is not, and
with steps it is as small as the residual.
"""

STEP, MOST_STEPS, FACTORIZATIONS, SHIFT = 0.03, 3, 12, 1e-12
"""‖x‖² over the length of a step in the unit of the part, steps, factorisations of each, and the share of the stiffness
of all joints sticking that is added in them."""


def sharpened(
    program: Program, associative: AssociativeResult, slope: FloatArray | float, sequence: SequenceResult
) -> SequenceResult:
    """The sequence with a state that light blocks fit too; as given where they do, or where none fits better.

    slope : (n_points,) tangent of the dilatancy angle, or 0
    """
    if sequence.state is None or program.guided:
        return sequence
    fell_short = sequence.status in FELL_SHORT
    best, least = sequence.state, misfit(program, sequence.state)
    if not fell_short and least <= SHARP:
        return sequence
    for state in _candidates(program, associative, slope, sequence.state):
        found = misfit(program, state)
        if found < least:
            best, least = state, found
        if least <= SHARP:
            break
    if best is sequence.state:
        return sequence
    if least > EXACT_RESIDUAL:
        return sequence if fell_short else replace(sequence, state=best)
    if not fell_short and sequence.state.residual <= EXACT_RESIDUAL:
        return replace(sequence, state=best)
    return replace(sequence, status=Status.SOLVED, state=best, reason="", remarks=(), tolerance_requested=None)


def stepped(joints: ElasticJoints, state: LawState, most: int) -> tuple[LawState, int]:
    """The state after one step of the exact law to rounding, from the forces and near the motion of another.

    joints : of a stiffness of 1 each

    Returns that state, and the factorisations that the step took, ``most`` at most.
    """
    program = joints.program
    length = max(float((state.forces**2).sum()), np.finfo(float).tiny) / (STEP * program.own_unit)
    step = JointStep(joints, Memory(state.forces[:, 0], state.forces[:, 1:].T), length)
    found = by_newton(step, state.velocities, state.load_factor, most=most, balanced=0.0, shift=SHIFT)
    forces = together(found.forces.normal, found.forces.shear)
    return law_state(program, joints.dilatancy, forces, found.u, found.factor), found.iterations


def _candidates(
    program: Program, associative: AssociativeResult, slope: FloatArray | float, state: LawState
) -> Iterator[LawState]:
    """States near the given one, by repaired forces and by steps of the exact law; the associative one under this law.

    The associative one comes last, and where the given one fits well only if it has the same load factor: it may be
    another state, of a higher one, and not just a sharper one.
    """
    repaired = repaired_forces(program, state.forces, state.load_factor)
    if repaired is not None:
        yield law_state(program, slope, repaired[0], state.velocities, repaired[1])
    joints = ElasticJoints.of(program, np.ones(program.n_points), 1.0, np.broadcast_to(slope, program.n_points))
    factor, least, before = state.load_factor, misfit(program, state), np.inf
    for _ in range(MOST_STEPS):
        state, _ = stepped(joints, state, FACTORIZATIONS)
        found = misfit(program, state)
        least = min(least, found)
        yield state
        if not found <= MENDS * before:
            break
        before = found
    start = associative.state
    if start is not None and (least > SOLVED_RESIDUAL or abs(start.load_factor - factor) <= NEAR * abs(factor)):
        size = max(abs(start.load_factor), ZERO_FACTOR * program.dead_over_live)  # what its residual is relative to
        same = law_state(program, slope, start.forces, start.velocities, size)
        yield replace(same, load_factor=start.load_factor)
