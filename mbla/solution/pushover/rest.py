"""A structure of elastic joints at rest under its dead load, at the pose to which the joints give."""

from __future__ import annotations

import numpy as np

from mbla.model.pose import Pose
from mbla.model.ties.moved import TieHistory
from mbla.solution.pushover.place import Energy, PushedPlace
from mbla.solution.pushover.pose.moved_joints import History, MovedJoints
from mbla.solution.pushover.pose.pose_step import PoseStep
from mbla.solution.pushover.pose.solved_step import solved
from mbla.solution.pushover.pose.structure import PushedStructure


def at_rest(structure: PushedStructure, ratio: float, *, settles: bool = False) -> tuple[PushedPlace | None, int]:
    """Where the structure rests, None where that is not found, and the factorisations that took.

    ratio   : stiffness of joints along over that across
    settles : whether a support is held that gives way later
    """
    none = np.zeros(structure.n_solids, dtype=np.bool_)
    ties, pose = TieHistory.at_rest(structure.model.ties), Pose.at_rest(structure.n_solids)
    joints = MovedJoints.at_pose(structure, pose, none, ties.broken(structure.model.ties), ratio)
    slips = np.zeros((joints.components - 1, joints.n_points))
    history = History(np.zeros((joints.components, joints.n_points)), slips)
    step = PoseStep(joints, history, joints.there(pose, 0.0), 0.0, 0.0, driven=settles)
    found = solved(step)
    if found is None or not found.solved:
        return None, step.spent
    after, factor = step.after(found.at, found.forces.normal), joints.full.scaling.load_factor(found.factor)
    twists = np.zeros((len(none), 6))
    return PushedPlace(found.at, joints, after, None, factor, twists, 0.0, ties, Energy()), step.spent
