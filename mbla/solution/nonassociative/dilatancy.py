"""Flow with a dilatancy angle ψ between none and that of friction φ, a law of its own at every joint.

Sliding lifts by tan ψ: v_N = tan ψ ‖v_T‖ while N > 0, with friction μ as ever. The steps of the proximal scheme are
taken with that law (``joint_law``), from the dead load. Where they do not come to rest, the angle is
raised from zero, or lowered from the friction angle, and each state is the start of the next.

The load factor is unique at ψ = φ only. Between, joints that are confined lock under a dilatancy of a few degrees, and
what the structure carries depends
on whether they were locked before: wall 3 of Ferris and Tin-Loi has 0.3558 at ψ = 0 and 0.4025 from ψ = 0.02 φ on. The
state from the dead load is the answer; what the forces of associative flow lead to is said beside it. On a wall of 400
blocks the steps from the dead load creep at 0.02 and 0.1 φ and come to rest at 0.3 φ and above; lowering the angle ends
in a few steps everywhere.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.sections.analysis import ProximalScheme
from mbla.errors import Message
from mbla.program.program import Program
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.linear_algebra.stiffness import Stiffness, stiffness_of
from mbla.solution.nonassociative.law_state import SequenceResult
from mbla.solution.nonassociative.law_steps import Stepper
from mbla.solution.nonassociative.proximal import SOLVED, ProximalRun, gravity_state, steps_from
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord, Status
from mbla.solution.standing.weak_spring_continuation import Weakening

SHARES = (0.25, 0.5, 0.75, 1.0)
"""Angles on the way from none, or from that of friction, to the one asked for."""

FROM_ABOVE = 12
"""Steps from the associative forces, to see whether they lead to another state."""

DIFFERENT = 1e-6
"""Relative difference of two load factors that is remarked on."""

ROUNDING = 1e-12


@dataclass(frozen=True)
class _Tries:
    """What all tries share; ``records`` grows with each."""

    stiffness: Stiffness
    settings: SolverSettings
    log: Log
    most_steps: int
    records: list[ProgramRecord]
    stress_free: Weakening | None

    def run(self, slope: FloatArray) -> ProximalRun:
        """A new sequence with the tangents of given angles, (n_points,)."""
        stepper = Stepper(self.stiffness, slope, self.settings, self.log)
        return ProximalRun(stepper, self.records, stress_free=self.stress_free)

    def along(self, angles: list[FloatArray], forces: FloatArray) -> SequenceResult:
        """From given forces through angles, each from the state of the one before; the result at the last.

        angles : (n_points,) each [rad]
        forces : (n_points, components)  non-dimensional, compression positive
        """
        for angle in angles:
            result = steps_from(self.run(np.tan(angle)), forces, self.most_steps)
            if result.state is None or result.status is Status.TIME_LIMIT:
                break
            forces = result.state.forces
        return result


def solve_dilatancy(
    program: Program, associative: AssociativeResult, scheme: ProximalScheme, settings: SolverSettings, log: Log
) -> SequenceResult:
    """Run the scheme with the dilatancy of the joints; associative forces are used where there are any."""
    records = list(associative.programs)
    tries = _Tries(stiffness_of(program), settings, log, scheme.max_programs, records, associative.stress_free)
    limits = program.limits
    angle, most = np.arctan(limits.dilatancy), np.arctan(limits.friction)
    above = None if associative.state is None else associative.state.forces
    if above is not None and np.all(angle >= most * (1.0 - ROUNDING)):
        return tries.along([most], above)
    gravity = gravity_state(tries.run(limits.dilatancy))
    if isinstance(gravity, SequenceResult):
        return gravity
    direct = tries.along([angle], gravity)
    if direct.status is Status.TIME_LIMIT or not np.any(angle > 0.0):
        return direct
    if _fits(tries, direct):
        return direct if above is None else _with_state_from_above(tries, direct, angle, above)
    raised = tries.along([share * angle for share in (0.0, *SHARES)], gravity)
    if _fits(tries, raised) or above is None:
        return _best_of(tries, direct, raised)
    lowered = tries.along([most + share * (angle - most) for share in SHARES], above)
    words = "this state was reached from the forces of associative flow, and others may lie below it"
    remark = Message("load-factor-not-unique", words)
    return _best_of(tries, direct, raised, replace(lowered, remarks=(*lowered.remarks, remark)))


def _fits(tries: _Tries, result: SequenceResult) -> bool:
    return result.state is not None and result.state.residual <= max(SOLVED, tries.settings.residual)


def _best_of(tries: _Tries, *results: SequenceResult) -> SequenceResult:
    """The first that fits the law, else the one that fits it best."""
    best = next((result for result in results if _fits(tries, result)), None)
    if best is None:
        best = min(results, key=lambda result: np.inf if result.state is None else result.state.residual)
    return replace(best, programs=tuple(tries.records))


def _with_state_from_above(
    tries: _Tries, direct: SequenceResult, angle: FloatArray, above: FloatArray
) -> SequenceResult:
    """The result, and in words whether the associative forces lead to another state of the same law."""
    assert direct.state is not None
    from_above = replace(tries, most_steps=FROM_ABOVE).along([angle], above)
    here = direct.state.load_factor
    result = replace(direct, programs=tuple(tries.records))
    if not _fits(tries, from_above) or from_above.state is None:
        return result
    there = from_above.state.load_factor
    if abs(there - here) <= DIFFERENT * max(abs(here), abs(there)):
        return result
    value = tries.stiffness.program.scaling.load_factor(there)
    remark = Message(
        "load-factor-not-unique",
        f"the load factor is not unique: with the forces of associative flow locked in before, the same law holds at "
        f"{value:.6g}",
    )
    return replace(result, remarks=(*result.remarks, remark))
