"""Random puzzles of unit cubes glued into bars and corners: every common surface can be counted cube by cube."""

from __future__ import annotations

from collections import defaultdict

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mbla.contacts import find_contacts
from mbla.model.solids.polyhedra import Polyhedra, polyhedra_from_lists
from tests.contacts.structures import any_rotation, blocks_of, model_of, moved, section

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
