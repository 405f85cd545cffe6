"""Frames of a time history found again: gaps, the law of elastic joints with dashpots, momentum and velocities.

Each frame is a step from poses that are stored. A contact point is a material point of both bodies, in a frame F that
turns with the host. With its places x_a and x_b, β its dashpot, h the step and h₋ the one before::

    w = F (x_b − x_a),    u = F (v_b − v_a) at the slave's point
    N = m_N − k_N (w_N + (h + β) u_N)  within −f_t … f_c,    T = m_T − k_T (h + β) u_T,  shortened to μN + c
    p − p₋ = (h + h₋)/2 (f + Gᵀ (N, T)) − m ΔV_g

m are the forces that the point would have at w_N = 0 and without sliding; forces act at the slave's point. L = J ω with
the inertia half a step ahead, by the turn that ω before the step is. No code of the step is used, nor any matrix of the
program stage.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.model import LoadCase
from mbla.model.motion.time_history import TimeHistory
from mbla.model.pose import moved_model
from mbla.solution.time_history.frames import Frames
from mbla.solution.verification.in_time.bodies import MovedSolids, Solids, rotations_of, spins_before
from mbla.solution.verification.in_time.contact import FrameContact
from mbla.solution.verification.in_time.loads import (
    dead_wrenches,
    force_wrenches,
    free_fall,
    on_bodies,
)
from mbla.solution.verification.in_time.motion import base_changes, integrals
from mbla.solution.verification.statics import left_to_balance


@dataclass(frozen=True)
class FrameResidual:
    """How far a frame is from what it should be.

    law        : largest force off the law, over the largest force or the mean weight of a point
    closing    : the same as the velocity across or along a point that would explain it, over that of free fall in h
    momentum   : largest impulse, or angular one over size, that a body lacks, over the mean load of a body times h
    velocities : largest velocity that is not that of the momentum, over the fastest or that of free fall in h
    overlap    : of bodies at a point that is pressed, over the size of the smaller
    apart      : of blocks from the body that they are part of, over its size
    memory     : largest normal force that a joint which cannot crush remembers, over the largest force
    """

    law: float
    closing: float
    momentum: float
    velocities: float
    overlap: float
    apart: float
    memory: float


@dataclass(frozen=True)
class FrameCheck:
    """What frames are held against.

    changes  : (n, 3) of the velocity of the base in the step of each frame
    impulses : (n, n_forces) of forces over time
    """

    case: LoadCase
    history: TimeHistory
    solids: Solids
    frames: Frames
    changes: FloatArray
    impulses: FloatArray

    @staticmethod
    def of(case: LoadCase, history: TimeHistory, solids: Solids, frames: Frames) -> FrameCheck:
        """With what the records give of each frame."""
        begins, ends = frames.times - frames.lengths_before / 2.0, frames.times + frames.lengths / 2.0
        impulses = [integrals(force.signal, begins, ends) for force in history.forces]
        columns = np.column_stack(impulses) if impulses else np.zeros((len(frames), 0))
        return FrameCheck(case, history, solids, frames, base_changes(history, begins, ends), columns)

    def contact(self, frame: int) -> FrameContact:
        """Bodies, points and ties of a frame where they are, with velocities after the step."""
        frames = self.frames
        moved = MovedSolids(self.solids, frames.shifts[frame], frames.turns[frame])
        return FrameContact.of(frames, frame, moved)

    def residual(self, frame: int, contact: FrameContact) -> FrameResidual:
        """Of one frame."""
        frames, solids, moved = self.frames, self.solids, contact.moved
        weight = float(np.abs(self.case.dead_load[~solids.model.fixed, :3]).sum())
        off, closing = contact.off_law(self._fall(frame))
        forces = frames.forces[frames.values(frame)]
        largest = max(float(np.abs(forces).max(initial=0.0)), weight / max(len(forces), 1), 1e-300)
        remembered = np.abs(frames.remembered[frames.values(frame), 0])[np.isinf(contact.crush)]
        return FrameResidual(
            law=off / largest,
            closing=closing,
            momentum=self._momentum(frame, moved, contact),
            velocities=self._velocities(frame, moved),
            overlap=contact.overlap(),
            apart=moved.apart(),
            memory=float(remembered.max(initial=0.0)) / largest,
        )

    def _fall(self, frame: int) -> float:
        """Velocity of free fall in the step."""
        return free_fall(self.case, self.solids) * float(self.frames.lengths[frame])

    def _momentum(self, frame: int, moved: MovedSolids, contact: FrameContact) -> float:
        frames, solids, case = self.frames, self.solids, self.case
        h, before = float(frames.lengths[frame]), float(frames.lengths_before[frame])
        dead = dead_wrenches(moved, case, self.history)
        given = (h + before) / 2.0 * dead + force_wrenches(moved, self.history, self.impulses[frame])
        left = on_bodies(moved, given)
        left[:, :3] -= solids.masses[:, None] * self.changes[frame]
        contact.add_to(left, (h + before) / 2.0)
        left -= frames.momenta[frame] - frames.momenta_before[frame]
        left = _without_guides(solids, moved, left)
        off = np.hstack([left[:, :3], left[:, 3:] / solids.sizes[:, None]])[solids.free]
        own = np.linalg.norm(on_bodies(moved, dead)[solids.free, :3], axis=1)
        load = float(own.mean()) if len(own) and own.any() else float(np.abs(frames.momenta).max(initial=0.0)) / h
        return float(np.abs(off).max(initial=0.0)) / max(load * h, 1e-300)

    def inertia_ahead(self, frame: int, moved: MovedSolids) -> FloatArray:
        """Of the bodies half a step ahead, (n_solids, 3, 3)."""
        frames, solids = self.frames, self.solids
        before = float(frames.lengths_before[frame])
        begun = spins_before(solids, moved, frames.momenta_before[frame, :, 3:], before)
        ahead = rotations_of(begun * frames.lengths[frame] / 2.0) @ moved.rotations
        return np.asarray(ahead @ solids.tensors @ ahead.transpose(0, 2, 1))

    def _velocities(self, frame: int, moved: MovedSolids) -> float:
        """Of every block against the momentum of its body after the step."""
        frames, solids = self.frames, self.solids
        motion, momenta = frames.velocities[frame], frames.momenta[frame]
        label, size = solids.label, solids.sizes[solids.label]
        can = solids.free & (solids.masses > 0.0)
        inertia = self.inertia_ahead(frame, moved)
        spin, speed = np.zeros((len(solids), 3)), np.zeros((len(solids), 3))
        spin[can] = np.linalg.solve(inertia[can], momenta[can, 3:, None])[:, :, 0]
        speed[can] = momenta[can, :3] / solids.masses[can, None]
        arms = moved.block_centroids - moved.centres[label]
        off = motion[:, :3] - speed[label] - np.cross(spin[label], arms)
        turned = (motion[:, 3:] - spin[label]) * size[:, None]
        counts = can[label] | ~solids.free[label]
        fastest = np.linalg.norm(motion[:, :3], axis=1) + size * np.linalg.norm(motion[:, 3:], axis=1)
        largest = max(float(fastest.max(initial=0.0)), self._fall(frame))
        return float(np.abs(np.hstack([off, turned])[counts]).max(initial=0.0)) / largest


def _without_guides(solids: Solids, moved: MovedSolids, left: FloatArray) -> FloatArray:
    """What no guide takes of impulses on bodies about their mass centres, (n, 6)."""
    guides = solids.model.guides
    if not len(guides):
        return left
    block = guides.blocks
    body = solids.label[block]
    model = moved_model(solids.model, moved.pose)
    arms = moved.block_centroids[block] - moved.centres[body]
    on_blocks = np.zeros((len(solids.label), 6))
    on_blocks[block] = left[body]
    on_blocks[block, 3:] -= np.cross(arms, left[body, :3])
    kept = left_to_balance(model, on_blocks, np.cbrt(model.blocks.volumes))[block]
    found = left.copy()
    found[body] = np.hstack([kept[:, :3], kept[:, 3:] + np.cross(arms, kept[:, :3])])
    return found
