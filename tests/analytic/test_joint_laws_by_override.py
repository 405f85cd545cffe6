"""Every number of a joint law holds where an override puts it, and only there; closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.decks.folder import BENCHMARKS
from tests.line import HEAD, factor_of

SLABS = (
    HEAD
    + """\
parameters: {c: 0, ft: 0, mu: 0.5}
joints: {dry: {friction: 1.2}, other: {friction: "=mu", cohesion: "=c", tensile_strength: "=ft"}}
blocks:
  - box: {group: low, material: stone, min: [0, 0, 0], max: [1, 1, 0.25]}
  - box: {group: high, material: stone, min: [0, 0, 0.25], max: [1, 1, 0.5]}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{force: [4905, 0, 0], on: high, at: [0, 0.5, 0.25]}]}
  lift: {live: [{force: [0, 0, 4905], on: high, at: [0.5, 0.5, 0.5]}]}
analysis: {flow_rule: associative}
"""
)
"""Two slabs of the weight 4905 N, 4905 Pa on the lower of them; the joint between them is another one."""
BETWEEN = "contacts={joint: dry, overrides: [{between: [low, high], joint: other}]}"
MODELS = ("concave", "convex")
STRESS = 4905.0


@pytest.mark.parametrize("model", MODELS)
def test_friction_and_cohesion(model: str) -> None:
    ways = (BETWEEN, f"analysis.contact_model={model}")
    assert factor_of(SLABS, *ways) == pytest.approx(0.5, rel=1e-5)
    assert factor_of(SLABS, *ways, f"parameters.c={0.3 * STRESS}") == pytest.approx(0.8, rel=1e-5)
    # with the override on the ground alone the upper slab slides on the joint of the section
    on_ground = BETWEEN.replace("[low, high]", "[low, ground]")
    assert factor_of(SLABS, on_ground, ways[1], "parameters.mu=0.9") == pytest.approx(1.2, rel=1e-5)


@pytest.mark.parametrize("model", MODELS)
def test_tensile_strength(model: str) -> None:
    strength = (f"parameters.c={STRESS}", f"parameters.ft={0.7 * STRESS}")
    found = factor_of(SLABS, BETWEEN, f"analysis.contact_model={model}", *strength, case=1)
    assert found == pytest.approx(1.7, rel=1e-5)
    # on the ground it holds the lower slab, which need not lift
    on_ground = BETWEEN.replace("[low, high]", "[low, ground]")
    found = factor_of(SLABS, on_ground, f"analysis.contact_model={model}", *strength, case=1)
    assert found == pytest.approx(1.0, rel=1e-5)


@pytest.mark.parametrize(("at_bed", "at_head"), [(0.0, 0.0), (10.0, 0.0), (0.0, 10.0), (12.0, 8.0), (30.0, 16.0)])
def test_dilatancy_of_bed_and_head_joints(at_bed: float, at_head: float) -> None:
    """The block moves by (v_x, 1, v_z), off either face by the tangent of its dilatancy angle times its slip.

    Friction opposes the slip on each face, so that N_b = W + T_h v_z/s_z, N_h = P + T_b v_x/s_x and the pull is
    T_b/s_x + T_h/s_z, with the slips s_x = |(v_x, 1)| on the bed and s_z = |(1, v_z)| on the head.
    """
    text = BENCHMARKS["bed_and_head_joints"].read_text(encoding="utf-8")
    mu_b, mu_h, press = 0.6, 0.3, 0.8
    tan_b, tan_h = math.tan(math.radians(at_bed)), math.tan(math.radians(at_head))
    rise = tan_b * math.sqrt((1 + tan_h**2) / (1 - (tan_b * tan_h) ** 2))
    away = tan_h * math.sqrt((1 + tan_b**2) / (1 - (tan_b * tan_h) ** 2))
    bed, head = math.hypot(away, 1), math.hypot(1, rise)
    on_bed, on_head = np.linalg.solve([[1.0, -mu_h * rise / head], [-mu_b * away / bed, 1.0]], [1.0, press])
    expected = mu_b * on_bed / bed + mu_h * on_head / head
    ways = (f"joints.bed.dilatancy={at_bed}", f"joints.head.dilatancy={at_head}", "analysis.flow_rule=dilatancy")
    found = factor_of(text, *ways)  # of a path that still rises a little
    assert (1.0 - 1e-3) * expected < found < (1.0 + 1e-5) * expected


def test_a_frictionless_joint_resists_nothing() -> None:
    """The upper slab is pressed against a stop by a tenth of its weight: pulled away, it is free beyond that."""
    push = "dead: [{gravity: [0, 0, -9.81]}, {force: [490.5, 0, 0], on: high, at: [0, 0.5, 0.25]}], live"
    text = SLABS.replace("push: {live", "push: {" + push).replace("force: [4905, 0, 0]", "force: [-4905, 0, 0]")
    stop = "  - box: {group: stop, material: stone, min: [1, 0, 0], max: [1.5, 1, 2]}"
    text = text.replace("supports: [{ground: {z: 0}}]", f"{stop}\nsupports: [{{ground: {{z: 0}}}}, {{blocks: stop}}]")
    smooth = "contacts={joint: frictionless, overrides: [{between: [low, [ground, stop]], joint: dry}]}"
    assert factor_of(text, smooth) == pytest.approx(0.1, rel=1e-5)
