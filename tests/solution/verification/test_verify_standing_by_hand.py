"""Forces and displacements of one block under its dead load: right, and wrong in one thing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.assemble import yield_limits
from mbla.program.program import Program
from mbla.program.reductions import reduce_program
from mbla.program.reductions.steps import ReductionSwitches
from mbla.solution.solution import Standing
from mbla.solution.standing.standing import assess_dead_load
from mbla.solution.verification.standing import standing_failures
from mbla.solution.verification.statics import contact_resultants
from tests.line import BLOCK, Line, line_of
from tests.solution.by_hand import cube, loaded, on_ground
from tests.solution.standing_structures import STRUCTURES, Structure, bar

# A block 1 x 1 x 0.5 on the ground, friction 1/2, weight 32 and a force of 8 along x at its base: it sinks by 8 and
# slips by 4, and each corner bears as much.

SETTLED = (4.0, 0.0, -8.0, 0.0, 0.0, 0.0)
ASTRAY = ("forces under the dead load alone do not come from the displacements of the blocks",)
BEYOND = ("forces under the dead load alone exceed the yield conditions",)


def block(joint: str = "friction: 0.5") -> Line:
    line = cube(joint)
    return replace(line, load_case=loaded(line.load_case, (8, 0, -32, 0, -2, 0), (0, 1e6, 0, 0, 0, 0)))


@pytest.fixture(scope="module")
def dry() -> Line:
    return block()


def shown(line: Line, forces: FloatArray, settled: FloatArray) -> tuple[str, ...]:
    limits = yield_limits(line.model, line.contacts)
    return standing_failures(line.model, line.contacts, line.load_case, forces, settled, limits)


def failures(
    line: Line, forces: FloatArray | tuple[float, float, float] = (8, -2, 0), settled: tuple[float, ...] = SETTLED
) -> tuple[str, ...]:
    if isinstance(forces, tuple):
        forces = on_ground(line.model, line.contacts, forces)
    return shown(line, forces, np.array([settled], dtype=float))


def test_the_exact_state(dry: Line) -> None:
    assert failures(dry) == ()


SIZE = float(np.sqrt(8.0**2 + 32.0**2 + (2.0 / 0.75) ** 2))
"""of the load, its moment over the lever arm of 3/4"""


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_three_millionths_of_the_load_may_be_left(side: float, dry: Line) -> None:
    settled = (4.0, 0.0, -9.0, 0.0, 0.0, 0.0)
    for share, told in ((2.99e-6, None), (3.01e-6, "3e-06"), (0.02, "0.02")):
        expected = (
            () if told is None else (f"under the dead load alone {told} of the load of block[0] is not balanced",)
        )
        assert failures(dry, (8 + side * share * SIZE / 4, -2, 0), settled) == expected


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_moments_count_over_the_lever_arm(side: float, dry: Line) -> None:
    """Half of the corners bear more by as much as the others bear less, at an arm of 1/2 over one of 3/4."""
    left = np.where(dry.contacts.points[:, 0] < 0.5, 1.0, -1.0)
    for share, balanced in ((2.99e-6, True), (3.01e-6, False)):
        forces = on_ground(dry.model, dry.contacts, (8, -2, 0))
        forces[:, 0] += side * left * share * SIZE * 0.75 / 2
        assert (failures(dry, forces, (4.0, 0.0, -9.0, 0.0, 0.0, 0.0)) == ()) == balanced


def test_forces_beyond_yield(dry: Line) -> None:
    for shear, expected in ((4.0, ()), (4.0 + 2.99e-6 * 36, ()), (4.2, BEYOND)):
        size = 32.0
        case = loaded(dry.load_case, (4 * shear, 0, -size, 0, -shear, 0), (0, 1, 0, 0, 0, 0))
        assert failures(replace(dry, load_case=case), (8, -shear, 0), (5.0, 0, -8.0, 0, 0, 0)) == expected
    mortar = block("friction: 0.5, cohesion: 16")
    case = loaded(mortar.load_case, (16.8, 0, -32, 0, -4.2, 0), (0, 1, 0, 0, 0, 0))
    assert failures(replace(mortar, load_case=case), (8, -4.2, 0), (5.0, 0, -8.0, 0, 0, 0)) == ()


@pytest.mark.parametrize(
    ("settled", "comes"),
    [
        ((4.0, 0, -8.0, 0, 0, 0), True),
        ((2.0, 0, -8.0, 0, 0, 0), True),  # as much as the shear
        ((2.0 - 1e-5 * 0.9, 0, -8.0, 0, 0, 0), False),
        (
            (2.0 - 8.008e-6 * 0.9, 0, -8.0, 0, 0, 0),
            True,
        ),  # 1e-6 of the force and 1e-9 of the displacement, 8
        ((2.0 - 8.008e-6 * 1.1, 0, -8.0, 0, 0, 0), False),
        ((4.0, 0, -8.0 + 8.008e-6 * 0.9, 0, 0, 0), True),
        ((4.0, 0, -8.0 + 8.008e-6 * 1.1, 0, 0, 0), False),
        ((4.0, 0, -16.0, 0, 0, 0), True),
        ((4.0, 0, 8.0, 0, 0, 0), False),  # opens under pressure
        ((-4.0, 0, -8.0, 0, 0, 0), False),  # the shear helps
        ((4.0, 1e-4, -8.0, 0, 0, 0), False),  # and is not against the slip
        ((0.0, 4.0, -8.0, 0, 0, 0), False),
        ((16.0, 0, -8.0, 0, 0, 0), True),
        ((0.0, 0, -8.0, 0, 0, 0), False),
    ],
)
def test_forces_come_from_displacements(settled: tuple[float, ...], comes: bool, dry: Line) -> None:
    assert failures(dry, settled=settled) == (() if comes else ASTRAY)


@pytest.mark.parametrize(("up", "comes"), [(0.9, True), (1.1, False), (1e9, False)])
@pytest.mark.parametrize("pull", [True, False])
def test_joints_pull_only_where_they_open(up: float, comes: bool, pull: bool) -> None:
    """A block hung by 8 at each corner on its mortar; it comes down by 8 at least."""
    hung = block("friction: 0.5, cohesion: 64, tensile_strength: 64")
    hung = replace(hung, load_case=loaded(hung.load_case, (0, 0, 32, 0, 0, 0), (0, 1, 0, 0, 0, 0)))
    rises = 8.0 - up * 8.008e-6 if pull else -8.0
    expected = () if comes and pull else ASTRAY
    assert failures(hung, (-8, 0, 0), (0, 0, rises if up < 10 else 0.0, 0, 0, 0)) == expected


def test_small_forces_are_measured_by_themselves(dry: Line) -> None:
    """Loads and displacements of a 1024th: what is off is over the largest of them, whatever their size."""
    small = replace(
        dry, load_case=loaded(dry.load_case, (8 / 1024, 0, -32 / 1024, 0, -2 / 1024, 0), (0, 1, 0, 0, 0, 0))
    )
    for factor, comes in ((1.0, True), (1.0 - 8.008e-6, False)):
        settled = (2.0 * factor / 1024, 0, -8.0 / 1024, 0, 0, 0)
        assert failures(small, (8 / 1024, -2 / 1024, 0), settled) == (() if comes else ASTRAY)


@pytest.mark.parametrize("sinking", [1e6, 1e7, 1e20])
def test_displacements_hide_what_is_astray_up_to_a_million_times_the_forces(sinking: float, dry: Line) -> None:
    """1e-6 of the largest force, 8, and 1e-9 of the displacement up to 1e6 times that."""
    allowed = 8e-6 + 1e-9 * min(sinking, 8e6)
    for off, comes in ((0.9 * allowed, True), (1.1 * allowed, False), (4.0, False)):
        assert failures(dry, settled=(2.0 - off, 0, -sinking, 0, 0, 0)) == (() if comes else ASTRAY)


def test_without_a_dead_load_nothing_needs_to_be_shown(dry: Line) -> None:
    unloaded = replace(dry, load_case=loaded(dry.load_case, (0, 0, 0, 0, 0, 0), (8, 0, 0, 0, 0, 0)))
    assert failures(unloaded, (np.nan, 0, 0)) == ()


@pytest.mark.parametrize("number", [np.nan, np.inf])
def test_numbers_that_are_none(number: float, dry: Line) -> None:
    expected = ("the forces or displacements under the dead load are not finite",)
    assert failures(dry, (number, 0, 0)) == expected
    assert failures(dry, settled=(number, 0, 0, 0, 0, 0)) == expected
    one = on_ground(dry.model, dry.contacts, (8, -2, 0))
    one[0, 0] = number
    assert failures(dry, one) == expected


def test_of_large_forces_more_may_be_rounding() -> None:
    """Between two walls that press with 2^40 at each of eight corners: 1e-12 of that, and 3e-6 of the load.

    A wall cannot be pressed into from both sides, so that the forces come from no displacement.
    """
    line = cube(supports="{ground: {x: 0}}, {ground: {point: [1, 0, 0], normal: [-1, 0, 0]}}")
    line = replace(line, load_case=loaded(line.load_case, (0, 0, -32, 0, 0, 0), (0, 1, 0, 0, 0, 0)))
    sign = np.where(line.contacts.bodies[line.contacts.interface_of_point][:, 1] == 0, 1.0, -1.0)
    allowed = 3e-6 * 32 + 1e-12 * 8 * 2.0**40
    for share, expected in ((0.99, ASTRAY), (1.01, ("is not balanced", *ASTRAY))):
        hung = sign[:, None] * np.array([0.0, 0.0, (32.0 - share * allowed) / 8])
        forces = np.einsum("pjx,px->pj", line.contacts.frames, hung)
        forces[:, 0] = 2.0**40
        found = failures(line, forces, (0, 0, -1e6, 0, 0, 0))
        assert len(found) == len(expected)
        assert all(failure.endswith(words) for failure, words in zip(found, expected, strict=True))


def test_guided_blocks_keep_to_their_guides(dry: Line, monkeypatch: pytest.MonkeyPatch) -> None:
    for off, told in ((1e-9, ()), (1.01e-9, ("guided blocks are displaced against their guides",))):
        monkeypatch.setattr("mbla.solution.verification.standing.off_guides", lambda *_, off=off: off)
        assert failures(dry) == told


@pytest.mark.parametrize(("settled", "comes"), [((4.0, 0, -8.0, 0, 0, 0), True), ((4.0, 0, 8.0, 0, 0, 0), False)])
def test_forces_may_be_far_less_than_what_displacements_ask_for(
    settled: tuple[float, ...], comes: bool, dry: Line
) -> None:
    """A corner bears 1/2 and is sheared by 1/8."""
    light = replace(dry, load_case=loaded(dry.load_case, (0.5, 0, -2, 0, -0.125, 0), (0, 1, 0, 0, 0, 0)))
    assert failures(light, (0.5, -0.125, 0), settled) == (() if comes else ASTRAY)


@pytest.fixture(scope="module")
def row() -> Line:
    """A fixed block, and two on the ground beside it that weigh 32 and 2."""
    boxes = "".join(
        f"  - box: {{group: {name}, material: stone, min: [{x}, 0, {z}], max: [{x + 1}, 1, {z + 1}]}}\n"
        for name, x, z in (("post", 10, 1), ("light", 5, 0))
    )
    text = BLOCK.replace("blocks:\n", f"blocks:\n{boxes}").replace(
        "{ground: {z: 0}}", "{ground: {z: 0}}, {blocks: post}"
    )
    line = line_of(text)
    assert line.model.fixed.tolist() == [True, False, False]
    dead = np.zeros((3, 6))
    dead[1:, 2] = -2.0, -32.0
    return replace(line, load_case=replace(line.load_case, dead_load=dead))


def of_row(line: Line, share: tuple[float, float] = (1.0, 1.0)) -> tuple[FloatArray, FloatArray]:
    """What bears these shares of both weights, and comes from sinking by 16."""
    forces = np.zeros((len(line.contacts.points), 3))
    light = (line.contacts.bodies[line.contacts.interface_of_point] == 1).any(axis=1)
    forces[:, 0] = np.where(light, 0.5 * share[0], 8.0 * share[1])
    settled = np.zeros((3, 6))
    settled[1:, 2] = -16.0
    return forces, settled


def of_standing(line: Line, forces: FloatArray, settled: FloatArray) -> tuple[str, ...]:
    return shown(line, forces, settled)


@pytest.mark.parametrize(("share", "block"), [((1.25, 1.125), 1), ((0.875, 0.75), 2)])
def test_the_block_that_is_off_by_most_of_its_own_load_is_named(
    share: tuple[float, float], block: int, row: Line
) -> None:
    assert of_standing(row, *of_row(row)) == ()
    (failure,) = of_standing(row, *of_row(row, share))
    assert failure == f"under the dead load alone 0.25 of the load of {row.model.blocks.name(block)} is not balanced"


def test_one_point_beyond_its_friction_is_enough(row: Line) -> None:
    """Two corners sheared against each other along the line between them, in balance."""
    forces, settled = of_row(row)
    first, second = np.flatnonzero(forces[:, 0] == 0.5)[:2]
    along = row.contacts.points[second] - row.contacts.points[first]
    for corner, side in ((first, 0.3), (second, -0.3)):
        forces[corner, 1:] = side * (row.contacts.frames[corner] @ along)[1:]
    assert of_standing(row, forces, settled) == (*BEYOND, *ASTRAY)


@pytest.mark.parametrize("way", range(6))
def test_fixed_blocks_stay(way: int, row: Line) -> None:
    forces, settled = of_row(row)
    settled[0, way] = -1e-12
    assert of_standing(row, forces, settled) == ("fixed blocks are displaced",)


# Forces and displacements that show that a structure stands: accepted as they are, refused when anything is off.


STANDING = [structure for structure in STRUCTURES if structure.verdict is Standing.YES]


def shown_solved(line: Line, parts: tuple[Program, ...]) -> tuple[FloatArray, FloatArray]:
    """Forces and displacements of the model under its dead load."""
    forces, settlement = np.zeros((len(line.contacts.points), 3)), np.zeros((len(line.model.blocks), 6))
    for program in parts:
        if not np.any(program.dead_load):
            continue
        standing = assess_dead_load(program)
        assert standing.forces is not None
        assert standing.settlement is not None
        forces += standing.forces
        settlement += standing.settlement
    return forces, settlement


def failures_solved(line: Line, forces: FloatArray, settlement: FloatArray) -> tuple[str, ...]:
    """What verification has against them."""
    limits = yield_limits(line.model, line.contacts)
    return standing_failures(line.model, line.contacts, line.load_case, forces, settlement, limits)


@pytest.mark.parametrize("structure", STANDING, ids=lambda structure: structure.name)
def test_what_stands_is_shown_to_stand_by_whole_and_reduced_programs(structure: Structure) -> None:
    line = line_of(structure.text)
    assert failures_solved(line, *shown_solved(line, (line.program,))) == ()
    # the most that is ever left out: halves, points inside the hull of others
    reduced = reduce_program(line.model, line.contacts, line.program, ReductionSwitches(), associative=True)
    assert failures_solved(line, *shown_solved(line, reduced.parts)) == ()


def test_thrust_that_was_locked_in_does_not_come_from_displacements() -> None:
    """The bar between two walls: pressed by both, held by friction, in balance, and moved in whatever way."""
    line = line_of(bar("friction: 0.5"))
    weight = 1 * 0.4 * 2000 * 9.81
    normal = np.where(np.abs(line.contacts.frames[:, 0, 0]) > 0.9, weight / 4, 0.0)
    upwards = line.contacts.frames[:, 1:] @ np.array([0.0, 0.0, 1.0])
    sign = np.where(line.contacts.bodies[line.contacts.interface_of_point][:, 1] == 0, 1.0, -1.0)
    forces = np.column_stack([normal, (sign * weight / 8)[:, None] * upwards])
    assert np.abs(contact_resultants(line.model, line.contacts, forces) + line.load_case.dead_load).max() < 1e-9
    falling = np.array([[0.0, 0.0, -1.0, 0.0, 0.0, 0.0]])
    for settlement in (falling, *np.random.default_rng(7).normal(size=(20, 1, 6))):
        for size in (1e6, 1e20):
            (failure,) = failures_solved(line, forces, size * settlement)
            assert "do not come from the displacements" in failure
