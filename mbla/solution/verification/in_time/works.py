"""Work in the steps of frames, from their forces and momenta, held against what rows say of these steps.

Everything does work on the mean of the velocities before and after the step, with h̄ = (h + h₋)/2::

    base −m ΔV·v̄      friction −h̄ T·ū_T      contacts −h̄ N ū_N      ties −h̄ N ū_N      forces (J + h̄ (f − f₀))·v̄

f₀ are dead loads that keep their direction, as if at mass centres, J impulses of forces over time. The angular velocity
before the step is that of its momentum with the inertia half a step ahead. Joints store N²/2k_N + T²/2k_T of what their
springs carry after the step; ties of what differs from the force that they were fitted with.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mbla.arrays import FloatArray, summed
from mbla.errors import Message
from mbla.solution.time_history.step_rows import StepRows
from mbla.solution.verification.in_time.bodies import MovedSolids
from mbla.solution.verification.in_time.contact import FrameContact
from mbla.solution.verification.in_time.frames import FrameCheck
from mbla.solution.verification.in_time.loads import dead_wrenches, force_wrenches, on_bodies, tie_limits
from mbla.solution.verification.in_time.rows import energy_scale, rows_of_frames, whole_steps

KINDS = ("base", "friction", "contacts", "ties", "forces", "elastic")
"""columns of the rows that follow from a frame; the last as it is after the step, the others by their change"""

WORK = 1e-5
"""Work of a step that is not that of its frame, over the greatest energy."""


def works_failures(check: FrameCheck, rows: StepRows, every: FloatArray) -> Iterator[Message]:
    """Where rows say other work, or another energy of joints, than frames; of steps that were made at once.

    every : (n_frames, 6) of ``works``
    """
    frames = check.frames
    at, whole = rows_of_frames(rows, frames, check.history.step), whole_steps(rows)
    own = [frame for frame in range(len(frames)) if at[frame] < len(whole) and whole[at[frame]]]
    if not own:
        return
    found = every[own]
    told = np.column_stack([np.diff(getattr(rows, kind))[at[own]] for kind in KINDS])
    told[:, -1] = rows.elastic[at[own] + 1]
    off = np.abs(found - told) / energy_scale(check.case, check.solids, rows, frames)
    for kind, values in zip(KINDS, off.T, strict=True):
        if not values.max() <= WORK:
            frame = own[int(np.argmax(np.where(np.isnan(values), np.inf, values)))]
            words = (
                f"the energy {kind} in the step at {frames.times[frame]:.4g} s is {values.max():.2g} of the greatest"
            )
            yield Message("time-energy", f"{words} off the forces and momenta of its frame, which exceeds {WORK:g}")


def works(check: FrameCheck, frame: int, after: FrameContact) -> FloatArray:
    """Of one frame, in the order of ``KINDS``, (6,).

    after : with velocities after the step
    """
    frames, solids, history, moved = check.frames, check.solids, check.history, after.moved
    between = float(frames.lengths[frame] + frames.lengths_before[frame]) / 2.0
    mean = _mean_motion(check, frame, moved)
    contact = FrameContact.of(frames, frame, moved, on_blocks(moved, mean))
    taken = -between * contact.forces * contact.closing
    surface = contact.surface
    dead = dead_wrenches(moved, check.case, history)
    given = on_bodies(moved, between * dead + force_wrenches(moved, history, check.impulses[frame]))
    kept = (check.case.dead_load - history.dead_following)[:, :3]
    given[:, :3] -= between * summed(solids.label, kept, len(solids))
    of_base = -float((solids.masses[:, None] * mean[:, :3]).sum(axis=0) @ check.changes[frame])
    across, along = taken[:, 0], taken[:, 1:].sum(axis=1)
    parts = of_base, along[surface].sum(), across[surface].sum(), across[~surface].sum(), (given * mean).sum()
    return np.array([*parts, _stored(after)], dtype=np.float64)


def _mean_motion(check: FrameCheck, frame: int, moved: MovedSolids) -> FloatArray:
    """Of bodies about mass centres, before and after the step, (n_solids, 6)."""
    frames, solids = check.frames, check.solids
    can = solids.free & (solids.masses > 0.0)
    inertia = check.inertia_ahead(frame, moved)[can]
    mean = np.zeros((len(solids), 6))
    momenta = (frames.momenta_before[frame] + frames.momenta[frame])[can] / 2.0
    mean[can, :3] = momenta[:, :3] / solids.masses[can, None]
    mean[can, 3:] = np.linalg.solve(inertia, momenta[:, 3:, None])[:, :, 0]
    return mean


def on_blocks(moved: MovedSolids, motion: FloatArray) -> FloatArray:
    """Velocities of the centroids of blocks and angular velocities, (n_blocks, 6), from those of bodies."""
    label = moved.solids.label
    arms = moved.block_centroids - moved.centres[label]
    own = motion[label]
    return np.hstack([own[:, :3] + np.cross(own[:, 3:], arms), own[:, 3:]])


def _stored(contact: FrameContact) -> float:
    """In the springs of joints and ties after the step."""
    normal, surface, stiffness = contact.forces[:, 0].copy(), contact.surface, contact.points.stiffness
    ties = contact.ties
    always = np.clip(np.zeros(len(ties)), *tie_limits(ties).T)
    normal[~surface] -= always[contact.points.laws[~surface]]
    shear = np.where(surface[:, None], contact.friction_kept(), 0.0)
    return 0.5 * float((normal**2 / stiffness[:, 0]).sum() + (shear**2 / stiffness[:, 1:]).sum())
