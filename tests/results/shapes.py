"""Blocks of a few shapes, turned at random, with exact volumes."""

from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.solids.blocks import Blocks, labels_of

TETRA = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], 1 / 6)
WEDGE = (
    [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 2], [1, 0, 2], [0, 1, 2]],
    [[0, 1, 4, 3], [0, 2, 1], [1, 2, 5, 4], [3, 4, 5], [2, 0, 3, 5]],
    1.0,
)
BRICK = (
    [[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0], [0, 0, 1], [2, 0, 1], [2, 1, 1], [0, 1, 1]],
    [[3, 0, 4, 7], [0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6]],
    2.0,
)
PYRAMID = (
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 3]],
    [[0, 3, 2, 1], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
    1.0,
)


def normal_of(corners: FloatArray) -> FloatArray:
    """Unit normal of a convex face, by the right hand."""
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[1])
    return np.asarray(normal / np.linalg.norm(normal))


def blocks_of(shapes: Any, seed: int = 0) -> Blocks:
    """Blocks of these shapes: vertices renumbered and the whole turned at random, one beside the other."""
    generator = np.random.default_rng(seed)
    vertices: list[Any] = []
    loops: list[Any] = []
    centroids: list[Any] = []
    normals: list[Any] = []
    for i, (corners, faces, _) in enumerate(shapes):
        turn, _ = np.linalg.qr(generator.normal(size=(3, 3)))
        turn *= np.sign(np.linalg.det(turn))
        order = generator.permutation(len(corners))
        points = (np.asarray(corners, float)[order] + [4.0 * i, 0, 0]) @ turn.T
        place = np.argsort(order)
        faces = [np.roll(place[face], generator.integers(len(face))) for face in faces]
        faces = [faces[k] for k in generator.permutation(len(faces))]
        loops += [np.asarray(face) + sum(len(v) for v in vertices) for face in faces]
        vertices.append(points)
        centroids.append(points.mean(axis=0))
        normals += [normal_of(points[face]) for face in faces]
    n = len(shapes)
    faces_of = [len(faces) for _, faces, _ in shapes]
    return Blocks(
        vertices=np.vstack(vertices),
        vertex_start=np.concatenate([[0], np.cumsum([len(v) for v in vertices])]),
        loops=np.concatenate(loops),
        loop_start=np.concatenate([[0], np.cumsum([len(loop) for loop in loops])]),
        face_start=np.concatenate([[0], np.cumsum(faces_of)]),
        facet_of_face=np.arange(sum(faces_of)),
        face_normals=np.array(normals),
        convex=np.ones(n, dtype=bool),
        volumes=np.array([volume for _, _, volume in shapes]),
        centroids=np.array(centroids),
        added_masses=np.zeros(n),
        added_mass_points=np.array(centroids),
        densities=np.ones(n),
        groups=("shape",) * n,
        group_indices=np.arange(n),
        labels=labels_of(n),
    )
