"""What broke, yielded and crushed while a structure moved in time, from the states that are kept of it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.model.model import Model
from mbla.model.ties.ties import Ties
from mbla.solution.time_history.frames import Frames, PointSet
from mbla.solution.time_history.history import TimeHistoryResult

AT_CAPACITY = 1e-6
"""Share of its capacity that the force of a tie may miss where it yields."""
NO_DEPTH = 1e-9
"""Crushing over the size of blocks that is rounding."""


@dataclass(frozen=True)
class HistoryDamage:
    """What joints and ties have suffered.

    broken   : ties that broke by their rows in the model, with the time of the first state without them, s
    yielded  : rows of ties that yielded and did not break
    crushing : greatest depth by which a joint has crushed, m; nan where no joint that is there can crush
    bodies   : of that joint, blocks, then grounds; of a kinematic block the first; −1 where none has
    """

    broken: tuple[tuple[int, float], ...] = ()
    yielded: tuple[int, ...] = ()
    crushing: float = math.nan
    bodies: tuple[int, int] = (-1, -1)


def history_damage(model: Model, found: TimeHistoryResult) -> HistoryDamage:
    """Nothing of what was not followed.

    model : as it may move under the load case
    """
    frames = found.frames
    if frames is None or not len(frames):
        return HistoryDamage()
    crushes = np.isfinite([joint.compressive_strength for joint in model.joints.values()])
    there, yields, broken = _ties_of(frames, 0), set[int](), dict[int, float]()
    depth, bodies = math.nan, (-1, -1)
    for number in range(len(frames)):
        points, values = frames.sets[int(frames.set_of_frame[number])], frames.values(number)
        for tie in there - _ties_of(frames, number):
            broken.setdefault(tie, float(frames.times[number]))
        of_ties = points.bodies[:, 0] < 0
        yields |= set(_at_capacity(model.ties, points, frames.forces[values][:, 0], of_ties))
        can = np.flatnonzero(~of_ties)
        can = can[crushes[points.laws[can]]]
        if len(can):
            crushed = np.maximum(-frames.remembered[values][can, 0] / points.stiffness[can, 0], 0.0)
            worst = int(crushed.argmax())
            if math.isnan(depth) or crushed[worst] > depth:
                depth, bodies = float(crushed[worst]), _bodies_of(model, frames, points, int(can[worst]))
    if not depth > NO_DEPTH * float(model.blocks.sizes.mean()):
        depth, bodies = 0.0 * depth, (-1, -1)
    return HistoryDamage(tuple(broken.items()), tuple(sorted(yields - broken.keys())), depth, bodies)


def _ties_of(frames: Frames, number: int) -> set[int]:
    """Rows of ties that a state has."""
    points = frames.sets[int(frames.set_of_frame[number])]
    return set(points.laws[points.bodies[:, 0] < 0].tolist())


def _at_capacity(ties: Ties, points: PointSet, forces: FloatArray, of_ties: BoolArray) -> list[int]:
    """Rows of ties, other than fill, whose force, (n_points,) of all points, is the greatest in a sense they take."""
    rows = points.laws[of_ties]
    if not len(rows):
        return []
    least, most = ties.least[rows], ties.greatest[rows]
    tension = np.where(most > 0.0, 1.0, -1.0) * forces[of_ties]
    pulled = (most > 0.0) & (tension >= (1.0 - AT_CAPACITY) * most)
    pushed = (least < 0.0) & (tension <= (1.0 - AT_CAPACITY) * least)
    return [int(row) for row in rows[(pulled | pushed) & ~ties.of_fill[rows]]]


def _bodies_of(model: Model, frames: Frames, points: PointSet, row: int) -> tuple[int, int]:
    """Bodies of a point, of solids their first block."""
    n_solids = int(frames.solid_of_block.max()) + 1
    found = [
        int(np.flatnonzero(frames.solid_of_block == body)[0])
        if body < n_solids
        else len(model.blocks) + body - n_solids
        for body in points.bodies[row].tolist()
    ]
    return found[0], found[1]
