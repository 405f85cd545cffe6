from __future__ import annotations

import itertools

import numpy as np
import pytest

from mbla.model.solids.build import BuiltBlocks
from tests.model.shapes import L_OUTLINE, Shape, box, build, moved, prism, rotation


def triangulated_box(n: int = 1, bulge: float = 0.0) -> Shape:
    """Unit box whose top is n x n squares of two triangles each, raised by ``bulge`` (1 - r^2) about the middle."""
    grid = [
        [i / n, j / n, 1 + bulge * (1 - (2 * i / n - 1) ** 2) * (1 - (2 * j / n - 1) ** 2)]
        for j in range(n + 1)
        for i in range(n + 1)
    ]

    def at(i: int, j: int) -> int:
        return j * (n + 1) + i

    top = []
    for i in range(n):
        for j in range(n):
            top += [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]
    base = len(grid)
    vertices = [*grid, [0.0, 0, 0], [1.0, 0, 0], [1.0, 1, 0], [0.0, 1, 0]]
    rim = [
        [at(i, 0) for i in range(n + 1)],
        [at(n, j) for j in range(n + 1)],
        [at(n - i, n) for i in range(n + 1)],
        [at(0, n - j) for j in range(n + 1)],
    ]
    sides = [[base + k, base + (k + 1) % 4, *rim[k][::-1]] for k in range(4)]
    return vertices, [*top, *sides, [base + 3, base + 2, base + 1, base]]


def facets(shape: Shape, tolerance: float = 1e-3) -> int:
    built = build(shape, tolerance=tolerance)
    assert not built.defects
    return int(built.blocks.facet_of_face.max()) + 1


@pytest.mark.parametrize("n", [1, 2, 7])
@pytest.mark.parametrize("seed", [0, 1])
def test_triangles_of_a_plane_are_one_facet(n: int, seed: int) -> None:
    shape = moved(triangulated_box(n), 1e3 * rotation(seed), (5e3, 0, 0))
    assert facets(shape) == 6


def test_box_has_six() -> None:
    assert build(box()).blocks.facet_of_face.tolist() == [0, 1, 2, 3, 4, 5]


def test_numbers_run_over_all_blocks_in_order() -> None:
    built = build(triangulated_box(), box((2, 0, 0), (3, 1, 1)))
    assert built.blocks.facet_of_face.tolist() == [0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]


def test_parallel_faces_at_different_heights_stay_apart() -> None:
    assert facets(prism([(0, 0), (2, 0), (2, 1), (1, 1), (1, 1.5), (0, 1.5)])) == 8


def test_coplanar_faces_that_share_no_edge_stay_apart() -> None:
    u_shape = [(0, 0), (3, 0), (3, 2), (2, 2), (2, 1), (1, 1), (1, 2), (0, 2)]
    assert facets(prism(u_shape)) == 10


def test_finely_faceted_curve_is_not_flattened() -> None:
    # neighbours are nearly in line, the whole leaves its plane by 25 times the tolerance
    assert facets(triangulated_box(40, bulge=2.5e-2)) > 100


@pytest.mark.parametrize("bulge", [5e-4, 2e-3, 1e-2, 5e-2])
@pytest.mark.parametrize("n", [4, 16])
def test_no_corner_leaves_its_facet_by_more_than_the_tolerance(bulge: float, n: int) -> None:
    blocks = build(triangulated_box(n, bulge)).blocks
    for facet in range(int(blocks.facet_of_face.max()) + 1):
        faces = np.flatnonzero(blocks.facet_of_face == facet)
        rows = np.concatenate([blocks.loops[blocks.loop_start[f] : blocks.loop_start[f + 1]] for f in faces])
        corners = blocks.vertices[rows] - blocks.vertices[rows].mean(axis=0)
        assert np.linalg.svd(corners)[1][2] / np.sqrt(len(rows)) <= 1e-3 * blocks.sizes[0]


def test_l_shaped_face_is_one_facet_with_its_triangles() -> None:
    vertices, faces = prism(L_OUTLINE)
    split = [[6, 7, 8], [6, 8, 9], [6, 9, 10], [6, 10, 11]]
    assert facets((vertices, [faces[0], *split, *faces[2:]])) == 8


def test_mantle_of_a_finely_faceted_ring_is_no_facet() -> None:
    """All the way round its normals cancel each other; every side is a facet, top and bottom are one each."""
    n = 400
    angles = np.arange(n) * 2 * np.pi / n
    rim = [(r * np.cos(a), r * np.sin(a), z) for z in (0.0, 1.0) for r in (1.0, 2.0) for a in angles]

    def corner(top: int, outer: int, k: int) -> int:
        return (2 * top + outer) * n + k % n

    faces = []
    for k in range(n):
        faces.append([corner(0, 1, k), corner(0, 1, k + 1), corner(1, 1, k + 1), corner(1, 1, k)])
        faces.append([corner(0, 0, k + 1), corner(0, 0, k), corner(1, 0, k), corner(1, 0, k + 1)])
        faces.append([corner(1, 0, k), corner(1, 1, k), corner(1, 1, k + 1), corner(1, 0, k + 1)])
        faces.append([corner(0, 0, k + 1), corner(0, 1, k + 1), corner(0, 1, k), corner(0, 0, k)])
    ring = build((rim, faces)).blocks
    assert len(set(ring.facet_of_face.tolist())) == 2 * n + 2


def lifted(height: float, order: tuple[int, ...] = (4, 5, 6, 7)) -> Shape:
    """A cube with the corner at (1, 1) of its top lifted; the loop of the top may begin anywhere."""
    vertices, faces = box()
    return [*vertices[:6], [1, 1, 1 + height], vertices[7]], [faces[0], list(order), *faces[2:]]


def prism_of_bent_faces(heights: list[float]) -> Shape:
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
    """Wherever the loop begins, and from either side; diagonals of one length differ by what files round.

    With no shorter diagonal about the centre, so that no direction in space is preferred.
    """
    n = len(heights)
    vertices, faces = prism_of_bent_faces(heights)
    rng = np.random.default_rng(1)
    splits = []
    for first, inverted in itertools.product(range(n), (False, True)):
        top = np.roll(faces[1], first).tolist()
        shape = (np.array(vertices) + 1e-9 * rng.normal(size=(2 * n, 3))).tolist(), [faces[0], top, *faces[2:]]
        if inverted:  # a block that hangs above, with the same face below
            raised = [[x, y, z + 2] for x, y, z in shape[0][:n]]
            shape = [*raised, *shape[0][n:]], [face[::-1] for face in shape[1]]
        splits.append({frozenset(tuple(np.round(c, 6)) for c in triangle) for triangle in build(shape).bent.triangles})
    assert len(splits[0]) == n
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
