"""Tilting table: the angle at which the structure collapses.

Where joints have no strength but friction and only gravity acts, the size of the loads does not matter: the level
structure with the live load ``across`` has the tangent of the angle for its load factor, in one program.

Else the loads of the angle t itself must be those at collapse. Of an angle t the load factor λ of the line from the
level loads to those at t is found; λ < 1 says that t is too large. Associative flow: its mechanism gives a line that no
load that can be borne passes (:mod:`mbla.questions.tilt`), and the table leaves it at the next angle.
All these angles are too large, and they fall to the angle of collapse as Newton's method does, or in one step where a
straight part of the limit decides. Other flow: λ = 1 is found by secants, as nothing bounds the loads that are borne.

What the limit cuts off between the level table and the angle found would be a collapse before it. It is ruled out if
the level table bears tan(t/2) times the load across: the tangents of the circle at both ends meet there.
"""

from __future__ import annotations

import math
from dataclasses import replace

from mbla.assembly.assembly import Assembly
from mbla.errors import Message
from mbla.model.model import LoadCase
from mbla.questions.angle import Angle
from mbla.questions.tilt import AT_ONCE, Tilt, chord, line_of, never_left
from mbla.solution.sequence.solved_case import AnalysisSequence, SolvedCase
from mbla.solution.solution import Solution, Status
from mbla.solution.verification.tilting_table import GOOD, only_direction_counts
from mbla.solution.verification.verify import level_bound, verify

ENDED = 1e-9
"""distance of the load factor from 1 at which the angle is that of collapse: below what the bounds resolve"""
SETTLED = 1e-10
"""change of the angle in radians below which steps are rounding"""
NEAR = 1e-2
"""distance up to which it is approximate; beyond, the angle is no result"""
MOST_STEPS = 16
"""Steps of Newton's method or of secants."""
PROBES = (0.5 * math.pi, 0.75 * math.pi, math.pi)
"""angles tried where the load across alone, from the level table, brings nothing down"""
BY_LINE = 1e-6
"""angle within which it falls at once where nothing of the change is borne: a load factor that is 0 but for rounding,
1e-13, moves the arc cosine near 1 by 5e-7"""
BETWEEN = 8
"""angles tried before the one found where nothing proves that the table gets there"""
NOT_PROVED_BETWEEN = Message(
    "tilt-between-not-proved", f"That it does not collapse before was seen at {BETWEEN - 1} angles, not proved"
)


def tilting_table(assembly: Assembly, load_case: LoadCase, tilt: Tilt) -> AnalysisSequence:
    """The angle of collapse, verified, with the solution of the level table that proves the angles before it."""
    found = yield from tilt_angles(assembly, load_case, tilt)
    return replace(found, checks=verify(assembly, found.load_case, found.solution))


def tilt_angles(assembly: Assembly, load_case: LoadCase, tilt: Tilt) -> AnalysisSequence:
    """The angle of collapse, in ``tilt.angle`` or as tangent by the load factor, with the loads and forces there."""
    tangent = only_direction_counts(assembly.model, assembly.contacts, tilt)
    level = yield load_case
    level = replace(level, load_case=replace(load_case, question=Angle(replace(tilt, tangent=tangent))))
    if math.isnan(level.load_factor) or (tangent and math.isfinite(level.load_factor)):
        return level
    start = next_angle(tilt, level)
    if start <= AT_ONCE:  # the level table bears nothing more: an angle of 0, and so is its tangent
        return replace(level, load_case=replace(load_case, question=Angle(replace(tilt, tangent=True))))
    upright = level_bound(assembly, load_case, tilt.across, with_level(level.solution, level.solution))
    search = _Search(load_case, replace(tilt, tangent=False, upright=upright), level.solution)
    found = yield from search.from_angle(start) if start < math.pi else search.from_probes()
    found = yield from search.before(found)
    return search.with_words(found)


def next_angle(tilt: Tilt, found: SolvedCase) -> float:
    """Angle in radians that the associative mechanism bounds, inf where it bounds none."""
    bounding = found.solution.associative
    return math.inf if bounding is None else line_of(tilt, bounding.mechanism, bounding.load_factor).first_crossing()


def falls_at_once(tilt: Tilt, found: SolvedCase) -> bool:
    """Whether it collapses at any tilt: nothing of the change of the loads is borne."""
    return abs(found.load_factor) <= GOOD and next_angle(tilt, found) <= BY_LINE


def never_collapses(tilt: Tilt, found: SolvedCase) -> Solution:
    """The solution of the last angle tried, which is no collapse of the table either."""
    if found.solution.status is Status.UNBOUNDED:
        return found.solution
    reason = f"it does not collapse at any of the angles that were tried, up to {tilt.angle:g} degrees"
    if never_left(tilt.upright, found.checks.static_bound):
        return replace(found.solution, status=Status.UNBOUNDED, reason=f"{reason}, and forces are known for all others")
    return replace(found.solution, status=Status.NOT_VERIFIED, reason=f"{reason}; nothing is proved of those between")


def with_level(solution: Solution, level: Solution) -> Solution:
    """The solution with what was found of the level table, which proves how much of the load across that bears."""
    bears_all = level.status is Status.UNBOUNDED
    return replace(solution, level=None if bears_all else level.associative, level_lock=level.lock)


class _Search:
    """Answers at one angle after the other."""

    def __init__(self, load_case: LoadCase, tilt: Tilt, level: Solution) -> None:
        self.load_case, self.tilt, self.level = load_case, tilt, level
        self.angles: list[float] = []
        self.seconds = 0.0

    def at(self, angle: float) -> AnalysisSequence:
        """The answer of the line from the level loads to those at an angle."""
        tilt = replace(self.tilt, angle=math.degrees(angle))
        case = replace(self.load_case, live_load=chord(tilt, angle), question=Angle(tilt))
        answer = yield case
        self.angles.append(angle)
        self.seconds += answer.solution.seconds
        return answer

    def from_probes(self) -> AnalysisSequence:
        """From the first of some angles that is too large; the last of them where none is."""
        for angle in PROBES:
            answer = yield from self.at(angle)
            if falls_at_once(self.tilt, answer):
                return answer
            if not answer.load_factor > 1.0:
                start = next_angle(self.tilt, answer)
                if not math.isfinite(answer.load_factor):
                    return answer
                return (yield from self.from_angle(min(start, angle)))
        return answer

    def from_angle(self, angle: float) -> AnalysisSequence:
        """Down to the angle whose load factor is 1, from one that is too large."""
        steps: list[tuple[float, float]] = []
        angle = max(angle, AT_ONCE)  # of no turn at all the loads would not change
        for _ in range(MOST_STEPS):
            answer = yield from self.at(angle)
            factor = answer.load_factor
            if not math.isfinite(factor) or abs(factor - 1.0) <= ENDED or falls_at_once(self.tilt, answer):
                return answer
            steps.append((angle, factor))
            following = self._next(answer, steps)
            if not 0.0 < following < math.pi or abs(following - angle) <= SETTLED:
                return answer
            angle = following
        return answer

    def _next(self, answer: SolvedCase, steps: list[tuple[float, float]]) -> float:
        angle, factor = steps[-1]
        if answer.solution.flow_rule == "associative":
            return next_angle(self.tilt, answer)
        if len(steps) > 1 and steps[-2][1] != factor:
            before, other = steps[-2]
            return angle + (1.0 - factor) * (angle - before) / (factor - other)
        own = answer.solution.mechanics
        return math.inf if own is None else line_of(self.tilt, own.mechanism, factor).first_crossing()

    def before(self, found: SolvedCase) -> AnalysisSequence:
        """The same, or an earlier collapse where nothing proves that the table gets so far."""
        angle = found.load_case.question.followed(found.load_factor)
        if falls_at_once(self.tilt, found) or not found.load_factor <= 1.0 + GOOD or self.tilt.borne_to(angle):
            return found
        for step in range(1, BETWEEN):
            answer = yield from self.at(angle * step / BETWEEN)
            if falls_at_once(self.tilt, answer):
                return answer
            if answer.load_factor < 1.0 - GOOD:
                return (yield from self.from_angle(min(next_angle(self.tilt, answer), angle * step / BETWEEN)))
        return found

    def with_words(self, found: SolvedCase) -> SolvedCase:
        """With remarks on the search."""
        solution, factor = found.solution, found.load_factor
        tilt = replace(self.tilt, angle=found.load_case.question.stated(factor))
        degrees = ", ".join(f"{math.degrees(angle):.7g}" for angle in self.angles)
        by_steps = f"The load factor is that of the change of the loads from the level table; angles tried: {degrees}"
        remarks = [Message("tilt-by-steps", by_steps)]
        if factor > 1.0 + GOOD:
            solution = never_collapses(tilt, found)
            tilt = replace(tilt, angle=math.nan)
        elif falls_at_once(self.tilt, found):
            at_once = "It collapses as soon as it turns: the level structure bears nothing of the change"
            remarks.append(Message("tilt-by-steps", at_once))
            tilt = replace(tilt, angle=0.0)
        elif abs(factor - 1.0) > GOOD and solution.status is Status.SOLVED:
            reason = f"the angle did not settle: its load factor differs from 1 by {abs(factor - 1.0):.1e}"
            near = abs(factor - 1.0) <= NEAR
            solution = replace(solution, status=Status.APPROXIMATE if near else Status.NOT_VERIFIED, reason=reason)
        elif not tilt.borne_to(math.radians(tilt.angle)):
            remarks.append(NOT_PROVED_BETWEEN)
        solution = replace(solution, remarks=(*solution.remarks, *remarks), seconds=self.seconds)
        return SolvedCase(
            replace(found.load_case, question=Angle(tilt)), with_level(solution, self.level), found.checks
        )
