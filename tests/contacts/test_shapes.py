"""Interfaces between blocks that are not cuboids face to face."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mbla.contacts import find_contacts
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra, polyhedra_from_lists
from tests.contacts.structures import any_rotation, blocks_of, boxes, contacts_of, model_of, moved, prism, section
from tests.contacts.test_search import assert_consistent

L_OUTLINE = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]


def circle(radius: float, corners: int, start: float = 0.0) -> list[list[float]]:
    angles = start + 2 * np.pi * np.arange(corners) / corners
    return [[radius * np.cos(angle), radius * np.sin(angle)] for angle in angles.tolist()]


def ring(inner: Sequence[Sequence[float]], outer: Sequence[Sequence[float]], bottom: float, top: float) -> Polyhedra:
    """Prism with a hole: top and bottom are strips of quadrilaterals between the two outlines."""
    n = len(inner)
    vertices = [[*p, z] for z in (bottom, top) for outline in (inner, outer) for p in outline]
    faces = []
    for i in range(n):
        j = (i + 1) % n
        faces += [[i, n + i, n + j, j], [2 * n + i, 2 * n + j, 3 * n + j, 3 * n + i]]
        faces += [[i, j, 2 * n + j, 2 * n + i], [n + i, 3 * n + i, 3 * n + j, n + j]]
    return polyhedra_from_lists([vertices], [faces])


@pytest.fixture(params=[None, 1, 2], ids=["along the axes", "turned", "turned again"])
def turn(request: pytest.FixtureRequest) -> np.ndarray | None:
    return None if request.param is None else any_rotation(request.param)


def test_box_in_the_notch_of_an_l(turn: np.ndarray | None) -> None:
    pair = join_polyhedra([prism(L_OUTLINE, 0, 1), boxes(([1, 1, 0], [2, 2, 1]))])
    contacts = contacts_of(moved(pair, turn=turn))
    assert len(contacts) == 2
    np.testing.assert_allclose(contacts.areas, 1.0, rtol=1e-9)
    assert abs(contacts.normals[0] @ contacts.normals[1]) < 1e-9
    assert contacts.report.overlaps.shape == (0, 2)


def test_l_on_l_is_one_interface_with_six_points(turn: np.ndarray | None) -> None:
    stack = join_polyhedra([prism(L_OUTLINE, 0, 1), prism(L_OUTLINE, 1, 2)])
    contacts = contacts_of(moved(stack, turn=turn))
    assert contacts.areas == pytest.approx([3.0], rel=1e-9)
    assert np.diff(contacts.point_start).tolist() == [6]
    assert_consistent(contacts)


def test_column_on_a_ring_has_an_interface_with_a_hole(turn: np.ndarray | None) -> None:
    inner, outer = circle(0.5, 12), circle(1.0, 12)
    stack = join_polyhedra([ring(inner, outer, 0, 1), prism(outer, 1, 3)])
    contacts = contacts_of(moved(stack, turn=turn))
    area = 12 * np.sin(2 * np.pi / 12) / 2 * (1 - 0.25)
    assert contacts.areas == pytest.approx([area], rel=1e-7)
    assert contacts.outline.tolist() == [12]
    assert np.diff(contacts.point_start).tolist() == [24]
    assert_consistent(contacts)


def test_cylinder_in_a_socket_touches_all_around(turn: np.ndarray | None) -> None:
    outline = circle(1.0, 24)
    pair = join_polyhedra([ring(outline, circle(2.0, 24), 0, 1), prism(outline, 0, 1)])
    contacts = contacts_of(moved(pair, turn=turn))
    assert len(contacts) == 24
    side = 2 * np.sin(np.pi / 24)
    np.testing.assert_allclose(contacts.areas, side, rtol=1e-9)
    # The normals go from socket to cylinder: inwards.
    axis = np.array([0, 0, 0.5]) if turn is None else turn @ [0, 0, 0.5]
    inward = np.einsum("ki,ki->k", contacts.normals, axis - contacts.centroids)
    np.testing.assert_allclose(inward, np.cos(np.pi / 24), rtol=1e-9)
    assert len(contacts.report.overlaps) == 0


def test_block_on_a_ridge_narrower_than_the_tolerance() -> None:
    ridge = prism([[-0.0004, 0], [0.0004, 0], [1, 1], [-1, 1]], 0, 1)
    turned = replace(ridge, vertices=ridge.vertices[:, [0, 2, 1]])
    contacts = contacts_of(join_polyhedra([boxes(([-1, 0, -1], [1, 1, 0])), turned]))
    assert contacts.areas == pytest.approx([0.0008], rel=1e-6)
    assert np.diff(contacts.point_start).tolist() == [4]


def test_curved_faces_that_do_not_match() -> None:
    """A finer cylinder in a socket: facets of different directions within a generous tolerance."""
    socket = ring(circle(1.0, 48), circle(2.0, 48), 0, 1)
    cylinder = prism(circle(1.0, 96), 0, 1)
    contacts = contacts_of(join_polyhedra([socket, cylinder]), tolerance=3e-3)
    assert len(contacts) == 96
    assert contacts.areas.sum() == pytest.approx(2 * np.pi, rel=2e-3)
    assert np.abs(contacts.gaps).max() < 3e-3 * 1.5


def test_faces_that_do_not_match() -> None:
    shifted = boxes(([0, 0, 0], [2, 2, 1]), ([0.5, 0.7, 1], [3, 3, 2]), ([-1, -1, 1], [0.25, 0.5, 2]))
    contacts = contacts_of(shifted)
    np.testing.assert_array_equal(contacts.bodies, [[0, 1], [0, 2]])
    np.testing.assert_allclose(contacts.areas, [1.5 * 1.3, 0.25 * 0.5], rtol=1e-12)


def test_crossing_bars_give_the_common_rhombus() -> None:
    turned = moved(boxes(([-5, -0.5, 1], [5, 0.5, 2])), turn=np.array([[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, 1]]))
    contacts = contacts_of(join_polyhedra([boxes(([-5, -0.5, 0], [5, 0.5, 1])), turned]))
    assert contacts.areas == pytest.approx([1 / 0.8], rel=1e-12)
    np.testing.assert_allclose(contacts.centroids, [[0, 0, 1]], atol=1e-12)
    assert_consistent(contacts)


def box_with_split_top(split: Sequence[Sequence[int]], extra: Sequence[Sequence[float]] = ()) -> Polyhedra:
    """Unit cube whose top (corners 4 to 7, further points from 8) is split into the given faces."""
    cube = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1], *extra]
    sides = [[0, 3, 2, 1], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    return polyhedra_from_lists([cube], [[*sides, *split]])


SPLITS = {
    "one diagonal": box_with_split_top([[4, 5, 6], [4, 6, 7]]),
    "other diagonal": box_with_split_top([[5, 6, 7], [5, 7, 4]]),
    "fan": box_with_split_top([[4, 5, 8], [5, 6, 8], [6, 7, 8], [7, 4, 8]], [[0.3, 0.6, 1]]),
}


@pytest.mark.parametrize("split", SPLITS)
def test_split_faces_give_the_interface_of_the_whole(split: str, turn: np.ndarray | None) -> None:
    lid = boxes(([0.25, 0.5, 1], [1.5, 1, 2]))
    contacts = contacts_of(moved(join_polyhedra([SPLITS[split], lid]), turn=turn))
    assert contacts.areas == pytest.approx([0.75 * 0.5], rel=1e-7)
    assert np.diff(contacts.point_start).tolist() == [4]
    np.testing.assert_allclose(contacts.point_areas, 0.75 * 0.5 / 4, rtol=1e-6)


def test_edges_and_corners_that_touch_are_no_interface() -> None:
    contacts = contacts_of(boxes(([0, 0, 0], [1, 1, 1]), ([1, 1, 0], [2, 2, 1]), ([2, 2, 1], [3, 3, 2])))
    assert len(contacts) == 0
    assert len(contacts.report.slivers) == 0


def test_wedge_in_a_groove(turn: np.ndarray | None) -> None:
    """Inclined faces: two interfaces on the flanks of a V."""
    groove = prism([[-2, -2], [2, -2], [2, 0], [1, 0], [0, -1], [-1, 0], [-2, 0]], 0, 1)
    wedge = prism([[0, -1], [1, 0], [0, 1], [-1, 0]], 0, 1)
    contacts = contacts_of(moved(join_polyhedra([groove, wedge]), turn=turn))
    np.testing.assert_allclose(contacts.areas, np.sqrt(2), rtol=1e-9)
    assert len(contacts) == 2
    assert len(contacts.report.overlaps) == 0


def test_faces_at_a_small_angle_within_the_tolerance_touch() -> None:
    tilt = 8e-4
    lower = boxes(([0, 0, 0], [1, 1, 1]))
    upper = boxes(([0, 0, 1], [1, 1, 2]))
    vertices = upper.vertices.copy()
    vertices[:, 2] += tilt * vertices[:, 0]
    tilted = Polyhedra(vertices, upper.vertex_start, upper.loops, upper.loop_start, upper.face_start)
    contacts = contacts_of(join_polyhedra([lower, tilted]))
    assert contacts.gaps == pytest.approx([tilt], rel=1e-3)
    np.testing.assert_allclose(contacts.points[:, 2], 1 + tilt * contacts.points[:, 0] / 2, atol=1e-6)
    assert_consistent(contacts)


# Random puzzles of unit cubes glued into bars and corners: every common surface can be counted cube by cube.


Cell = tuple[int, int, int]
DIRECTIONS = [np.eye(3, dtype=int)[axis] * sign for axis in range(3) for sign in (1, -1)]


def neighbours(cell: Cell) -> list[Cell]:
    return [(cell[0] + int(d[0]), cell[1] + int(d[1]), cell[2] + int(d[2])) for d in DIRECTIONS]


def puzzle(seed: int, size: int) -> dict[Cell, int]:
    """Piece of every cell of a cube of ``size``; pieces of up to three cells, a tenth of the cells left empty."""
    rng = np.random.default_rng(seed)
    cells = [(int(i), int(j), int(k)) for i, j, k in np.ndindex(size, size, size)]
    piece: dict[Cell, int] = {}
    empty = {cell for cell in cells if rng.random() < 0.1}
    for number, start in enumerate(rng.permutation(len(cells))):
        if cells[start] in piece or cells[start] in empty:
            continue
        piece[cells[start]] = number
        grown = [cells[start]]
        for _ in range(int(rng.integers(0, 3))):
            free = [n for cell in grown for n in neighbours(cell) if n in cells and n not in piece and n not in empty]
            if free:
                grown.append(free[int(rng.integers(len(free)))])
                piece[grown[-1]] = number
    numbers = sorted(set(piece.values()))
    return {cell: numbers.index(number) for cell, number in piece.items()}


def square(cell: Cell, direction: np.ndarray) -> list[Cell]:
    """Corners of the side of a cell towards a direction."""
    axis = int(np.abs(direction).argmax())
    u, v = (axis + 1) % 3, (axis + 2) % 3
    corners = []
    for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
        corner = list(cell)
        corner[axis] += int(direction[axis] > 0)
        corner[u] += a
        corner[v] += b
        corners.append((corner[0], corner[1], corner[2]))
    return corners


def pieces_as_polyhedra(piece: dict[Cell, int]) -> Polyhedra:
    """One polyhedron for each piece, its surface made of unit squares."""
    vertex_lists, face_lists = [], []
    for number in range(max(piece.values()) + 1):
        faces = [
            square(cell, d)
            for cell in sorted(c for c, p in piece.items() if p == number)
            for d, n in zip(DIRECTIONS, neighbours(cell), strict=True)
            if piece.get(n) != number
        ]
        rows = {corner: row for row, corner in enumerate(sorted({corner for face in faces for corner in face}))}
        vertex_lists.append(np.array(list(rows), dtype=float))
        face_lists.append([[rows[corner] for corner in face] for face in faces])
    return polyhedra_from_lists(vertex_lists, face_lists)


def counted(piece: dict[Cell, int]) -> dict[tuple[int, int], list[int]]:
    """Sizes of the connected common surfaces of each pair of pieces, in unit squares."""
    squares: dict[tuple[int, int, int, int], set[Cell]] = defaultdict(set)
    for cell, number in piece.items():
        for axis in range(3):
            other = neighbours(cell)[2 * axis]
            if piece.get(other, number) != number:
                a, b = sorted((number, piece[other]))
                squares[a, b, axis, cell[axis]].add(cell)
    found: dict[tuple[int, int], list[int]] = defaultdict(list)
    for (a, b, *_), cells in squares.items():
        while cells:
            part, queue = 0, [cells.pop()]
            while queue:
                part += 1
                near = cells & set(neighbours(queue.pop()))
                cells -= near
                queue += near
            found[a, b].append(part)
    return {pair: sorted(parts) for pair, parts in found.items()}


@pytest.mark.every(2)
@pytest.mark.parametrize("turned", [False, True])
@settings(max_examples=12)
@given(st.integers(0, 10**6))
def test_every_common_surface_of_a_puzzle_is_found(turned: bool, seed: int) -> None:
    piece = puzzle(seed, 4)
    polyhedra = moved(pieces_as_polyhedra(piece), turn=any_rotation(seed) if turned else None)
    contacts = find_contacts(model_of(blocks_of(polyhedra)), section())
    found: dict[tuple[int, int], list[float]] = defaultdict(list)
    for (a, b), area in zip(contacts.bodies.tolist(), contacts.areas.tolist(), strict=True):
        found[a, b].append(area)
    expected = counted(piece)
    assert found.keys() == expected.keys()
    for pair, areas in found.items():
        assert sorted(areas) == pytest.approx(expected[pair], rel=1e-8)
    assert len(contacts.report.overlaps) == 0
    assert len(contacts.report.slivers) == 0
