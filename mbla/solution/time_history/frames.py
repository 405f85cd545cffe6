"""States of a time history that are kept: poses, momentum before and after a step, contact points with their forces.

A frame is one step: it begins at ``times`` with the poses given, velocities before it, and the memory of its joints; it
ends with the velocities after it. Momentum, contact law and gaps can be derived from it without the steps between::

    p − p₋ = h̄ (f + Gᵀ x) − m ΔV_g,    h̄ = (h + h₋)/2    (h₋ = 0 in the first step: it starts at rest)
    x_N = n̄ − k_N g − k_N' h u_N ≥ 0,    x_T = t̄ − k_T' h u_T,  ‖x_T‖ ≤ μ x_N + c,     u = G v,  k' = k (1 + β/h)

Bodies are the solids of the structure: blocks, those that glue joins, kinematic blocks, about their mass centres.
"""

from __future__ import annotations

from dataclasses import dataclass

from mbla.arrays import BoolArray, FloatArray, IntArray


@dataclass(frozen=True)
class PointSet:
    """Contact points as material points of their bodies, from one search for contacts to the next; ties last.

    bodies  : (n, 2) solids, then grounds; −1 of ties
    host    : (n,) whether b is the host, in whose frame the frame is
    arms    : (n, 2, 3) m, of the points of a and b from the reference points of their solids, as built
    frames  : (n, 3, 3) in the frame of the host
    laws    : (n,) rows of the joint laws of the model; of ties their rows
    areas   : (n,) m² that count for strength
    stiffness : (n, 3) k across and along, force per length
    dashpot : (n,) s, β of each point
    """

    bodies: IntArray
    host: BoolArray
    arms: FloatArray
    frames: FloatArray
    laws: IntArray
    areas: FloatArray
    stiffness: FloatArray
    dashpot: FloatArray


@dataclass(frozen=True)
class Frames:
    """n frames.

    times, lengths, lengths_before : (n,) s, begin of the step, h, and h₋ of the step before
    shifts, turns : (n, n_blocks, 3) m, rotation vectors: poses at the begin, from as built (sag included)
    solid_of_block : (n_blocks,)
    momenta_before : (n, n_solids, 6) linear and angular momentum (about the mass centre) before the step, force × s
    momenta : (n, n_solids, 6) after it
    velocities : (n, n_blocks, 6) after it, of centroids, and angular velocities
    base    : (n, 3) displacement of the base at the begin
    missed  : (n,) whether the step did not converge
    set_of_frame : (n,) number of its points in ``sets``
    point_start : (n + 1,) of the values of each frame in what follows
    remembered : (n_values, 3) N: n̄, the normal force at no gap (0 but of joints that have crushed, and ties), and t̄
    forces  : (n_values, 3) N, T1, T2: x, impulses of the step over h̄
    sets    : points
    """

    times: FloatArray
    lengths: FloatArray
    lengths_before: FloatArray
    shifts: FloatArray
    turns: FloatArray
    solid_of_block: IntArray
    momenta_before: FloatArray
    momenta: FloatArray
    velocities: FloatArray
    base: FloatArray
    missed: BoolArray
    set_of_frame: IntArray
    point_start: IntArray
    remembered: FloatArray
    forces: FloatArray
    sets: tuple[PointSet, ...]

    def __len__(self) -> int:
        return len(self.times)

    def values(self, frame: int) -> slice:
        """Place of the values of a frame."""
        return slice(int(self.point_start[frame]), int(self.point_start[frame + 1]))
