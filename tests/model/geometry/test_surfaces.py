from __future__ import annotations

import numpy as np
import pytest

from mbla.model.geometry.geometry import Geometry
from mbla.model.geometry.repair import repair
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
    assert built.defects[0].message == "faces 1 and 6 have the same corners: each face is listed once"


def test_faces_without_area_are_left_out_with_a_notice() -> None:
    vertices, faces = box()
    geometry = split_surface(soup((vertices, [*faces, [0, 1, 1]])))
    assert [notice.message for notice in geometry.notices] == [
        "1 face without area was left out: corners at the same place"
    ]
    assert build_raw(geometry.polyhedra).blocks.volumes == pytest.approx([1])


def test_an_open_part_is_left_to_be_refused_by_name() -> None:
    vertices, faces = box((5, 0, 0), (6, 1, 1))
    built = build_raw(split_surface(soup(box(), (vertices, faces[1:]))).polyhedra)
    assert [defect.block for defect in built.defects] == [1]
    assert built.defects[0].message.startswith("is not closed")
