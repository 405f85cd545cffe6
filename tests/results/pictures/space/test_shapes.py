import itertools

import numpy as np
import pytest

from mbla.results.pictures.space.shapes import SIDES, Faces, arrows, rods, turning_arrows


def volume(faces: Faces) -> float:
    """By the divergence theorem; positive where faces look outwards, whatever their order."""
    total = 0.0
    for first, last in zip(faces.start[:-1], faces.start[1:], strict=True):
        a, *rest = faces.points[faces.loops[first:last]]
        for b, c in itertools.pairwise(rest):
            total += float(a @ np.cross(b, c)) / 6
    return total


GREY = np.full((1, 3), 0.5)


def test_rods_are_closed_prisms_with_their_ends_where_they_were_asked_for() -> None:
    start, end = np.array([[1.0, 2.0, 3.0]]), np.array([[1.0, 5.0, 7.0]])
    faces = rods(start, end, np.array([0.1]), GREY)
    prism = SIDES / 2 * np.sin(2 * np.pi / SIDES) * 0.1**2 * 5.0
    assert abs(volume(faces)) == pytest.approx(prism, rel=1e-12)
    along = (faces.points - start) @ np.array([0.0, 0.6, 0.8])
    assert along.min() == pytest.approx(0.0, abs=1e-12)
    assert along.max() == pytest.approx(5.0, rel=1e-12)


def test_arrows_end_at_their_tips_and_are_thickest_behind_them() -> None:
    tips = np.array([[0.0, 0.0, 2.0], [3.0, 0.0, 0.0]])
    faces = arrows(np.zeros((2, 3)), tips, np.full(2, 0.05), np.tile(GREY, (2, 1)))
    first = faces.points[: len(faces.points) // 2]
    assert first[:, 2].max() == pytest.approx(2.0)
    widest = first[np.argmax(np.hypot(first[:, 0], first[:, 1]))]
    assert 1.0 < widest[2] < 2.0
    assert len(faces.colours) == len(faces.start) - 1


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_rings_turn_by_the_right_hand(sense: float) -> None:
    """The head comes three quarters of a turn after the tail: between them lies the missing quarter."""
    faces = turning_arrows(np.zeros((1, 3)), np.array([[0.0, 0.0, sense]]), np.array([1.0]), 0.01, GREY[0])
    tip = faces.points[-1]
    tail = faces.points[0]
    assert np.sign(np.cross(tip, tail)[2]) == sense  # from the tip on by a quarter to the tail, the same way round
    assert np.linalg.norm(tip) == pytest.approx(1.0, abs=0.05)
