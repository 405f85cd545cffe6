"""Mirror symmetry of structure and load, found on what the program is made of: centroids, contact points, loads.

A mirror plane with unit normal m and reflection R = I − 2 m mᵀ maps block b to block σb and contact point k to πk. A
motion (v, ω) of b becomes (R v, −R ω) of σb: an angular velocity is an axial vector. A force F on body b of a point
becomes R F on σb. Under associative flow the program is convex, so that the mean of an optimum and its mirror image is
an optimum too: symmetric motions and forces are enough.

``half_of`` makes the program of one half of the structure.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.program.lift import Lift
from mbla.program.program import Program
from mbla.program.reductions.restrict import block_matrix, chosen_limits, restricted
from mbla.program.reductions.scene import SYMMETRIC, ProgramGeometry

FEW = 1000
"""Points of which all distances are compared: loading scipy's tree of points takes longer."""


@dataclass(frozen=True)
class MirrorPlane:
    """One plane of symmetry.

    normal        : (3,) unit
    block_of      : (n_free,) σ
    point_of      : (n_points,) π
    velocity_maps : (6, 6) on the motion of a block
    force_maps    : (n_points, 3, 3) from the components of the force at k to those at πk
    """

    normal: FloatArray
    block_of: IntArray
    point_of: IntArray
    velocity_map: FloatArray
    force_maps: FloatArray

    def keeps_interfaces(self, interfaces: IntArray) -> bool:
        """Whether the image of an interface is one, and no pieces of several: of each point, (n_points,), its own."""
        pairs = np.unique(np.column_stack([interfaces, interfaces[self.point_of]]), axis=0)
        return len(pairs) == len(np.unique(interfaces))


def mirror_candidates(scene: ProgramGeometry) -> Iterator[FloatArray]:
    """Unit normals, (3,) each, that a mirror plane could have, the likely ones first.

    Loads lie in the plane, or they come in mirrored pairs; so the plane holds the resultants. Where all joints have
    their normals in one plane, that plane is the likely one; then the axes, and the principal axes of the structure.
    """
    dead, live = (load[:, :3].sum(axis=0) for load in scene.loads())
    _, sizes, rows = np.linalg.svd(scene.frames[:, 0], full_matrices=len(scene.points) < 3)
    spread = scene.centroids - scene.centroids.mean(axis=0)
    normals = [
        row for row, size in zip(rows[::-1], [*sizes, 0, 0, 0][:3][::-1], strict=False) if size <= 1e-9 * sizes[0]
    ]
    normals += [np.cross(dead, live), *np.eye(3), *np.linalg.eigh(spread.T @ spread)[1].T]
    largest = max(float(np.linalg.norm(dead)), float(np.linalg.norm(live)), 1e-300)
    tried: list[FloatArray] = []
    for normal in normals:
        length = float(np.linalg.norm(normal))
        if length <= 1e-9 * largest**2 and length < 0.5:
            continue
        unit = normal / length
        unit = unit * np.sign(unit[np.abs(unit).argmax()])
        in_plane = max(abs(float(unit @ dead)), abs(float(unit @ live))) <= 1e-8 * largest
        if in_plane and not any(abs(abs(float(unit @ other)) - 1.0) < 1e-12 for other in tried):
            tried.append(unit)
            yield unit


def mirror_about(scene: ProgramGeometry, normal: FloatArray) -> MirrorPlane | None:
    """The mirror symmetry about the plane through the mean of the centroids with that normal; None if there is none.

    normal : (3,) unit
    """
    reflect = np.eye(3) - 2.0 * np.outer(normal, normal)
    middle = scene.centroids.mean(axis=0)
    block_of = _matched(
        scene.centroids - middle,
        (scene.centroids - middle) @ reflect,
        scene.symmetric * np.maximum(scene.arms, scene.length),
    )
    if block_of is None or np.any(block_of[block_of] != np.arange(len(block_of))):
        return None
    if np.abs(scene.arms[block_of] / scene.arms - 1.0).max(initial=0.0) > scene.symmetric:
        return None
    velocity_map = np.zeros((6, 6))
    velocity_map[:3, :3], velocity_map[3:, 3:] = reflect, -reflect
    if not _loads_match(scene, block_of, velocity_map) or not _guides_match(scene, block_of, velocity_map):
        return None
    return _with_points(scene, normal, reflect, middle, block_of, velocity_map)


def _matched(there: FloatArray, image: FloatArray, apart: FloatArray | float) -> IntArray | None:
    """Row of ``there`` at each row of ``image``, each used once; None where one has no partner."""
    distance, row = _nearest(there, image)
    if np.any(distance > apart) or len(np.unique(row)) < len(row):
        return None
    return row


def _nearest(there: FloatArray, image: FloatArray) -> tuple[FloatArray, IntArray]:
    """Distance and row of the point of ``there`` next to each of ``image``."""
    if len(there) <= FEW:
        squares = np.zeros((len(image), len(there)))
        for here, other in zip(image.T, there.T, strict=True):
            squares += np.subtract.outer(here, other) ** 2
        row = np.asarray(squares.argmin(axis=1), dtype=np.int64)
        return np.asarray(np.sqrt(((image - there[row]) ** 2).sum(axis=1))), row
    from scipy.spatial import cKDTree

    distance, nearest = cKDTree(there).query(image)
    return np.asarray(distance, dtype=np.float64), np.asarray(nearest, dtype=np.int64)


def _loads_match(scene: ProgramGeometry, block_of: IntArray, velocity_map: FloatArray) -> bool:
    for load in scene.loads():
        size = np.abs(load).max(initial=0.0)
        image = np.zeros_like(load)
        image[block_of] = load @ velocity_map.T
        if np.abs(image - load).max(initial=0.0) > SYMMETRIC * size:
            return False
    return True


def _guides_match(scene: ProgramGeometry, block_of: IntArray, velocity_map: FloatArray) -> bool:
    """Whether the image of every motion that guides allow is allowed: M Π Mᵀ = Π."""
    if scene.allowed is None:
        return True
    n = len(block_of)
    image = block_matrix(np.broadcast_to(velocity_map, (n, 6, 6)), block_of, np.arange(n), (n, n))
    off = abs(image @ scene.allowed @ image.T - scene.allowed)
    return off.nnz == 0 or float(off.max()) <= SYMMETRIC


def _with_points(
    scene: ProgramGeometry,
    normal: FloatArray,
    reflect: FloatArray,
    middle: FloatArray,
    block_of: IntArray,
    velocity_map: FloatArray,
) -> MirrorPlane | None:
    """The symmetry with its contact points; None where they or their joint laws do not match."""
    image_bodies = np.append(block_of, -1)[scene.bodies]
    images = (scene.points - middle) @ reflect
    here = _features(scene.points - middle, scene.bodies, scene.frames[:, 0], scene.length)
    there = _features(images, image_bodies, scene.frames[:, 0] @ reflect, scene.length)
    own = _middles_of_interfaces(scene) - middle
    point_of = _matched_points(
        np.hstack([here, own / scene.length]), np.hstack([there, own @ reflect / scene.length]), scene.symmetric
    )
    if point_of is None:  # an interface that comes in pieces, its image in one
        point_of = _matched_points(here, there, scene.symmetric)
    if point_of is None:
        return None
    limits = scene.program.limits
    laws = np.column_stack([limits.friction, limits.dilatancy, limits.cohesion, limits.tension, limits.compression])
    if not np.allclose(laws[point_of], laws, rtol=SYMMETRIC, atol=0.0):
        return None
    same_side = (scene.bodies[point_of] == image_bodies).all(axis=1)
    sign = np.where(same_side, 1, -1)
    if np.any(scene.cut[point_of] != sign * scene.cut):
        return None
    force_maps = sign[:, None, None] * (scene.frames[point_of] @ reflect @ scene.frames.transpose(0, 2, 1))
    if np.abs(force_maps[:, 0, 0] - 1.0).max(initial=0.0) > scene.symmetric:
        return None
    found = MirrorPlane(normal, block_of, point_of, velocity_map, force_maps)
    return found if _ties_match(scene, found) else None


def _ties_match(scene: ProgramGeometry, mirror: MirrorPlane) -> bool:
    """Whether the image of a tie that pulls at further bodies pulls at their images."""
    passing, n = np.unique(scene.linking), len(mirror.block_of)
    if not len(passing):
        return True
    images = block_matrix(np.broadcast_to(mirror.velocity_map, (n, 6, 6)), mirror.block_of, np.arange(n), (n, n))
    matrix = sp.csc_array(scene.program.equilibrium_matrix)
    off = abs(images @ matrix[:, 3 * passing] - matrix[:, 3 * mirror.point_of[passing]])
    return off.nnz == 0 or float(off.max()) <= SYMMETRIC * float(abs(matrix[:, 3 * passing]).max())


def _matched_points(here: FloatArray, there: FloatArray, apart: float) -> IntArray | None:
    """Row of ``here`` at each row of ``there``, which is its image in turn; None where there are none such."""
    point_of = _matched(here, there, apart)
    return None if point_of is None or np.any(point_of[point_of] != np.arange(len(point_of))) else point_of


def _middles_of_interfaces(scene: ProgramGeometry) -> FloatArray:
    """Mean of the points of its interface for every point, (n_points, 3): it distinguishes points in one place."""
    count = np.maximum(np.bincount(scene.interfaces), 1)
    means = np.column_stack([np.bincount(scene.interfaces, axis) / count for axis in scene.points.T])
    return np.asarray(means[scene.interfaces])


def _features(points: FloatArray, bodies: IntArray, normals: FloatArray, length: float) -> FloatArray:
    """Position, pair of bodies and normal (from the lower body to the higher one) of contact points, as coordinates."""
    turned = np.where(bodies[:, 0] <= bodies[:, 1], 1.0, -1.0)[:, None]
    return np.column_stack([points / length, 10.0 * np.sort(bodies, axis=1), normals * turned])


def half_of(scene: ProgramGeometry, mirror: MirrorPlane) -> tuple[Program, Lift]:
    """The program with unknowns on one side of the plane, symmetric motions and symmetric forces, and the way back.

    A point that stands for two has the force and the strength of both, and so moves as each of them does.
    """
    points = np.arange(len(mirror.point_of))
    kept = np.flatnonzero(points <= mirror.point_of)
    limits = chosen_limits(scene.program.limits, kept)
    stands_for = np.where(mirror.point_of[kept] == kept, 1.0, 2.0)
    limits = replace(
        limits,
        cohesion=stands_for * limits.cohesion,
        tension=stands_for * limits.tension,
        compression=stands_for * limits.compression,
    )
    way = Lift(scene.program, _symmetric_motions(mirror), _symmetric_forces(mirror), scene.program.components)
    return replace(restricted(scene.program, way.velocities, way.forces, limits), of_blocks=way), way


def in_plane_directions(normal: FloatArray) -> FloatArray:
    """Two unit vectors across the normal, as near to the axes as may be, (2, 3)."""
    axis = np.eye(3)[np.abs(normal).argmin()]
    first = axis - (axis @ normal) * normal
    first = first / np.linalg.norm(first)
    return np.array([first, np.cross(normal, first)])


def in_plane_motions(normal: FloatArray) -> FloatArray:
    """Motions of a block that its mirror image repeats, (6, 3): two translations in the plane, rotation about m."""
    basis = np.zeros((6, 3))
    basis[:3, :2] = in_plane_directions(normal).T
    basis[3:, 2] = normal
    return basis


def _symmetric_motions(mirror: MirrorPlane) -> sp.csr_array:
    """S, orthonormal columns: six for a pair of blocks, three for a block that the plane halves."""
    blocks = np.arange(len(mirror.block_of))
    first, alone = np.flatnonzero(blocks < mirror.block_of), np.flatnonzero(blocks == mirror.block_of)
    n, columns = len(blocks), np.arange(len(first))
    here = block_matrix(np.broadcast_to(np.eye(6), (len(first), 6, 6)), first, columns, (n, len(first)))
    images = np.broadcast_to(mirror.velocity_map, (len(first), 6, 6))
    there = block_matrix(images, mirror.block_of[first], columns, (n, len(first)))
    own = np.broadcast_to(in_plane_motions(mirror.normal), (len(alone), 6, 3))
    halved = block_matrix(own, alone, np.arange(len(alone)), (n, len(alone)))
    return sp.csr_array(sp.hstack([(here + there) / np.sqrt(2.0), halved]))


def _symmetric_forces(mirror: MirrorPlane) -> sp.csr_array:
    """P: half of the force at a point and half at its image; at a point in the plane the mean of both."""
    points = np.arange(len(mirror.point_of))
    kept = np.flatnonzero(points <= mirror.point_of)
    partner, columns, shape = mirror.point_of[kept], np.arange(len(kept)), (len(points), len(kept))
    here = block_matrix(np.broadcast_to(0.5 * np.eye(3), (len(kept), 3, 3)), kept, columns, shape)
    return sp.csr_array(here + block_matrix(0.5 * mirror.force_maps[kept], partner, columns, shape))
