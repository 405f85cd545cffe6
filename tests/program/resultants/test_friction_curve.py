"""Friction with torsion: curves inside the true limit."""

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.resultants.friction_curve import (
    disc_radius,
    fitted_curves,
    friction,
    rectangle_curve,
    safe_torsion,
)
from tests.program.resultants.polygons import SHAPES, points_inside, rectangle, regular

SQUARE = (np.sqrt(2) + np.log(1 + np.sqrt(2))) / 6


def centres(size: float, seed: int = 1) -> FloatArray:
    """Centres of rotation near and far, along the axes and in odd directions, (1, n, 2)."""
    odd = np.random.default_rng(seed).uniform(0, 2 * np.pi, 20)
    angle = np.concatenate([np.pi / 2 * np.arange(4), odd])
    radius = size * np.concatenate([np.geomspace(1e-3, 300.0, 25), np.linspace(0.1, 3.0, 25)])
    return np.asarray((radius[:, None, None] * np.column_stack([np.cos(angle), np.sin(angle)])).reshape(1, -1, 2))


def limit_curve(outline: FloatArray, seed: int = 1) -> tuple[FloatArray, FloatArray]:
    """‖T‖ and M at many points of the true limit curve."""
    c = centres(float(np.abs(outline).max()), seed)
    rho, mean = friction(outline, c)
    return np.hypot(mean[0, :, 0], mean[0, :, 1]), (rho + (c * mean).sum(axis=2))[0]


@pytest.mark.parametrize("name", SHAPES)
def test_friction_is_that_of_a_sum_over_the_area(name: str) -> None:
    outline = SHAPES[name]
    c = 3.0 * float(np.abs(outline).max()) * np.array([[[0.5, 0.3], [-0.2, 0.9], [0.0, -2.0]]])
    c = c[:, (np.abs(c) > 0.9 * np.abs(outline).max()).any(axis=2)[0]]  # outside: no singular point amid the area
    points, weights = points_inside(outline[0])
    rho, mean = friction(outline, c)
    for k in range(c.shape[1]):
        arm = points - c[0, k]
        distance = np.hypot(arm[:, 0], arm[:, 1])
        assert rho[0, k] == pytest.approx(weights @ distance, rel=1e-9)
        assert mean[0, k] == pytest.approx(weights @ (arm / distance[:, None]), abs=1e-9)


def test_square_and_disc() -> None:
    rho, theta, gradient = rectangle_curve(np.array([[1.0, 1.0]]))
    assert rho == pytest.approx(SQUARE, rel=1e-14)
    assert theta == pytest.approx(2 - 4 * SQUARE * np.arcsinh(1.0))
    assert gradient == pytest.approx(np.full((1, 2), SQUARE / 2))
    many = regular(720)
    assert friction(many, np.zeros((1, 1, 2)))[0] == pytest.approx(2 / 3, rel=1e-4)
    assert disc_radius(np.array([np.pi])) == pytest.approx(2 / 3)


def test_slender_rectangle_is_a_line() -> None:
    rho, theta, gradient = rectangle_curve(np.array([[1.0, 1e-6], [1e-6, 1.0]]))
    assert rho == pytest.approx(0.25, rel=1e-5)
    assert theta == pytest.approx(1.0, abs=1e-5)
    assert gradient[0, 0] == pytest.approx(0.25, rel=1e-5)


def test_gradient_of_the_radius_is_a_supporting_plane() -> None:
    sides = np.random.default_rng(3).uniform(0.1, 2.0, (200, 2))
    rho, _, gradient = rectangle_curve(sides)
    assert (gradient * sides).sum(axis=1) == pytest.approx(rho)  # homogeneous of degree 1
    assert np.all(gradient @ sides.T <= rho[None, :] * (1 + 1e-12))  # convex: the tangent is below everywhere
    step = np.array([1e-6, 0.0])
    numeric = (rectangle_curve(sides + step)[0] - rectangle_curve(sides - step)[0]) / 2e-6
    assert gradient[:, 0] == pytest.approx(numeric, rel=1e-6)


@pytest.mark.parametrize("aspect", [1.0, 1.3, 2.0, 3.0, 5.0, 10.0, 100.0])
def test_safe_curve_of_rectangles_is_inside_the_limit_curve(aspect: float) -> None:
    rho, theta, _ = rectangle_curve(np.array([[aspect, 1.0]]))
    shear, torsion = limit_curve(rectangle(aspect, 1.0))
    assert np.all(rho * safe_torsion(shear, theta) <= torsion * (1 + 1e-9))


@pytest.mark.parametrize(("aspect", "least"), [(1.0, 0.955), (2.0, 0.892), (10.0, 0.838)])
def test_safe_curve_of_rectangles_is_not_far_inside(aspect: float, least: float) -> None:
    """Along every ray the safe curve reaches at least this share of the limit curve, which depends on direction."""
    rho, theta, _ = rectangle_curve(np.array([[aspect, 1.0]]))
    shear, torsion = limit_curve(rectangle(aspect, 1.0))
    m = torsion / rho
    size = 0.5 * (theta * m + np.sqrt(((2 - theta) * m) ** 2 + 4 * shear**2))
    assert 1 / size.max() > least
    assert 1 / size.max() < least + 0.005  # the stated bound is not a loose one


@pytest.mark.parametrize("name", SHAPES)
def test_fitted_curves_are_inside_the_limit_curve(name: str) -> None:
    outline = SHAPES[name]
    radius, theta = fitted_curves(outline)
    for seed in (1, 2, 3):
        shear, torsion = limit_curve(outline, seed)
        assert np.all(radius * safe_torsion(shear, theta) <= torsion * (1 + 1e-9))
    pure = friction(outline, centres(float(np.abs(outline).max())) * 0.01)[0].min()
    short = {"slender triangle": 0.955, "trapezium": 0.985}.get(name, 0.985)
    assert radius > short * pure


def test_fitted_curves_do_not_depend_on_size_place_in_the_array_or_rotation() -> None:
    outline = SHAPES["trapezium"]
    radius, theta = fitted_curves(outline)
    turn = np.array([[0.6, 0.8], [-0.8, 0.6]])
    radii, thetas = fitted_curves(np.concatenate([outline * 1000.0, SHAPES["square"], outline @ turn]))
    assert radii[0] == pytest.approx(1000 * radius[0], rel=1e-9)
    assert thetas[0] == pytest.approx(theta[0], abs=1e-6)
    assert radii[2] == pytest.approx(radius[0], rel=1e-9)


@pytest.mark.parametrize("name", ["square", "two to one"])
def test_a_fitted_curve_of_a_rectangle_is_as_sharp_as_the_closed_form(name: str) -> None:
    sides = np.ptp(SHAPES[name], axis=1)
    assert fitted_curves(SHAPES[name])[1] == pytest.approx(rectangle_curve(sides)[1], abs=1e-6)
