"""Flow without dilatancy, or with it, by the path of elastic joints: closed forms, clamps and locks, what is said."""

from __future__ import annotations

import math
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.program.program import Program
from mbla.solution.flow.path_of_part import path_of_part
from mbla.solution.flow.path_record import RISES, Stop
from mbla.solution.flow.settings import PathSettings
from mbla.solution.nonassociative.collapse_state import CollapseState
from mbla.solution.nonassociative.elastic import _claim
from mbla.solution.solution import Checks, Solution, Status
from tests.line import BLOCK, HEAD, WALL, line_of, line_of_file, solution_of, verified
from tests.performance.standard_set import DECKS
from tests.reached import BELOW, reaches
from tests.solution.nonassociative.structures import (
    FERRIS_3,
    SETTINGS,
    associative_of,
    by_path,
    groove,
    in_the_groove,
    least_of,
    unbalanced,
    with_share,
)
from tests.solution.planar import planar_program
from tests.solution.standing_structures import bar, box, deck, plane
from tests.solution.standing_structures import groove as wedge

NON_ASSOCIATIVE = "analysis.flow_rule=non_associative"

CLOSE = 1e-5
"""Relative: what is left of the smoothing at the greatest load."""

DEFORMS = 0.03
"""Share of the sliding in the step of the greatest load by which elastic joints still close or open."""


def exact(text: str, *overrides: str, case: int = 0) -> tuple[float, Solution, Checks]:
    """Load factor of a case that must be solved."""
    solution, checks, status = verified(line_of(text, *overrides, case=case))
    assert status is Status.SOLVED, (status, solution.reason, checks.failures)
    assert solution.mechanics is not None
    assert checks.yield_violation < 1e-6
    assert checks.equilibrium_residual < 1e-6
    return solution.mechanics.load_factor, solution, checks


# --- closed forms ---------------------------------------------------------------------------------------------------


def test_a_sliding_block_does_not_lift() -> None:
    factor, solution, _ = exact(BLOCK, NON_ASSOCIATIVE, "parameters.h=0.5")
    assert factor == pytest.approx(0.5, rel=CLOSE)
    assert solution.mechanics is not None
    velocities = solution.mechanics.contact_velocities
    assert velocities[:, 0] == pytest.approx(0, abs=DEFORMS * np.abs(velocities[:, 1:]).max())


@pytest.mark.parametrize("angle", [0, 25, 45, 70])
def test_sliding_strength_is_the_same_in_every_direction(angle: float) -> None:
    direction = f"[{math.cos(math.radians(angle))!r}, {math.sin(math.radians(angle))!r}, 0]"
    live = f"load_cases.push.live=[{{acceleration: {direction}}}]"
    factor, _, _ = exact(BLOCK, NON_ASSOCIATIVE, "parameters.h=0.3", "parameters.mu=0.4", live)
    assert factor == pytest.approx(0.4, rel=CLOSE)


@pytest.mark.parametrize("share", [0.0, 0.02, 0.1, 0.5, 0.9, 1.0])
def test_a_wedge_in_a_groove_lifts_by_its_dilatancy(share: float) -> None:
    mu, slope = 0.84, math.radians(30)
    rise = math.tan(share * math.atan(mu))
    factor, found = by_path(with_share(line_of(groove(mu, slope)).program, share), rise)
    assert found.status is Status.SOLVED
    assert reaches(factor, in_the_groove(mu, slope, rise))


def test_dilatancy_of_a_free_block_lifts_it_and_changes_no_load_factor() -> None:
    program = with_share(line_of(BLOCK, "parameters.h=0.5", "parameters.c=1000").program, 0.4)
    factor, found = by_path(program, program.limits.dilatancy)
    assert factor == pytest.approx(0.5 + 1000 / (0.5 * 2000 * 9.81), rel=CLOSE)
    assert found.state is not None
    v = program.contact_velocities(found.state.velocities)
    sliding = np.hypot(v[:, 1], v[:, 2])
    assert v[:, 0] == pytest.approx(program.limits.dilatancy * sliding, abs=DEFORMS * sliding.max())


@pytest.mark.parametrize("box", ["[2, 2, 0.5]", "[9, 9, 0.1]", "[1, 1, 1]"])
@pytest.mark.parametrize("dilatancy", [1, 10, 26])
def test_one_block_slides_at_its_friction_with_every_dilatancy(box: str, dilatancy: float) -> None:
    text = HEAD + (
        f"joints: {{dry: {{friction: 0.5, dilatancy: {dilatancy}}}}}\n"
        f"blocks:\n  - box: {{group: a, material: stone, min: [0, 0, 0], max: {box}}}\n"
        "supports: [{ground: {z: 0}}]\n"
        "load_cases: {push: {live: [{acceleration: [0.8, 0.6, 0]}]}}\n"
        "analysis: {flow_rule: dilatancy}\n"
    )
    program = line_of(text).program
    factor, found = by_path(program, program.limits.dilatancy)
    assert found.status is Status.SOLVED
    assert factor == pytest.approx(0.5, rel=CLOSE)


def test_a_block_without_friction_collapses_at_zero() -> None:
    factor, found = by_path(line_of(BLOCK, "parameters.mu=0").program)
    assert (found.status, found.path_end) == (Status.SOLVED, Stop.AT_ONCE.value)
    assert factor == pytest.approx(0.0, abs=1e-9)


def test_a_block_in_neutral_equilibrium_moves_under_no_live_load() -> None:
    """Though a state of rigid joints carries a load, at which another mechanism begins."""
    line = line_of_file(Path("decks/regressions/neutral_overhang.yaml"))
    solution = solution_of(line)
    assert solution.status is Status.SOLVED
    assert solution.mechanics is not None
    assert 0.0 <= solution.mechanics.load_factor < 1e-5


def test_a_small_structure_falls_where_it_turns_over_the_edge_of_a_kerb() -> None:
    """A state of the law lies 3 % higher."""
    factor, _ = by_path(line_of_file(Path("decks/regressions/block_at_a_kerb.yaml")).program)
    assert factor == pytest.approx(0.9 / 0.47, rel=CLOSE)


# --- invariance -----------------------------------------------------------------------------------------------------


@pytest.mark.every(2)
@pytest.mark.parametrize(
    "overrides",
    [
        ("units.length=mm", "blocks.0.wall.unit=[400, 200, 175]", "blocks.0.wall.length=2400"),
        ("materials.stone.density=2e-3",),
        ("materials.stone.density=2e9",),
    ],
)
def test_the_factor_does_not_know_units(overrides: tuple[str, ...]) -> None:
    here, _, _ = exact(WALL, NON_ASSOCIATIVE, "parameters.n=6")
    there, _, _ = exact(WALL, NON_ASSOCIATIVE, "parameters.n=6", *overrides)
    assert there == pytest.approx(here, rel=1e-6)


SLENDER = (
    HEAD
    + """\
joints: {dry: {friction: 0.65}}
blocks:
  - wall: {material: stone, unit: [0.4, 0.2, 0.175], length: 2.0, courses: 10}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
"""
)

FAR = """\
  - wall:
      material: stone
      unit: [2.0, 2.0, 0.875]
      length: 8.0
      courses: 3
      transform: {translate: [1000, 0, 0]}
supports:"""
"""A wall of units five times as large, out of reach of the slender one, that collapses later."""


@pytest.mark.long
def test_a_part_ends_where_it_does_alone() -> None:
    """Nothing may follow from parts that cannot interact, such as the unit of the load factor."""
    alone, _, _ = exact(SLENDER, NON_ASSOCIATIVE)
    beside, _, _ = exact(SLENDER.replace("supports:", FAR), NON_ASSOCIATIVE)
    assert beside == pytest.approx(alone, rel=1e-4)


# --- clamped, confined, locked --------------------------------------------------------------------------------------


def prism(group: str, *corners: tuple[float, float]) -> str:
    """A block with the given corners in the x-z plane, 0.5 thick."""
    n = len(corners)
    vertices = [[x, y, z] for y in (0.0, 0.5) for x, z in corners]
    faces = [list(range(n)), list(range(n, 2 * n))]
    faces += [[i, (i + 1) % n, (i + 1) % n + n, i + n] for i in range(n)]
    return f"  - polyhedron: {{group: {group}, material: stone, vertices: {vertices}, faces: {faces}}}\n"


PLANK = (
    HEAD
    + "joints: {dry: {friction: 0.4}}\nblocks:\n"
    + prism("base", (0, 0), (1, 0), (1, 1), (0, 0.9))
    + prism("back", (0, 0.9), (0.7, 0.97), (0.7, 1.17), (0, 1.05))
    + prism("plank", (0.7, 0.97), (1.5, 1.05), (1.5, 1.17 + 0.8 * 0.12 / 0.7), (0.7, 1.17))
    + prism("top", (0, 1.05), (1, 1.17 + 0.3 * 0.12 / 0.7), (1, 2.1), (0, 2.1))
    + "supports: [{blocks: base}]\nload_cases: {pull: {live: [{acceleration: [1, 0, 0], on: plank}]}}\n"
)
"""A plank thicker outside than inside, clamped under a wall and pulled out."""


def test_a_clamped_plank_is_held_by_what_it_loses_as_it_slides() -> None:
    """At its peak it goes out and the wall that clamps it hardly moves; then the load falls, to the least state."""
    line = line_of(PLANK)
    factor, found = by_path(line.program)
    assert (found.status, found.path_end) == (Status.SOLVED, Stop.FALLS.value)
    assert found.state is not None
    assert unbalanced(line.program, found.state) < 1e-6
    least = line.program.scaling.load_factor(least_of(line.program).load_factor)
    assert factor > 1.4 * least
    assert least * (1.0 - 1e-3) < found.path_last < factor
    associative = associative_of(line.program).state
    assert associative is not None
    assert factor < line.program.scaling.load_factor(associative.load_factor)
    mechanism = line.program.mechanism(found.state.velocities)
    outwards = int(np.argmax(np.linalg.norm(mechanism[:, :3], axis=1)))
    assert line.model.blocks.groups[outwards] == "plank"
    assert mechanism[outwards, 0] > 0.0


CONFINED = (
    HEAD
    + "joints: {dry: {friction: 0.5}}\n"
    + "blocks:\n"
    + "  - box: {group: block, material: stone, min: [0, 0, 0], max: [2, 1, 1]}\n"
    + "  - box: {group: ceiling, material: stone, min: [0, 0, 1], max: [2, 1, 2]}\n"
    + "supports: [{ground: {z: 0}, blocks: block}, {blocks: ceiling}]\n"
    + "load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}\n"
)
"""A block that fills the room between the ground and a fixed ceiling, which it does not press."""


def test_a_ceiling_that_nothing_presses_carries_nothing() -> None:
    """The law forgets the gap that the weight opens: it allows 0.5625 and 2. The ground gives 0.5."""
    factor, found = by_path(line_of(CONFINED).program)
    assert found.status is Status.SOLVED
    assert factor == pytest.approx(0.5, rel=CLOSE)


@pytest.mark.parametrize(("friction", "below"), [(1.7, BELOW), (2.0, BELOW), (5.0, 1e-2)])
def test_a_wedge_in_a_groove_slides_where_dilatancy_would_lock_it(friction: float, below: float) -> None:
    """With normality it locks from mu = 1/tan b = 1.732 on; without it slides at mu/cos b for every mu.

    The path takes longer to it the greater friction is.
    """
    program, slope = line_of(groove(friction, math.radians(30))).program, math.radians(30)
    assert (associative_of(program).status is Status.UNBOUNDED) is (friction > 1.733)
    factor, found = by_path(program)
    assert found.status is Status.SOLVED
    assert reaches(factor, friction / math.cos(slope), below)


BEAM = bar("friction: 0.5", below=plane(0, 1, 0, 1))


def pushed(text: str, direction: str) -> Program:
    """Program of a deck with another live load."""
    return line_of(text, f"load_cases.push.live=[{{acceleration: {direction}}}]").program


LOCKED = {
    "wedge pushed into its groove": (wedge(0.5), "[0, 0, -1]"),
    "wedge pushed into a smooth groove": (wedge(0), "[0, 0, -1]"),
    "bar pushed against a wall": (BEAM, "[1, 0, 0]"),
    "block pressed on the ground, askew within its friction": (deck(box(0, 1, 0, 1)), "[0.4, 0.2, -1]"),
    "block pressed down, cohesion beside the point": (
        deck(box(0, 1, 0, 1), joint="friction: 0.5, cohesion: 1.e4"),
        "[0, 0, -1]",
    ),
}


@pytest.mark.every(2)
@pytest.mark.parametrize(("text", "direction"), LOCKED.values(), ids=LOCKED)
def test_what_locks_without_dilatancy_too(text: str, direction: str) -> None:
    _, found = by_path(pushed(text, direction))
    assert found.status is Status.UNBOUNDED
    assert "nothing gives way" in found.reason


def test_a_bar_drawn_along_the_walls_that_it_touches_is_held_by_the_ground_alone() -> None:
    """Thrust between the walls would have to be locked in."""
    factor, found = by_path(pushed(BEAM, "[0, 1, 0]"))
    assert found.status is Status.SOLVED
    assert factor == pytest.approx(0.5, rel=CLOSE)


def test_a_block_pressed_askew_beyond_its_friction_slides_at_its_closed_form() -> None:
    """0.6 λ = 0.5 (1 + λ)."""
    factor, _ = by_path(pushed(deck(box(0, 1, 0, 1)), "[0.6, 0, -1]"))
    assert factor == pytest.approx(5.0, rel=CLOSE)


# --- what is said ---------------------------------------------------------------------------------------------------


def test_with_little_dilatancy_a_confined_wall_is_said_to_rise_where_its_path_ends() -> None:
    """Towards 0.4025, at which rigid joints of that dilatancy give way; joints wedge as they slide."""
    program = with_share(planar_program(line_of(FERRIS_3)), 0.1)
    factor, found = by_path(program, program.limits.dilatancy)
    assert 0.356 < factor < 0.4025
    assert found.path_gain > RISES
    assert [remark.identifier for remark in found.remarks] == ["elastic-path-rises"]


def test_beyond_the_time_limit_the_path_does_not_go_on() -> None:
    late = replace(SETTINGS, deadline=time.monotonic())
    factor, found = by_path(planar_program(line_of(FERRIS_3)), settings=late)
    assert found.status is Status.APPROXIMATE
    assert factor < 0.3558
    assert found.reason.endswith("could not be followed further (time limit)")


@pytest.mark.long
def test_where_what_rests_cannot_carry_what_is_passed_on_to_it_the_whole_is_followed() -> None:
    """A parapet is pushed off a bridge whose arch stands by little: a stone of it falls at t/h."""
    line = line_of_file(DECKS / "tutorials" / "bridge_with_parapets.yaml", NON_ASSOCIATIVE)
    solution, _, status = verified(line)
    assert status is Status.SOLVED, (status, solution.reason)
    assert solution.mechanics is not None
    assert solution.mechanics.load_factor == pytest.approx(0.25 / 0.9, rel=CLOSE)


def path_that(stop: Stop, residual: float) -> tuple[Status, str]:
    """What is claimed of a block's path that ended so, with a state of that residual."""
    program = line_of(BLOCK, "parameters.h=0.5").program
    found = path_of_part(program, associative_of(program), PathSettings())
    state = CollapseState(np.zeros((program.n_points, 3)), np.zeros(len(program.dead_load)), 0.5, residual)
    return _claim(replace(found, stop=stop), state, 1.0)


@pytest.mark.parametrize(
    ("stop", "residual", "status", "said"),
    [
        (Stop.FAR, 1e-7, Status.SOLVED, ""),
        (Stop.FALLS, 1e-7, Status.SOLVED, ""),
        (Stop.FLAT, 1e-3, Status.APPROXIMATE, "fits the law of elastic joints to 0.001 only"),
        (Stop.FAR, 1e-1, Status.NOT_VERIFIED, "fits the law of elastic joints to 0.1 only"),
        (Stop.STUCK, 1e-7, Status.APPROXIMATE, "it stands at least to a load factor of 0.5, where the path"),
        (Stop.UNBOUNDED, 1e-7, Status.UNBOUNDED, "nothing gives way"),
        (Stop.DOES_NOT_STAND, 1e-7, Status.NOT_VERIFIED, "does not carry its dead load"),
    ],
)
def test_a_path_is_judged_by_its_end_and_by_the_law(stop: Stop, residual: float, status: Status, said: str) -> None:
    claimed, reason = path_that(stop, residual)
    assert claimed is status
    assert said in reason
    assert bool(reason) is bool(said)
