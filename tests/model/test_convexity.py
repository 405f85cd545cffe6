from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from mbla.model.solids.measures import face_geometry, find_convex
from tests.model.shapes import L_OUTLINE, TETRAHEDRON, box, build, hull, moved, prism, raw, rotation


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_each_block_by_itself(scale: float) -> None:
    shapes = [box(), prism(L_OUTLINE), TETRAHEDRON, hull(0)[0], prism(L_OUTLINE, 0.1)]
    built = build(*[moved(shape, scale * rotation(0)) for shape in shapes])
    assert built.blocks.convex.tolist() == [True, False, True, True, False]


def test_large_polyhedra() -> None:
    points = np.random.default_rng(0).normal(size=(400, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    faces = ConvexHull(points).simplices.tolist()
    dented = points.copy()
    dented[7] *= 0.5
    built = build((points.tolist(), faces), (dented.tolist(), faces))
    assert not built.defects
    assert built.blocks.convex.tolist() == [True, False]


@pytest.mark.parametrize(("dent", "convex"), [(1e-4, True), (1e-2, False)])
def test_dents_within_the_tolerance_do_not_count(dent: float, convex: bool) -> None:
    vertices, faces = box()
    vertices = [*vertices, [0.5, 0.5, 1 - dent]]
    built = build((vertices, [faces[0], *([4 + i, 4 + (i + 1) % 4, 8] for i in range(4)), *faces[2:]]))
    assert built.blocks.convex.tolist() == [convex]


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_huge_polyhedra_are_judged_as_large_ones(monkeypatch: pytest.MonkeyPatch, scale: float) -> None:
    points = np.random.default_rng(0).normal(size=(400, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    faces = ConvexHull(points).simplices.tolist()
    shapes = []
    for dent in (0.0, 1e-4, 5e-2, 0.5):
        dented = points.copy()
        dented[7] *= 1 - dent
        shapes.append(moved((dented.tolist(), faces), scale * rotation(0)))
    large = build(*shapes).blocks.convex.tolist()
    assert set(large) == {True, False}
    monkeypatch.setattr("mbla.model.solids.measures.HUGE", 0)
    assert build(*shapes).blocks.convex.tolist() == large


def test_huge_polyhedra_are_not_called_convex_where_nothing_is_allowed(monkeypatch: pytest.MonkeyPatch) -> None:
    polyhedra = raw(box(), box())
    monkeypatch.setattr("mbla.model.solids.measures.LARGE", 0)
    monkeypatch.setattr("mbla.model.solids.measures.HUGE", 0)
    convex = find_convex(polyhedra, face_geometry(polyhedra), np.array([0.0, 1e-3]))
    assert convex.tolist() == [False, True]
