"""Tilting table: the angle at which the structure collapses.

Where joints have no strength but friction and only gravity acts, the size of the loads does not matter: the level
structure with the live load ``across`` has the tangent of the angle for its load factor, in one program.

Else the loads of the angle t itself must be those at collapse. Of an angle t the load factor λ of the line from the
level loads to those at t is found; λ < 1 says that t is too large. Associative flow: its mechanism gives a line that no
load that can be borne passes (:mod:`mbla.solution.tilt_circle`), and the table leaves it at the next angle. All these
angles are too large, and they fall to the angle of collapse as Newton's method does, or in one step where a straight
part of the limit decides. Other flow: λ = 1 is found by secants, as nothing bounds the loads that are borne.

What the limit cuts off between the level table and the angle found would be a collapse before it. It is ruled out if
the level table bears tan(t/2) times the load across: the tangents of the circle at both ends meet there.
"""

from __future__ import annotations

import math
from collections.abc import Generator
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly.assembly import Assembly
from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import LoadCase, Model, Tilt
from mbla.solution.solution import WITH_VALUE, Checks, Mechanics, Solution, Status
from mbla.solution.tilt_circle import AT_ONCE, chord, line_of, never_left
from mbla.solution.verification.further_claims import SAME_LOADS, only_direction_counts
from mbla.solution.verification.verify import level_bound

Angles: TypeAlias = Generator[LoadCase, "Answer", "Answer"]
"""Load cases to be solved and verified one after the other; each comes back as an answer, and the last is returned."""

ENDED = 1e-9
"""distance of the load factor from 1 at which the angle is that of collapse: below what the bounds resolve"""
SETTLED = 1e-10
"""change of the angle in radians below which steps are rounding"""
GOOD = 1e-6
"""distance of the load factor from 1 up to which the case may be called solved"""
NEAR = 1e-2
"""distance up to which it is approximate; beyond, the angle is no result"""
MOST_STEPS = 16
"""steps; Newton's method takes 3 to 6, secants about as many"""
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


@dataclass(frozen=True)
class Answer:
    """The last request and its answer."""

    load_case: LoadCase
    solution: Solution
    checks: Checks

    @property
    def bounding(self) -> Mechanics | None:
        """The mechanism that bounds the loads, with a load factor that holds."""
        return self.solution.associative

    @property
    def load_factor(self) -> float:
        """By the flow rule of the analysis; inf where no multiple brings it down, nan where there is none."""
        if self.solution.status is Status.UNBOUNDED:
            return math.inf
        known = self.solution.mechanics is not None and self.solution.status in WITH_VALUE
        return self.solution.mechanics.load_factor if known and self.solution.mechanics is not None else math.nan

    def next_angle(self, tilt: Tilt) -> float:
        """Angle that the mechanism bounds, inf where it bounds none."""
        found = self.bounding
        return math.inf if found is None else line_of(tilt, found, found.load_factor).first_crossing()

    def falls_at_once(self, tilt: Tilt) -> bool:
        """Whether nothing of the change of the loads is borne, so that every turn brings it down."""
        return abs(self.load_factor) <= GOOD and self.next_angle(tilt) <= BY_LINE


def tilt_angles(assembly: Assembly, load_case: LoadCase) -> Angles:
    """The angle of collapse, in ``tilt.angle`` or as tangent by the load factor, with the loads and forces there."""
    tilt = load_case.tilt
    assert tilt is not None  # that is why it is requested
    tangent = only_direction_counts(assembly.model, assembly.contacts, tilt)
    level = yield load_case
    level = replace(level, load_case=replace(load_case, tilt=replace(tilt, tangent=tangent)))
    if math.isnan(level.load_factor) or (tangent and math.isfinite(level.load_factor)):
        return level
    start = level.next_angle(tilt)
    if start <= AT_ONCE:  # the level table bears nothing more: an angle of 0, and so is its tangent
        return replace(level, load_case=replace(load_case, tilt=replace(tilt, tangent=True)))
    upright = level_bound(assembly, load_case, with_level(level.solution, level.solution))
    search = _Search(load_case, replace(tilt, tangent=False, upright=upright), level.solution)
    found = yield from search.from_angle(start) if start < math.pi else search.from_probes()
    found = yield from search.before(found)
    return search.with_words(found)


def never_collapses(tilt: Tilt, found: Answer) -> Solution:
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


def leads_across(tilt: Tilt, live_load: FloatArray) -> bool:
    """Whether a live load, (n_blocks, 6), is that of the level table across, which leads to no angle."""
    off = float(np.abs(live_load - tilt.across).max(initial=0.0))
    return off <= SAME_LOADS * float(np.abs(tilt.across).max(initial=0.0))


def angle_of_load(tilt: Tilt, live_load: FloatArray) -> float:
    """Angle in radians to which a live load leads from the level table, whether it is that of collapse or not."""
    size = max(float(np.abs(tilt.across).max(initial=0.0)), np.finfo(np.float64).tiny)
    columns = np.column_stack([tilt.across.ravel(), -tilt.turning.ravel()]) / size
    (across, lowered), *_ = np.linalg.lstsq(columns, live_load.ravel() / size)
    return float(np.arctan2(across, 1.0 - lowered))


def found_tangent(model: Model, contacts: Contacts, tilt: Tilt, live_load: FloatArray, solution: Solution) -> bool:
    """Whether a run states the load factor of a live load as tangent of the angle.

    It does of the load across the level table where only directions count, and where that table bears nothing of it.
    """
    found = solution.associative
    if found is None or solution.status not in WITH_VALUE or not leads_across(tilt, live_load):
        return tilt.tangent
    at_once = line_of(tilt, found, found.load_factor).first_crossing() <= AT_ONCE
    return at_once or only_direction_counts(model, contacts, tilt)


def found_angle(tilt: Tilt, live_load: FloatArray, solution: Solution) -> float:
    """The angle of collapse in degrees that a run states of a live load and the load factor found for it.

    nan where the load factor is its tangent, where the load leads to none, and where the table does not collapse there.
    """
    own = solution.mechanics
    if tilt.tangent or leads_across(tilt, live_load) or (own is not None and own.load_factor > 1.0 + GOOD):
        return math.nan
    angle = math.degrees(angle_of_load(tilt, live_load))
    if own is None:
        return math.nan if math.isnan(tilt.angle) else angle
    at_once = abs(own.load_factor) <= GOOD and tilt.angle == 0.0
    return 0.0 if at_once else angle


class _Search:
    """Answers at one angle after the other."""

    def __init__(self, load_case: LoadCase, tilt: Tilt, level: Solution) -> None:
        self.load_case, self.tilt, self.level = load_case, tilt, level
        self.angles: list[float] = []
        self.seconds = 0.0

    def at(self, angle: float) -> Angles:
        """The answer of the line from the level loads to those at an angle."""
        tilt = replace(self.tilt, angle=math.degrees(angle))
        case = replace(self.load_case, live_load=chord(tilt, angle), tilt=tilt)
        answer = yield case
        self.angles.append(angle)
        self.seconds += answer.solution.seconds
        return answer

    def from_probes(self) -> Angles:
        """From the first of some angles that is too large; the last of them where none is."""
        for angle in PROBES:
            answer = yield from self.at(angle)
            if answer.falls_at_once(self.tilt):
                return answer
            if not answer.load_factor > 1.0:
                start = answer.next_angle(self.tilt)
                if not math.isfinite(answer.load_factor):
                    return answer
                return (yield from self.from_angle(min(start, angle)))
        return answer

    def from_angle(self, angle: float) -> Angles:
        """Down to the angle whose load factor is 1, from one that is too large."""
        steps: list[tuple[float, float]] = []
        angle = max(angle, AT_ONCE)  # of no turn at all the loads would not change
        for _ in range(MOST_STEPS):
            answer = yield from self.at(angle)
            factor = answer.load_factor
            if not math.isfinite(factor) or abs(factor - 1.0) <= ENDED or answer.falls_at_once(self.tilt):
                return answer
            steps.append((angle, factor))
            following = self._next(answer, steps)
            if not 0.0 < following < math.pi or abs(following - angle) <= SETTLED:
                return answer
            angle = following
        return answer

    def _next(self, answer: Answer, steps: list[tuple[float, float]]) -> float:
        angle, factor = steps[-1]
        if answer.solution.flow_rule == "associative":
            return answer.next_angle(self.tilt)
        if len(steps) > 1 and steps[-2][1] != factor:
            before, other = steps[-2]
            return angle + (1.0 - factor) * (angle - before) / (factor - other)
        own = answer.solution.mechanics
        return math.inf if own is None else line_of(self.tilt, own, factor).first_crossing()

    def before(self, found: Answer) -> Angles:
        """The same, or an earlier collapse where nothing proves that the table gets so far."""
        angle = math.radians(found.load_case.tilt.angle) if found.load_case.tilt is not None else math.nan
        if (
            found.falls_at_once(self.tilt)
            or not found.load_factor <= 1.0 + GOOD
            or self.tilt.upright >= math.tan(angle / 2.0)
        ):
            return found
        for step in range(1, BETWEEN):
            answer = yield from self.at(angle * step / BETWEEN)
            if answer.falls_at_once(self.tilt):
                return answer
            if answer.load_factor < 1.0 - GOOD:
                return (yield from self.from_angle(min(answer.next_angle(self.tilt), angle * step / BETWEEN)))
        return found

    def with_words(self, found: Answer) -> Answer:
        """With remarks on the search."""
        solution, tilt = found.solution, found.load_case.tilt
        assert tilt is not None  # every answer has one
        degrees = ", ".join(f"{math.degrees(angle):.7g}" for angle in self.angles)
        by_steps = f"The load factor is that of the change of the loads from the level table; angles tried: {degrees}"
        remarks = [Message("tilt-by-steps", by_steps)]
        angle, factor = math.radians(tilt.angle), found.load_factor
        if factor > 1.0 + GOOD:
            solution = never_collapses(tilt, found)
            tilt = replace(tilt, angle=math.nan)
        elif found.falls_at_once(self.tilt):
            at_once = "It collapses as soon as it turns: the level structure bears nothing of the change"
            remarks.append(Message("tilt-by-steps", at_once))
            tilt = replace(tilt, angle=0.0)
        elif abs(factor - 1.0) > GOOD and solution.status is Status.SOLVED:
            reason = f"the angle did not settle: its load factor differs from 1 by {abs(factor - 1.0):.1e}"
            near = abs(factor - 1.0) <= NEAR
            solution = replace(solution, status=Status.APPROXIMATE if near else Status.NOT_VERIFIED, reason=reason)
        elif not self.tilt.upright >= math.tan(angle / 2.0):
            remarks.append(NOT_PROVED_BETWEEN)
        solution = replace(solution, remarks=(*solution.remarks, *remarks), seconds=self.seconds)
        return Answer(replace(found.load_case, tilt=tilt), with_level(solution, self.level), found.checks)
