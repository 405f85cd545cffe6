"""The way of a structure that is pushed: rest, peak, and on, by smoothed steps, and rows that are solved from them.

It begins at rest under the dead load. Steps are measured by the work of the live load, in units of what its elastic
joints take at a tenth of the dead load: the first are those of the path of elastic joints. Then they grow to the step
that is asked of the control point, as long as no solid moves or turns far in one. A row of the curve is a step that is
solved from where its smoothed one has led; the way goes on from the smoothed one.

Where a step is blocked it is made shorter, and begun afresh; then with larger products, which let the structure slip
past; then it jumps (:mod:`mbla.solution.pushover.jump`).
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.model.pose import Pose
from mbla.solution.flow.unit_of_displacement import elastic_motion
from mbla.solution.pushover.control import MOVES, Control
from mbla.solution.pushover.curve_rows import CurveEnd
from mbla.solution.pushover.jump import jump
from mbla.solution.pushover.place import PushedPlace, Row, place_after, row_after
from mbla.solution.pushover.pose.pose_step import PoseStep, greatest_motion, turned_on
from mbla.solution.pushover.pose.smoothed_step import Smoothed, smoothed
from mbla.solution.pushover.pose.solved_step import solved
from mbla.solution.pushover.pose.structure import PushedStructure
from mbla.solution.pushover.renewal import renewed
from mbla.solution.pushover.rest import at_rest
from mbla.solution.pushover.rows_of_way import RowsOfWay
from mbla.solution.solution import Mechanics

RATIO = 0.4
"""Stiffness of joints along over that across."""

FIRST, UNIT = 0.2, 0.1
"""Live work of the first step, in units; load factor of the unit over that at which live and dead load are alike."""

LONGER, LONG, OF_WAY = {1: 2.0, 2: 2.0, 3: 1.4, 4: 1.4}, 1.0, 0.25
"""A step over the one before, by directions that took, and with more; and over the whole way so far, at most."""

LARGEST = 0.02
"""Greatest motion of a solid over its size, and greatest rotation, in a step."""

SHORTER, SHARP, TRIES = 0.5, 2, 4
"""Length of a step over that of the blocked one before; successive blocked steps after which a step begins afresh where
it cannot be finished from the state before, and after which κ is SOFTEST; after as many more the structure jumps."""

SMOOTHING, SOFT, SOFTEST = 50.0, 5.0, 0.5
"""κ: initial, greatest after SHARP blocked steps, greatest after TRIES blocked steps."""

EASY, EASIER = 3, 1.5
"""Directions of a step after which κ rises again, and by how much."""

AT_BREAK = 0.05
"""Step in which a tie breaks over the one before, at most."""

LOST = 0.1
"""Greatest loss of load factor in a jump, over the load factor of the first movement; beyond, the curve ends."""

JUMPS, LESS = 3, 0.2
"""Successive jumps that may fail, and step of a jump over that of the jump before."""

TAKEN = 0.2
"""Weight of falling blocks over that of the blocks of the control point, or over that of the blocks that follow a
settling support, at which the curve ends."""


@dataclass
class Attempts:
    """Steps from one place that are blocked in turn.

    work  : live work of the next
    asked : of the first
    tries, jumps : steps that were blocked since the last jump, jumps that came to nothing
    """

    work: float
    asked: float = 0.0
    tries: int = 0
    jumps: int = 0


@dataclass
class Way:
    """Steps of a load case.

    control : of the displacement
    first   : the structure as it starts to move
    step    : m, of the control point
    until   : m, at which it ends
    until_load_factor : at which it ends as it falls
    steps   : rows at most
    most    : multiple of the greatest motion and rotation of solids in a step
    watch   : told of each step the row that it leads to, the load factor, and whether it is made
    kappa   : smoothing of the next step
    spent, missed, jumps : factorisations, rows that were not solved, and jumps so far
    """

    structure: PushedStructure
    control: Control
    first: Mechanics
    step: float
    until: float
    until_load_factor: float
    steps: int
    deadline: float | None = None
    most: float = 1.0
    watch: Callable[[int, float, bool], None] = lambda row, factor, made: None
    kappa: float = SMOOTHING
    spent: int = 0
    missed: int = 0
    jumps: int = 0

    @property
    def stiffness(self) -> tuple[float, float]:
        """Of joints, across and along, force per volume."""
        return self.structure.stiffness, RATIO * self.structure.stiffness

    def rows(self) -> Iterator[Row | CurveEnd]:
        """Rows from the peak on, then why the curve ends."""
        place = self.at_rest()
        if place is None:
            yield CurveEnd.STUCK
            return
        rows = RowsOfWay(self, self._unit(place), self.first.load_factor)
        attempts = Attempts(FIRST * rows.unit)
        while True:
            if self.deadline is not None and time.monotonic() > self.deadline:
                yield CurveEnd.LATE
                return
            place = renewed(place, self.is_over)
            if self.is_over(place.joints.fallen):
                yield self.fall
                return
            step, found = self._stepped(place, attempts)
            factor = place.factor if found is None else step.joints.full.scaling.load_factor(found.state.factor)
            self.watch(rows.count + 1, factor, found is not None)
            if found is None:
                past = self._past(place, attempts)
                if isinstance(past, CurveEnd):
                    yield past
                    return
                place = past
                continue
            after = place_after(step, found, place)
            if self._breaks(place, after) and step.work > AT_BREAK * place.work:
                attempts.work *= SHORTER
                continue
            ended = yield from rows.of_step(step, found, place, after)
            if ended is not None:
                yield ended
                return
            attempts = Attempts(self._next(place, after, found, step.work, rows))
            if found.directions <= EASY:
                self.kappa = min(SMOOTHING, EASIER * self.kappa)
            place = after

    def _past(self, place: PushedPlace, attempts: Attempts) -> PushedPlace | CurveEnd:
        """Where to go on from where a step is blocked: there with another one, or behind a jump; else why not."""
        attempts.tries, attempts.work = attempts.tries + 1, SHORTER * attempts.work
        if attempts.tries == SHARP:
            self.kappa = min(self.kappa, SOFT)
        if attempts.tries == TRIES:
            attempts.work, self.kappa = attempts.asked, SOFTEST
        if attempts.tries < 2 * TRIES:
            return place
        jumped = self._jumped(place, attempts.asked)
        self.kappa, attempts.tries = SOFT, 0
        if isinstance(jumped, PushedPlace):
            attempts.jumps, attempts.work = 0, attempts.asked
            return jumped
        if attempts.jumps == JUMPS or jumped is not None or not attempts.asked:
            return jumped or CurveEnd.STUCK
        attempts.jumps, attempts.work = attempts.jumps + 1, LESS * attempts.asked
        return place

    def _jumped(self, place: PushedPlace, work: float) -> PushedPlace | CurveEnd | None:
        """Where the structure rests again, or why it does not; None where that is not found."""
        jumped = jump(place, work, SOFT, self.is_over)
        self.spent += jumped.spent
        there = jumped.place
        if there is None:
            return None
        lost = place.factor - there.factor > LOST * abs(self.first.load_factor) and not self.settles
        self.jumps += not lost
        return self.fall if lost else there

    def _breaks(self, place: PushedPlace, after: PushedPlace) -> bool:
        """Whether a tie breaks on the way from one place to another."""
        ties = self.structure.model.ties
        return bool((after.ties.broken(ties) & ~place.ties.broken(ties)).any())

    def at_rest(self) -> PushedPlace | None:
        """Under the dead load, or on its support; None where that is not found."""
        place, spent = at_rest(self.structure, RATIO, settles=self.settles)
        self.spent += spent
        return place

    def displacement(self, pose: Pose) -> float:
        """Of the control point, m."""
        return self.control.displacement(self.structure.model, self.structure.blocks_at(pose))

    @property
    def settles(self) -> bool:
        """Whether a support settles."""
        return not self.structure.case.question.multiplies

    @property
    def fall(self) -> CurveEnd:
        """The end of what falls."""
        return CurveEnd.NOT_CARRIED if self.settles else CurveEnd.FALLS

    def row(self, step: PoseStep, found: Smoothed, place: PushedPlace) -> Row | None:
        """The step from a place solved from a smoothed one; None where that is not found."""
        sharp = replace(step, spent=0)
        row = solved(sharp, found)
        self.spent += sharp.spent
        return None if row is None or not row.fit else row_after(sharp, row, place)

    def is_over(self, fallen: BoolArray) -> bool:
        """Whether too much has fallen, (n_solids,): of the control point, or of the blocks on a settling support."""
        blocks = fallen[self.structure.solids.label]
        if not self.settles:
            return float(self.control.weights[blocks[self.control.blocks]].sum()) > TAKEN
        return float(self._carried[blocks].sum()) > TAKEN * float(self._carried.sum())

    @cached_property
    def _carried(self) -> FloatArray:
        """Masses of the blocks that follow a settling support in the first movement, (n_blocks,)."""
        speed = np.linalg.norm(self.first.mechanism[:, :3], axis=1)
        masses = np.where(speed > MOVES * speed.max(), self.structure.model.blocks.masses, 0.0)
        masses[self.control.blocks] = 0.0
        masses[self.structure.case.question.giving_way] = 0.0
        return masses

    def _unit(self, place: PushedPlace) -> float:
        """Live work of elastic joints, at a tenth of the dead load; with less, where nothing holds what moves."""
        at, length = place.at.joints, place.joints.length
        joints = replace(at, normal=at.normal * length, shear=at.shear * length)
        program = joints.program
        motion = elastic_motion(joints, np.ones(program.n_points, dtype=np.bool_))
        dead, live = (float(np.abs(load).sum()) for load in (program.dead_load, program.live_load))
        motion *= UNIT * (dead or live) / live
        far = greatest_motion(place.joints, place.joints.twists(motion))
        return abs(float(program.live_load @ motion)) * min(1.0, LARGEST / max(far, 1e-300))

    def _stepped(self, place: PushedPlace, attempts: Attempts) -> tuple[PoseStep, Smoothed | None]:
        """A smoothed step from a place, as the one before led there."""
        joints, work = place.joints, attempts.work
        if not attempts.tries:
            attempts.asked = work
        step = PoseStep(joints, place.history, place.at, place.factor / joints.full.scaling.live, work)
        share = work / place.work if place.work else 0.0
        anew = attempts.tries >= SHARP
        found = smoothed(step, turned_on(place.twists, share), place.state, share, self.kappa, anew=anew)
        self.spent += step.spent
        return step, found

    def _next(self, before: PushedPlace, after: PushedPlace, found: Smoothed, work: float, rows: RowsOfWay) -> float:
        """Live work of the next step."""
        wanted = min(LONGER.get(found.directions, LONG) * work, max(FIRST * rows.unit, OF_WAY * rows.way))
        moved = self.displacement(after.pose) - self.displacement(before.pose)
        if moved > 0.0:
            wanted = min(wanted, work * self.step / moved)
        far = greatest_motion(after.joints, after.twists)
        wanted = min(wanted, work * self.most * LARGEST / max(far, 1e-300))
        left = self.until - self.displacement(after.pose)
        return work * left / moved if moved > 0.0 and 0.0 < left < wanted / work * moved else wanted
