"""States of a time history that are kept: poses, momentum before and after a step, contact points with their forces.

A frame is one step: it begins at ``times`` with the poses given, velocities before it, and the memory of its joints; it
ends with the velocities after it. Momentum, contact law and gaps can be derived from it without the steps between::

    M (v − v₋) = (h + h₋)/2 f − M ΔV_g + Gᵀ P,    P = h x    (h₋ = 0 in the first step: it starts at rest)
    n̄ = −k_N g,  x_N = n̄ − k_N' h u_N ≥ 0,    x_T = t̄ − k_T' h u_T,  ‖x_T‖ ≤ μ x_N + c,     u = G v,  k' = k (1 + β/h)
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
    interfaces : (n,) number of the interface of the assembly with the same two bodies (−1: bodies that met later, ties)
    areas   : (n,) m² that count for strength
    stiffness : (n, 3) k across and along, force per length
    dashpot : (n,) s, β of each point
    """

    bodies: IntArray
    host: BoolArray
    arms: FloatArray
    frames: FloatArray
    laws: IntArray
    interfaces: IntArray
    areas: FloatArray
    stiffness: FloatArray
    dashpot: FloatArray


@dataclass(frozen=True)
class Frames:
    """n frames.

    times, lengths, lengths_before : (n,) s, begin of the step, h, and h₋ of the step before
    shifts, turns : (n, n_blocks, 3) m, rotation vectors: poses at the begin, from as built (sag included)
    momenta_before : (n, n_solids, 6) linear and angular momentum (about the mass centre) before the step, force × s
    momenta : (n, n_solids, 6) after it
    velocities : (n, n_blocks, 6) after it, of centroids, and angular velocities
    base    : (n, 3) displacement of the base at the begin
    missed  : (n,) whether the step did not converge
    set_of_frame : (n,) number of its points in ``sets``
    point_start : (n + 1,) of the values of each frame in what follows
    remembered : (n_values, 3) N: n̄ of the law at gap 0 (0 but for crushing), and t̄ at the begin
    forces  : (n_values, 3) N, T1, T2: impulses of the step over h
    sets    : points
    """

    times: FloatArray
    lengths: FloatArray
    lengths_before: FloatArray
    shifts: FloatArray
    turns: FloatArray
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
