"""From the first crack to the ground: the load factor as a structure moves, by one step program after another.

A step is limit analysis of the moved geometry with gaps: with the poses of step k, its contacts, their matrix A and the
gaps g of the contact points, and with the live work D̄ of the step (Portioli 2020, doi:10.1007/s10518-019-00722-0;
static form and its dual)::

    max λ D̄ − g·N   s.t.  A x + f_D + λ f_L = 0,  x within its yield conditions
    min −f_D·Δu + dissipation   s.t.  f_L·Δu = D̄,  Δv = AᵀΔu,  Δv_N + g compatible with the joints

At D̄ → 0 and g = 0 that is limit analysis, the first point of the curve. Divided by D̄ it is the program of limit
analysis with the gaps as weights of the normal forces (``Program.gaps``). Pairs of programs of :mod:`alternation` start
from the normal forces of the step before. A gap keeps its sign: where a step let blocks overlap, the next pushes them
apart. A support that gives way (settlement) is the same with its own motion for the live work.

Blocks that nothing carries any more fall without the rest: they stay where they are and are left out (debris).
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.contacts.contacts import Contacts
from mbla.contacts.glue import Solids
from mbla.contacts.moved import MovedContacts, MovedSearch
from mbla.model.model import LoadCase, Model
from mbla.model.pose import Pose
from mbla.model.solids.measures import connected_labels
from mbla.model.ties.moved import TieHistory, moved_ties
from mbla.model.ties.ties import Ties
from mbla.solution.pushover.control import MOVES, Control
from mbla.solution.pushover.step_program import Normals, StepProgram, moved_solids, ties_left
from mbla.solution.solution import Mechanics

OFF, MOST_WORKS = 0.2, 3
"""Share by which the live work of a step may differ from that for which it was solved before it is solved again, and
how many times it is."""

DEEP = 0.01
"""Overlap of blocks over their size, from which a shorter step is tried; without one the curve is at its end."""

LARGEST_MOTION, LARGEST_TURN = 0.02, 0.02
"""Greatest motion of a block in a step, over its size, and greatest rotation, rad."""

SHORTER = (1.0, 0.5, 0.25, 0.125)
"""Shares of a step that are tried in turn where no forces are found: so sharply the end of a curve is known."""

TAKEN = 0.2
"""Weight of falling blocks over that of the control point, or of what moves at first with a support that gives way,
from which the curve is at its end."""

DRIVEN, FAST = 3.0, 0.1
"""Power of the dead load over that of the live load in a motion in which blocks drop, and speed of these over the
greatest. Blocks that drop in two steps on end are debris; in one they may come to rest on others."""


@dataclass(frozen=True)
class Step:
    """A pose with the load factor that holds it there, and the mechanism by which it goes on.

    displacement : of the control point, m
    mechanism    : (n_blocks, 6) for a live power of 1
    forces       : (n_points, 3) N of the contacts there
    fallen       : (n_blocks,) blocks that are debris
    led          : live work of the step that led here
    scale        : live work for which it was solved, inf without gaps: those of its contacts close by no more in it
    whole        : live work of a whole step that goes on from here, at most that
    work         : live work of the step that goes on from here: less where less is left to the displacement asked for
    history      : of ties
    """

    displacement: float
    load_factor: float
    mechanism: FloatArray
    forces: FloatArray
    pose: Pose
    fallen: BoolArray
    led: float
    scale: float
    history: TieHistory
    whole: float = 0.0
    work: float = 0.0


@dataclass
class Pushover:
    """Steps of one load case by the flow rule of the analysis.

    model   : as it may move under the load case
    control : of its mechanism
    step    : m, of the control point
    most    : multiple of the greatest motion and rotation of blocks in a step
    late    : whether the time limit ended it
    falls   : whether the dead load alone brings the structure down there, as far as was tried last
    deep    : whether blocks overlap too much there
    short   : steps on end that were made shorter than asked for
    carried : (n_blocks,) masses of what moves at first with a support that gives way, without it
    """

    model: Model
    contacts: Contacts
    search: MovedSearch
    case: LoadCase
    control: Control
    program: StepProgram
    step: float
    most: float = 1.0
    late: bool = False
    falls: bool = False
    deep: bool = False
    short: int = 0
    carried: FloatArray = field(default_factory=lambda: np.zeros(0))

    def steps(self, first: Mechanics) -> Iterator[Step]:
        """Steps of the curve, that of limit analysis first, until no forces or no motion are found."""
        still = np.zeros(len(self.model.blocks), dtype=bool)
        pose, normals = Pose.at_rest(len(still)), Normals.of(self.contacts, first.contact_forces)
        history = TieHistory.at_rest(self.model.ties)
        step = Step(0.0, first.load_factor, first.mechanism, first.contact_forces, pose, still, 0.0, np.inf, history)
        step = self._going_on(step, self.work_of(step))
        speed = np.linalg.norm(first.mechanism[:, :3], axis=1)
        self.carried = np.where(speed > MOVES * speed.max(), self.model.blocks.masses, 0.0)
        self.carried[self.control.blocks] = 0.0
        if self.case.settlement is not None:
            self.carried[self.case.settlement.blocks] = 0.0
        while True:
            yield step
            if self.program.settings.deadline is not None and time.monotonic() > self.program.settings.deadline:
                self.late = True
                return
            after = self._after(step, normals)
            if after is None:
                return
            step, normals = after

    def _after(self, step: Step, normals: Normals) -> tuple[Step, Normals] | None:
        """The next step and its normal forces; None without any."""
        for share in SHORTER:
            solved = self._with_debris(step, share * step.work, normals)
            if solved is not None:
                whole = share == 1.0 and solved[0].whole > 0.5 * self.work_of(solved[0])
                self.short = 0 if whole else self.short + 1
                return solved
        return None

    def work_of(self, step: Step) -> float:
        """Live work of a whole step from there."""
        return work_of(self.model, self.control, self.step, step.pose, step.mechanism, self.most)

    def _going_on(self, step: Step, whole: float) -> Step:
        """With the live work of a whole step, and of the one that ends at the displacement asked for."""
        assert self.case.pushover is not None  # else nothing is pushed
        far = self.case.pushover.until - step.displacement
        speed = self.control.speed(self.model, step.pose, step.mechanism)
        left = far / speed if far > 0.0 and speed > 0.0 else np.inf
        return replace(step, whole=whole, work=min(whole, left))

    def _with_debris(self, step: Step, led: float, normals: Normals) -> tuple[Step, Normals] | None:
        """The step by a live work from another one, without the blocks that fall meanwhile."""
        fallen, pose = step.fallen, step.pose.after(led * step.mechanism)
        history = history_after(self.model, step.history, step.pose, led * step.mechanism, pose)
        while True:
            found = self.search.at(pose, fallen)
            self.deep = found.overlap > DEEP
            if self.deep:
                return None
            left, slack = ties_left(self.model, pose, fallen, history)
            hanging = _hanging(self.model, found.contacts, left) & ~fallen
            if hanging.any() and not self._ends_it(fallen | hanging):
                fallen = fallen | hanging
                continue
            solids, case, found = moved_solids(self.model, found, self.case, pose, fallen, left, slack)
            reached = self._reached(
                pose, fallen, led, step.whole if step.work < step.whole else led, solids, case, found, normals, history
            )
            carried = reached is not None and (reached.load_factor > 0.0 or self.case.settlement is not None)
            falling = fallen if carried else fallen | self.program.falling(solids, case)
            if reached is not None and carried:
                drops = _drops(self.case, step.load_factor, step.mechanism)
                falling = fallen | (drops & _drops(self.case, reached.load_factor, reached.mechanism))
            if not (falling & ~fallen).any() or self._ends_it(falling):
                break
            fallen = falling
        if reached is None:
            self.falls = self._ends_it(falling)
            return None
        return reached, Normals.of(found.contacts, reached.forces)

    def _reached(
        self,
        pose: Pose,
        fallen: BoolArray,
        led: float,
        whole: float,
        solids: Solids,
        case: LoadCase,
        found: MovedContacts,
        normals: Normals,
        history: TieHistory,
    ) -> Step | None:
        """The state at a pose, solved for the live work by which it goes on: gaps close by no more than they are.

        whole : live work to begin with; a whole step from the pose before where that was cut at the displacement asked
                for: over the short rest the work of gaps would outweigh that of the live load
        """
        work, best = whole, None
        for _ in range(MOST_WORKS):
            solved = self.program.solved(solids, case, found, work, normals)
            if solved is None:  # what overlaps on two sides cannot be pushed apart: then it may not overlap more
                apart = replace(found, gaps=np.maximum(found.gaps, 0.0))
                solved = self.program.solved(solids, case, apart, work, normals)
            if solved is None:
                break
            there, moved = solids.block_motions(solved.mechanism), self.control.displacement(self.model, pose)
            best = Step(moved, solved.load_factor, there, solved.contact_forces, pose, fallen, led, work, history)
            asked, normals = self.work_of(best), Normals.of(found.contacts, best.forces)
            best = self._going_on(best, min(asked, work))
            if abs(asked / work - 1.0) <= OFF:
                break
            work = asked
        return best

    def _ends_it(self, fallen: BoolArray) -> bool:
        """Whether too much has fallen to go on: of the control point, or of what a support that gives way carried."""
        if self.case.settlement is None:
            return float(self.control.weights[fallen[self.control.blocks]].sum()) > TAKEN
        return float(self.carried[fallen].sum()) > TAKEN * float(self.carried.sum())


def work_of(
    model: Model, control: Control, length: float, pose: Pose, mechanism: FloatArray, most: float = 1.0
) -> float:
    """Live work of a whole step: its length as far as the control point goes, m, and no block too far.

    mechanism : (n_blocks, 6) for a live power of 1
    most      : multiple of the greatest motion and rotation
    """
    moved = float((np.linalg.norm(mechanism[:, :3], axis=1) / model.blocks.sizes).max())
    turned = float(np.linalg.norm(mechanism[:, 3:], axis=1).max())
    far = min(LARGEST_MOTION / max(moved, 1e-300), LARGEST_TURN / max(turned, 1e-300)) * most
    speed = control.speed(model, pose, mechanism)
    return min(length / speed, far) if speed > 0.0 else far


def _drops(case: LoadCase, load_factor: float, mechanism: FloatArray) -> BoolArray:
    """Blocks that move in a motion, (n_blocks, 6), that the dead load drives and hardly the live load, (n_blocks,)."""
    speed = np.linalg.norm(mechanism[:, :3], axis=1)
    driven = float(np.vdot(case.dead_load, mechanism)) > DRIVEN * abs(load_factor)
    return np.asarray(driven & (speed > FAST * speed.max(initial=0.0)))


def history_after(model: Model, history: TieHistory, before: Pose, motion: FloatArray, pose: Pose) -> TieHistory:
    """Of ties after a step from one pose by a motion, (n_blocks, 6), to the next."""
    if not len(model.ties):
        return history
    here, there = (moved_ties(model.ties, model.blocks, each) for each in (before, pose))
    return history.after(before.moved(model.blocks), here, motion, there)


def _hanging(model: Model, contacts: Contacts, ties: Ties) -> BoolArray:
    """Free blocks that touch no support, directly or through others or ties, (n_blocks,)."""
    n_blocks = len(model.blocks)
    held = np.concatenate([model.fixed, np.ones(len(model.grounds), dtype=bool)])
    held[model.guides.blocks] = True
    node = np.where(held, len(held), np.arange(len(held)))
    pairs = [node[contacts.bodies], np.append(node, len(held))[ties.links(len(held))]]
    if contacts.solid_of_block is not None:
        first = np.unique(contacts.solid_of_block, return_index=True)[1]
        pairs.append(np.column_stack([node[:n_blocks], node[first[contacts.solid_of_block]]]))
    label = connected_labels(np.vstack(pairs), len(held) + 1)
    return np.asarray(~held[:n_blocks] & (label[:n_blocks] != label[-1]))
