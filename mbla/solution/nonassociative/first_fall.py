"""What the load path says of a load factor without dilatancy: no collapse load lies above the end of the path.

Forces and mechanism may fit the joint law at a load factor that the structure never reaches, or never rests at:

- above the end of the path (``standing_path``), where it no longer stands before. Programs in turn
  (``alternation``) from the last state that stands lead to the state that belongs to the end; where
  they lead to none there is no answer;
- below it, where forces that friction holds after the dead load was applied are lost as joints slide. Under a given
  load it collapses at the end of the path then, its peak, and the lower figure is what is left while it moves;
- below zero, which is no load factor at all of a structure that stands.

Looks at single loads forget what joints go through on the way, so that a peak is no higher than elastic joints reach
from the dead load on (:mod:`mbla.solution.flow.least_reached`), and what is left below it hangs on how the structure
moves: it is approximate. The forces of a peak balance the loads within the yield conditions, which shows that it is
carried. A plank clamped in a wall and pulled out (associative 3.3086) stands at 2.17 under all of its load at once,
comes to 1.40 to 1.55 step by step, by the stiffness of its joints, and is at rest at 1.0720.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.solution.associative.repair import repaired_forces
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.flow.least_reached import BOTH, least_reached
from mbla.solution.nonassociative.default_scheme import state_near
from mbla.solution.nonassociative.law_state import LawState, SequenceResult, law_state
from mbla.solution.solution import ProgramRecord, Status
from mbla.solution.standing.standing_path import GROWTH, SMALL, PathState, StandingPath
from mbla.solution.thresholds import SOLVED_RESIDUAL

PEAK = 1e-3
"""Share of a load factor by which the end of the path must differ from it."""

NEAR = 1e-2
"""Share of a load factor by which a state may lie above the last one that stands: how joints share forces between them,
which follows from their stiffness, counts as much."""

NEUTRAL = 1e-5
"""Live over dead load up to which the end of the path is none: in neutral equilibrium it falls under any live load, and
is seen to from some millionths on, the share of its load that may be on its spring."""


@dataclass(frozen=True)
class PathVerdict:
    """A sequence as the load path leaves it.

    peak     : the last state that stands, where that lies above the load factor; its velocities are how it falls
    remark   : what a reader must know; None where there is nothing to say
    programs : records of the path
    """

    sequence: SequenceResult
    peak: LawState | None = None
    remark: Message | None = None
    programs: tuple[ProgramRecord, ...] = ()


def judged_by_path(
    path: StandingPath, sequence: SequenceResult, most: float, log: Log, first_program: int, *, peak: bool
) -> PathVerdict:
    """What the load path, at its beginning or followed before, makes of a state without dilatancy.

    most          : the associative load factor, infinite where there is none
    first_program : number of the first program in the records
    peak          : whether the path is followed beyond the load factor where it gets there
    """
    state, started = sequence.state, time.perf_counter()
    if state is None:
        return PathVerdict(sequence)
    if not path.last.stands:
        return _at_its_limit(path, sequence, most, log)
    margin = _margin(path, state)
    if most - state.load_factor <= margin:
        return PathVerdict(sequence)
    if state.load_factor > margin:
        path.follow(state.load_factor - margin)
    above = path.fall is not None and path.fall.load_factor <= state.load_factor - margin
    if not above and path.goes_on and (peak or state.load_factor <= 0.0):
        path.follow(state.load_factor + margin, within=2.0 * margin)
        path.follow_on(max(GROWTH * state.load_factor, SMALL * path.unit), most)
    beyond = path.stands_beyond(most)
    if beyond is not None:
        verdict = _contradicted(path, sequence, beyond)
    else:
        if above:
            sequence = _from_the_end(path, sequence, margin, log)
            margin = margin if sequence.state is None else _margin(path, sequence.state)
        verdict = _verdict(path, sequence, most, margin)
    sequence = replace(verdict.sequence, path=path.points())
    return replace(verdict, sequence=sequence, programs=(_record(path, first_program, time.perf_counter() - started),))


def _at_its_limit(path: StandingPath, sequence: SequenceResult, most: float, log: Log) -> PathVerdict:
    """Where standing is in doubt: no figure above the load that elastic joints of either stiffness reach.

    Columns that topple down a slope fall with joints of one stiffness and stand with another: the state that belongs to
    their fall may be a tenth of what a search from other states comes to.
    """
    found, reached = sequence.state, least_reached(path.program, most) if np.isfinite(most) else None
    assert found is not None
    if reached is None or reached.load_factor >= found.load_factor:
        return PathVerdict(sequence, remark=NOT_STANDING)
    live, records = path.program.scaling.live, list(sequence.programs)
    reason = REACHED.format(f"{reached.load_factor * live:.6g}", f"{found.load_factor * live:.6g}")
    near = state_near(path.program, reached.state, (1.0 + NEAR) * reached.load_factor, path.settings, log, records)
    if near is None or near.residual > SOLVED_RESIDUAL or near.load_factor < 0.0:
        unknown = replace(sequence, status=Status.NOT_VERIFIED, reason=reason, programs=tuple(records))
        return PathVerdict(unknown, peak=reached.state, remark=reason)
    lower = replace(sequence, status=Status.APPROXIMATE, state=near, reason=reason, programs=tuple(records))
    return PathVerdict(lower, remark=reason)


def _as_it_falls(path: StandingPath, sequence: SequenceResult, most: float) -> PathVerdict:
    """With a peak, no higher than the load that elastic joints reach: what is left below hangs on how it moves.

    Where they still gain at the end of their path they say nothing of a figure above it.
    """
    state, peak, live = sequence.state, _peak(path), path.program.scaling.live
    assert state is not None
    reached = least_reached(path.program, most, BOTH[:1]) if np.isfinite(most) else None
    ends = reached is not None and (reached.load_factor > state.load_factor or not reached.rises)
    if reached is not None and ends and reached.load_factor < peak.load_factor:
        peak = reached.state
    height, rest = (f"{each.load_factor * live:.6g}" for each in (peak, state))
    if peak.load_factor <= state.load_factor:
        reason = REACHED.format(height, rest)
        return PathVerdict(replace(sequence, status=Status.APPROXIMATE, state=peak, reason=reason), remark=reason)
    remark = FALLS.format(height, rest)
    if peak.load_factor > (1.0 + NEAR) * state.load_factor:
        sequence = _at_most_approximate(sequence, remark)
    return PathVerdict(sequence, peak=peak, remark=remark)


def _contradicted(path: StandingPath, sequence: SequenceResult, beyond: PathState) -> PathVerdict:
    """No load factor where the structure stands above the load at which the path is seen to fall."""
    assert sequence.state is not None
    assert path.fall is not None
    factors = (path.last, path.fall, beyond, sequence.state)
    up_to, falls, again, rest = (f"{each.load_factor * path.program.scaling.live:.6g}" for each in factors)
    reason = CONTRADICTED.format(up_to, falls, again, rest)
    return PathVerdict(replace(sequence, status=Status.NOT_VERIFIED, reason=reason), peak=_peak(path))


def _margin(path: StandingPath, state: LawState) -> float:
    """By how much the end of the path must differ from the load factor of a state."""
    return PEAK * max(abs(state.load_factor), PEAK * path.unit)


def _from_the_end(path: StandingPath, sequence: SequenceResult, margin: float, log: Log) -> SequenceResult:
    """The state at the end of the path, or the sequence as not verified."""
    program, live, found, end = path.program, path.program.scaling.live, sequence.state, path.fall
    assert found is not None
    assert end is not None
    records = list(sequence.programs)
    above, ends = f"{found.load_factor * live:.6g}", f"{end.load_factor * live:.6g}"
    most = min((1.0 + NEAR) * path.last.load_factor + margin, found.load_factor)
    neutral = end.load_factor <= NEUTRAL * path.unit
    there = state_near(program, _peak(path), most, path.settings, log, records, neutral=neutral)
    if there is None or there.residual > SOLVED_RESIDUAL:
        if found.load_factor - path.last.load_factor <= NEAR * found.load_factor:
            return replace(sequence, programs=tuple(records))
        reason = NO_STATE.format(above, ends, path.last.load_factor * live)
        return replace(sequence, status=Status.NOT_VERIFIED, reason=reason, programs=tuple(records))
    remarks = (*sequence.remarks, LOWER.format(above, ends))
    return SequenceResult(Status.SOLVED, there, "", tuple(records), remarks=remarks)


def _verdict(path: StandingPath, sequence: SequenceResult, most: float, margin: float) -> PathVerdict:
    """The peak, and what is to be said of it; beyond the associative load factor it falls whatever was looked at."""
    state, live, last = sequence.state, path.program.scaling.live, path.last.load_factor
    assert state is not None  # the path is not followed without
    rest, height = f"{state.load_factor * live:.6g}", f"{last * live:.6g}"
    if sequence.status is Status.NOT_VERIFIED:
        return PathVerdict(sequence, peak=_peak(path))
    if path.end is not None and last < state.load_factor - 2.0 * margin:
        why = path.end.weakening.reason or "it falls there"
        remark = NOT_SEEN.format(height, why)
        return PathVerdict(_at_most_approximate(sequence, remark), remark=remark)
    if last <= max(state.load_factor + margin, NEUTRAL * path.unit):
        return PathVerdict(sequence)
    if state.load_factor <= 0.0:
        reason = NO_LOAD.format(rest, height)
        return PathVerdict(replace(sequence, status=Status.NOT_VERIFIED, reason=reason), peak=_peak(path))
    if path.fall is None and last < most:
        remark = STANDS_ON.format(height, rest)
        unknown = replace(sequence, status=Status.NOT_VERIFIED, reason=remark)
        return PathVerdict(unknown, peak=_peak(path), remark=remark)
    return _as_it_falls(path, sequence, most)


def _at_most_approximate(sequence: SequenceResult, reason: Message) -> SequenceResult:
    """A sequence that is not solved for a reason of the path."""
    solved = sequence.status is Status.SOLVED
    return replace(sequence, status=Status.APPROXIMATE, reason=reason) if solved else sequence


def _peak(path: StandingPath) -> LawState:
    """The last state that stands, with the motion in which the structure falls."""
    program, last = path.program, path.last.weakening
    assert last.forces is not None  # it stands
    repaired = repaired_forces(program, last.forces, path.last.load_factor)  # of what the springs carry
    forces, load_factor = repaired or (last.forces, path.last.load_factor)
    return _moving_from(path, forces, load_factor)


def _moving_from(path: StandingPath, forces: FloatArray, load_factor: float) -> LawState:
    """Forces, (n_points, components), with the motion in which the structure falls, or else that of the live load."""
    program = path.program
    for state in (path.fall, path.last):
        way = None if state is None else state.weakening.displacements
        power = 0.0 if way is None else float(program.live_load @ way)
        if way is not None and power > 0.0:
            return law_state(program, 0.0, forces, way / power, load_factor)
    along = program.live_load / float(program.live_load @ program.live_load)
    return law_state(program, 0.0, forces, along, load_factor)


def _record(path: StandingPath, number: int, seconds: float) -> ProgramRecord:
    value = path.program.scaling.load_factor(path.last.load_factor)
    known = path.end is None or path.end.falls
    status = Status.SOLVED if known else Status.APPROXIMATE
    return ProgramRecord(number, "load path", status, value, np.nan, path.looks, seconds)


NOT_STANDING = Message(
    "path-not-seen", "the load path was not followed: no state under the dead load alone was found to start from"
)
NOT_SEEN = Message(
    "path-not-seen",
    "the load path was followed to {} only, and whether the structure stands up to the load factor was not seen: {}",
)
REACHED = Message(
    "found-above-path",
    "joints of a stiffness lead from the dead load to {} and no further; forces and mechanism fit the joint law of "
    "rigid ones at {} as well, which this loading does not reach",
)
LOWER = Message(
    "found-above-path",
    "the steps came to {}, above the load that the structure reaches: from the dead load on it no longer stands at {}, "
    "from where the steps led to the state given",
)
NO_STATE = (
    "forces and mechanism fit the joint law at {}, but from the dead load on the structure no longer stands at {}; "
    "it stands up to {:.6g}, and no mechanism that fits the law was found there"
)
CONTRADICTED = (
    "the load path is in doubt: from the dead load on the structure stands up to {} and is seen to fall at {}, but "
    "with joints of one stiffness at least it stands at {}; forces and mechanism fit the joint law at {}"
)
NO_LOAD = (
    "forces and mechanism fit the joint law at {}, which is no load of a structure that stands under its dead load: "
    "from the dead load on it stands up to {}, and no mechanism that fits the law was found there"
)
FALLS = Message(
    "peak-on-path",
    "the load path from the dead load rises to {} and falls from there to {}: the peak is the collapse load, the lower "
    "figure what is left while the structure moves",
)
STANDS_ON = Message(
    "peak-not-seen",
    "from the dead load on the structure stands at {} still, above the load factor of {}: its end was not seen",
)
