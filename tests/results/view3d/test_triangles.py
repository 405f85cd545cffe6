from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.contacts.polygons import triangulate
from mbla.model.solids.blocks import Blocks
from mbla.results.view3d.surface import face_triangles, reentrant_faces, triangle_normals
from tests.results.synthetic import cuboids

L_SHAPE = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]], float)


def prism(outline: Any, height: float) -> Blocks:
    """A prism over a plane outline, counter-clockwise; only what drawing needs is right."""
    n = len(outline)
    flat = np.column_stack([outline, np.zeros(n)])
    vertices = np.vstack([flat, flat + np.array([0, 0, height])])
    sides = [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    faces = [list(range(n))[::-1], list(range(n, 2 * n)), *sides]
    edges = np.roll(outline, -1, axis=0) - outline
    outward = np.column_stack([edges[:, 1], -edges[:, 0], np.zeros(n)])
    outward /= np.linalg.norm(outward, axis=1)[:, None]
    return replace(
        cuboids([[0, 0, 0]], [[1, 1, 1]], ("prism",)),
        vertices=vertices,
        vertex_start=np.array([0, 2 * n]),
        loops=np.concatenate([np.array(face) for face in faces]),
        loop_start=np.cumsum([0, *map(len, faces)]),
        face_start=np.array([0, n + 2]),
        facet_of_face=np.arange(n + 2),
        face_normals=np.vstack([[0, 0, -1], [0, 0, 1], outward]),
    )


def areas(blocks: Blocks, triangles: Any) -> Any:
    a, b, c = (blocks.vertices[triangles[:, i]] for i in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def test_boxes_are_cut_along_diagonals() -> None:
    blocks = cuboids([[0, 0, 0], [5, 0, 0]], [[1, 2, 3], [6, 1, 1]], ("a", "b"))
    triangles, faces = face_triangles(blocks)
    assert faces.tolist() == np.repeat(np.arange(12), 2).tolist()
    assert not reentrant_faces(blocks).any()
    assert areas(blocks, triangles).sum() == pytest.approx(22 + 6)
    np.testing.assert_allclose(triangle_normals(blocks.vertices, triangles), blocks.face_normals[faces], atol=1e-12)


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_a_reentrant_face_is_covered_once(scale: float) -> None:
    """A fan about the corner (0, 0) would do here, about (2, 0) it would cover the notch: so every start is tried."""
    for start in range(6):
        blocks = prism(scale * np.roll(L_SHAPE, start, axis=0), scale)
        triangles, faces = face_triangles(blocks)
        assert np.flatnonzero(reentrant_faces(blocks)).tolist() == [0, 1]
        assert areas(blocks, triangles[faces < 2]).sum() == pytest.approx(6 * scale**2)
        assert len(triangles) == 4 + 4 + 12
        normals = triangle_normals(blocks.vertices, triangles)
        np.testing.assert_allclose(normals, blocks.face_normals[faces], atol=1e-9)


def test_corners_on_a_straight_side_are_no_reentrant_ones() -> None:
    assert not reentrant_faces(prism(np.array([[0, 0], [1, 0], [2, 0], [2, 1], [0, 1]], float), 1.0)).any()


def test_an_outline_that_crosses_itself_is_a_fan() -> None:
    assert triangulate(np.array([[0, 0], [1, 1], [1, 0], [0, 1]], float)).tolist() == [[0, 1, 2], [0, 2, 3]]
