"""Each repair on files that have exactly the fault it is for; and what must not be repaired."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.model.geometry.geometry import Geometry
from mbla.model.geometry.repair import repair
from mbla.model.geometry.welding import weld
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra
from tests.model.shapes import Shape, box, build_raw, moved, prism, raw, rotation


def soup(*shapes: Shape) -> Polyhedra:
    """All faces of several shapes as one surface in which no two faces share a vertex, as in an STL file."""
    parts = join_polyhedra([raw(shape) for shape in shapes])
    n_corners = len(parts.loops)
    return Polyhedra(
        parts.vertices[parts.loops],
        np.array([0, n_corners]),
        np.arange(n_corners),
        parts.loop_start,
        np.array([0, len(parts.loop_start) - 1]),
    )


def split_surface(surface: Polyhedra) -> Geometry:
    return repair(Geometry(surface, indexed=False), 1e-3)


def split_volumes(*shapes: Shape) -> list[float]:
    built = build_raw(split_surface(soup(*shapes)).polyhedra)
    assert not built.defects
    return [float(volume) for volume in built.blocks.volumes]


def test_parts_in_order_of_their_first_face() -> None:
    shapes = [box((5, 0, 0), (6, 1, 1)), box((0, 0, 0), (1, 1, 2)), box((9, 0, 0), (10, 1, 3))]
    assert split_volumes(*shapes) == pytest.approx([1, 2, 3])


@pytest.mark.parametrize("seed", [None, 0, 1])
@pytest.mark.parametrize(
    "offset",
    [(0, 0, 1), (1, 0, 0), (1, 1, 0), (1, 1, 1), (0.5, 0, 1), (0.5, 0.25, 1)],
    ids=["stacked", "side by side", "at an edge", "at a corner", "in bond", "askew"],
)
def test_touching_boxes(offset: tuple[float, float, float], seed: int | None) -> None:
    turn = np.eye(3) if seed is None else rotation(seed)
    shapes = [box(), moved(box(), np.eye(3), offset)]
    assert split_volumes(*[moved(shape, turn) for shape in shapes]) == pytest.approx([1, 1])


def test_wedges_around_a_common_edge() -> None:
    corners = [[np.cos(a), np.sin(a)] for a in 2 * np.pi * np.arange(7) / 7]
    wedges = [prism([[0.0, 0.0], corners[i], corners[(i + 1) % 7]]) for i in range(7)]
    assert split_volumes(*wedges) == pytest.approx([np.sin(2 * np.pi / 7) / 2] * 7)


def test_faces_that_do_not_pair_off_stay_together() -> None:
    vertices, faces = box((0, 0, 1), (1, 1, 2))
    inside_out: Shape = (vertices, [face[::-1] for face in faces])
    built = build_raw(split_surface(soup(box(), inside_out)).polyhedra)
    assert len(built.defects) == 1
    assert built.defects[0].message.startswith("has 4 edges with more than two faces")


def test_faces_without_area_are_left_out_with_a_notice() -> None:
    vertices, faces = box()
    geometry = split_surface(soup((vertices, [*faces, [0, 1, 1]])))
    assert [notice.message for notice in geometry.notices] == [
        "1 face was left out, without area: corners at the same place"
    ]
    assert build_raw(geometry.polyhedra).blocks.volumes == pytest.approx([1])


def test_an_open_part_is_left_to_be_refused_by_name() -> None:
    vertices, faces = box((5, 0, 0), (6, 1, 1))
    built = build_raw(split_surface(soup(box(), (vertices, faces[1:]))).polyhedra)
    assert [defect.block for defect in built.defects] == [1]
    assert built.defects[0].message.startswith("is not closed")


TRIANGLES = [[a, b, c] for face in box()[1] for a, b, c in (face[:3], [face[0], *face[2:]])]


def repaired(*surfaces: Polyhedra, names: tuple[str, ...] = (), weld: float | None = None) -> Geometry:
    return repair(Geometry(join_polyhedra(surfaces), names=names), 1e-3, weld)


def volumes(geometry: Geometry) -> list[float]:
    built = build_raw(geometry.polyhedra)
    assert [defect.message for defect in built.defects] == []
    return [float(volume) for volume in built.blocks.volumes]


def told(geometry: Geometry) -> list[str]:
    return [notice.message for notice in geometry.notices]


def test_a_sound_file_is_left_as_it_is() -> None:
    geometry = repaired(raw(box()), raw(box((2, 0, 0), (3, 1, 1))), names=("a", "b"))
    assert volumes(geometry) == [1, 1]
    assert geometry.notices == ()
    assert geometry.names == ("a", "b")


@pytest.mark.parametrize("far", [0.0, 1000.0])
def test_corners_that_miss_each_other_by_rounding_are_welded(far: float) -> None:
    surface = soup(moved(box(), rotation(1), (far, 0, 0)))
    off = np.random.default_rng(0).uniform(-2e-4, 2e-4, surface.vertices.shape)
    rough = Polyhedra(
        surface.vertices + off, surface.vertex_start, surface.loops, surface.loop_start, surface.face_start
    )
    geometry = repaired(rough)
    assert volumes(geometry) == pytest.approx([1], abs=1e-3)
    (message,) = told(geometry)
    assert message == "16 vertices were merged with another up to 0.001 away"


def test_corners_further_apart_than_the_tolerance_are_not_welded_unless_asked_for() -> None:
    surface = soup(box())
    off = np.random.default_rng(0).uniform(-5e-3, 5e-3, surface.vertices.shape)
    rough = Polyhedra(
        surface.vertices + off, surface.vertex_start, surface.loops, surface.loop_start, surface.face_start
    )
    built = build_raw(repaired(rough).polyhedra)
    assert built.defects[0].message.startswith("is not closed")
    built = build_raw(repaired(rough, weld=0.02).polyhedra, tolerance=0.02)
    assert not built.defects
    assert built.blocks.volumes == pytest.approx([1], abs=0.02)


def test_welding_is_relative_to_the_edges_nearby() -> None:
    """A small block in the file of a large one is welded by its own measure, not by that of the large one."""
    small = soup(box((0, 0, 0), (1e-3, 1e-3, 1e-3)))
    off = np.random.default_rng(0).uniform(-2e-7, 2e-7, small.vertices.shape)
    rough = Polyhedra(small.vertices + off, small.vertex_start, small.loops, small.loop_start, small.face_start)
    geometry = repaired(join_one(rough, soup(box((5, 0, 0), (6, 1, 1)))))
    assert volumes(geometry) == pytest.approx([1e-9, 1], rel=1e-2)


def join_one(*surfaces: Polyhedra) -> Polyhedra:
    """Several surfaces as one."""
    joined = join_polyhedra(surfaces)
    ends = np.array([0, len(joined.vertices)])
    return Polyhedra(joined.vertices, ends, joined.loops, joined.loop_start, np.array([0, len(joined.loop_start) - 1]))


def test_a_face_listed_twice_goes() -> None:
    vertices, faces = box()
    for second in (faces[2], faces[2][::-1], [*faces[2][1:], faces[2][0]]):
        geometry = repaired(raw((vertices, [*faces, second])), names=("a",))
        assert volumes(geometry) == [1]
        assert told(geometry) == ["1 face was left out, listed twice; object a"]


@pytest.mark.parametrize("turned", ["none", "every other", "last three"])
@pytest.mark.parametrize("missing", [0, 1, 2, 5])
def test_most_faces_listed_twice_go_once(missing: int, turned: str) -> None:
    vertices, faces = box()
    turn = {"none": [], "every other": [1, 3, 5], "last three": [3, 4, 5]}[turned]
    again = [face[::-1] if number in turn else face for number, face in enumerate(faces)][missing:]
    for surface in (raw((vertices, [*faces, *again])), raw((vertices, [*again[::-1], *faces]))):
        geometry = repaired(surface, raw(box((2, 0, 0), (3, 1, 1))), names=("a", "b"))
        assert volumes(geometry) == [1, 1]
        assert geometry.names == ("a", "b")
        count = "1 face was" if missing == 5 else f"{6 - missing} faces were"
        assert told(geometry) == [f"{count} left out, listed twice; object a"]


def test_faces_listed_three_times_in_two_objects() -> None:
    vertices, faces = box()
    thrice = raw((vertices, [*faces, *faces, *faces]))
    geometry = repaired(thrice, raw(moved((vertices, [*faces, faces[0]]), rotation(1), (9, 0, 0))), names=("a", "b"))
    assert volumes(geometry) == pytest.approx([1, 1])
    assert told(geometry) == ["13 faces were left out, listed twice; in 2 objects, first a"]


@pytest.mark.parametrize("seed", [None, 0])
@pytest.mark.parametrize("again", [[], [0], [0, 6], [2, 3, 4], list(range(12))], ids=str)
def test_a_wall_between_two_blocks_of_an_object_stays(again: list[int], seed: int | None) -> None:
    turn = np.eye(3) if seed is None else rotation(seed)
    wall = [moved(box(), turn), moved(box((0, 0, 1), (1, 1, 2)), turn)]
    faces = [(vertices, face) for vertices, faces in wall for face in faces]
    copies = [(vertices, [face]) for vertices, face in (faces[number] for number in again)]
    assert split_volumes(*wall, *copies) == pytest.approx([1, 1])


def test_a_face_listed_once_more_the_other_way_round_beside_a_wall_goes() -> None:
    vertices, faces = box()
    assert split_volumes(box(), box((0, 0, 1), (1, 1, 2)), (vertices, [faces[2][::-1]])) == pytest.approx([1, 1])


def test_both_sides_of_every_face_listed() -> None:
    vertices, faces = box()
    geometry = repaired(raw((vertices, [*faces, *(face[::-1] for face in faces)])))
    assert volumes(geometry) == [1]
    assert told(geometry) == ["1 closed surface was left out: the faces of another once more"]


def test_faces_that_two_blocks_share_are_kept() -> None:
    geometry = repaired(soup(*(box((x, 0, z), (x + 1, 1, z + 1)) for z in range(3) for x in range(3))))
    assert volumes(geometry) == pytest.approx([1] * 9)
    assert told(geometry) == ["184 vertices were merged with another of their block at the same place"]


def test_a_block_enclosed_by_others_keeps_its_faces() -> None:
    grid = [box((x, y, z), (x + 1, y + 1, z + 1)) for z in range(3) for y in range(3) for x in range(3)]
    assert volumes(repaired(soup(*grid))) == pytest.approx([1] * 27)


def with_t_junction(seed: int | None) -> Shape:
    """A unit cube whose top is two rectangles, so that its sides have a vertex in the middle of an edge."""
    vertices, faces = box()
    vertices = [*vertices, [0.5, 0.0, 1.0], [0.5, 1.0, 1.0]]
    shape: Shape = (vertices, [face for face in faces if sorted(face) != [4, 5, 6, 7]] + [[4, 8, 9, 7], [8, 5, 6, 9]])
    return shape if seed is None else moved(shape, rotation(seed), (3, 2, 1))


@pytest.mark.parametrize("seed", [None, 0, 1])
def test_t_junctions(seed: int | None) -> None:
    geometry = repaired(raw(with_t_junction(seed)))
    assert volumes(geometry) == pytest.approx([1])
    assert told(geometry) == ["2 vertices were made corners of the face in the middle of whose edge they lie"]
    built = build_raw(geometry.polyhedra)
    assert built.blocks.facet_of_face.max() + 1 == 6


def test_several_t_junctions_on_one_edge_in_order_from_both_sides() -> None:
    vertices, faces = box()
    vertices = [*vertices, *([x, y, 1.0] for x in (0.25, 0.75, 0.5) for y in (0.0, 1.0))]
    top = [[4, 8, 9, 7], [8, 12, 13, 9], [12, 10, 11, 13], [10, 5, 6, 11]]
    sides = [face for face in faces if sorted(face) != [4, 5, 6, 7]]
    geometry = repaired(raw((vertices, [*sides, *top])))
    assert volumes(geometry) == pytest.approx([1])
    assert told(geometry) == ["6 vertices were made corners of the face in the middle of whose edge they lie"]


def test_a_vertex_near_an_edge_but_off_it_is_no_t_junction() -> None:
    vertices, faces = with_t_junction(None)
    vertices = [*vertices[:8], [0.5, -0.01, 1.0], [0.5, 1.01, 1.0]]
    built = build_raw(repaired(raw((vertices, faces))).polyhedra)
    assert built.defects[0].message.startswith("is not closed")


def test_faces_of_no_width_go_and_leave_no_hole() -> None:
    vertices, faces = with_t_junction(None)
    geometry = repaired(raw((vertices, [*faces, [4, 8, 5], [7, 9, 6][::-1]])))
    assert volumes(geometry) == pytest.approx([1])
    assert told(geometry) == [
        "2 faces were left out, without area: all corners on one line",
        "2 vertices were made corners of the face in the middle of whose edge they lie",
    ]


@pytest.mark.parametrize("height", [1e-3, 1e-4])
def test_thin_plates_are_left_alone(height: float) -> None:
    geometry = repaired(raw(box((0, 0, 0), (1, 1, height))))
    assert volumes(geometry) == pytest.approx([height])
    assert geometry.notices == ()


def test_an_object_of_several_closed_surfaces_is_split() -> None:
    ring = join_one(*(raw(box((2 * x, 0, 0), (2 * x + 1, 1, 1))) for x in range(3)))
    geometry = repaired(raw(box((0, 5, 0), (1, 6, 1))), ring, names=("base", "ring"))
    assert volumes(geometry) == [1, 1, 1, 1]
    assert geometry.names == ("base", "ring", "ring", "ring")
    assert told(geometry) == ["1 object was split into 3 closed surfaces, a block each; first ring"]


def test_a_hole_is_not_closed() -> None:
    vertices, faces = box()
    built = build_raw(repaired(raw((vertices, faces[1:]))).polyhedra)
    assert built.defects[0].message.startswith("is not closed: 4 edges")


def test_triangles_of_mixed_orientation_with_all_faults_at_once() -> None:
    vertices, _ = box()
    faces = [face[::-1] if number % 3 else face for number, face in enumerate(TRIANGLES)]
    geometry = repaired(soup((vertices, [*faces, TRIANGLES[4], [0, 0, 1]])))
    assert volumes(geometry) == pytest.approx([1])
    assert [notice.identifier for notice in geometry.notices] == [
        "vertices-merged",
        "faces-collapsed",
        "faces-repeated",
    ]


def test_objects_that_are_single_faces_are_taken_together() -> None:
    vertices, faces = box()
    sides = [raw((vertices, [face])) for face in faces]
    geometry = repaired(*sides, names=tuple(f"side {number}" for number in range(6)))
    assert volumes(geometry) == [1]
    assert geometry.names == ("",)
    assert "none of its 6 objects is closed by itself: their faces are taken together as one surface" in told(geometry)


def test_an_open_object_beside_closed_ones_is_not_completed_from_them() -> None:
    vertices, faces = box((0, 0, 1), (1, 1, 2))
    geometry = repaired(raw(box()), raw((vertices, faces[1:])), names=("low", "high"))
    (defect,) = build_raw(geometry.polyhedra).defects
    assert defect.block == 1
    assert defect.message.startswith("is not closed")


@pytest.mark.parametrize("wild", [np.nan, np.inf, 1e60])
def test_wild_coordinates_are_left_to_be_refused_by_block(wild: float) -> None:
    vertices, faces = box((2, 0, 0), (3, 1, 1))
    geometry = repaired(raw(box()), raw(([[wild, 0.0, 0.0], *vertices[1:]], faces[1:])))
    (defect,) = build_raw(geometry.polyhedra).defects
    assert defect.block == 1
    assert "not finite or exceeds" in defect.message


def test_what_is_repaired_is_blocks_and_stays_as_it_is() -> None:
    once = repaired(soup(box(), box((1, 0, 0), (2, 1, 1))))
    assert once.cells
    twice = repair(once, 1e-3)
    assert volumes(twice) == pytest.approx([1, 1])
    assert twice.polyhedra.loops.tolist() == once.polyhedra.loops.tolist()


@pytest.mark.parametrize("indexed", [False, True])
def test_of_nothing_nothing_is_left(indexed: bool) -> None:
    geometry = repair(Geometry(join_polyhedra([]), indexed=indexed), 1e-3, 0.1)
    assert len(geometry.polyhedra) == 0
    assert geometry.notices == ()


def test_equal_corners_are_one_also_where_a_zero_has_a_sign() -> None:
    surface = soup(box())
    assert weld(surface).merged == 16
    signed = np.where(surface.vertices == 0, -0.0, surface.vertices)
    signed[:3] = surface.vertices[:3]
    welded = weld(
        Polyhedra(signed, surface.vertex_start, surface.loops, surface.loop_start, surface.face_start)
    ).polyhedra
    assert len(welded.vertices) == 8
