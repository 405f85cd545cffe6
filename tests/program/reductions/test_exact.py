"""Reductions in any place and unit, verified in the whole model; what is only nearly symmetric is left as it is."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mbla.program.reductions import Reduced, StepState, reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from tests.line import HEAD, Line, line_of, verified

THREE = (
    HEAD
    + """\
parameters: {w: 0.0, d: 0.0}
joints: {dry: {friction: 0.55}}
blocks:
  - box: {group: left, material: stone, min: [0, 0, 0], max: [1, 1, 2], TRANSFORM}
  - box: {group: right, material: stone, min: [3, 0, 0], max: ["=4+w", 1, 2], TRANSFORM}
  - box: {group: lintel, material: stone, min: [0, "=d", 2], max: [4, "=1+d", 3], TRANSFORM}
supports: [{ground: {point: POINT, normal: NORMAL}}]
load_cases:
  push: {dead: [{gravity: DOWN}], live: [{acceleration: ALONG}]}
  out: {dead: [{gravity: DOWN}], live: [{acceleration: ACROSS}]}
"""
)
"""A trilithon, planar under the push along it, with a plane of symmetry across it under the one out of its plane."""

PLACES = {
    "as drawn": (np.zeros(3), np.zeros(3), 1.0),
    "turned": (np.array([0.3, -1.1, 0.7]), np.zeros(3), 1.0),
    "in mm": (np.zeros(3), np.zeros(3), 1000.0),
    "far away": (np.zeros(3), np.array([1e5, -2e5, 3e4]), 1.0),
    "turned, in mm, away": (np.array([-0.9, 0.4, 1.7]), np.array([3e5, 1e5, -2e5]), 1000.0),
}
"""Rotation vector, shift, and how many units of length are a metre."""


def placed(place: str, *overrides: str, case: int = 0) -> Line:
    turn, shift, scale = PLACES[place]
    rotation = Rotation.from_rotvec(turn)
    angle = math.degrees(float(np.linalg.norm(turn)))
    axis = (turn / np.linalg.norm(turn)).tolist() if angle else [0, 0, 1]
    steps = f"[{{scale: {scale}}}, {{rotate: {{axis: {axis}, angle: {angle!r}}}}}, {{translate: {shift.tolist()}}}]"
    words = {
        "TRANSFORM": f"transform: {steps}",
        "POINT": str(shift.tolist()),
        "NORMAL": str(rotation.apply([0, 0, 1]).tolist()),
        "DOWN": str((rotation.apply([0, 0, -9.81]) * scale).tolist()),
        "ALONG": str(rotation.apply([1, 0, 0]).tolist()),
        "ACROSS": str(rotation.apply([0, 1, 0]).tolist()),
    }
    text = THREE if scale == 1.0 else "units: {length: mm, force: N, mass: t}\n" + THREE.replace("2000", "2.e-9")
    for name, value in words.items():
        text = text.replace(name, value)
    return line_of(text, *overrides, case=case)


def reduced(line: Line) -> Reduced:
    associative = line.deck.analysis.flow_rule == "associative"
    return reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=associative)


def applied(line: Line) -> set[str]:
    return {step.name for step in reduced(line).steps if step.state is StepState.APPLIED}


@pytest.mark.parametrize("flow_rule", ["associative", "non_associative"])
@pytest.mark.parametrize("place", PLACES)
def test_planar_in_any_place(place: str, flow_rule: str) -> None:
    line = placed(place, f"analysis.flow_rule={flow_rule}")
    assert applied(line) == {"planar"}
    assert_same_with_and_without(place, flow_rule, "planar", 0)


@pytest.mark.parametrize("place", PLACES)
def test_halves_in_any_place(place: str) -> None:
    assert applied(placed(place, "analysis.flow_rule=associative", case=1)) == {"mirror"}
    assert_same_with_and_without(place, "associative", "mirror", 1)


def assert_same_with_and_without(place: str, flow_rule: str, name: str, case: int) -> None:
    """Load factor and bounds; residuals of forces and velocities were recomputed on the whole model."""
    factors = []
    for switch in ("true", "false"):
        overrides = (f"analysis.flow_rule={flow_rule}", f"analysis.reductions={switch}", "analysis.range=false")
        solution, checks, status = verified(placed(place, *overrides, case=case))
        assert status == "solved", checks.failures
        assert solution.mechanics is not None
        assert checks.equilibrium_residual < 1e-7
        factors.append((solution.mechanics.load_factor, checks.static_bound, checks.kinematic_bound))
    assert factors[0] == pytest.approx(factors[1], rel=1e-6)


@pytest.mark.parametrize(("size", "name"), [(1e-12, {"planar"}), (1e-5, set())])
@pytest.mark.parametrize("place", ["as drawn", "turned", "in mm"])
def test_nearly_planar_is_not_planar(place: str, size: float, name: set[str]) -> None:
    """The lintel beside the middle plane by a share of its size."""
    assert applied(placed(place, f"parameters.d={1.6 * size!r}", "analysis.flow_rule=associative")) == name


@pytest.mark.parametrize(("size", "name"), [(1e-12, {"mirror"}), (1e-5, set())])
@pytest.mark.parametrize("place", ["as drawn", "turned", "in mm"])
def test_nearly_symmetric_is_not_symmetric(place: str, size: float, name: set[str]) -> None:
    """One pier wider than the other by a share of its size, pushed out of the plane of the three."""
    overrides = (f"parameters.w={1.3 * size!r}", "analysis.flow_rule=associative")
    assert applied(placed(place, *overrides, case=1)) == name


@pytest.mark.parametrize(("share", "name"), [(1e-12, {"mirror"}), (1e-5, set())])
def test_a_load_that_is_nearly_symmetric(share: float, name: set[str]) -> None:
    live = f"load_cases.out.live=[{{acceleration: [0, 1, 0]}}, {{acceleration: [0, {share!r}, 0], on: left}}]"
    assert applied(placed("as drawn", live, "analysis.flow_rule=associative", case=1)) == name


@pytest.mark.parametrize(("share", "name"), [(1e-12, {"planar"}), (1e-5, set())])
def test_a_load_that_is_nearly_in_the_plane(share: float, name: set[str]) -> None:
    live = f"load_cases.push.live=[{{acceleration: [1, {share!r}, 0]}}]"
    assert applied(placed("as drawn", live, "analysis.flow_rule=associative")) == name


def test_joint_laws_have_to_be_symmetric_too() -> None:
    laws = "contacts.overrides=[{between: [left, lintel], joint: other}]"
    for friction, name in ((0.55, {"mirror"}), (0.55 * (1 + 1e-5), set())):
        joints = f"joints={{dry: {{friction: 0.55}}, other: {{friction: {friction!r}}}}}"
        assert applied(placed("as drawn", joints, laws, "analysis.flow_rule=associative", case=1)) == name
