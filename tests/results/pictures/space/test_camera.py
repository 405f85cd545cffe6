import numpy as np
import pytest

from mbla.results.pictures.space.camera import FRAME, axes_of, fitted

BOX = np.array([[x, y, z] for x in (0.0, 4.0) for y in (0.0, 2.0) for z in (0.0, 3.0)])


@pytest.mark.parametrize(
    ("azimuth", "elevation", "right", "up"),
    [(-90.0, 0.0, [1, 0, 0], [0, 0, 1]), (0.0, 0.0, [0, 1, 0], [0, 0, 1]), (-90.0, 90.0, [1, 0, 0], [0, 1, 0])],
)
def test_front_right_and_top_are_those_of_drawings(
    azimuth: float, elevation: float, right: list[int], up: list[int]
) -> None:
    towards, across, above = axes_of(azimuth, elevation)
    assert across == pytest.approx(np.array(right), abs=1e-12)
    assert above == pytest.approx(np.array(up), abs=1e-12)
    assert np.cross(across, above) == pytest.approx(towards, abs=1e-12)


@pytest.mark.parametrize("shift", [0.0, 1e6])
@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_everything_lies_in_the_frame_and_fills_it_in_one_direction(shift: float, scale: float) -> None:
    points = scale * (BOX + shift)
    places = fitted(points, -60.0, 25.0, 1.6).project(points)
    (left, end), (bottom, top) = FRAME
    assert places[:, 0].min() >= left - 1e-6
    assert places[:, 0].max() <= end + 1e-6
    assert places[:, 1].min() >= bottom - 1e-6
    assert places[:, 1].max() <= top + 1e-6
    fills = np.ptp(places, axis=0) / [end - left, top - bottom]
    assert fills.max() == pytest.approx(1.0, abs=1e-6)


def test_parallel_projection_keeps_lengths_across_the_line_of_sight() -> None:
    camera = fitted(BOX, -90.0, 0.0, 1.6)
    a, b = camera.project(np.array([[0.0, 0.0, 0.0], [4.0, 2.0, 0.0]]))
    assert (b[0] - a[0]) * camera.height * camera.aspect == pytest.approx(4.0)


def test_a_single_point_is_no_division_by_nothing() -> None:
    camera = fitted(np.ones((1, 3)), 0.0, 0.0, 1.6)
    assert np.isfinite(camera.project(np.ones((1, 3)))).all()
