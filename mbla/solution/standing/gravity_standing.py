"""Standing by the gravity step of elastic joints, at two ratios of their stiffness.

The dead load acts on the stress-free assembly; the structure carries it where the step is solved and the weak springs
that hold the blocks carry next to nothing, whatever the ratio of shear to normal stiffness. Where they carry a share of
the weight it falls. What proves standing are the forces and the displacements from which they follow by the law of
elastic joints that remember nothing.

Of 279 states of the decks the verdict is that of :mod:`.weak_spring_continuation` but for columns at the limit of
standing, which that does not decide.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.stiffness_shares import shares_in_units, shares_of
from mbla.solution.flow.gravity_step import Gravity, gravity_step
from mbla.solution.flow.peak_step import EXACT, PeakStep, solved_peak
from mbla.solution.law.elastic_joints import ElasticJoints
from mbla.solution.mechanics import lifted, motion_of
from mbla.solution.nonassociative.law_state import LawState, StepHistory
from mbla.solution.solution import Standing, StandingResult
from mbla.solution.standing.standing import DOUBTFUL, NO, NO_DEAD_LOAD, SELF_STRESS, UNKNOWN, YES

RATIOS = (0.4, 1.0)
"""Of shear to normal stiffness."""

SLOWLY = "the gravity step of elastic joints was not solved"
BY_STIFFNESS = "it depends on how stiff the joints are in shear against compression"


def standing_by_gravity(program: Program, carried: bool | None) -> StandingResult:
    """Standing of a part, with forces and displacements of the model where it stands.

    carried : whether some contact forces within the yield conditions are known to carry the dead load; None where that
              was not decided
    """
    if not np.any(program.dead_load):
        return StandingResult(Standing.YES, None, NO_DEAD_LOAD)
    joints = [ElasticJoints.of(program, shares_of(program), ratio) for ratio in RATIOS]
    found = [gravity_step(one) for one in joints]
    if all(gravity.carried for gravity in found):
        return _proved(program, joints[0], found[0])
    motion = np.linalg.norm(motion_of(program, found[0].state.u), axis=1)
    block = int(motion.argmax())
    if not all(gravity.settled for gravity in found):
        return StandingResult(Standing.DOUBTFUL, block, f"{DOUBTFUL}: {SLOWLY}")
    if any(gravity.carried for gravity in found):
        return StandingResult(Standing.DOUBTFUL, block, f"{DOUBTFUL}: {BY_STIFFNESS}")
    if carried is None:
        return StandingResult(Standing.DOUBTFUL, block, UNKNOWN)
    verdict, reason = (Standing.SELF_STRESS, SELF_STRESS) if carried else (Standing.NO, NO)
    return StandingResult(verdict, block, reason)


def _proved(program: Program, joints: ElasticJoints, gravity: Gravity) -> StandingResult:
    """The state at rest, solved until the law holds."""
    start = PeakStep(gravity.step, EXACT**2 * gravity.force**2, gravity.state, 0.0)
    state = solved_peak(start, gravity.force)[0].state
    forces = state.forces
    rest = LawState(forces, state.u, 0.0, 0.0, history=StepHistory(np.zeros_like(forces), joints.normal, joints.shear))
    return _on_model(program, rest)


def _on_model(program: Program, rest: LawState) -> StandingResult:
    """Forces, and the displacements that cause them on joints as stiff as their shares."""
    while program.reduction is not None:
        rest, program = lifted(program, rest), program.reduction.full
    assert rest.history is not None
    assert program.areas is not None
    scaling = program.scaling
    stiffness: FloatArray = rest.history.normal / shares_in_units(program.areas, scaling.units)
    size = float(np.median(stiffness[stiffness > 0.0])) * scaling.force**2 / scaling.live
    settlement = program.mechanism(rest.velocities) * size
    return StandingResult(Standing.YES, None, YES, scaling.forces(rest.forces), settlement)
