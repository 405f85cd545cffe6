from __future__ import annotations

import numpy as np

from mbla.model.geometry.gaps import lone_edge_corners, shortest_edges
from tests.model.shapes import box, raw

TRIANGLE = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0], [9.0, 9.0, 9.0]]


def test_the_shortest_edge_at_a_vertex_leads_to_it_or_from_it() -> None:
    """Sides of 3, 5 and 4; the last vertex is of no face."""
    for corners in ([0, 1, 2], [2, 1, 0]):
        assert shortest_edges(raw((TRIANGLE, [corners]))).tolist() == [3, 3, 4, np.inf]


def test_the_shortest_edges_of_a_box() -> None:
    assert shortest_edges(raw(box((1, 1, 1), (4, 3, 6)))).tolist() == [2] * 8


def test_lone_edges_are_those_of_one_face() -> None:
    vertices, faces = box()
    assert lone_edge_corners(raw((vertices, faces))).tolist() == []
    assert lone_edge_corners(raw((vertices, faces[:1]))).tolist() == [0, 1, 2, 3]
    without_top = raw((vertices, [faces[0], *faces[2:]]))
    ends = np.stack([without_top.loops, without_top.next_loops], axis=1)[lone_edge_corners(without_top)]
    assert sorted(map(sorted, ends.tolist())) == [[4, 5], [4, 7], [5, 6], [6, 7]]
