"""Blocks carried along by a mechanism, for files and pictures: displacements to a scale that can be seen.

A mechanism has no size of its own. It is drawn so that the farthest corner moves by a tenth of the size of the part of
the model that can move, or the fastest block turns by half a radian, whichever comes first. Every block follows its own
screw: parts that turn against each other come apart at their hinge by the square of the angle, less than can be seen.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.model import Model
from mbla.model.pose import paths_of, screws
from mbla.model.solids.blocks import Blocks
from mbla.results.results import CaseResult
from mbla.solution.time_history.frames import Frames
from mbla.solution.time_history.history import TimeHistoryResult

SHARE_OF_SIZE = 0.1
"""largest displacement over the diagonal of the box around the free blocks"""
LARGEST_ROTATION = 0.5
"""radians; without this limit a small block that spins in a large model would turn several times"""


SAME_POSE = 1e-7
"""difference of rotations, and of displacements over the size of the model, of blocks that keep together"""


def drawn_motion(model: Model, case: CaseResult | None) -> FloatArray:
    """Displacement and rotation of each block as drawn, (n_blocks, 6) m and rad.

    From the mechanism; without equilibrium from the motion that proves it; of a structure in time where it is displaced
    most, or has fallen, to no smaller scale than its own; zero where there is none of these or no case.
    """
    if case is not None and case.solution.mechanics is not None:
        motion = case.solution.mechanics.mechanism
    elif case is not None and case.solution.certificate is not None:
        motion = case.solution.certificate
    elif case is not None and (frames := case.solution.further.time_history.frames) is not None:
        motion = history_motion(frames, peak_state(case.solution.further.time_history))
        return max(motion_scale(model, motion), 1.0) * motion
    else:
        return np.zeros((len(model.blocks), 6))
    return motion_scale(model, motion) * motion


def motion_scale(model: Model, motion: FloatArray) -> float:
    """Factor from velocities to displacements as drawn; 0 where nothing moves.

    motion : (n_blocks, 6) velocity and angular velocity about the centroid
    """
    displacement = np.linalg.norm(vertex_displacements(model.blocks, motion), axis=1).max(initial=0.0)
    rotation = np.linalg.norm(motion[:, 3:], axis=1).max(initial=0.0)
    if displacement == 0.0:
        return 0.0
    scale = SHARE_OF_SIZE * movable_size(model) / displacement
    return float(min(scale, LARGEST_ROTATION / rotation) if rotation > 0 else scale)


def movable_size(model: Model) -> float:
    """Diagonal of the box around the free blocks, m."""
    free = ~model.fixed[model.blocks.block_of_vertex]
    vertices = model.blocks.vertices[free] if free.any() else model.blocks.vertices
    return float(np.linalg.norm(np.ptp(vertices, axis=0)))


def displacements_at(blocks: Blocks, motion: FloatArray, owners: IntArray, points: FloatArray) -> FloatArray:
    """Linearised displacement of points that belong to blocks, u + θ × (p − c), (n, 3) m."""
    arms = points - blocks.centroids[owners]
    return np.asarray(motion[owners, :3] + np.cross(motion[owners, 3:], arms))


def vertex_displacements(blocks: Blocks, motion: FloatArray) -> FloatArray:
    """Linearised displacement of every vertex, (n_vertices, 3) m."""
    return displacements_at(blocks, motion, blocks.block_of_vertex, blocks.vertices)


def largest_displacements(blocks: Blocks, motion: FloatArray) -> FloatArray:
    """Linearised displacement of the corner of each block that moves most, (n_blocks,) m."""
    largest = np.zeros(len(blocks))
    np.maximum.at(largest, blocks.block_of_vertex, np.linalg.norm(vertex_displacements(blocks, motion), axis=1))
    return largest


def mean_displacements(blocks: Blocks, motion: FloatArray, bodies: IntArray, points: FloatArray) -> FloatArray:
    """Mean linearised displacement of two bodies at each point, (n, 3) m; grounds do not move.

    bodies : (n, 2) of each point, blocks and then grounds
    """
    total = np.zeros_like(points)
    for owners in bodies.T:
        block = owners < len(blocks)
        total[block] += displacements_at(blocks, motion, owners[block], points[block])
    return total / 2


def moved_vertices(blocks: Blocks, motion: FloatArray) -> FloatArray:
    """Vertices after a finite motion, (n_vertices, 3) m; see ``moved_points``."""
    return moved_points(blocks, motion, blocks.block_of_vertex, blocks.vertices)


def moved_points(blocks: Blocks, motion: FloatArray, owners: IntArray, points: FloatArray) -> FloatArray:
    """Points of blocks after a finite motion, (n, 3) m: the screw that the motion of their block is the beginning of.

    It is the exponential of the twist (u, θ), p' = c + V u + R (p − c) with R = exp(K) and V = ∫₀¹ exp(s K) ds, K the
    cross-product matrix of θ. It keeps the shape of blocks, turns a part about its hinge and not about its centroid,
    and moves blocks that move as one body alike, so that they do not part (Murray, Li and Sastry 1994, section 2.3.2).

    motion : (n_blocks, 6) displacement of the centroid m and rotation vector rad
    owners : (n,) block of each point
    """
    rotation, travel = screws(motion)
    turned = np.einsum("vij,vj->vi", rotation[owners], points - blocks.centroids[owners])
    return np.asarray((blocks.centroids + travel)[owners] + turned)


def rigid_frames(blocks: Blocks, motion: FloatArray, origin: FloatArray, count: int) -> tuple[IntArray, FloatArray]:
    """Parts that keep together, and where they are in frames from rest to a finite motion: p' = R p + d.

    Returns the part of each block, (n_blocks,), 0 for what does not move, and [R | d] of each part in each frame,
    (count + 1, n_parts, 3, 4), d in m, of points p from ``origin``, (3,) m.
    """
    centres, found = blocks.centroids - origin, np.empty((count + 1, len(blocks), 3, 4))
    for frame, share in enumerate(np.linspace(0.0, 1.0, count + 1).tolist()):
        rotation, travel = screws(share * motion)
        found[frame, :, :, :3] = rotation
        found[frame, :, :, 3] = centres + travel - np.einsum("nij,nj->ni", rotation, centres)
    moving = np.flatnonzero(np.any(motion != 0, axis=1))
    size = float(np.linalg.norm(np.ptp(blocks.vertices, axis=0)))
    last = (found[-1, moving] / [1.0, 1.0, 1.0, size]).reshape(-1, 12)
    _, first, part = np.unique(np.rint(last / SAME_POSE), axis=0, return_index=True, return_inverse=True)
    parts = np.zeros(len(blocks), dtype=np.int64)
    parts[moving] = 1 + part.ravel()
    rest = np.broadcast_to(np.eye(3, 4), (count + 1, 1, 3, 4))
    return parts, np.concatenate([rest, found[:, moving[first]]], axis=1)


def pushed_motions(case: CaseResult) -> list[FloatArray]:
    """Twist of each block from where it was built to where it is at each step of a pushover, (n_blocks, 6) each."""
    steps = case.solution.further.pushover.rows
    return [twists_to(pose.shift, pose.rotation_vectors) for pose in (steps.poses if steps is not None else ())]


def history_motion(frames: Frames, state: int) -> FloatArray:
    """The same of a state of a structure in time, relative to the base, (n_blocks, 6)."""
    return twists_to(frames.shifts[state], frames.turns[state])


def end_motion(found: TimeHistoryResult) -> tuple[float, FloatArray] | None:
    """When it ends, s, and the same there; None where no state that is kept begins before that.

    States begin with a step, and after the last one there is none.
    """
    assert found.rows is not None  # as frames are
    assert found.frames is not None
    assert found.peaks is not None
    end, ends = float(found.rows.times[-1]), found.peaks.ends
    return (end, twists_to(ends[:, :3], ends[:, 3:])) if end > float(found.frames.times[-1]) else None


def peak_state(found: TimeHistoryResult) -> int:
    """The state that is kept next to the greatest displacement; the last one of a structure that falls."""
    assert found.frames is not None  # a structure that stands has states
    assert found.peaks is not None
    if found.peaks.first_to_fall >= 0:
        return len(found.frames) - 1
    return int(np.abs(found.frames.times - found.peaks.times[found.peaks.block]).argmin())


def twists_to(shifts: FloatArray, turns: FloatArray) -> FloatArray:
    """Twists (n_blocks, 6) whose screws lead to displacements and rotation vectors, (n_blocks, 3) each."""
    paths = paths_of(turns)[1]
    return np.hstack([np.linalg.solve(paths, shifts[:, :, None])[:, :, 0], turns])
