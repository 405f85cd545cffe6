"""A block on a ring whose hole touches the block's edge between two corners: every point of it has an area."""

from __future__ import annotations

import pytest

from mbla.solution.solution import Status
from tests.contacts.test_shapes import ring
from tests.line import case_of

DECK = """\
mbla: 1
materials: {{stone: {{density: 2000}}}}
joints: {{dry: {{friction: 0.6, cohesion: 1.0e5, tensile_strength: 1.0e5, compressive_strength: 1.0e6}}}}
contacts: {{joint: dry, points: {{per_edge: {per_edge}}}}}
blocks:
  - polyhedron: {{group: ring, material: stone, vertices: {vertices}, faces: {faces}}}
  - box: {{group: top, material: stone, min: [-0.5, -0.7, 1], max: [1.0, 0.9, 2]}}
supports: [{{blocks: ring}}]
load_cases: {{push: {{live: [{{acceleration: [1, 0, 0]}}]}}}}
analysis: {{flow_rule: {flow_rule}}}
"""


@pytest.mark.parametrize("flow_rule", ["associative", "non_associative"])
def test_strengths_of_points_along_an_edge_that_a_hole_touches(flow_rule: str) -> None:
    """More points carry no more than those at the corners, and little less."""
    inner, outer = ([[r, 0], [0, r], [-r, 0], [0, -r]] for r in (0.5, 2.0))
    shape = ring(inner, outer, 0, 1)
    faces = [shape.loops[a:b].tolist() for a, b in zip(shape.loop_start, shape.loop_start[1:], strict=False)]
    factors = []
    for per_edge in (1, 2, 3):
        deck = DECK.format(per_edge=per_edge, vertices=shape.vertices.tolist(), faces=faces, flow_rule=flow_rule)
        _, case = case_of(deck)
        assert case.status is Status.SOLVED
        assert case.solution.mechanics is not None
        factors.append(case.solution.mechanics.load_factor)
    assert factors == sorted(factors, reverse=True)
    assert factors[-1] == pytest.approx(factors[0], rel=1e-3)
