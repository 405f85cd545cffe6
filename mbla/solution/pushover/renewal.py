"""Renewal of contacts during a pushover: new contact points, their history, and bodies that have lost their support."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray
from mbla.contacts.carried import Placed
from mbla.model.pose import Pose
from mbla.model.solids.measures import connected_labels
from mbla.solution.pushover.inherited import inherited
from mbla.solution.pushover.place import PushedPlace
from mbla.solution.pushover.pose.moved_joints import History, MovedJoints

MOVED, FAR, SLIPPED = 0.04, 0.1, 0.01
"""Motion of two solids near each other over their size, of one that is near none, and slip of a point, from which
contacts are searched anew."""

NEAR = 2e-3
"""Gap over the size of the smaller block up to which a point may hold it."""


def renewed(place: PushedPlace, is_over: Callable[[BoolArray], bool], falls: BoolArray | None = None) -> PushedPlace:
    """The place with contacts found anew where something has moved since they were, and without debris.

    is_over : whether too much has fallen, (n_solids,): then contacts do not matter any more
    falls   : (n_solids,) that is debris from here on
    """
    joints, structure = place.joints, place.joints.structure
    broken = place.ties.broken(structure.model.ties)
    gone = len(joints.ties) > 0 and bool(broken[joints.ties].any())
    if falls is None and not gone and not is_stale(joints, place.pose):
        return place
    fallen = joints.fallen if falls is None else joints.fallen | falls
    while not is_over(fallen):
        there = MovedJoints.at_pose(structure, place.pose, fallen, broken, joints.ratio, (joints, place.history))
        at = there.there(place.pose, place.factor / there.full.scaling.live)
        history, state = inherited(place, there, at)
        hanging = _hanging(there, history)
        if not hanging.any():
            return replace(place, at=at, joints=there, history=history, state=state if falls is None else None)
        fallen = fallen | hanging
    return replace(place, joints=replace(joints, fallen=fallen))


def is_stale(joints: MovedJoints, pose: Pose, placed: Placed | None = None) -> bool:
    """Whether contacts may have come, or slipped, since they were found.

    placed : contact points at the pose, where they are known
    """
    since, solids = joints.found_at, joints.structure.solids.model.blocks
    sizes, (first, second) = solids.sizes, joints.nearness.pairs.T
    ways, turns = [], []
    for each in (since, pose):
        line = (solids.centroids + each.shift)[second] - (solids.centroids + each.shift)[first]
        ways.append(np.einsum("nji,nj->ni", each.rotation[first], line))
        turns.append(each.rotation[first].transpose(0, 2, 1) @ each.rotation[second])
    angle = np.sqrt(np.maximum(3.0 - np.einsum("nij,nij->n", *turns), 0.0))
    moved = np.linalg.norm(ways[1] - ways[0], axis=1) + 0.5 * angle * sizes[second]
    if bool(np.any(moved > MOVED * np.minimum(sizes[first], sizes[second]))):
        return True
    alone = np.linalg.norm(pose.shift - since.shift, axis=1) / sizes
    turned = np.einsum("nij,nij->n", since.rotation, pose.rotation)
    alone = alone + 0.5 * np.sqrt(np.maximum(3.0 - turned, 0.0))
    if bool(np.any(alone > np.where(joints.nearness.of_ground, MOVED, FAR))):
        return True
    slips = joints.touching.slips(joints.touching.points.at(pose) if placed is None else placed)
    return bool(np.any(slips > SLIPPED))


def _hanging(joints: MovedJoints, history: History) -> BoolArray:
    """Free solids that touch no support, directly or through others or ties, (n_solids,).

    Joints that dilate touch where they have opened by their slip.
    """
    model, n_solids = joints.model, joints.structure.n_solids
    held = np.append(np.concatenate([model.fixed, np.ones(len(model.grounds), dtype=bool)]), True)
    held[model.guides.blocks] = True
    held[joints.structure.solids.label[joints.structure.case.question.giving_way]] = True
    node = np.where(held, len(held) - 1, np.arange(len(held)))
    touching = joints.touching
    near = touching.points.at(joints.found_at).offsets[:, 0] - joints.opened(history) < NEAR * touching.sizes
    pairs = [node[touching.points.bodies[near]]]
    if joints.contacts.ties is not None:
        ties = joints.contacts.ties
        ends = joints.contacts.bodies[joints.contacts.interface_of_point[ties.points]]
        pairs += [node[np.column_stack([ends[:, side], ties.bodies])] for side in (0, 1)]
    label = connected_labels(np.vstack(pairs), len(held))
    return np.asarray(~held[:n_solids] & ~joints.fallen & (label[:n_solids] != label[-1]))
