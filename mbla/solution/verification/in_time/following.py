"""Frames that follow each other at once: the second begins with the poses, momenta and friction that the first leaves.

Poses go on by the velocities of the step, c + h v and exp(h ω) R; what is remembered of friction is what the springs of
the joints carry of it, without their dashpots and within what the normal force allows::

    t̄ ← T + β k_T u_T,   shortened to μN + c
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mbla.errors import Message
from mbla.solution.verification.in_time.bodies import MovedSolids, rotations_of
from mbla.solution.verification.in_time.frames import FrameCheck
from mbla.solution.verification.in_time.rows import SAME_TIME

GOES_ON = 1e-6
"""Difference over the greatest momentum, size of bodies, or force, up to which the one goes on as the other."""


def following_failures(check: FrameCheck) -> Iterator[Message]:
    """Where frames do not go on from those before; only of steps that are whole."""
    frames, history = check.frames, check.history
    near = np.abs(frames.times[:-1] + frames.lengths[:-1] - frames.times[1:]) <= SAME_TIME * history.step
    near &= np.abs(frames.lengths_before[1:] - frames.lengths[:-1]) <= SAME_TIME * history.step
    for frame in np.flatnonzero(near).tolist():
        for what, off in _off(check, frame):
            if not off <= GOES_ON:
                words = f"{what} at {frames.times[frame + 1]:.4g} s are {off:.2g} off those that the step before leaves"
                yield Message("time-frames", words)
                return


def _off(check: FrameCheck, frame: int) -> Iterator[tuple[str, float]]:
    frames, solids, h = check.frames, check.solids, float(check.frames.lengths[frame])
    moved, there = (MovedSolids(solids, frames.shifts[each], frames.turns[each]) for each in (frame, frame + 1))
    free = solids.free
    momenta = (frames.momenta[frame] - frames.momenta_before[frame + 1])[free]
    yield "momenta", float(np.abs(momenta).max(initial=0.0)) / max(float(np.abs(frames.momenta).max()), 1e-300)
    motion = frames.velocities[frame, solids.first]
    arms = moved.centres - moved.block_centroids[solids.first]
    centres = moved.centres + h * (motion[:, :3] + np.cross(motion[:, 3:], arms))
    off = np.linalg.norm(there.centres - centres, axis=1) / solids.sizes
    turn = np.abs(rotations_of(h * motion[:, 3:]) @ moved.rotations - there.rotations).max(axis=(1, 2))
    yield "poses", float(np.max([off, turn], initial=0.0))
    if frames.set_of_frame[frame] == frames.set_of_frame[frame + 1]:
        contact = check.contact(frame)
        kept = contact.friction_kept()
        left = np.where(contact.points.bodies[:, :1] >= 0, frames.remembered[frames.values(frame + 1), 1:] - kept, 0.0)
        largest = max(float(np.abs(frames.forces[frames.values(frame)]).max(initial=0.0)), 1e-300)
        yield "friction forces", float(np.abs(left).max(initial=0.0)) / largest
