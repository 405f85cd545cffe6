"""Flow without dilatancy, or with a joint's own, by the path of elastic joints: the greatest load that is reached.

Forces, motion and history of the state are proved by statics and the law of elastic joints
(:mod:`mbla.solution.verification.elastic_law`); that the history is that of the loading is not.
"""

from __future__ import annotations

import itertools
import time
from dataclasses import dataclass, field, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.program.program import Program
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.flow.path_of_part import WHAT_MOVES, Extent, PathOfPart, path_of_part
from mbla.solution.flow.path_record import RISES, UNENDED, PathStep, Stop
from mbla.solution.flow.settings import PathSettings
from mbla.solution.flow.state_of_path import path_with_state, state_at_once, state_of_path
from mbla.solution.law.interfaces import NONE, Interfaces
from mbla.solution.nonassociative.by_stiffness import (
    another_answer,
    load_factors,
    may_hang_on_stiffness,
    ratios_asked,
)
from mbla.solution.nonassociative.collapse_state import CollapseState, FlowResult
from mbla.solution.nonassociative.locking import recession_cone
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, IterationRecord, PathPoint, ProgramRecord, Status
from mbla.solution.standing.standing import stress_free_state
from mbla.solution.thresholds import APPROXIMATE_RESIDUAL, NEAR_ZERO, SOLVED_RESIDUAL


def solve_by_elastic_path(
    program: Program,
    associative: AssociativeResult,
    slope: FloatArray,
    settings: SolverSettings,
    log: Log,
    interfaces: Interfaces = NONE,
) -> FlowResult:
    """The state at the greatest load of the path.

    slope      : (n_points,) tangent of the angle by which joints lift as they slide
    interfaces : of the model that have a law of their own
    """
    paths = Paths(program, associative, slope, settings, log, interfaces, list(associative.programs))
    ratio = settings.analysis.path.ratio
    found, state = path_with_state(program, lambda extent: paths.follow(ratio, extent), paths.state_on, interfaces)
    status, reason = _judged(paths, found, state)
    if found.stop is not Stop.LATE and status in (*WITH_VALUE, Status.UNBOUNDED):
        other = _other_answer(paths, found)
        if other is not None:
            least, reason = paths.followed[other], _hangs(paths, ratio, other)
            lower = paths.state_on(least) if least.load_factor < found.load_factor else None
            if lower is not None:
                ratio, found, state = other, least, lower
            status = Status.NOT_VERIFIED if state is None else Status.APPROXIMATE
    value = np.nan if state is None else program.scaling.load_factor(state.load_factor)
    if status is Status.SOLVED and found.gains(UNENDED, paths.above):
        status, reason = Status.APPROXIMATE, UNENDED_PATH.format(f"{value:.6g}", 100.0 * found.gain)
    return FlowResult(
        status,
        state,
        reason,
        tuple(paths.records),
        remarks=(RISING.format(100.0 * found.gain),) if found.gains(RISES, paths.above) else (),
        path=_curve(program, found),
        path_end=found.stop.value,
        path_gain=found.gain,
        path_last=found.moving * program.scaling.live,
        by_stiffness=load_factors(paths.followed, ratio, program.scaling.live, paths.above),
    )


@dataclass(frozen=True)
class Paths:
    """Paths of one part.

    slope      : (n_points,) tangent of the angle by which joints lift as they slide
    interfaces : of the model that have a law of their own
    records    : of programs so far, to which each path adds its own
    followed   : the last path of each ratio of stiffness
    """

    program: Program
    associative: AssociativeResult
    slope: FloatArray
    settings: SolverSettings
    log: Log
    interfaces: Interfaces
    records: list[ProgramRecord]
    followed: dict[float, PathOfPart] = field(default_factory=dict)

    @property
    def above(self) -> float:
        """Load factor of associative flow, which none exceeds; inf without."""
        return np.inf if self.associative.state is None else self.associative.state.load_factor

    def follow(self, ratio: float, extent: Extent = WHAT_MOVES) -> PathOfPart:
        """The path of joints of a ratio of stiffness."""
        live, number, count = self.program.scaling.live, len(self.records) + 1, itertools.count(1)
        started = time.perf_counter()

        def watch(step: PathStep) -> None:
            seconds, factor = time.perf_counter() - started, step.load_factor * live
            self.log(IterationRecord(number, next(count), factor, np.nan, np.nan, np.nan, step.reach, seconds))

        by = replace(PathSettings.of(self.settings), ratio=ratio, watch=watch)
        dilates = self.slope if np.any(self.slope) else None
        path = path_of_part(self.program, self.associative, by, dilates, self.interfaces, extent=extent)
        self.followed[ratio] = path
        self.records.append(_record(number, path, live, time.perf_counter() - started))
        return path

    def state_on(self, path: PathOfPart) -> CollapseState | None:
        """The state at the greatest load of a path."""
        if path.stop is Stop.AT_ONCE:
            return state_at_once(self.program, self.associative.state, self.slope, self.settings, self.log)
        return state_of_path(self.program, path, self.settings, self.log, self.interfaces)


def _judged(paths: Paths, found: PathOfPart, state: CollapseState | None) -> tuple[Status, str]:
    """Status and reason, in words, by the path alone."""
    program = paths.program
    status, reason = _claim(found, state, program.scaling.live)
    if status in WITH_VALUE and state is not None and _at_limit(program, found, state, paths.interfaces):
        return Status.APPROXIMATE, AT_LIMIT.format(f"{state.load_factor * program.scaling.live:.2g}")
    if status is Status.UNBOUNDED and not _carries_the_live_load(program):
        return Status.NOT_VERIFIED, NOT_ALONE
    return status, reason


def _other_answer(paths: Paths, found: PathOfPart) -> float | None:
    """The ratio of stiffness whose path comes to another load factor, the least; None where that does not matter."""
    shown, program = paths.settings.analysis.path.ratio, paths.program
    for ratio in ratios_asked(found, paths.associative, paths.settings.analysis):
        paths.follow(ratio)
    nothing, doubtful = NEAR_ZERO * program.dead_over_live, may_hang_on_stiffness(found, paths.associative)
    return another_answer(paths.followed, shown, nothing, paths.above, doubtful=doubtful)


def _hangs(paths: Paths, shown: float, other: float) -> Message:
    """How stiff joints are decides."""
    live = paths.program.scaling.live
    one, two = (f"{paths.followed[ratio].load_factor * live:.6g}" for ratio in (shown, other))
    return HANGS.format(one, f"{shown:g}", two, f"{other:g}")


def _record(number: int, path: PathOfPart, live: float, seconds: float) -> ProgramRecord:
    status = Status.SOLVED if path.is_answer else Status.APPROXIMATE
    status = status if np.isfinite(path.load_factor) else WITHOUT_FIGURE.get(path.stop, Status.NOT_VERIFIED)
    factor = path.load_factor * live if status in WITH_VALUE else np.nan
    return ProgramRecord(number, "elastic path", status, factor, np.nan, path.factorizations, seconds)


WITHOUT_FIGURE = {Stop.UNBOUNDED: Status.UNBOUNDED, Stop.LATE: Status.TIME_LIMIT}


def _carries_the_live_load(program: Program) -> bool:
    """Whether the live load alone is carried from the stress-free assembly, by joints without strengths.

    This is the limit of a load factor so large that the dead load does not count beside it.
    """
    alone = replace(program, dead_load=program.live_load, limits=recession_cone(program.limits))
    return stress_free_state(alone).rest is not None


def _at_limit(program: Program, found: PathOfPart, state: CollapseState, interfaces: Interfaces) -> bool:
    """Whether a load factor is next to nothing beside what its state misses of the law of interfaces.

    In shares of the dead load. Without a path, what interfaces crush as the structure moves at once is not known.
    """
    if interfaces is NONE or program.facts.settling_support:
        return False
    return found.stop is Stop.AT_ONCE or state.residual * program.dead_over_live > AT_MOST * abs(state.load_factor)


AT_MOST = 0.02
"""Share of the load factor that what its state misses of the law may be worth."""


def _curve(program: Program, found: PathOfPart) -> tuple[PathPoint, ...]:
    """Load factors over displacements, of the model."""
    if found.path is None or found.rest is None:
        return ()
    begins, live = found.rest.begins, program.scaling.live
    return tuple(
        PathPoint(number, step.displacement, (begins + step.load_factor) * live, step.open, step.slide, step.counted)
        for number, step in enumerate(found.path.steps, start=1)
    )


def _claim(found: PathOfPart, state: CollapseState | None, live: float) -> tuple[Status, str]:
    """Status and reason, in words, of what was found."""
    if found.stop in WITHOUT:
        status = Status.UNBOUNDED if found.stop is Stop.UNBOUNDED else Status.NOT_VERIFIED
        return status, WITHOUT[found.stop]
    if state is None:
        return Status.TIME_LIMIT if found.stop is Stop.LATE else Status.NOT_VERIFIED, NO_STATE
    if state.residual > APPROXIMATE_RESIDUAL:
        return Status.NOT_VERIFIED, MISSED.format(state.residual)
    if not found.is_answer:
        return Status.APPROXIMATE, NOT_SEEN.format(f"{state.load_factor * live:.6g}", found.stop)
    if state.residual > SOLVED_RESIDUAL:
        return Status.APPROXIMATE, MISSED.format(state.residual)
    return Status.SOLVED, ""


WITHOUT = {
    Stop.DOES_NOT_STAND: "with elastic joints the structure does not carry its dead load from the stress-free assembly",
    Stop.UNDECIDED: "whether elastic joints carry the dead load from the stress-free assembly was not decided",
    Stop.UNBOUNDED: "with elastic joints nothing gives way, however large the live load",
    Stop.UNLOADED: "no live load acts on it",
}
NOT_ALONE = (
    "with elastic joints nothing gives way on the path, but they were not seen to carry the live load alone, as they "
    "must if no multiple of it brings the structure down"
)
NO_STATE = "the path of elastic joints came to no state in balance"
MISSED = Message("elastic-law-missed", "the step of the greatest load fits the law of elastic joints to {:.2g} only")
NOT_SEEN = Message(
    "elastic-path-not-seen",
    "it stands at least to a load factor of {}, where the path of elastic joints could not be followed further ({})",
)
HANGS = Message(
    "elastic-path-by-stiffness",
    "how stiff its joints are decides: it starts to move at a load factor of {} where they have {} of their stiffness "
    "in shear, at {} with {}",
)
AT_LIMIT = Message(
    "elastic-path-at-limit",
    "it stands at its limit: its load factor, {}, is next to what its state misses of the law of elastic joints",
)
UNENDED_PATH = Message(
    "elastic-path-not-ended",
    "it stands at least to a load factor of {}: of it {:.2g} % were gained over the last half of the path of elastic "
    "joints, which ends before the load does",
)
RISING = Message(
    "elastic-path-rises",
    "the load still rises where the path of elastic joints ends: {:.2g} % of it were gained over its last half",
)
