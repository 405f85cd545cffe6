from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from mbla.arrays import FloatArray
from mbla.model.blocks.curves import Curve, named_curve
from mbla.model.blocks.curves.shapes import Pointed, basket, catenary, circle, ellipse, segmental
from mbla.model.blocks.curves.spline import curve_through

SPAN = 4.0
GIVEN = [(0.0, 0.0), (0.4, 1.0), (1.3, 1.7), (2.6, 1.8), (3.7, 0.9), (4.0, 0.2)]
CURVES: dict[str, Curve] = {
    "semicircle": circle(SPAN, np.pi / 2),
    "segment": segmental(SPAN, 0.7),
    "horseshoe": circle(SPAN, np.radians(110)),
    "flat ellipse": ellipse(SPAN, 1.1),
    "tall ellipse": ellipse(SPAN, 3.0),
    "flat catenary": catenary(SPAN, 0.05),
    "catenary": catenary(SPAN, 2.5),
    "basket": basket(SPAN, 1.3, np.radians(60)),
    "pointed": Pointed(SPAN, 3.0),
    "spline": curve_through(GIVEN),
}
SYMMETRIC = [name for name in CURVES if name != "spline"]
LEVEL = ("semicircle", "flat ellipse", "tall ellipse", "basket", "pointed")

every_curve = pytest.mark.parametrize("name", list(CURVES))


def on_curve(curve: Curve, parameters: FloatArray, offset: float = 0.0) -> FloatArray:
    return curve.points(parameters, np.full((len(parameters), 1), offset))[:, 0]


def fine(curve: Curve, offset: float, per_part: int = 4000) -> FloatArray:
    """Length of the line at an offset, by many chords, between joints of a division into ten, (10,)."""
    joints = curve.divide(10, offset)
    lengths = []
    for low, high in pairwise(joints):
        if isinstance(curve, Pointed):  # the apex lies where the arc has turned by acos(d / reach)
            ends = [turned(curve, p, offset) for p in (low, high)]
            lengths.append(abs(ends[1] - ends[0]) * (curve.radius + offset))
            continue
        at = np.linspace(low, high, per_part)
        lengths.append(np.linalg.norm(np.diff(on_curve(curve, at, offset), axis=0), axis=1).sum())
    return np.array(lengths)


def turned(curve: Pointed, parameter: float, offset: float) -> float:
    if parameter == np.pi / 2:
        return float(np.arccos((curve.radius - curve.span / 2) / (curve.radius + offset)))
    return min(parameter, np.pi - parameter)


@every_curve
@pytest.mark.parametrize("offset", [0.0, 0.3])
def test_division_into_equal_lengths_along_the_line_at_an_offset(name: str, offset: float) -> None:
    lengths = fine(CURVES[name], offset)
    assert lengths == pytest.approx(np.full(10, lengths.mean()), rel=2e-6)


@every_curve
def test_springings_are_exact(name: str) -> None:
    curve = CURVES[name]
    ends = on_curve(curve, curve.divide(7, 0.15)[[0, -1]])
    expected = [[0, 0], [4, 0.2 if name == "spline" else 0]]
    assert ends == pytest.approx(np.array(expected), abs=1e-15)
    directions = curve.forwards(curve.divide(7, 0.15)[[0, -1]])
    if name in LEVEL:
        assert directions == pytest.approx(np.array([[0, 1], [0, -1]]), abs=1e-15)


@every_curve
def test_directions_are_those_of_the_curve(name: str) -> None:
    curve = CURVES[name]
    joints = curve.divide(11, 0.2)
    step = 1e-6
    inner = joints[1:-1]
    ahead = on_curve(curve, inner + step) - on_curve(curve, inner - step)
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    assert curve.forwards(inner) == pytest.approx(ahead, abs=1e-8)


@every_curve
def test_lines_beside_the_curve_lie_at_their_offsets_along_the_joints(name: str) -> None:
    curve = CURVES[name]
    joints = curve.divide(9, 0.2)  # odd: none at the apex of the pointed arch
    ladder = curve.points(joints, np.tile([0.0, 0.1, 0.4], (10, 1)))
    forwards = curve.forwards(joints)
    normals = np.stack([-forwards[:, 1], forwards[:, 0]], axis=1)
    for column, offset in ((1, 0.1), (2, 0.4)):
        assert ladder[:, column] - ladder[:, 0] == pytest.approx(offset * normals, abs=1e-14)


@every_curve
def test_lengths_are_those_of_the_chords_in_the_limit(name: str) -> None:
    curve = CURVES[name]
    low, high = curve.divide(1, 0.0).tolist()
    at = np.linspace(low, high, 40_001)
    if curve.crest is not None:  # parameters in between stand for no point of the curve
        half = curve.points(np.array([curve.crest]), np.zeros((1, 1)))[0, 0]
        turn = np.arctan2(half[1], curve.radius - half[0])
        at = np.concatenate([np.linspace(0, turn, 20_000), np.pi - np.linspace(turn, 0, 20_000)])
    chords = np.linalg.norm(np.diff(on_curve(curve, at), axis=0), axis=1)
    assert np.diff(curve.lengths(at)).sum() == pytest.approx(chords.sum(), rel=1e-8)


@pytest.mark.parametrize("name", SYMMETRIC)
@pytest.mark.parametrize("count", [6, 7])
def test_halves_are_mirror_images(name: str, count: int) -> None:
    curve = CURVES[name]
    found = curve.points(curve.divide(count, 0.1), np.tile([0.0, 0.25], (count + 1, 1)))
    assert found[::-1] * [-1, 1] + [SPAN, 0] == pytest.approx(found, abs=1e-14)


def test_length_of_an_ellipse() -> None:
    curve = ellipse(6.0, 2.0)
    exact = quad(lambda u: np.hypot(3 * np.cos(u), 2 * np.sin(u)), -np.pi / 2, np.pi / 2, epsabs=1e-13)[0]
    assert curve.lengths(np.array([np.pi / 2])) == pytest.approx([exact], rel=1e-12)


@pytest.mark.parametrize("rise", [1e-4, 0.4, 2.0, 40.0, 4000.0])
def test_a_catenary_has_its_rise(rise: float) -> None:
    curve = catenary(SPAN, rise)
    assert on_curve(curve, np.array([0.0]))[0] == pytest.approx([2.0, rise], rel=1e-11)


def test_an_ellipse_as_high_as_half_its_span_is_a_circle() -> None:
    joints = np.tile([0.0, 0.3], (12, 1))
    round_one = circle(SPAN, np.pi / 2)
    expected = round_one.points(round_one.divide(11, 0.1), joints)
    for curve in (ellipse(SPAN, 2.0), basket(SPAN, 2.0, np.radians(50))):
        assert curve.points(curve.divide(11, 0.1), joints) == pytest.approx(expected, abs=1e-13)


def test_a_basket_arch_has_common_tangents_and_its_rise() -> None:
    curve = CURVES["basket"]
    turn = np.pi / 2 - np.radians(60)
    for side in (-1, 1):
        around = side * np.array([turn - 1e-9, turn + 1e-9])
        assert np.ptp(on_curve(curve, around), axis=0) == pytest.approx([0, 0], abs=1e-8)
    assert on_curve(curve, np.array([0.0])) == pytest.approx(np.array([[2.0, 1.3]]))
    radii = [curve.lengths(np.array([low, high])) for low, high in ((1.2, 1.3), (0.1, 0.2))]
    assert 0 < np.diff(radii[0]) < np.diff(radii[1])


def test_the_lines_beside_a_pointed_arch_meet_on_the_axis() -> None:
    curve = Pointed(SPAN, SPAN * np.sqrt(3) / 2)
    assert curve.radius == pytest.approx(SPAN)  # equilateral: the centres are the springings
    apex = curve.points(np.array([np.pi / 2]), np.array([[0.0, 0.5]]))[0]
    assert apex == pytest.approx(np.array([[2, np.sqrt(12)], [2, np.sqrt(4.5**2 - 4)]]))


def test_a_spline_through_points_of_a_circle_comes_close_to_it() -> None:
    angles = np.linspace(-1.2, 1.2, 15)
    given = np.stack([np.sin(angles) - np.sin(-1.2), np.cos(angles) - np.cos(1.2)], axis=1)
    curve = curve_through(given.tolist())
    joints = curve.divide(8, 0.2)
    arc = circle(float(2 * np.sin(1.2)), 1.2)
    expected = arc.points(arc.divide(8, 0.2), np.full((9, 1), 0.2))
    assert curve.points(joints, np.full((9, 1), 0.2)) == pytest.approx(expected, abs=3e-4)


def test_a_spline_passes_its_points() -> None:
    chords = np.linalg.norm(np.diff(np.array(GIVEN), axis=0), axis=1)
    at = np.concatenate([[0.0], np.cumsum(chords)])
    assert on_curve(CURVES["spline"], at) == pytest.approx(np.array(GIVEN), abs=1e-14)


@pytest.mark.parametrize("shape", ["semicircular", "segmental", "pointed", "elliptic", "catenary", "basket"])
def test_shapes_of_the_deck(shape: str) -> None:
    rise = {"semicircular": None, "pointed": 2.5}.get(shape, 1.2)
    curve = named_curve(shape, SPAN, rise)
    crown = curve.divide(2, 0.0)[1:2]
    assert on_curve(curve, crown) == pytest.approx(np.array([[2.0, rise or 2.0]]))
