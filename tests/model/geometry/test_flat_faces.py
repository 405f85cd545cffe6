from __future__ import annotations

import pytest

from mbla.model.geometry.gaps import FLAT, flat_faces
from tests.model.shapes import raw


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize(("width", "flat"), [(0.9 * FLAT, True), (1.1 * FLAT, False)])
def test_a_face_is_a_line_by_its_width_over_its_longest_edge(size: float, width: float, flat: bool) -> None:
    triangle = [[0.0, 0.0, 0.0], [size, 0.0, 0.0], [0.5 * size, width * size, 0.0]]
    assert flat_faces(raw((triangle, [[0, 1, 2]]))).tolist() == [flat]


def test_a_small_face_far_from_the_first_corner_of_its_block_is_not_flat() -> None:
    corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    corners += [[1.0, 1.0, 1.0], [1.0001, 1.0, 1.0], [1.0, 1.0001, 1.0]]
    assert flat_faces(raw((corners, [[0, 1, 2], [3, 4, 5]]))).tolist() == [False, False]


def test_a_face_whose_corners_all_lie_at_one_place_is_flat() -> None:
    assert flat_faces(raw(([[1.0, 2.0, 3.0]] * 3, [[0, 1, 2]]))).tolist() == [True]
