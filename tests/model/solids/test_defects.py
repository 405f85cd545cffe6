from __future__ import annotations

import numpy as np
import pytest

from tests.model.shapes import Shape, box, build, build_raw, moved, raw, rotation


def message_of(shape: Shape, tolerance: float = 1e-3) -> str:
    """The one defect of the middle of three blocks, the others being sound."""
    built = build(box((-9, 0, 0), (-8, 1, 1)), shape, box((9, 0, 0), (10, 1, 1)), tolerance=tolerance)
    (defect,) = built.defects
    assert defect.block == 1
    return defect.message


def test_missing_face() -> None:
    vertices, faces = box()
    assert message_of((vertices, faces[1:])) == (
        "is not closed: 4 edges with one face only, first that between vertices 0 and 1, of face 1"
    )


def test_face_listed_twice() -> None:
    vertices, faces = box()
    message = message_of((vertices, [*faces, faces[2][::-1]]))
    assert message.startswith("has 4 edges with more than two faces")
    assert message.endswith("; faces 2 and 6 have the same corners: is one listed twice?")


def test_edge_with_more_than_two_faces() -> None:
    vertices, faces = box()
    fin = [[0, 4, 8], [0, 8, 4]]
    assert message_of(([*vertices, [-1, -1, 0.5]], [*faces, fin[0]])) == (
        "has 1 edge with more than two faces, first that between vertices 0 and 4"
    )


def test_vertex_passed_twice() -> None:
    vertices, faces = box()
    assert message_of((vertices, [[0, 3, 2, 1, 3], *faces[1:]])) == "face 0 passes vertex 3 twice"


def test_two_vertices_at_one_place() -> None:
    vertices, faces = box()
    vertices = [*vertices, list(vertices[5])]
    faces = [[8 if corner == 5 else corner for corner in faces[2]] if n == 2 else face for n, face in enumerate(faces)]
    assert message_of((vertices, faces)) == "vertices 5 and 8 lie at the same place"


@pytest.mark.parametrize("coordinate", [np.nan, np.inf, -np.inf, 1e60])
def test_wild_coordinates(coordinate: float) -> None:
    vertices, faces = box()
    vertices = [*vertices[:3], [0.0, coordinate, 0], *vertices[4:]]
    assert message_of((vertices, faces)) == "vertex 3 has a coordinate that is not finite or exceeds 1e+50"


def test_flat_face() -> None:
    vertices = [[0.0, 0, 0], [1.0, 0, 0], [0.0, 1, 0], [0.5, 0, 0], [0.0, 0, 1]]
    faces = [[0, 3, 1], [0, 2, 3], [3, 2, 1], [0, 1, 4], [1, 2, 4], [2, 0, 4]]
    assert message_of((vertices, faces)) == "face 0 has no area"


def test_no_volume_far_from_the_origin_whatever_rounding_makes_of_it() -> None:
    flat = [[0.0, 0, 0], [0.1, 0, 0], [0.1, 0.1, 0], [0, 0.1, 0]]
    shape = moved((flat, [[0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3]]), rotation(5), (1e5, 3e5, -2e5))
    assert message_of(shape) == "has no volume"


@pytest.mark.parametrize("thickness", [1e-2, 1e-4, 1e-5])
@pytest.mark.parametrize("thin_axes", [1, 2])
@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_plates_and_needles_are_blocks(thickness: float, thin_axes: int, scale: float) -> None:
    extent = [1.0, 1.0, 1.0]
    for axis in range(thin_axes):
        extent[axis] = thickness
    shape = moved(box((0, 0, 0), extent), scale * rotation(1))
    built = build(shape)
    assert not built.defects
    assert built.blocks.volumes == pytest.approx([thickness**thin_axes * scale**3])


def test_thin_plate_far_from_the_origin_is_a_block() -> None:
    assert not build(moved(box((0, 0, 0), (1, 1, 1e-4)), rotation(2), (1e4, 1e4, 1e4))).defects


def bent_box(height: float) -> Shape:
    vertices, faces = box()
    return [*vertices[:6], [1, 1, 1 + height], vertices[7]], faces


def notched(height: float) -> Shape:
    """An L from above, one corner of its top lifted."""
    outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    vertices = [[float(x), float(y), float(z)] for z in (0, 1) for x, y in outline]
    vertices[7][2] = 1 + height
    sides = [[i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6] for i in range(6)]
    return vertices, [[5, 4, 3, 2, 1, 0], [6, 7, 8, 9, 10, 11], *sides]


def test_a_bent_face_with_a_notch_is_not_split() -> None:
    assert message_of(notched(0.1)).startswith("face 1 is not planar: corners leave the plane by 0.0")


def test_bent_faces_beyond_the_tolerance() -> None:
    built = build(box((-9, 0, 0), (-8, 1, 1)), bent_box(0.1))
    assert not built.defects
    assert (built.bent.blocks.tolist(), built.bent.faces.tolist()) == ([1], [1])
    assert [notice.message for notice in built.notices] == [
        "1 face of 1 block (b[1]) is not planar and split into triangles; the worst, face 1 of b[1], leaves its "
        "plane by 0.025 of the block size"
    ]


def test_bent_faces_within_the_tolerance() -> None:
    built = build(box((-9, 0, 0), (-8, 1, 1)), bent_box(0.002))
    assert not built.defects
    (notice,) = built.notices
    assert notice.identifier == "faces-not-quite-planar"
    assert notice.message == (
        "1 face of 1 block (b[1]) is planar only within the tolerance, each taken as the plane fitted to its corners; "
        "the worst, face 1 of b[1], leaves its plane by 0.0005 of the block size"
    )


@pytest.mark.parametrize("scale", [1e-6, 1e6])
def test_the_tolerance_is_relative_to_the_block(scale: float) -> None:
    assert build(moved(notched(0.1), scale * np.eye(3))).defects
    assert not build(moved(notched(0.002), scale * np.eye(3))).defects


def test_rounding_far_from_the_origin_is_not_reported() -> None:
    assert build(moved(box(), rotation(4), (1e7, 1e7, 1e7))).notices == ()


def test_every_block_with_a_defect_is_reported_once() -> None:
    vertices, faces = box()
    open_box = (vertices, faces[1:])
    built = build(open_box, box(), notched(0.1), open_box)
    assert [defect.block for defect in built.defects] == [0, 2, 3]


def test_unused_vertices_are_left_out_with_a_notice() -> None:
    vertices, faces = box()
    built = build_raw(raw(([*vertices, [7, 7, 7]], faces), box((3, 0, 0), (4, 1, 1))))
    assert not built.defects
    assert len(built.blocks.vertices) == 16
    assert [notice.message for notice in built.notices] == ["1 vertex was left out, used by no face, in 1 block (b[0])"]
    assert built.blocks.volumes == pytest.approx([1, 1])
