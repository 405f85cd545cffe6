"""How structures fail, and the class of each mechanism."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mbla
from mbla.assembly.assembly import Assembly
from mbla.assembly.rigid_bodies import rigid_bodies
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.clusters import ENOUGH, FEW, clusters_of
from mbla.results.collapse.collapse import NOTABLE, Failure, collapse_of, failure_of, mechanism_class
from mbla.results.collapse.joint_planes import HingeLine, SlidingPlane
from mbla.results.collapse.rigid_parts import rigid_parts
from mbla.results.record.json_record import results_json
from mbla.solution.solution import ContactMode, Mechanics
from mbla.solution.verification.statics import contact_velocities
from tests.line import HEAD, case_of, line_of, verified
from tests.results.synthetic import cuboids, horizontal_contacts, tower_model

WALL = (
    HEAD
    + """\
parameters: {scale: 1, dx: 0}
joints: {dry: {friction: 0.65}}
blocks:
  - wall:
      {group: wall, material: stone, unit: ["=0.4*scale", "=0.2*scale", "=0.2*scale"], length: "=2*scale", courses: 4,
       transform: {translate: ["=dx", 0, 0]}}
supports: [{ground: {z: 0}}]
load_cases:
  across: {live: [{acceleration: [0, 1, 0]}]}
  along: {live: [{acceleration: [1, 0, 0]}]}
analysis: {flow_rule: associative}
"""
)
SLIDE = (
    HEAD
    + """\
joints: {dry: {friction: 0.2}}
blocks:
  - box: {group: table, material: stone, min: [0, 0, 0], max: [3, 1, 1]}
  - box: {group: slab, material: stone, min: [0, 0, 1], max: [3, 1, 1.2]}
supports: [{blocks: table}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
"""
)


def told(text: str, *overrides: str, case: int = 0) -> tuple[Model, Contacts, Failure]:
    line = line_of(text, *overrides, case=case)
    solution, _, _ = verified(line)
    assert solution.mechanics is not None
    collapse = collapse_of(line.assembly, line.load_case, solution.mechanics)
    failure = failure_of(line.model, line.contacts, collapse, solution.mechanics)
    return line.model, line.contacts, failure


def stack(n: int) -> tuple[Model, Contacts]:
    """Unit cubes one on the other, the lowest fixed."""
    lower = np.array([[0, 0, i] for i in range(n)], float)
    blocks = cuboids(lower, lower + 1, ["stack"] * n)
    model = replace(tower_model(), blocks=blocks, fixed=np.arange(n) == 0, grounds=())
    return model, horizontal_contacts([[i, i + 1] for i in range(n - 1)], [(0, 1, 0, 1, i + 1) for i in range(n - 1)])


def clusters(n: int, speeds: Any) -> tuple[Any, float]:
    model, contacts = stack(n)
    motion = np.zeros((n, 6))
    motion[:, 0] = speeds
    found = clusters_of(model, rigid_parts(model, rigid_bodies(model, contacts), motion), motion)
    return found.of_block.tolist(), found.explained


@pytest.mark.parametrize("overrides", [(), ("parameters.scale=1000", "parameters.dx=1e6"), ("parameters.scale=1e-3",)])
def test_a_wall_that_tilts_over_has_one_hinge_line_along_its_foot(overrides: Any) -> None:
    """Five stones stand on the ground: one line of five interfaces as long as the wall, in any unit and place."""
    model, _, failure = told(WALL, *overrides)
    (line,) = failure.hinge_lines
    size = float(np.ptp(model.blocks.vertices[:, 0]))
    start = float(model.blocks.vertices[:, 0].min())
    assert line.clusters == (1, 0)
    assert len(line.interfaces) == 5
    assert line.length == pytest.approx(size)
    assert line.direction == pytest.approx([-1, 0, 0], abs=1e-6)
    assert line.start == pytest.approx([start + size, size / 10, 0], abs=1e-6 * size)
    assert line.end == pytest.approx([start, size / 10, 0], abs=1e-6 * size)
    assert failure.cracks == () == failure.sliding_planes


def test_a_stepped_crack_runs_through_a_wall_pushed_in_its_plane() -> None:
    """What turns over the corner parts from the rest along head and bed joints that touch one another."""
    _, contacts, failure = told(WALL, case=1)
    assert len(failure.motions) >= 1
    assert failure.motions[0].turns
    joined = {int(i) for crack in failure.cracks for i in crack.interfaces}
    first = failure.cracks[0]
    sides = failure.clusters[contacts.bodies[first.interfaces]]
    assert {tuple(sorted(pair)) for pair in sides.tolist()} == {tuple(sorted(first.clusters))}
    assert first.area == pytest.approx(contacts.areas[first.interfaces].sum())
    assert len(joined) == sum(len(crack.interfaces) for crack in failure.cracks)
    assert tuple(first.start[[2, 0]]) < tuple(first.end[[2, 0]])


def test_a_slab_slides_in_one_plane_and_friction_takes_all_the_power() -> None:
    line = line_of(SLIDE)
    _, result = case_of(SLIDE)
    mechanics = result.solution.mechanics
    assert mechanics is not None
    collapse = collapse_of(line.assembly, line.load_case, mechanics)
    failure = failure_of(line.model, line.contacts, collapse, mechanics)
    (plane,) = failure.sliding_planes
    assert plane.clusters == (1, 0)
    assert plane.area == pytest.approx(3.0)
    assert plane.direction == pytest.approx([1, 0, 0], abs=1e-6)
    assert plane.normal == pytest.approx([0, 0, 1])
    assert plane.centroid == pytest.approx([1.5, 0.5, 1])
    assert plane.power_share == pytest.approx(1.0, abs=1e-5) == plane.shear_power_share
    assert not plane.twists
    assert failure.hinge_lines == () == failure.cracks


def test_few_parts_are_told_as_they_are() -> None:
    assert clusters(4, [0, 1, 2, 3]) == ([0, 1, 2, 3], 1.0)
    assert clusters(5, [0, 0, 1, 1.01, 1.02]) == ([0, 0, 1, 2, 3], 1.0)


@pytest.mark.parametrize("size", [1e-9, 1.0, 1e9])
def test_a_chain_of_small_slips_is_told_as_few_rigid_motions(size: float) -> None:
    """Each of 60 blocks slides over the one below by up to 0.017, together by 0.5 along a parabola.

    Speeds that grow evenly with height are those of a rotation, and are told as one.
    """
    height = np.arange(61.0)
    found, explained = clusters(61, size * np.where(height > 0, 1 + 0.5 * (height / 60) ** 2, 0.0))
    assert 1 <= max(found) <= FEW
    assert ENOUGH <= explained < 1.0
    evenly, _ = clusters(61, size * np.where(height > 0, 1 + 0.01 * height, 0.0))
    assert max(evenly) == 1


@pytest.mark.parametrize(("edge", "lines"), [(1.0, 1), (1.01, 1), (1.2, 2)])
def test_hinges_of_two_clusters_are_one_line_only_where_their_axes_are_one(edge: float, lines: int) -> None:
    """A slab with two feet that tilts over the edges of both; the second foot ends farther out by a share of it."""
    model = replace(
        tower_model(),
        blocks=cuboids([[0, 0, 0], [0, 0, 1]], [[2, 5, 1], [1, 5, 2]], ["base", "slab"]),
        fixed=np.array([True, False]),
        grounds=(),
    )
    contacts = horizontal_contacts([[0, 1], [0, 1]], [(0, 1, 0, 1, 1), (0, edge, 3, 4, 1)])
    motion = np.zeros((2, 6))
    motion[1] = [*np.cross([0, 1, 0], model.blocks.centroids[1] - [1, 0, 1]), 0, 1, 0]
    velocities = contact_velocities(model, contacts, motion)
    outer = contacts.points[:, 0] >= 1.0  # the feet give at their edges as one joint law has it
    modes = np.where(outer, ContactMode.STICK, ContactMode.OPEN)
    collapse = collapse_of(
        Assembly(model, contacts), model.load_cases[0], Mechanics(1.0, np.ones((8, 3)), velocities, motion, modes)
    )
    moved = replace(
        collapse.interfaces,
        hinge_points=np.array([[1, 0.5, 1], [edge, 3.5, 1]]),
        hinge_ends=np.array([[[1, 0, 1], [1, 1, 1]], [[edge, 3, 1], [edge, 4, 1]]]),
    )
    mechanics = Mechanics(1.0, np.ones((8, 3)), velocities, motion, modes)
    failure = failure_of(model, contacts, replace(collapse, interfaces=moved), mechanics)
    assert len(failure.hinge_lines) == lines
    assert failure.hinge_lines[0].length == pytest.approx(4.0 if lines == 1 else 1.0, rel=1e-3)
    assert failure.hinge_lines[0].direction == pytest.approx([0, 1, 0])  # of the slab against the base


# --- Mechanisms whose class is known, solved or put together by hand ------------------------------------------------


BLOCK = """
mbla: 1
materials: {{stone: {{density: 2000}}}}
joints: {{dry: {{friction: 0.5}}}}
blocks:
  - box: {{group: block, material: stone, min: [0, 0, 0], max: [1, 1, {height}]}}
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}, joint: dry}}]
load_cases: {{case: {{live: [{live}]}}}}
analysis: {{flow_rule: associative}}
"""


def classes_of(deck: str | Path) -> list[str]:
    return [case["mechanism"]["class"] for case in results_json(mbla.run(deck).records)["cases"]]


@pytest.mark.parametrize(
    ("height", "live", "expected"),
    [
        (0.4, "{acceleration: [1, 0, 0]}", "sliding"),  # b/h = 2.5 above the friction of 0.5
        (4, "{acceleration: [1, 0, 0]}", "overturning"),  # b/h = 0.25 below it
        (1, "{moment: [0, 0, 1000], on: block}", "twisting"),
        (1, "{force: [0, 0, 1000], on: block, at: [0.5, 0.5, 1]}", "opening"),
    ],
)
def test_a_block(height: float, live: str, expected: str) -> None:
    assert classes_of(BLOCK.format(height=height, live=live)) == [expected]


# --- put together by hand -----------------------------------------------------------------------------------------


def line(clusters: tuple[int, int] = (1, 0), **changes: Any) -> HingeLine:
    at, along = np.zeros(3), np.array([0.0, 1.0, 0.0])
    one = HingeLine(
        clusters, np.array([0]), at, along, along, 1.0, 1.0, slides=False, crushes=False, shear_power_share=0.0
    )
    return replace(one, **changes)


def plane(**changes: Any) -> SlidingPlane:
    at, normal = np.zeros(3), np.array([0.0, 0.0, 1.0])
    one = SlidingPlane((1, 0), np.array([0]), 1.0, at, normal, np.array([1.0, 0, 0]), False, 1.0, 1.0, 1.0)
    return replace(one, **changes)


def moving(*joints: HingeLine | SlidingPlane) -> Failure:
    lines = tuple(joint for joint in joints if isinstance(joint, HingeLine))
    planes = tuple(joint for joint in joints if isinstance(joint, SlidingPlane))
    return Failure(np.array([1]), (), 1.0, lines, planes, (), ())


@pytest.mark.parametrize(
    ("joints", "expected"),
    [
        ((line((1, 0)), line((2, 0))), "overturning"),  # two towers, each by itself
        ((line((1, 0)), line((2, 1))), "hinging"),
        ((line((1, 0)), line((2, 1), share=NOTABLE / 2)), "overturning"),
        ((line(), plane()), "sliding and hinging"),
        ((line(), plane(share=NOTABLE / 2)), "overturning"),
        ((line(), plane(twists=True)), "sliding and hinging"),
        ((plane(), plane(twists=True)), "sliding"),
        ((plane(twists=True), plane(twists=True)), "twisting"),
        ((line(slides=True, shear_power_share=2 * NOTABLE),), "sliding and hinging"),
        ((line(slides=True, shear_power_share=NOTABLE / 2),), "overturning"),
        ((line(slides=True, shear_power_share=float("nan")),), "overturning"),
        ((), "opening"),
    ],
)
def test_only_joints_that_move_notably_count(joints: tuple[HingeLine | SlidingPlane, ...], expected: str) -> None:
    assert mechanism_class(moving(*joints)) == expected
