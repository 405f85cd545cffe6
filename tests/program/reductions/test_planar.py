"""Planar structures whose interfaces come in pieces: forces of a piece and of its image go back alike."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.program.reductions import reduce_program
from mbla.program.reductions.mirror import half_of, mirror_about, mirror_candidates
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.solution import Status
from tests.line import BLOCK, HEAD, WALL, case_of, line_of, verified
from tests.program.reductions.scenes import scene

HALVES = """\
parameters: {cut: 0.2}
joints: {dry: {friction: 0.9}}
blocks:
  - box: {group: foot, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - polyhedron:
      group: top
      material: stone
      vertices: [[0, 0, 1], [1, 0, 1], [1, "=0.5-cut", 1], [0, "=0.5+cut", 1],
                 [0, 0, 2], [1, 0, 2], [1, "=0.5-cut", 2], [0, "=0.5+cut", 2]]
      faces: [[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
  - polyhedron:
      group: top
      material: stone
      vertices: [[0, 1, 1], [1, 1, 1], [1, "=0.5-cut", 1], [0, "=0.5+cut", 1],
                 [0, 1, 2], [1, 1, 2], [1, "=0.5-cut", 2], [0, "=0.5+cut", 2]]
      faces: [[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
analysis: {flow_rule: associative}
"""
"""A cube on a cube, the upper one in two glued halves that an upright cut askew to the push divides."""


def test_halves_cut_askew_balance_out_of_the_plane() -> None:
    deck = (HEAD + HALVES).replace("joint: dry}", "joint: dry, overrides: [{between: [top, top], joint: glued}]}")
    _, result = case_of(deck)
    assert result.solution.size is not None
    assert result.solution.size.dimension == 2
    assert result.status is Status.SOLVED, result.checks.failures
    assert result.checks.equilibrium_residual < 1e-9
    assert result.solution.mechanics is not None
    assert result.solution.mechanics.load_factor == pytest.approx(0.5, rel=1e-6)  # about the edge of the ground


BETWEEN = """\
joints: {dry: {friction: 0.9}}
blocks:
  - box: {group: foot, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: half, material: stone, min: [0, 0, 1], max: [1, 0.5, 2]}
  - box: {group: cap, material: stone, min: [0, 0, 2], max: [0.8, 1, 3]}
  - box: {group: half, material: stone, min: [0, 0.5, 1], max: [1, 1, 2]}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""
"""Two cubes and a shorter block on them, the middle one in two glued halves between which that block is numbered."""


@pytest.mark.parametrize("flow_rule", ["associative", "non_associative"])
def test_an_interface_and_its_image_may_name_their_blocks_in_opposite_orders(flow_rule: str) -> None:
    """The points of one half, behind one another from its end, were taken for a place of their own: equilibrium
    missed half of a moment out of the plane."""
    glued = "joint: dry, overrides: [{between: [half, half], joint: glued}]}"
    deck = (HEAD + BETWEEN).replace("joint: dry}", glued) + f"analysis: {{flow_rule: {flow_rule}}}\n"
    _, result = case_of(deck)
    assert result.solution.size is not None
    assert result.solution.size.dimension == 2
    assert result.status is Status.SOLVED, result.checks.failures
    assert result.checks.equilibrium_residual < 1e-9
    assert result.solution.mechanics is not None
    assert result.solution.mechanics.load_factor == pytest.approx(1.48 / 4.0, rel=1e-6)  # about the edge of the ground


FIXED_COURSE = (
    HEAD
    + """\
parameters: {mu: 0.6, c: 0, ft: 0, joint: 0.4}
joints: {dry: {friction: "=mu", cohesion: "=c", tensile_strength: "=ft"}}
blocks:
  - box: {group: base, material: stone, min: [0, 0, -0.2], max: ["=joint", 0.2, 0]}
  - box: {group: base, material: stone, min: ["=joint", 0, -0.2], max: [0.8, 0.2, 0]}
  - box: {group: brick, material: stone, min: [0.2, 0, 0], max: [0.6, 0.2, 0.2]}
  - box: {group: top, material: stone, min: [0.2, 0, 0.2], max: [0.6, 0.2, 0.5]}
supports: [{blocks: base}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
  across: {live: [{acceleration: [0, 1, 0]}]}
  skew: {live: [{acceleration: [0.8, 0.6, 0]}]}
analysis: {flow_rule: non_associative}
"""
)
"""A brick on two fixed ones that meet under it, and another block on it: 12 points, of which 4 coincide in pairs."""

STRENGTHS = {
    "dry": (),
    "cohesion": ("parameters.c=2000",),
    "mortar": ("parameters.c=2000", "parameters.ft=500"),
    "weak": ("parameters.c=2000", "parameters.ft=500", "joints.dry.compressive_strength=9.e4"),
}


@pytest.mark.every(5)
@pytest.mark.parametrize("flow_rule", ["associative", "non_associative"])
@pytest.mark.parametrize("joint", [0.4, 0.3], ids=["under its middle", "beside it"])
@pytest.mark.parametrize("case", [0, 1])
@pytest.mark.parametrize("strength", STRENGTHS.values(), ids=STRENGTHS)
def test_points_in_one_place_of_two_interfaces(
    strength: tuple[str, ...], case: int, joint: float, flow_rule: str
) -> None:
    """Each has the strength of its own share: the plane gives what space gives, forces within every limit."""
    asked = (*strength, f"parameters.joint={joint}", f"analysis.flow_rule={flow_rule}")
    factors, dimensions = [], []
    for switch in ("true", "false"):
        line = line_of(FIXED_COURSE, *asked, f"analysis.reductions={switch}", case=case)
        solution, checks, status = verified(line)
        assert status is Status.SOLVED, checks.failures
        assert solution.size is not None
        assert solution.mechanics is not None
        dimensions.append(solution.size.dimension)
        factors.append(solution.mechanics.load_factor)
    assert factors[0] == pytest.approx(factors[1], rel=1e-6)
    assert dimensions[1] == 3
    assert dimensions[0] == 2 or (case == 1 and joint != 0.4)


# Planes about which a structure and its loads may be symmetric.


TURNED = WALL.replace("courses:", "transform: [{rotate: {axis: [0, 0, 1], angle: 30}}], courses:")
ALONG = np.array([np.cos(np.pi / 6), np.sin(np.pi / 6), 0.0])
ACROSS = np.array([-np.sin(np.pi / 6), np.cos(np.pi / 6), 0.0])


def push(*acceleration: float) -> str:
    return f"load_cases.push.live=[{{acceleration: [{', '.join(map(str, acceleration))}]}}]"


def test_a_plane_holds_both_resultants() -> None:
    for found in ([0.0, 1.0, 0.0], [1.0, 0.0, 0.0]):
        direction = np.cross(found, [0, 0, 1])
        candidates = list(mirror_candidates(scene(BLOCK, push(*direction))))
        assert len(candidates) == 1
        assert np.abs(candidates[0]) == pytest.approx(found, abs=1e-12)


def test_a_plane_that_all_joints_are_seen_edge_on_in_comes_first() -> None:
    """Loads along one line alone lie in many planes."""
    first, *others = mirror_candidates(scene(TURNED, push(0, 0, -1)))
    assert abs(float(first @ ACROSS)) == pytest.approx(1.0, abs=1e-12)
    assert any(abs(float(other @ ALONG)) == pytest.approx(1.0, abs=1e-12) for other in others)


def test_blocks_and_points_go_to_their_images() -> None:
    whole = scene(WALL, push(0, 1, 0))
    mirror = mirror_about(whole, np.array([1.0, 0.0, 0.0]))
    assert mirror is not None
    middle = whole.centroids[:, 0].mean()
    for places, image in ((whole.centroids, mirror.block_of), (whole.points, mirror.point_of)):
        assert places[image, 0] == pytest.approx(2 * middle - places[:, 0], abs=1e-12)
        assert places[image, 1:] == pytest.approx(places[:, 1:], abs=1e-12)
    assert mirror_about(whole, np.array([0.0, 1.0, 0.0])) is None  # the load is not symmetric about that plane


def test_motions_of_a_half_keep_their_size() -> None:
    whole = scene(WALL, push(0, 1, 0))
    mirror = mirror_about(whole, np.array([1.0, 0.0, 0.0]))
    assert mirror is not None
    half, way = half_of(whole, mirror)
    gram = half.lift.velocities.T @ way.velocities
    assert gram.toarray() == pytest.approx(np.eye(gram.shape[0]), abs=1e-12)


@pytest.mark.parametrize(("offset", "planes"), [(1.0, 1), (1.5, 0)])
def test_without_dilatancy_a_half_is_left_out_about_a_given_plane_alone(offset: float, planes: int) -> None:
    line = line_of(WALL, push(0, 1, 0), "analysis.flow_rule=non_associative")
    middle = float(line.model.blocks.centroids[:, 0].mean())
    model = replace(line.model, mirrors=((1.0, 0.0, 0.0, offset * middle),))
    reduced = reduce_program(model, line.contacts, line.program, ReductionSwitches(), associative=False)
    assert reduced.size.mirror_planes == planes


SOIL = """\
joints: {dry: {friction: 0.9}}
blocks:
  - box: {group: foot, material: stone, min: [0, 0, 0], max: [2, 1, 0.5]}
  - soil:
      {group: earth, material: stone, outline: [[0, 0.5], [2, 0.5], [2, 1], [0, 1]], width: WIDTH, cells: {size: 1},
       friction_angle: 30, transform: [{translate: [0, START, 0]}]}
WALLS
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
analysis: {flow_rule: associative}
"""
WALLS = """\
  - box: {group: wall, material: stone, min: [0, 0, 0.5], max: [2, 0.2, 1]}
  - box: {group: wall, material: stone, min: [0, 0.8, 0.5], max: [2, 1, 1]}
"""


@pytest.mark.parametrize(
    ("width", "start", "walls", "expected"), [(1.0, 0.0, "", (2, 0)), (0.6, 0.2, WALLS.rstrip(), (3, 1))]
)
def test_soil_between_walls_is_in_space(width: float, start: float, walls: str, expected: tuple[int, int]) -> None:
    """Walls along the faces are images of each other; soil through the width is planar."""
    text = SOIL.replace("WIDTH", str(width)).replace("START", str(start)).replace("WALLS\n", f"{walls}\n".lstrip("\n"))
    line = line_of(HEAD + text)
    size = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=True).size
    assert (size.dimension, size.mirror_planes) == expected
