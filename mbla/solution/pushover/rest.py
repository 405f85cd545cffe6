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

FITTED, LEFT, MORE = 60, 1e-6, 2.0
"""Times at most that ties are stretched anew until each carries its prestress at rest, what may be left of that, and
what they are stretched by at once, relative."""


def at_rest(
    structure: PushedStructure, ratio: float, *, settles: bool = False, prestressed: bool = False
) -> tuple[PushedPlace | None, int]:
    """Where the structure rests, None where that is not found, and the factorisations that took.

    ratio   : stiffness of joints along over that across
    settles : whether a support is held that gives way later
    prestressed : whether ties have their prestress, on which load factors and what is pushed do not depend
    """
    none = np.zeros(structure.n_solids, dtype=np.bool_)
    ties, pose = TieHistory.at_rest(structure.model.ties), Pose.at_rest(structure.n_solids)
    joints = MovedJoints.at_pose(structure, pose, none, ties.broken(structure.model.ties), ratio)
    slips = np.zeros((joints.components - 1, joints.n_points))
    values, there = np.zeros((joints.components, joints.n_points)), joints.there(pose, 0.0)
    wanted, spent = joints.prestress if prestressed else np.zeros(joints.n_points), 0
    values[0], holds = wanted, wanted != 0.0
    for _ in range(FITTED):
        step = PoseStep(joints, History(values, slips), there, 0.0, 0.0, driven=settles)
        found = solved(step)
        spent += step.spent
        if found is None or not found.solved:
            return None, spent
        carried = found.forces.normal[holds]
        if not (np.abs(carried - wanted[holds]) > LEFT * np.abs(wanted[holds])).any():
            break
        share = np.divide(wanted[holds], carried, out=np.full(len(carried), MORE), where=carried > 0.0)
        values[0, holds] *= np.minimum(share, MORE)  # joints give as ties are stretched
    else:
        return None, spent
    after, factor = step.after(found.at, found.forces.normal), joints.full.scaling.load_factor(found.factor)
    twists = np.zeros((len(none), 6))
    return PushedPlace(found.at, joints, after, None, factor, twists, 0.0, ties, Energy()), spent
