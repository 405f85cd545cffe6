"""Rows of the way of a structure that is pushed: steps that are solved at multiples of the step that is asked for.

Besides, there is one at a peak between them, where nothing is left of the load factor, where it has fallen to the one
asked for, and where a jump ends.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from mbla.solution.pushover.curve_rows import CurveEnd
from mbla.solution.pushover.place import PushedPlace, Row
from mbla.solution.pushover.pose.pose_step import PoseStep
from mbla.solution.pushover.pose.smoothed_step import Smoothed

if TYPE_CHECKING:
    from mbla.solution.pushover.way import Way

AT_END, SEARCHES, FURTHER = 1e-6, 12, 1.5
"""Search for a row: its tolerance, relative; most steps; greatest length of each, over a step of the way."""

MISSED = 1e-4
"""Distance of a row from its displacement, over the step of the deck, from which it is not that row."""

SUDDEN, NOTHING, BLOCKED = 0.2, 1e-6, 100.0
"""Loss of load factor in the last step, over the greatest so far, with which the structure falls; load factor over that
of the first movement that counts as nothing, and load factor over it above which something blocks the motion."""

RISEN = 0.99
"""Load factor over that of the first movement, above which it has risen before it falls."""

HIGHER = 1.001
"""Load factor over those of two neighbouring rows, above which a row of the peak stands between them."""


@dataclass
class RowsOfWay:
    """Rows of a way, at multiples of its step, and one at a peak between them.

    unit     : of live work; ``way`` so far
    last     : load factor of the last row
    target   : displacement of the next
    peak     : the step with the greatest load factor since the last row
    highest  : load factor so far
    zero     : the step in which it falls below zero, where the curve goes on behind it
    """

    of: Way
    unit: float
    last: float
    way: float = 0.0
    target: float = 0.0
    count: int = 0
    peak: tuple[PoseStep, Smoothed, PushedPlace] | None = None
    greatest: float = 0.0
    highest: float = 0.0
    zero: tuple[PoseStep, Smoothed, PushedPlace] | None = None

    def of_step(
        self, step: PoseStep, found: Smoothed, place: PushedPlace, after: PushedPlace
    ) -> Generator[Row, None, CurveEnd | None]:
        """Rows within a step; returns why the curve ends there, or None."""
        way, moved = self.of, self.of.displacement(after.pose)
        self.way += step.work
        self.target = self.target or way.step
        if after.factor > self._blocked and not way.settles:
            highest = None if self.peak is None else way.row(*self.peak)
            if highest is not None and highest.load_factor > HIGHER * self.last and self.count < way.steps:
                self.count += 1
                yield highest
            return CurveEnd.BLOCKED
        if after.factor > self.greatest:
            self.peak, self.greatest = (step, found, place), after.factor
        self.highest = max(self.highest, after.factor)
        ended, lowest = self._is_at_end(after.factor), way.until_load_factor
        if ended and place.factor - lowest > SUDDEN * (self.highest - min(lowest, 0.0)):
            return way.fall
        if lowest < 0.0 and after.factor <= 0.0 < place.factor:
            self.zero = step, found, place
        broken = after.ties.broken(way.structure.model.ties)[after.joints.ties]
        begun = way.displacement(place.pose)
        for goal in [] if broken.any() else self._goals(begun, moved, ended=ended):
            row = self._at(step, found, place, goal)
            if row is not None and goal is not None:
                if self._is_at_end(row.load_factor):
                    row = self._at(step, found, place, None)
                elif abs(way.displacement(row.pose) - goal) > MISSED * way.step:
                    way.missed += 1  # it stands for the one that is not found
            if row is None:
                way.missed += 1
                continue
            for between in (self._top(row), self._zero(row)):
                if between is not None and self.count < way.steps:
                    self.count += 1
                    yield between
            self.peak, self.greatest, self.last = None, row.load_factor, row.load_factor
            if self.count < way.steps:
                self.count += 1
                yield row
            end = self._end(row)
            if end is not None or self.count >= way.steps:
                return end or CurveEnd.STEPS_DONE
        return None

    def _goals(self, begun: float, moved: float, *, ended: bool) -> list[float | None]:
        """Displacements of rows within a step, None where the load factor is at its end.

        Where a jump has passed some by, the end of the step stands for these.
        """
        goals, until = list[float | None](), self.of.until
        if self.target < min(begun, moved, until) * (1.0 - AT_END):
            goals.append(min(moved, until))
        while self.target < min(begun, until) * (1.0 - AT_END):
            self.target += self.of.step
        while self.target <= moved * (1.0 + AT_END) and self.target < until * (1.0 - AT_END):
            goals.append(self.target)
            self.target += self.of.step
        goals += [until] if moved >= until * (1.0 - AT_END) else []
        return goals + ([None] if ended else [])

    def _top(self, row: Row) -> Row | None:
        """The row of a peak before a row, where there is one."""
        if self.peak is None or self.greatest <= HIGHER * max(self.last, row.load_factor):
            return None
        top = self.of.row(*self.peak)
        before = top is not None and self.of.displacement(top.pose) < self.of.displacement(row.pose)
        return top if before else None

    def _zero(self, row: Row) -> Row | None:
        """The row at which nothing is left of the load factor, where one behind it is the next."""
        if self.zero is None or row.load_factor >= 0.0:
            return None
        there, self.zero = self.zero, None
        if abs(self.last) <= NOTHING * abs(self.of.first.load_factor):
            return None
        at = self._at(*there, None, 0.0)
        before = at is not None and self.of.displacement(at.pose) < self.of.displacement(row.pose)
        return at if before else None

    def _end(self, row: Row) -> CurveEnd | None:
        if self.of.displacement(row.pose) >= self.of.until * (1.0 - 2.0 * AT_END):
            return CurveEnd.REACHED
        ends = CurveEnd.FACTOR_REACHED if self.of.until_load_factor else CurveEnd.NOTHING_LEFT
        return ends if self._is_at_end(row.load_factor) else None

    @property
    def _blocked(self) -> float:
        """Load factor from which something blocks the way: of a tilting table its angle, half a turn."""
        return np.pi if self.of.structure.case.question.tilts else BLOCKED * abs(self.of.first.load_factor)

    def _is_at_end(self, factor: float) -> bool:
        """Whether a load factor has fallen to its end, above which it has been; of a reaction that is no end."""
        asked = self.of.until_load_factor
        end = asked + NOTHING * abs(self.of.first.load_factor)
        above = self.highest > min(end, RISEN * self.of.first.load_factor) and self.highest > factor
        return factor <= end and self.way > 2.0 * self.unit and (asked <= 0.0 or above) and not self.of.settles

    def _at(
        self, step: PoseStep, found: Smoothed, place: PushedPlace, goal: float | None, factor: float | None = None
    ) -> Row | None:
        """The row of a part of a step at a displacement of the control point; without one at a load factor, the one the
        deck asks for by default. None where no row is found.
        """
        way, end = self.of, self.of.until_load_factor if factor is None else factor
        size = max(abs(place.factor), abs(end), 1e-300) if goal is None else goal

        def value(row: Row) -> float:
            return row.load_factor - end if goal is None else way.displacement(row.pose) - goal

        def of_part(share: float) -> Row | None:
            part, u = replace(step, work=share * step.work), share * found.u
            there = step.joints.there(step.joints.after(step.start.pose, u), found.state.factor)
            return way.row(part, replace(found, at=there, u=u), place)

        begun = place.factor - end if goal is None else way.displacement(place.pose) - goal
        moved = 0.0 if goal is None else way.displacement(found.at.pose) - goal
        share = begun / (begun - moved) if begun < 0.0 < moved else 1.0  # as far as the smoothed step goes by there
        best = of_part(share) if share < 1.0 else None
        if best is None:
            share, best = 1.0, way.row(step, found, place)
        if best is None:
            return None
        low, high = (0.0, begun), (share, value(best))
        for _ in range(SEARCHES):
            if abs(value(best)) <= AT_END * size or high[1] == low[1]:
                break
            share = low[0] - low[1] * (high[0] - low[0]) / (high[1] - low[1])
            if not 0.0 < share < FURTHER or (row := of_part(share)) is None:
                break
            best, now = row, value(row)
            low, high = ((share, now), high) if now * high[1] < 0.0 else (low, (share, now))
        return best
