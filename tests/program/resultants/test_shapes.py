from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from mbla.program.resultants.friction_curve import disc_radius, fitted_curves
from mbla.program.resultants.shapes import InterfaceShapes, interface_shapes
from tests.line import HEAD, Line, line_of

PRISM = (
    HEAD
    + """\
joints: {dry: {friction: 0.5}}
blocks:
  - polyhedron: {group: block, material: stone, vertices: VERTICES, faces: FACES}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""
)


def prism_line(outline: Sequence[tuple[float, float]], *overrides: str, text: str = PRISM) -> Line:
    """A prism of this outline on the ground."""
    n = len(outline)
    vertices = [[x, y, z] for z in (0, 1) for x, y in outline]
    faces = [list(range(n)), list(range(n, 2 * n))]
    faces += [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    return line_of(text.replace("VERTICES", str(vertices)).replace("FACES", str(faces)), *overrides)


def shapes_of(*outline: tuple[float, float], text: str = PRISM, refine: int = 1) -> InterfaceShapes:
    """The interface of a prism of this outline with the ground."""
    return interface_shapes(prism_line(outline, f"contacts.points.per_edge={refine}", text=text).contacts)


def test_rectangle_in_any_position() -> None:
    angle = 0.4
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    corners = np.array([[0, 0], [1.2, 0], [1.2, 0.7], [0, 0.7]]) @ turn
    shapes = shapes_of(*[(float(x), float(y)) for x, y in corners])
    assert shapes.rectangles.all()
    assert sorted(shapes.sides[0]) == pytest.approx([0.7, 1.2])
    assert shapes.axes[0] @ shapes.axes[0].T == pytest.approx(np.eye(2), abs=1e-15)
    assert (shapes.edge_slopes() * shapes.corners).sum(axis=1) == pytest.approx(np.ones(4))


def test_rectangle_but_for_rounding_has_axes_at_right_angles() -> None:
    """Conditions and checks use the axes in different ways, which agree for right angles alone."""
    shapes = shapes_of((0, 0), (1, 0), (1 + 5e-7, 0.8), (5e-7, 0.8))
    assert shapes.rectangles.all()
    assert shapes.axes[0] @ shapes.axes[0].T == pytest.approx(np.eye(2), abs=1e-15)


def test_parallelogram_is_no_rectangle() -> None:
    assert not shapes_of((0, 0), (1, 0), (1.01, 0.8), (0.01, 0.8)).rectangles.any()


def test_points_on_edges_are_no_corners() -> None:
    plain, refined = shapes_of((0, 0), (1, 0), (0.3, 0.8)), shapes_of((0, 0), (1, 0), (0.3, 0.8), refine=4)
    assert refined.corners == pytest.approx(plain.corners)
    assert refined.radii == pytest.approx(plain.radii, rel=1e-12)


def test_angle_has_the_hull_for_its_edges_and_itself_for_its_friction() -> None:
    angle = ((0, 0), (1, 0), (1, 0.4), (0.4, 0.4), (0.4, 1), (0, 1))
    shapes = shapes_of(*angle)
    assert not shapes.convex.any()
    assert len(shapes.corners) == 5  # the inner corner is not one of the hull
    area = 0.64
    centroid = np.array([0.4 * 0.5 + 0.24 * 0.2, 0.4 * 0.2 + 0.24 * 0.7]) / area
    radius, theta = fitted_curves((np.array(angle) - centroid)[None])
    assert shapes.radii == pytest.approx(radius, rel=1e-6)
    assert shapes.thetas == pytest.approx(theta, abs=1e-6)


def test_holes_leave_the_least_radius_of_their_area() -> None:
    frame = """\
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: low, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - polyhedron: {group: high, material: stone, vertices: VERTICES, faces: FACES}
supports: [{blocks: low}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""
    outer = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    inner = [(0.3, 0.3), (0.7, 0.3), (0.7, 0.7), (0.3, 0.7)]
    vertices = [[x, y, z] for z in (1, 2) for loop in (outer, inner) for x, y in loop]
    faces = []
    for i in range(4):
        j = (i + 1) % 4
        faces += [[i, j, 4 + j, 4 + i], [8 + i, 8 + j, 12 + j, 12 + i]]  # bottom, top
        faces += [[i, j, 8 + j, 8 + i], [4 + i, 4 + j, 12 + j, 12 + i]]  # outside, inside
    line = line_of(HEAD + frame.replace("VERTICES", str(vertices)).replace("FACES", str(faces)))
    shapes = interface_shapes(line.contacts)
    assert not shapes.convex.any()
    assert shapes.radii == pytest.approx(disc_radius(np.array([0.84])))
    assert shapes.thetas == pytest.approx(1.0)
