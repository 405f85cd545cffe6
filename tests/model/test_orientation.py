import numpy as np
import pytest

from mbla.model.solids.measures import count_pieces, faces_to_turn, find_edges
from tests.model.shapes import L_OUTLINE, Shape, box, build, hull, prism, raw


def with_faces_turned(shape: Shape, numbers: set[int]) -> Shape:
    vertices, faces = shape
    return vertices, [face[::-1] if number in numbers else face for number, face in enumerate(faces)]


@pytest.mark.parametrize("turned", [{0}, {1, 4}, {0, 1, 2, 3}, set(range(6))])
def test_faces_of_a_box_are_turned_outwards(turned: set[int]) -> None:
    built = build(with_faces_turned(box(), turned))
    normals = built.blocks.face_normals
    middle = built.blocks.vertices[built.blocks.loops].reshape(6, 4, 3).mean(axis=1)
    assert np.einsum("ij,ij->i", normals, middle - 0.5) == pytest.approx([0.5] * 6)
    assert built.blocks.volumes == pytest.approx([1.0])
    assert [notice.identifier for notice in built.notices] == ["faces-turned-outwards"]
    assert built.notices[0].message == f"{len(turned)} faces were turned outwards in 1 block (b[0])".replace(
        "1 faces were", "1 face was"
    )


def test_a_sound_box_needs_no_notice() -> None:
    assert build(box()).notices == ()


def test_non_convex_block_is_turned_too() -> None:
    built = build(with_faces_turned(prism(L_OUTLINE), {2, 5}))
    assert built.blocks.volumes == pytest.approx([3.0])


def test_only_blocks_that_need_it_are_touched() -> None:
    built = build(box(), with_faces_turned(box((3, 0, 0), (4, 1, 1)), {2}), box((6, 0, 0), (7, 1, 1)))
    assert "(b[1])" in built.notices[0].message
    first = slice(0, built.blocks.loop_start[6])
    assert built.blocks.loops[first].tolist() == [corner for face in box()[1] for corner in face]


def test_the_notice_names_the_first_blocks_and_counts_the_rest() -> None:
    built = build(*[with_faces_turned(box((3.0 * i, 0, 0), (3.0 * i + 1, 1, 1)), {i % 6}) for i in range(8)])
    assert (
        built.notices[0].message == "8 faces were turned outwards in 8 blocks (b[0], b[1], b[2], b[3], b[4] and 3 more)"
    )


def test_edges_of_a_box() -> None:
    edges = find_edges(raw(box(), box()))
    assert len(edges.ends) == 24
    assert edges.face_count.tolist() == [2] * 24
    assert edges.opposed.all()
    assert np.bincount(edges.block).tolist() == [12, 12]


def test_pieces_are_counted() -> None:
    near, far = box(), box((5, 0, 0), (6, 1, 1))
    both = [*near[0], *far[0]], [*near[1], *([corner + 8 for corner in face] for face in far[1])]
    polyhedra = raw(near, both)
    assert count_pieces(polyhedra, find_edges(polyhedra)).tolist() == [1, 2]


def test_klein_bottle_is_one_sided() -> None:
    # a 4 x 4 grid of quadrilaterals, closed along one side, and along the other with a reversal
    n = 4
    faces = []
    for i in range(n):
        for j in range(n):
            left = [(i, j), (i, (j + 1) % n)]
            right = [(i + 1, j), (i + 1, (j + 1) % n)]
            corners = [left[0], right[0], right[1], left[1]]
            faces.append([_on_klein_bottle(row, column, n) for row, column in corners])
    points = np.random.default_rng(0).normal(size=(n * n, 3)).tolist()
    polyhedra = raw((points, faces))
    assert find_edges(polyhedra).face_count.tolist() == [2] * (2 * n * n)
    turned, one_sided = faces_to_turn(polyhedra, find_edges(polyhedra))
    assert one_sided.tolist() == [True]
    assert not turned.any()
    assert [d.message for d in build((points, faces)).defects] == [
        "is one-sided: its faces cannot all be turned outwards"
    ]


def _on_klein_bottle(row: int, column: int, n: int) -> int:
    return (-column) % n if row == n else row * n + column


@pytest.mark.parametrize("seed", range(3))
def test_random_orientations_are_repaired(seed: int) -> None:
    shape, volume = hull(seed, 40)
    assert build(shape).blocks.volumes == pytest.approx([volume])


def test_no_face_of_a_sound_box_is_turned() -> None:
    polyhedra = raw(box(), box((3, 0, 0), (4, 1, 1)))
    turned, one_sided = faces_to_turn(polyhedra, find_edges(polyhedra))
    assert turned.tolist() == [False] * 12
    assert one_sided.tolist() == [False, False]


def test_only_faces_that_disagree_with_the_first_of_their_block_are_turned() -> None:
    polyhedra = raw(box(), with_faces_turned(box((3, 0, 0), (4, 1, 1)), {2, 5}))
    turned, _ = faces_to_turn(polyhedra, find_edges(polyhedra))
    assert np.flatnonzero(turned).tolist() == [8, 11]
