from __future__ import annotations

import numpy as np
import pytest

from mbla.model.geometry.gaps import insert_t_junctions
from tests.model.shapes import Shape, raw


def edge_and_tip(x: float, y: float = 0.0) -> Shape:
    """A triangle with an edge from (0, 0) to (1, 0), and one beyond it whose tip lies at (x, y)."""
    vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 2.0, 0.0], [x, y, 0.0], [x - 0.5, -2.0, 0.0], [x, -2.0, 0.0]]
    return vertices, [[0, 1, 2], [3, 4, 5]]


def inserted(shape: Shape, reach: float) -> list[int]:
    """Corners of the first face."""
    polyhedra, count = insert_t_junctions(raw(shape), np.full(6, reach))
    first: list[int] = polyhedra.loops[: polyhedra.loop_start[1]].tolist()
    assert len(first) == 3 + count
    return first


@pytest.mark.parametrize("reach", [0.0, 1e-3])
def test_a_vertex_on_an_edge_becomes_a_corner_of_its_face(reach: float) -> None:
    assert inserted(edge_and_tip(0.25), reach) == [0, 3, 1, 2]


def test_a_vertex_as_far_off_the_edge_as_it_reaches_lies_on_it() -> None:
    assert inserted(edge_and_tip(0.5, -0.125), 0.125) == [0, 3, 1, 2]
    assert inserted(edge_and_tip(0.5, -0.125), 0.12) == [0, 1, 2]


@pytest.mark.parametrize("x", [0.25, 0.75])
def test_a_vertex_that_reaches_an_end_of_the_edge_is_left_to_be_welded(x: float) -> None:
    assert inserted(edge_and_tip(x), 0.25) == [0, 1, 2]
    assert inserted(edge_and_tip(x), 0.24) == [0, 3, 1, 2]
