"""Compressive strengths that no joint comes near, and forces asked for where joints crush: proved as any other."""

from __future__ import annotations

import pytest

from mbla.solution.solution import Status
from tests.asked import settlement_of
from tests.line import case_of

WALL = """mbla: 1
materials: {{stone: {{density: 2000}}}}
joints: {{dry: {{friction: 0.6, compressive_strength: {strength}}}}}
blocks:
  - wall:
      group: wall
      material: stone
      unit: [0.5, 0.25, 0.25]
      length: 2.0
      courses: 5
      openings: [{{from: [0.75, 0], to: [1.25, 0.5], lintel: {{bearing: 0.25}}}}]
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}}}]
ties:
  - {{through: [[0.568, 0.1, 0.62], [-2.2, -2.2, 0.8]], on: [{{group: wall, index: 19}}, ground], capacity: 300}}
  - {{through: [[0.3476, 0.1, 1.1], [2.04, 0.371, 0.7]], on: [{{group: wall, index: 15}}, ground], capacity: 300}}
load_cases: {{push: {{live: [{{acceleration: [1, 0, 0]}}]}}}}
analysis: {{flow_rule: associative}}
"""
RING = """mbla: 1
units: {force: kN, mass: t}
materials: {stone: {unit_weight: 22}}
joints: {mortar: {friction: 0.6, compressive_strength: "5 MPa"}}
blocks:
  - arch: {group: ring, material: stone, shape: segmental, span: 8, rise: 2, thickness: 0.5, width: 3, voussoirs: 31, springers: ground}
contacts: {joint: mortar}
load_cases:
  thrust: {objective: {force: {on: {group: ring, voussoir: 0}, direction: [1, 0, 0]}}}
analysis: {flow_rule: associative}
"""  # noqa: E501


@pytest.mark.parametrize("strength", ["1.e+11", "1.e+40"])
def test_a_strength_that_cannot_matter(strength: str) -> None:
    """It slides at the friction coefficient, which is proved whatever the strength is."""
    _, case = case_of(WALL.format(strength=strength))
    assert case.status is Status.SOLVED
    assert case.solution.mechanics is not None
    assert case.solution.mechanics.load_factor == pytest.approx(0.6, rel=1e-6)


@pytest.mark.parametrize(("end", "force"), [(0, 111.993), (1, 199.633)])
@pytest.mark.parametrize("length", [1.0, 1000.0])
def test_ends_of_a_thrust_where_joints_crush(end: int, force: float, length: float) -> None:
    """The load factor of a force counts from one many times the weight of a voussoir: forces balance that as well."""
    text = RING
    if length != 1.0:
        text = RING.replace("force: kN", "length: mm, force: kN").replace("unit_weight: 22", 'unit_weight: "22 kN/m^3"')
        for key, value in (("span", 8), ("rise", 2), ("thickness", 0.5), ("width", 3)):
            text = text.replace(f"{key}: {value}", f"{key}: {value * length:g}")
    _, case = case_of(text, case=end)
    assert case.status is Status.SOLVED
    assert case.solution.mechanics is not None
    settlement = settlement_of(case.load_case)
    assert abs(settlement.reaction(case.solution.mechanics.load_factor)) == pytest.approx(force, rel=2e-5)
