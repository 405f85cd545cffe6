"""Motions in two results: the angle between their mechanisms, and modes that are not the same in both.

The angle is as the kinetic energy of the blocks measures it:
cos φ = ⟨u, v⟩/√(⟨u, u⟩⟨v, v⟩) with ⟨u, v⟩ = Σ m u_b·v_b + ω_bᵀ J_b ω'_b over the blocks that both have: 0 degrees for
the same motion, however scaled; 90 where nothing of the one is in the other; 180 for the opposite motion.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.solids.blocks import Blocks
from mbla.results.collapse.interface_modes import InterfaceMode, interface_motion
from mbla.results.diff.matching import Matching, match_interfaces, match_points
from mbla.results.record.scene import scene_of
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import ContactMode


@dataclass(frozen=True)
class PointChange:
    """How many contact points have another mode: modes in A and in B."""

    modes: tuple[str, str]
    count: int


@dataclass(frozen=True)
class InterfaceChange:
    """An interface with another mode: its bodies as A names them, centroid in A (3,), modes in A and in B."""

    bodies: str
    centroid: FloatArray
    modes: tuple[str, str]


@dataclass(frozen=True)
class ModeComparison:
    """What joints do.

    contact_points : those with another mode, by modes
    compared       : contact points and interfaces that both have
    only           : contact points of A alone and of B alone
    interfaces     : every interface with another mode
    """

    contact_points: tuple[PointChange, ...]
    compared: dict[str, int]
    only: tuple[int, int]
    interfaces: tuple[InterfaceChange, ...]


def compare_modes(
    results: tuple[Results, Results], cases: tuple[CaseResult, CaseResult], matching: Matching, length: float
) -> ModeComparison:
    """Modes of two mechanisms at the contacts that both have; ``length`` is B's unit in that of A."""
    first, second = (each.contacts for each in results)
    sizes = results[0].model.blocks.sizes
    points, faces = (match(first, second, matching, sizes, length) for match in (match_points, match_interfaces))
    of_points, of_faces = zip(*(_modes(*each) for each in zip(results, cases, strict=True)), strict=True)
    there, both = np.flatnonzero(points >= 0), np.flatnonzero(faces >= 0)
    changed = there[of_points[0][there] != of_points[1][points[there]]]
    counts = Counter(zip(of_points[0][changed].tolist(), of_points[1][points[changed]].tolist(), strict=True))
    return ModeComparison(
        contact_points=tuple(PointChange(_words(ContactMode, pair), count) for pair, count in sorted(counts.items())),
        compared={"contact_points": len(there), "interfaces": len(both)},
        only=(len(points) - len(there), len(second.points) - len(np.unique(points[there]))),
        interfaces=tuple(
            InterfaceChange(
                "/".join(results[0].model.body_name(int(body)) for body in first.bodies[row]),
                first.centroids[row],
                _words(InterfaceMode, (of_faces[0][row], of_faces[1][faces[row]])),
            )
            for row in both[of_faces[0][both] != of_faces[1][faces[both]]]
        ),
    )


def _modes(results: Results, case: CaseResult) -> tuple[IntArray, IntArray]:
    """Of contact points, (n_points,), and interfaces, (n_interfaces,)."""
    scene = scene_of(results, case)
    assert scene.mechanics is not None  # asked for results only
    return scene.mechanics.modes, interface_motion(scene.model, scene.contacts, scene.mechanics).modes


def _words(kind: type[ContactMode] | type[InterfaceMode], modes: tuple[int, int]) -> tuple[str, str]:
    return kind(int(modes[0])).name.lower(), kind(int(modes[1])).name.lower()


def inertia_tensors(blocks: Blocks) -> FloatArray:
    """Of volumes about their centroids, (n_blocks, 3, 3) m5: the sum over tetrahedra of centroid and face triangles.

    ∫ x xᵀ of a tetrahedron 0, a, b, c is det(a, b, c)/120 (s sᵀ + a aᵀ + b bᵀ + c cᵀ) with s = a + b + c.
    """
    corners = np.arange(len(blocks.loops))
    face = blocks.face_of_corner
    first, last = blocks.loop_start[:-1][face], blocks.loop_start[1:][face] - 1
    inner = (corners > first) & (corners < last)
    at = corners[inner]
    block = blocks.block_of_face[face[inner]]
    points = blocks.vertices[blocks.loops]
    a, b, c = (points[rows] - blocks.centroids[block] for rows in (first[inner], at, at + 1))
    det = np.einsum("ij,ij->i", a, np.cross(b, c))
    total = a + b + c
    second = sum(x[:, :, None] * x[:, None, :] for x in (total, a, b, c)) * (det / 120.0)[:, None, None]
    moments = np.zeros((len(blocks), 3, 3))
    np.add.at(moments, block, second)
    return np.asarray(np.trace(moments, axis1=1, axis2=2)[:, None, None] * np.eye(3) - moments)


def angle_between(
    blocks: Blocks, first: FloatArray, second: FloatArray, matching: Matching, length: float
) -> float | None:
    """Degrees between mechanisms (n_blocks, 6) of A and of B; None where the blocks or a motion do not allow it.

    length : of B's unit of length in that of A
    """
    rows = matching.bodies[: len(blocks)]
    there = np.flatnonzero(rows >= 0)
    if not matching.comparable:
        return None
    density = blocks.densities[there] if (blocks.densities > 0).any() else np.ones(len(there))
    masses, inertia = density * blocks.volumes[there], density[:, None, None] * inertia_tensors(blocks)[there]
    u, v = first[there], second[rows[there]] * np.repeat([length, 1.0], 3)

    def product(x: FloatArray, y: FloatArray) -> float:
        of_rotations = np.einsum("bi,bij,bj->", x[:, 3:], inertia, y[:, 3:])
        return float(masses @ (x[:, :3] * y[:, :3]).sum(axis=1) + of_rotations)

    own, other = _of_unit_size(u, product), _of_unit_size(v, product)
    if own is None or other is None:
        return None
    # between unit vectors; the arc cosine alone loses small angles to rounding
    apart, together = product(own - other, own - other), product(own + other, own + other)
    return math.degrees(2.0 * math.atan2(math.sqrt(max(apart, 0.0)), math.sqrt(max(together, 0.0))))


def _of_unit_size(motion: FloatArray, product: Callable[[FloatArray, FloatArray], float]) -> FloatArray | None:
    largest = float(np.abs(motion).max(initial=0.0))
    if largest == 0.0 or not math.isfinite(largest):
        return None
    motion = motion / largest
    size = product(motion, motion)
    return None if size <= 0.0 else motion / math.sqrt(size)
