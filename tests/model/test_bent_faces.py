from __future__ import annotations

import itertools

import numpy as np
import pytest

from mbla.model.solids.build import BuiltBlocks
from tests.model.shapes import Shape, box, build, moved, rotation


def lifted(height: float, order: tuple[int, ...] = (4, 5, 6, 7)) -> Shape:
    """A cube with the corner at (1, 1) of its top lifted; the loop of the top may begin anywhere."""
    vertices, faces = box()
    return [*vertices[:6], [1, 1, 1 + height], vertices[7]], [faces[0], list(order), *faces[2:]]


def prism(heights: list[float]) -> Shape:
    """On a regular polygon, its top corners at heights of their own."""
    n = len(heights)
    angles = 2 * np.pi * np.arange(n) / n
    vertices = [[np.cos(a), np.sin(a), z] for z in (0, 1) for a in angles]
    for corner, height in enumerate(heights):
        vertices[n + corner][2] += height
    sides = [[i, (i + 1) % n, (i + 1) % n + n, i + n] for i in range(n)]
    return vertices, [list(range(n))[::-1], list(range(n, 2 * n)), *sides]


def corners_of(built: BuiltBlocks) -> set[frozenset[tuple[float, ...]]]:
    """The triangles, by their corners."""
    return {frozenset(map(tuple, triangle.tolist())) for triangle in built.bent.triangles}


@pytest.mark.parametrize("turn", [np.eye(3), rotation(3)], ids=["upright", "turned"])
def test_the_shorter_diagonal_is_taken(turn: np.ndarray) -> None:
    """The cube and a tetrahedron of height 0.2 on half of its top."""
    built = build(moved(lifted(0.2), turn))
    assert not built.defects
    assert built.blocks.volumes == pytest.approx([1 + 0.2 / 6])
    assert len(built.bent.triangles) == 2
    tetrahedron = np.array([0.75, 0.75, 1.05])
    middle = (np.full(3, 0.5) + 0.2 / 6 * tetrahedron) / (1 + 0.2 / 6)
    assert built.blocks.centroids[0] == pytest.approx(turn @ middle)


@pytest.mark.parametrize("heights", [[0.1, -0.1, 0.1, -0.1], [0.1, 0, 0, 0, 0], [0.2, 0, -0.1, 0, 0.1, 0.05]])
def test_faces_with_the_same_corners_are_split_alike(heights: list[float]) -> None:
    """Wherever the loop begins, and from either side; diagonals of one length differ by what files round."""
    n = len(heights)
    vertices, faces = prism(heights)
    rng = np.random.default_rng(1)
    splits = []
    for first, inverted in itertools.product(range(n), (False, True)):
        top = np.roll(faces[1], first).tolist()
        shape = (np.array(vertices) + 1e-9 * rng.normal(size=(2 * n, 3))).tolist(), [faces[0], top, *faces[2:]]
        if inverted:  # a block that hangs above, with the same face below
            raised = [[x, y, z + 2] for x, y, z in shape[0][:n]]
            shape = [*raised, *shape[0][n:]], [face[::-1] for face in shape[1]]
        splits.append({frozenset(tuple(np.round(c, 6)) for c in triangle) for triangle in build(shape).bent.triangles})
    assert len(splits[0]) == n - 2
    assert all(split == splits[0] for split in splits)


def test_other_faces_keep_their_numbers() -> None:
    built = build(lifted(0.2), lifted(-0.2))
    faces = np.diff(built.blocks.face_start)
    assert faces.tolist() == [7, 7]
    assert built.blocks.face_normals[built.blocks.face_start[1] + np.array([0, 2, 3])] == pytest.approx(
        np.array([[0, 0, -1], [0, -1, 0], [1, 0, 0]])
    )


def test_a_face_that_is_split_into_something_that_crosses_itself_is_refused() -> None:
    """A corner lifted so far down that the top passes through the bottom."""
    (defect,) = build(lifted(-1.5)).defects
    assert "intersects itself" in defect.message or "not planar" in defect.message
