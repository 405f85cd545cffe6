"""The dead load on the stress-free assembly: what stands, what falls, and that nothing drifts."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.program.stiffness_shares import shares_of
from mbla.solution.flow.gravity_step import gravity_step
from mbla.solution.flow.renewed_springs import are_light
from mbla.solution.law.elastic_joints import ElasticJoints
from tests.decks.folder import BENCHMARKS, PATHS
from tests.line import BLOCK, line_of, line_of_file
from tests.solution.flow.paths import case_of, rest_of

INCLINE = "load_cases.push.dead=[{gravity: [%s, 0, -9.81]}]"


def test_a_block_rests_on_its_corners() -> None:
    gravity = rest_of(line_of(BLOCK))
    assert gravity.carried
    np.testing.assert_allclose(gravity.state.normal, gravity.force, rtol=1e-6)
    np.testing.assert_allclose(gravity.memory.normal, gravity.force, rtol=1e-6)


@pytest.mark.parametrize(("side", "stands"), [(0.499, True), (0.501, False)])
@pytest.mark.parametrize("ratio", [0.2, 1.0])
def test_a_block_slides_down_where_its_weight_is_beyond_friction(side: float, stands: bool, ratio: float) -> None:
    line = line_of(BLOCK, "parameters.h=0.5", INCLINE % (side * 9.81))
    gravity = rest_of(line, ratio)
    assert gravity.settled
    assert gravity.carried is stands


@pytest.mark.parametrize("name", ["cocchetti_rizzi_mu_700", "cocchetti_rizzi_mu_380", "cocchetti_rizzi_mu_310"])
def test_arches_at_their_least_thickness(name: str) -> None:
    assert rest_of(line_of_file(BENCHMARKS[f"{name}_stands"])).carried
    assert not rest_of(line_of_file(BENCHMARKS[f"{name}_falls"])).carried


def test_a_block_that_nothing_pushes_stays_at_its_neighbour() -> None:
    line = line_of_file(BENCHMARKS["open_and_frictionless_joints"])
    gravity = rest_of(line)
    assert gravity.carried
    assert float(gravity.memory.normal.min()) > -20.0 * gravity.force  # in elastic displacements: no gap of note


@pytest.mark.parametrize(("deck", "name"), [("spiral_stair", "one_tread"), ("cross_vault_on_piers", "spreading")])
def test_structures_that_were_blocked_with_small_products(deck: str, name: str) -> None:
    """From products of n₀² the step led nowhere; a support of the vault gives way, and is held here."""
    (path,) = (path for path in PATHS if path.stem == deck)
    program = case_of(path, name).loaded
    gravity = gravity_step(ElasticJoints.of(program, shares_of(program), 0.4))
    assert gravity.carried
    assert gravity.steps < 100


SOIL = """\
mbla: 1
units: {force: kN}
parameters: {size: 0.35}
materials: {stone: {density: 1800}, earth: {density: 2040}}
joints: {dry: {friction: 0.6}}
blocks:
  - arch:
      {group: arch, material: stone, shape: segmental, span: 6.55, rise: 1.428, thickness: 0.22, voussoirs: 41,
       width: 3.8, springers: ground}
contacts: {joint: dry}
fill:
  soil:
    {on: arch, material: earth, level: 1.813, cells: {size: "=size", beyond: 3}, friction_angle: 30, cohesion: 5}
load_cases: {push: {live: [{acceleration: [0, 0, -1], on: arch}]}}
"""


@pytest.mark.parametrize(("size", "ratio"), [(0.35, 1.0), (0.33, 0.4)])
def test_soil_of_cells_comes_to_rest_where_many_of_them_slide(size: float, ratio: float) -> None:
    """Springs that carry nothing leave such equations nearly singular: some are solved by springs that are renewed."""
    gravity = rest_of(line_of(SOIL, f"parameters.size={size}"), ratio)
    assert gravity.settled
    assert gravity.carried
    assert are_light(gravity.step, gravity.state)


def test_springs_that_carry_a_light_block_are_renewed() -> None:
    line = line_of(SOIL, "parameters.size=0.5", "materials.stone.density=1e-4")
    gravity = rest_of(line)
    assert gravity.carried
    assert are_light(gravity.step, gravity.state)
