"""Non-associative flow by interior paths: several starts in turn, the first that ends in a state of the exact law.

Each try follows one central path (``central_path``) by arc length. Whenever the residual has
fallen by another decade, steps of the exact law are tried from there, which end most paths early. The tries differ in
the pull towards the gravity state, which chooses the branch, and in the noise, which parts branches that meet.

Measured: walls, barrel vaults, blocks and wedges end after 40 to 180 factorisations with residuals of 1e-12, domes of
24 to 160 voussoirs and a cross vault of 184 blocks after 350 to 2,000 with 1e-9 to 1e-6. The load factor is not
unique: with κ = 10 the walls 1, 3 and 5 of Ferris and Tin-Loi (doi:10.1016/S0020-7403(99)00111-3) give 0.6417, 0.3572
and 0.2146 (least exact solutions known: 0.6390, 0.3558, 0.2086), with κ = 0 0.6415, 0.3869, 0.2208. Where a path folds
its end depends on rounding too: the same vault gave 0.2601 and 0.2628 from gravity states that differed by 1e-8.
"""

from __future__ import annotations

import itertools
import time
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from mbla.arrays import FloatArray
from mbla.deck.sections.analysis import InteriorScheme
from mbla.errors import Message
from mbla.program.program import Program
from mbla.solution.associative.solve_associative import AssociativeResult
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.linear_algebra.stiffness import Stiffness, stiffness_of
from mbla.solution.nonassociative.interior_path.one_try import SOLVED, Moment, Start, Try, go
from mbla.solution.nonassociative.law_state import LawState, SequenceResult
from mbla.solution.nonassociative.proximal import rough_result
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, ProgramRecord, Status
from mbla.solution.standing.standing import least_forces
from mbla.solution.thresholds import APPROXIMATE_RESIDUAL, SOLVED_RESIDUAL

WARNED = SOLVED_RESIDUAL
"""Residual up to which a state still counts as solved, with a remark."""

USABLE = APPROXIMATE_RESIDUAL
"""Residual up to which a load factor is worth reporting, as approximate."""

ROUGH = 0.1
"""Share of a residual above ``SOLVED`` that is asked for at which a path is left: points of it keep forces where joints
close by a little, which the verification counts as six times the residual here. Exact steps are tried before."""

LOG_EVERY = 10
"""Steps along the path between two lines of the log."""


def starts() -> Iterator[Start]:
    """Ways to begin, in the order in which they are tried; without end.

    The first keeps closest to loading from rest, as long as its path does not turn; in vaults it soon does, and from
    its turning points descents ended in local minima, where those of κ = 1 mostly did not.
    """
    yield Start(10.0, 0.1, 0, descends=False)
    yield Start(1.0, 0.1, 0)
    yield Start(0.0, 0.1, 1)
    yield Start(0.0, 1.0, 0)
    for seed in itertools.count(2):
        yield Start(1.0, 0.1, seed)
        yield Start(0.0, 0.1, seed)
        yield Start(0.0, 1.0, seed)


ONE_OF_MANY = Message(
    "load-factor-not-unique",
    "the load factor is that of one state of the law without dilatancy; other interior paths may end in other states "
    "(measured: load factors up to 1 % apart in domes, 5 % in cross vaults, 10 % in walls with openings)",
)


@dataclass
class _Tries:
    """What all tries share, and what they have brought so far."""

    program: Program
    stiffness: Stiffness
    settings: SolverSettings
    log: Log
    records: list[ProgramRecord]
    states: list[LawState] = field(default_factory=list)
    steps: int = 0

    def late(self) -> bool:
        """Whether the time limit has passed."""
        return self.settings.deadline is not None and time.monotonic() > self.settings.deadline

    @property
    def wanted(self) -> float:
        """Residual of a state with which no other start is tried; that of the exact law, however sharp it is asked for.

        Another start leads to another state, at the cost of the first, and mostly no nearer: on the tutorial dome the
        second ended at 2e-6, the third at 7e-9, the fourth had come to 8e-8 after 1,600 factorisations.
        """
        return max(SOLVED, ROUGH * self.settings.residual)

    @property
    def best(self) -> LawState | None:
        return min(self.states, key=lambda state: state.residual, default=None)


def solve_interior(
    program: Program,
    associative: AssociativeResult,
    scheme: InteriorScheme,
    settings: SolverSettings,
    log: Log,
    start: SequenceResult | None = None,
) -> SequenceResult:
    """Follow interior paths until one ends in a state of the exact law, at most ``scheme.tries``.

    associative : only gives the records it continues, unless ``start`` does
    start       : a sequence that stalled; its records are continued and its state counts as a try
    """
    records = list(associative.programs if start is None else start.programs)
    tries = _Tries(program, stiffness_of(program), settings, log, records)
    if start is not None and start.state is not None:
        tries.states.append(start.state)
    anchor = _gravity_state(tries)
    for begin in itertools.islice(_possible(anchor), scheme.tries):
        if tries.late():
            break
        state = _try(tries, begin, anchor, scheme.max_factorizations)
        if state is not None:
            tries.states.append(state)
            if state.residual <= tries.wanted:
                break
    return _result(tries, scheme)


def _possible(anchor: FloatArray | None) -> Iterator[Start]:
    return (begin for begin in starts() if begin.kappa == 0.0 or anchor is not None)


def _gravity_state(tries: _Tries) -> FloatArray | None:
    """The least forces that carry the dead load, (n_points, components); None where the program finds none."""
    found = least_forces(tries.program, tries.settings, tries.log, tries.records)
    return None if isinstance(found, ConeSolution) else found


def _try(tries: _Tries, begin: Start, anchor: FloatArray | None, most: int) -> LawState | None:
    """Carry out one try and record it; the best state it found, None where it could not begin."""
    attempt = Try(
        tries.stiffness,
        most,
        lambda moment: _log(tries, attempt, moment),
        tries.late,
        tries.wanted,
        tries.settings.residual,
    )
    go(attempt, begin, anchor)
    _record(tries, attempt.best, attempt.factorizations, time.perf_counter() - attempt.started)
    return attempt.best


def _log(tries: _Tries, attempt: Try, moment: Moment) -> None:
    tries.steps += 1
    if tries.steps % LOG_EVERY != 1:
        return
    tries.log(
        IterationRecord(
            program=len(tries.records) + 1,
            iteration=moment.factorizations,
            load_factor=tries.program.scaling.load_factor(moment.state.load_factor),
            gap=moment.state.residual,
            primal_residual=moment.state.residual,
            dual_residual=moment.sigma,
            step=moment.step,
            seconds=time.perf_counter() - attempt.started,
        )
    )


def _record(tries: _Tries, best: LawState | None, count: int, seconds: float) -> None:
    before = tries.states[-1].load_factor if tries.states else float("nan")
    factor = float("nan") if best is None else best.load_factor
    change = abs(factor - before) / max(abs(factor), 1e-300)
    tries.records.append(
        ProgramRecord(
            program=len(tries.records) + 1,
            kind="interior",
            status=_status(best),
            load_factor=tries.program.scaling.load_factor(factor),
            change=change,
            iterations=count,
            seconds=seconds,
        )
    )


def _status(best: LawState | None) -> Status:
    """Status of one try: only a state of the exact law counts as solved."""
    if best is None or best.residual > USABLE:
        return Status.NOT_VERIFIED
    return Status.SOLVED if best.residual <= SOLVED else Status.APPROXIMATE


def _result(tries: _Tries, scheme: InteriorScheme) -> SequenceResult:
    best, records = tries.best, tuple(tries.records)
    if best is None:
        status = Status.TIME_LIMIT if tries.late() else Status.NUMERICAL_ERROR
        reason = "the time limit was reached" if tries.late() else "no interior path could be begun"
        return SequenceResult(status, None, reason, records)
    if best.residual <= SOLVED:
        return SequenceResult(Status.SOLVED, best, "", records, _spread(tries, WARNED), (ONE_OF_MANY,))
    if best.residual <= tries.wanted:
        rough = rough_result(tries.program, 0.0, best, tries.settings.residual, records)
        return replace(rough, remarks=(*rough.remarks, ONE_OF_MANY))
    spread = _spread(tries, USABLE)
    reason = Message(
        "law-missed", f"no interior path ended in a state of the exact joint law: residual {best.residual:.2g}"
    )
    if tries.late():
        return SequenceResult(Status.TIME_LIMIT, best, "the time limit was reached; " + reason, records, spread)
    if best.residual <= WARNED:
        return SequenceResult(Status.SOLVED, best, reason, records, spread, (reason,))
    status = Status.APPROXIMATE if best.residual <= USABLE else Status.NOT_VERIFIED
    return SequenceResult(status, best, f"{reason} ({scheme.tries} tries)", records, spread)


def _spread(tries: _Tries, worst: float) -> tuple[float, float] | None:
    """Least and greatest load factor of the tries with residuals up to ``worst``, where there are several."""
    factors = [state.load_factor for state in tries.states if state.residual <= worst]
    return (min(factors), max(factors)) if len(factors) > 1 else None
