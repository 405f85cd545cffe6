"""What a structure does where no equilibrium lies nearby: it moves in time, to the next rest, or something falls.

Steps are implicit, of length h, with the masses of the solids and no velocity from the step before, so that nothing is
thrown: springs m g_0/h hold every solid where the step begins. h grows as the motion dies away.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.solution.pushover.place import PushedPlace, place_after
from mbla.solution.pushover.pose.moved_joints import MovedJoints
from mbla.solution.pushover.pose.pose_step import PoseStep, greatest_motion, turned_on
from mbla.solution.pushover.pose.smoothed_step import smoothed
from mbla.solution.pushover.renewal import renewed

FIRST, LEAST, LONGER, SHORTER, STEPS = 0.01, 1e-6, 1.5, 0.25, 400
"""Length of the first step over the size of a block, least length, factors on it after a step that succeeds and one
that fails, and most steps."""

TRIES = 3
"""Successive steps that fail, before a step begins without the state before."""

RESTS, GRAVITY = 3e-4, 9.81
"""Motion in a step over its length from which the structure rests, and g_0, in any unit of time."""

DROPPED, FAST = (0.05, 0.3), 0.3
"""Motion of a solid over its size from which it may fall, in a blocked jump and in any jump; motion, and work of the
weight, over the greatest of all solids, from which a solid falls."""


@dataclass(frozen=True)
class Jump:
    """Where a structure comes to rest, or the place before without what falls; nothing where neither is found.

    spent : factorisations
    """

    place: PushedPlace | None
    spent: int


def jump(place: PushedPlace, work: float, kappa: float, is_over: Callable[[BoolArray], bool]) -> Jump:
    """From a place where a step of some live work is blocked.

    kappa   : smoothing of the steps
    is_over : whether too much has fallen, (n_solids,)
    """
    size = float(np.median(place.joints.structure.solids.model.blocks.sizes))
    length, here, led, resting, spent, failed = FIRST * size, place, work, 0, 0, 0
    motion, none, share = np.zeros_like(place.twists), np.zeros_like(place.twists), 0.0
    for _ in range(STEPS):
        here = renewed(here, is_over)
        joints = here.joints
        if is_over(joints.fallen):
            return Jump(here, spent)
        held = GRAVITY / length * _masses(joints)
        step = PoseStep(joints, here.history, here.at, here.factor / joints.full.scaling.live, led, held=held)
        found = smoothed(step, turned_on(here.twists, share), here.state, share, kappa)
        spent += step.spent
        if found is None:
            length, share, failed = length * SHORTER, share * SHORTER, failed + 1
            if failed == TRIES:
                here = replace(here, state=None)
            if length < LEAST * size:
                break
            continue
        failed = 0
        here, led = place_after(step, found, here), 0.0
        resting = resting + 1 if greatest_motion(joints, here.twists) * size < RESTS * length else 0
        if resting == 2:
            return Jump(replace(here, twists=none, work=0.0, state=None), spent)
        motion[:, :3] = here.pose.shift - place.pose.shift
        if greatest_motion(joints, motion) > DROPPED[1]:
            break
        share = LONGER if found.directions <= 3 else 1.0
        length *= share
    drops = greatest_motion(place.joints, motion) > DROPPED[0]
    return Jump(_without(place, motion[:, :3], is_over) if drops else None, spent)


def _without(place: PushedPlace, motion: FloatArray, is_over: Callable[[BoolArray], bool]) -> PushedPlace | None:
    """The place without the solids that fall in a motion, (n_solids, 3); None where none does."""
    down = (place.at.loads[0][:, :3] * motion).sum(axis=1)
    speed = np.linalg.norm(motion, axis=1)
    falls = (speed > FAST * speed.max()) & (down > FAST * down.max())
    return renewed(place, is_over, falls) if falls.any() else None


def _masses(joints: MovedJoints) -> FloatArray:
    """Of the rows of the program, with a moment of inertia of a twelfth of mass times size squared, (n_rows,)."""
    blocks, scaling = joints.model.blocks, joints.full.scaling
    mass, size = blocks.masses[joints.full.facts.free], blocks.sizes[joints.full.facts.free]
    every = np.repeat(mass[:, None], 6, axis=1)
    every[:, 3:] *= (size**2)[:, None] / 12.0
    return np.asarray(joints.ways[0].power(2).T @ (every.ravel() * scaling.row**2 * scaling.live))
