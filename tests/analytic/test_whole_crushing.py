"""A joint that crushes whole, under forces up to 1e11 times the weight of the block: f_c A less the weight."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from tests.line import HEAD, factor_of

OUTLINES = {
    "rectangle": [(0.0, 0.0), (1.0, 0.0), (1.0, 0.5), (0.0, 0.5)],
    "triangle": [(0.0, 0.0), (1.0, 0.0), (0.3, 0.8)],
    "L": [(0.0, 0.0), (1.0, 0.0), (1.0, 0.4), (0.5, 0.4), (0.5, 1.0), (0.0, 1.0)],
}
FLOW_RULES = ("associative", "non_associative")
GRAVITY = 9.81


def block(outline: str, strength: float, eccentricity: tuple[float, float] = (0.0, 0.0), size: float = 1.0) -> str:
    """A prism on the ground, of a height and outline times ``size`` [m], pressed by f_c A."""
    corners = size * np.array(OUTLINES[outline])
    base = shapely.Polygon(corners)
    n, centre = len(corners), np.array(base.centroid.coords[0]) + size * np.array(eccentricity)
    vertices = [[*corner, z] for z in (0.0, size) for corner in corners.tolist()]
    sides = [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    faces = [list(range(n))[::-1], list(range(n, 2 * n)), *sides]
    return (
        HEAD
        + f"""\
joints: {{dry: {{friction: 0.6, compressive_strength: {strength!r}}}}}
blocks: [{{polyhedron: {{group: block, material: stone, vertices: {vertices}, faces: {faces}}}}}]
supports: [{{ground: {{z: 0}}}}]
load_cases:
  press: {{live: [{{force: [0, 0, {-strength * base.area!r}], on: block, at: {[*centre.tolist(), size]}}}]}}
"""
    )


@pytest.mark.every(3)
@pytest.mark.parametrize(
    ("strength", "density", "flow_rule"), [(1e5, 2e3, "associative"), (1e11, 1.0, "non_associative")]
)
@pytest.mark.parametrize("outline", OUTLINES)
def test_a_centred_force_crushes_the_whole_joint(outline: str, strength: float, density: float, flow_rule: str) -> None:
    ways = (f"materials.stone.density={density}", f"analysis.flow_rule={flow_rule}")
    found = factor_of(block(outline, strength), *ways)
    assert found == pytest.approx(1.0 - density * GRAVITY / strength, rel=1e-8)


@pytest.mark.parametrize(
    ("eccentricity", "strength", "flow_rule"),
    [
        (1e-6, 1e5, "non_associative"),
        (1e-3, 1e5, "associative"),
        (1e-6, 1e12, "associative"),
        (1e-3, 1e12, "non_associative"),
    ],
)
def test_a_force_that_is_nearly_centred(eccentricity: float, strength: float, flow_rule: str) -> None:
    """n² = n − 2 e (n − w) with n = N/(f_c A), w = W/(f_c A), for a rectangle of width 1."""
    weight, across = 2000 * GRAVITY / strength, 1.0 - 2.0 * eccentricity
    exact = 0.5 * (across + np.sqrt(across**2 + 8.0 * eccentricity * weight)) - weight
    found = factor_of(block("rectangle", strength, (eccentricity, 0.0)), f"analysis.flow_rule={flow_rule}")
    assert found == pytest.approx(exact, rel=1e-8)


@pytest.mark.long
@pytest.mark.parametrize("flow_rule", FLOW_RULES)
def test_a_force_that_is_nearly_centred_both_ways_has_one_figure_in_every_unit(flow_rule: str) -> None:
    """The weight is next to nothing: only the outline counts."""
    ways = (f"analysis.flow_rule={flow_rule}",)
    found = [
        factor_of(block("L", strength, (1e-3, 2e-3), size), *ways) for strength, size in ((1e12, 1.0), (1e9, 1e-3))
    ]
    assert found[0] == pytest.approx(found[1], rel=1e-7)
