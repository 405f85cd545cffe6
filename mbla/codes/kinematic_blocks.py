"""The kinematic blocks of a mechanism: their weights and virtual displacements, of which the articles make e*."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, summed
from mbla.assembly.assembly import Assembly
from mbla.model.model import LoadCase, Model
from mbla.model.pose import Pose
from mbla.results.collapse.collapse import collapse_of, failure_of
from mbla.solution.solution import Mechanics

IN_PLANE = 0.01
"""motion out of the vertical plane of the live load, over the greatest, from which a mechanism is one in space"""


@dataclass(frozen=True)
class KinematicBlocks:
    """Weights and virtual displacements of a mechanism, the greatest of a cluster 1.

    acceleration   : of the live load, in g
    weights, delta : (n,) of the clusters that move
    stones         : the same of single blocks, (m,), (m,)
    control        : of the control point; nan where there is none, or where it is not counted along the live load
    in_plane       : parallel to the vertical plane of the live load
    explained      : share of the motion that the clusters reproduce
    """

    acceleration: float
    weights: FloatArray
    delta: FloatArray
    stones: tuple[FloatArray, FloatArray]
    control: float
    in_plane: bool
    explained: float


def kinematic_blocks_of(assembly: Assembly, case: LoadCase, mechanics: Mechanics) -> KinematicBlocks:
    """Those of the mechanism of a load case, (n,) clusters that move."""
    model = assembly.model.of_case(case)
    motion, blocks = mechanics.mechanism, model.blocks
    live = case.live_load[:, :3].sum(axis=0) / model.total_weight
    acceleration = float(np.linalg.norm(live))
    along = live / acceleration
    failure = failure_of(model, assembly.contacts, collapse_of(assembly, case, mechanics), mechanics)
    speeds = (motion[:, :3] + np.cross(motion[:, 3:], blocks.mass_centres - blocks.centroids)) @ along
    moves, count = failure.clusters > 0, int(failure.clusters.max()) + 1
    weights = summed(failure.clusters, model.weights, count)[1:]
    delta = summed(failure.clusters, model.weights * speeds, count)[1:] / weights
    size = float(np.abs(delta).max())
    across = np.cross([0.0, 0.0, 1.0], along)
    off = np.abs(motion[:, :3] @ across) + blocks.sizes * np.linalg.norm(np.cross(motion[:, 3:], across), axis=1)
    return KinematicBlocks(
        acceleration,
        weights,
        delta / size,
        (model.weights[moves], speeds[moves] / size),
        _control_speed(model, case, motion, along) / size,
        bool(off.max() <= IN_PLANE * np.linalg.norm(motion[:, :3], axis=1).max()),
        failure.explained,
    )


def _control_speed(model: Model, case: LoadCase, motion: FloatArray, along: FloatArray) -> float:
    """Of the control point of a pushover, along the live load; nan where there is none or it counts another way."""
    if case.pushover is None:
        return math.nan
    from mbla.solution.pushover.control import Control  # late, as few load cases are pushed

    control = Control.of(model, case, motion)
    speed = control.speed(model, Pose.at_rest(len(model.blocks)), motion)
    return speed if float(control.direction @ along) > 1.0 - 1e-9 and speed > 0.0 else math.nan
