from __future__ import annotations

import numpy as np
import pytest

from mbla.model.solids.measures import face_geometry
from tests.model.shapes import L_OUTLINE, box, moved, prism, raw, rotation


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
