"""Reduced programs have the optimum of the whole, and their states are states of the whole."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mbla.program.program import Program
from mbla.program.reductions import Reduced, ReductionOutcome, reduce_program
from mbla.program.reductions.mirror import MirrorPlane
from mbla.program.reductions.steps import ReductionSwitches
from mbla.program.yield_conditions import yield_violation
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.full_model.mechanics import lifted
from mbla.solution.nonassociative.collapse_state import CollapseState
from mbla.solution.settings import SolverSettings
from tests.line import BLOCK, HEAD, WALL, Line, line_of, unreduced, verified

ARCH = (
    HEAD
    + """\
joints: {dry: {friction: 0.6}}
blocks:
  - arch: {group: arch, material: stone, shape: semicircular, span: 4, thickness: 0.5, width: 1, voussoirs: 11}
supports: [{ground: {z: 0}}]
load_cases:
  crown: {live: [{force: [0, 0, -1000], on: {group: arch, index: 5}}]}
  push: {live: [{acceleration: [1, 0, 0]}]}
analysis: {flow_rule: associative}
"""
)

MORTAR = WALL.replace(
    'joints: {dry: {friction: "=mu"}}',
    'joints: {dry: {friction: "=mu", cohesion: 3000, tensile_strength: 1000, compressive_strength: 2.e5}}',
)

TWO_WALLS = WALL.replace(
    "supports:",
    """  - wall:
      group: other
      material: stone
      unit: [0.4, 0.2, 0.175]
      length: "=0.4*n"
      courses: 9
      transform: [{translate: [0, 3, 0]}]
supports:""",
)


def reduced(line: Line, *, associative: bool = True, switches: ReductionSwitches | None = None) -> Reduced:
    switches = ReductionSwitches() if switches is None else switches
    return reduce_program(line.model, line.contacts, line.program, switches, associative=associative)


def optimum(program: Program) -> CollapseState:
    result = solve_associative(program, SolverSettings(1e-9), lambda record: None)
    assert result.state is not None, result.reason
    return result.state


def both(line: Line) -> tuple[CollapseState, CollapseState, Program]:
    """State of the whole program, and that of the only part with its program."""
    (part,) = reduced(line).parts
    return optimum(line.program), optimum(part), part


@pytest.mark.parametrize(
    ("text", "case"),
    [(WALL, 0), (MORTAR, 0), (ARCH, 0), (ARCH, 1), (BLOCK, 0)],
    ids=["wall", "mortar", "crown", "push", "block"],
)
def test_planar_and_spatial_optimum_agree_and_the_way_back_is_exact(text: str, case: int) -> None:
    line = line_of(text, case=case)
    spatial, planar, part = both(line)
    assert reduced(line).size.dimension == 2
    assert part.components == 2
    assert part.equilibrium_matrix.shape[0] == line.program.equilibrium_matrix.shape[0] // 2
    assert planar.load_factor == pytest.approx(spatial.load_factor, rel=1e-6)
    assert part.full is line.program
    assert_state_of(line.program, lifted(part, planar))


def assert_state_of(program: Program, state: CollapseState) -> None:
    """Equilibrium, yield, compatibility and unit live power in the whole program."""
    unbalanced = program.equilibrium_matrix @ state.forces.ravel() + program.dead_load
    unbalanced += state.load_factor * program.live_load
    assert np.abs(unbalanced).max() < 1e-6
    assert yield_violation(state.forces, program.limits).max() < 1e-8
    velocities = (program.equilibrium_matrix.T @ state.velocities).reshape(-1, 3)
    lack = program.limits.friction * np.hypot(velocities[:, 1], velocities[:, 2]) - velocities[:, 0]
    crushable = np.isfinite(program.limits.compression)
    assert (np.where(crushable, 0.0, lack) / np.abs(velocities).max()).max() < 1e-6
    assert program.live_load @ state.velocities == pytest.approx(1.0)


def test_points_inside_the_hull_are_left_out_of_associative_programs_only() -> None:
    """An L-shaped base: the inner corner lies within the hull of the others."""
    outline = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]
    vertices = [[x, y, z] for z in (0, 1) for x, y in outline]
    sides = [[i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6] for i in range(6)]
    faces = [[0, 1, 2, 3, 4, 5], [6, 7, 8, 9, 10, 11], *sides]
    text = BLOCK.replace(
        'box: {group: block, material: stone, min: [0, 0, 0], max: ["=b", 1, "=h"]}',
        f"polyhedron: {{group: block, material: stone, vertices: {vertices}, faces: {faces}}}",
    )
    line = line_of(text, "load_cases.push.live=[{acceleration: [1, 0.2, 0]}]", "parameters.mu=2")
    kept = reduced(line).parts[0]
    assert (line.program.n_points, kept.n_points) == (6, 5)
    assert reduced(line, associative=False).parts[0].n_points == 6
    assert optimum(kept).load_factor == pytest.approx(optimum(line.program).load_factor, rel=1e-6)


def test_everything_can_be_switched_off() -> None:
    line = line_of(TWO_WALLS)
    off = reduced(line, switches=ReductionSwitches(on=False))
    assert off.parts == (line.program,)
    assert off.size == unreduced(line.program, line.contacts).size


# Reductions in any place and unit, verified in the whole model; what is only nearly symmetric is left as it is.


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


def applied(line: Line) -> set[str]:
    return {
        step.name
        for step in reduced(line, associative=line.deck.analysis.flow_rule == "associative").steps
        if step.state is ReductionOutcome.APPLIED
    }


@pytest.mark.every(3)
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
        overrides = (f"analysis.flow_rule={flow_rule}", f"analysis.reductions={switch}")
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


def test_an_image_of_an_interface_is_one_or_pieces_of_several() -> None:
    """Two pairs of interfaces on either side of a plane, the second as pieces that are not images of one another."""
    of_point = np.array([0, 0, 1, 1, 2, 2, 3, 3])
    none, maps = np.zeros(3), np.zeros((8, 3, 3))
    swapped = MirrorPlane(none, np.zeros(1, dtype=np.int64), np.array([2, 3, 0, 1, 6, 7, 4, 5]), np.eye(6), maps)
    assert swapped.keeps_interfaces(of_point)
    across = replace(swapped, point_of=np.array([2, 3, 0, 1, 6, 5, 4, 7]))
    assert not across.keeps_interfaces(of_point)
