from __future__ import annotations

import numpy as np
import pytest

from mbla.model.solids.measures import (
    count_pieces,
    face_geometry,
    faces_to_turn,
    find_edges,
    volumes_and_centroids,
)
from tests.model.shapes import L_OUTLINE, TETRAHEDRON, Shape, box, build, hull, moved, prism, raw, rotation


@pytest.mark.parametrize("seed", [None, 0, 1])
def test_planes_of_a_box(seed: int | None) -> None:
    turn = np.eye(3) if seed is None else rotation(seed)
    faces = face_geometry(raw(moved(box((0, 0, 0), (2, 3, 5)), turn, (7, 8, 9))))
    assert faces.areas == pytest.approx([6, 6, 10, 15, 10, 15])
    assert faces.perimeters == pytest.approx([10, 10, 14, 16, 14, 16])
    outwards = np.array([[0, 0, -1], [0, 0, 1], [0, -1, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0]])
    assert faces.normals == pytest.approx(outwards @ turn.T)
    centres = [[1, 1.5, 0], [1, 1.5, 5], [1, 0, 2.5], [2, 1.5, 2.5], [1, 3, 2.5], [0, 1.5, 2.5]]
    assert faces.centres == pytest.approx(np.array(centres) @ turn.T)
    assert faces.deviations == pytest.approx([0] * 6, abs=1e-14)


def test_area_of_a_face_that_is_not_convex() -> None:
    faces = face_geometry(raw(prism(L_OUTLINE)))
    assert faces.areas[:2] == pytest.approx([3, 3])
    assert faces.perimeters[:2] == pytest.approx([8, 8])


def test_a_face_without_area_has_no_normal() -> None:
    faces = face_geometry(raw(([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]])))
    assert faces.areas.tolist() == [0]
    assert faces.normals.tolist() == [[0, 0, 0]]
    assert faces.perimeters.tolist() == [4]


def test_corners_of_a_bent_face_leave_its_plane_by_a_quarter_of_what_one_is_raised() -> None:
    """To first order: the plane through the middle rises with half of it along both sides."""
    faces = face_geometry(raw(([[0, 0, 0], [1, 0, 0], [1, 1, 0.2], [0, 1, 0]], [[0, 1, 2, 3]])))
    assert faces.deviations == pytest.approx([0.05 / np.sqrt(1 + 2 * 0.1**2)])


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


def test_the_notice_names_the_first_blocks_and_counts_the_rest() -> None:
    built = build(*[with_faces_turned(box((3.0 * i, 0, 0), (3.0 * i + 1, 1, 1)), {i % 6}) for i in range(8)])
    assert (
        built.notices[0].message == "8 faces were turned outwards in 8 blocks (b[0], b[1], b[2], b[3], b[4] and 3 more)"
    )


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


def test_non_convex_prism() -> None:
    volumes, centroids = volumes_and_centroids(raw(prism(L_OUTLINE, 4.0)))
    assert volumes == pytest.approx([12.0], rel=1e-15)
    assert centroids == pytest.approx(np.array([[5 / 6, 5 / 6, 2.0]]), rel=1e-15)


def test_inward_faces_give_a_negative_volume() -> None:
    vertices, faces = box()
    volumes, _ = volumes_and_centroids(raw((vertices, [face[::-1] for face in faces])))
    assert volumes == pytest.approx([-1.0])


@pytest.mark.parametrize("seed", range(5))
def test_random_hulls_against_scipy(seed: int) -> None:
    shape, volume = hull(seed)
    built = build(shape)
    assert not built.defects
    assert built.blocks.volumes == pytest.approx([volume], rel=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_rotation_changes_neither_volume_nor_relative_centroid(seed: int) -> None:
    shape, turn = prism(L_OUTLINE), rotation(seed)
    before, after = build(shape).blocks, build(moved(shape, turn, (3, -4, 5))).blocks
    assert after.volumes == pytest.approx(before.volumes, rel=1e-13)
    assert after.centroids == pytest.approx(before.centroids @ turn.T + [3, -4, 5], rel=1e-13)


def test_far_from_the_origin_nothing_is_lost() -> None:
    # 1e6 and 2^-20 steps beside it are exact in binary, so that only the computation could lose digits
    step = 2.0**-20
    shape = moved(prism(L_OUTLINE), step * np.eye(3), (1e6, -1e6, 1e6))
    volumes, centroids = volumes_and_centroids(raw(shape))
    assert volumes / step**3 == pytest.approx([3.0], rel=1e-14)
    assert (centroids - [1e6, -1e6, 1e6]) / step == pytest.approx(np.array([[5 / 6, 5 / 6, 0.5]]), abs=2e-4)


def test_volume_of_a_bent_face_does_not_depend_on_its_first_corner() -> None:
    vertices, faces = box()
    vertices = [*vertices[:6], [1.0, 1.0, 1.0005], vertices[7]]
    turned = [[*face[2:], *face[:2]] for face in faces]
    shifted = [[*face[1:], *face[:1]] for face in faces]
    volumes, _ = volumes_and_centroids(raw((vertices, faces), (vertices, turned), (vertices, shifted)))
    assert volumes[1:] == pytest.approx([volumes[0]] * 2, rel=1e-15)


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_each_block_by_itself(scale: float) -> None:
    shapes = [box(), prism(L_OUTLINE), TETRAHEDRON, hull(0)[0], prism(L_OUTLINE, 0.1)]
    built = build(*[moved(shape, scale * rotation(0)) for shape in shapes])
    assert built.blocks.convex.tolist() == [True, False, True, True, False]


@pytest.mark.parametrize(("dent", "convex"), [(1e-4, True), (1e-2, False)])
def test_dents_within_the_tolerance_do_not_count(dent: float, convex: bool) -> None:
    vertices, faces = box()
    vertices = [*vertices, [0.5, 0.5, 1 - dent]]
    built = build((vertices, [faces[0], *([4 + i, 4 + (i + 1) % 4, 8] for i in range(4)), *faces[2:]]))
    assert built.blocks.convex.tolist() == [convex]
