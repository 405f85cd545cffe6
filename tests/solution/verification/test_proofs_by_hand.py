"""What forces and velocities of one block prove, by hand: with what rounding leaves, and with more than that."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from mbla.solution.solution import Mechanics
from mbla.solution.verification.case import LoadedModel
from mbla.solution.verification.proofs import associative_bounds, certificate_failures
from tests.line import BLOCK, Line, line_of
from tests.solution.by_hand import DEAD, LIVE, RISES, cube, loaded, on_ground, pushed_block, state


def proved(line: Line, mechanics: Mechanics) -> tuple[float, float]:
    return associative_bounds(LoadedModel(line.model, line.contacts, line.load_case), mechanics)


def of_block(
    line: Line, factor: float, shear: float, motion: tuple[float, ...] = RISES, size: float = 1.0
) -> Mechanics:
    """Weight shared by the corners, and the shear of each against the push."""
    forces = on_ground(line.model, line.contacts, (8, -shear, 0))
    return state(forces, size * np.array([motion]), factor)


@pytest.mark.parametrize("size", [0.25, 1.0, 4.0])
def test_the_exact_state_proves_its_factor(size: float, dry: Line) -> None:
    assert proved(dry, of_block(dry, 2.0, 4.0, size=size)) == pytest.approx((2.0, 2.0), abs=1e-13)


@pytest.mark.parametrize("size", [0.25, 1.0, 4.0])
def test_what_is_left_unbalanced_is_taken_from_the_static_bound(size: float, dry: Line) -> None:
    """2e-9 of the weight may be left, 8e-9 of the load factor: in the mechanism it is worth just what it adds."""
    for off in (7.9e-9, -7.9e-9):
        static, _ = proved(dry, of_block(dry, 2.0 + off, 4.0, size=size))
        assert static == pytest.approx(2.0 + off - 7.9e-9, abs=1e-12)
    for off in (8.1e-9, -8.1e-9, 1.0):
        assert np.isnan(proved(dry, of_block(dry, 2.0 + off, 4.0, size=size))[0])


@pytest.mark.parametrize("size", [0.25, 1.0, 4.0])
def test_what_is_beyond_yield_is_taken_as_well(size: float, dry: Line) -> None:
    """Forces that balance 2 + off are 2 off beyond friction at each of four corners: 2e-9 of the weight at most."""
    speed = math.hypot(0.125, 0.0625)
    static, _ = proved(dry, of_block(dry, 2.0 + 3.1e-8, 4.0 + 6.2e-8, size=size))
    assert static == pytest.approx(2.0 + 3.1e-8 * (1.0 - 8.0 * speed), abs=1e-12)
    assert np.isnan(proved(dry, of_block(dry, 2.0 + 3.3e-8, 4.0 + 6.6e-8, size=size))[0])


def test_without_a_mechanism_forces_prove_what_they_carry(dry: Line) -> None:
    static, kinematic = proved(dry, of_block(dry, 2.0 + 7.9e-9, 4.0, (-0.125, 0, 0, 0, 0, 0)))
    assert static == pytest.approx(2.0 + 7.9e-9, abs=1e-12)
    assert np.isnan(kinematic)
    assert np.isnan(proved(dry, of_block(dry, 2.0, 4.0, (0, 0, 1, 0, 0, 0)))[1])


def test_a_factor_below_zero_is_one_where_there_is_a_dead_load(dry: Line) -> None:
    assert proved(dry, of_block(dry, -0.5, -1.0, (0, 0, 1, 0, 0, 0)))[0] == pytest.approx(-0.5)


@pytest.mark.parametrize(("factor", "shear", "static"), [(-0.5, -1.0, 0.0), (0.5, 1.0, 0.5), (0.5, 1.1, 0.0)])
def test_no_forces_balance_no_load(factor: float, shear: float, static: float, mortar: Line) -> None:
    unloaded = replace(mortar, load_case=loaded(mortar.load_case, (0, 0, 0, 0, 0, 0), (8, 0, 0, 0, -2, 0)))
    forces = on_ground(mortar.model, mortar.contacts, (0, -shear, 0))
    mechanics = state(forces, np.array([(0, 0, 1.0, 0, 0, 0)]), factor)
    assert proved(unloaded, mechanics)[0] == pytest.approx(static)


@pytest.mark.parametrize("size", [0.25, 1.0, 4.0])
@pytest.mark.parametrize(
    ("joint", "up", "bound"),
    [
        ("dry", 0.125, 4.0),  # more than it must: the weight takes 32 · 0.125
        ("dry", 0.0, 4.0),  # too little by 1/16 at four corners: charged with twice 8
        ("dry", -0.0625, 8.0 - 2.0),
        ("mortar", 0.0625, 2.0 + 2.0),  # 16 · 0.125
        ("mortar", 0.125, 2.0 + 0.5 + 4.0),  # and tension 8 · 0.0625
        ("mortar", 0.0, 2.0 + 4.0),
        ("weak", 0.0, 4.0),  # strength 64 · 0.0625
        ("weak", 0.0625, 2.0),
        ("weak", 0.125, 4.0),
        ("weak", -0.0625, 8.0 - 2.0),
    ],
)
def test_what_a_motion_proves(joint: str, up: float, bound: float, size: float, request: pytest.FixtureRequest) -> None:
    line: Line = request.getfixturevalue(joint)
    assert proved(line, of_block(line, 2.0, 4.0, (0.125, 0, up, 0, 0, 0), size))[1] == pytest.approx(bound)


def test_small_forces_charge_little(dry: Line) -> None:
    """Twice a hundredth, at four corners of 1/16."""
    forces = on_ground(dry.model, dry.contacts, (0.01, 0, 0))
    assert proved(dry, state(forces, np.array([(0.125, 0, 0, 0, 0, 0)]), 2.0))[1] == pytest.approx(0.005)


def rising(by: float) -> tuple[float, ...]:
    """Proves 32 times that."""
    return (0.125, 0, by, 0, 0, 0)


def test_one_corner_beyond_yield_is_enough(dry: Line) -> None:
    """Two corners sheared against each other along the line between them, in balance, beyond their friction of 4."""
    found = of_block(dry, 0.0, 0.0)
    points, frames = dry.contacts.points, dry.contacts.frames
    along = points[1] - points[0]
    for size, proves in ((3.9, True), (4.1, False)):
        forces = found.contact_forces.copy()
        for corner, side in ((0, size), (1, -size)):
            forces[corner, 1:] = side * (frames[corner] @ along)[1:]
        assert np.isfinite(proved(dry, replace(found, contact_forces=forces))[0]) == proves


def test_one_block_out_of_balance_is_enough() -> None:
    """Of two that slide beside each other, each with the load of the one."""
    text = BLOCK.replace(
        "blocks:\n", "blocks:\n  - box: {group: two, material: stone, min: [5, 0, 0], max: [6, 1, 2]}\n"
    )
    line = line_of(text)
    loads = [np.array([load, load], dtype=float) for load in (DEAD, (8, 0, 0, 0, -8, 0))]
    line = replace(line, load_case=replace(line.load_case, dead_load=loads[0], live_load=loads[1]))
    motion = 0.5 * np.array([RISES, RISES])
    forces = on_ground(line.model, line.contacts, (8, -4, 0))
    assert proved(line, state(forces, motion, 2.0)) == pytest.approx((2.0, 2.0))
    first = (line.contacts.bodies[line.contacts.interface_of_point] == 0).any(axis=1)
    for here in (first, ~first):
        short = forces * np.where(here, 1.0, 0.75)[:, None]
        assert np.isnan(proved(line, state(short, motion, 2.0))[0])


CLAMPED = "{ground: {x: 0}}, {ground: {point: [1, 0, 0], normal: [-1, 0, 0]}}"


@pytest.mark.parametrize(("off", "proves"), [(0.9, True), (1.1, False)])
def test_of_large_forces_more_may_be_rounding(off: float, proves: bool) -> None:
    """Pressed between two walls with 2^30 at each of eight corners, which weight and a push of 2^23 hang on: 1e-6 of
    the forces times 2e-9."""
    line = cube(supports=CLAMPED)
    line = replace(line, load_case=loaded(line.load_case, DEAD, (0, 8, 0, 0, 0, 0)))
    pressure = 2.0**30
    sign = np.where(line.contacts.bodies[line.contacts.interface_of_point][:, 1] == 0, 1.0, -1.0)
    allowed = 2e-9 * 1e-6 * 8 * pressure
    hung = sign[:, None] * np.array([0.0, -(2.0**20), (32.0 - off * allowed) / 8])
    forces = np.einsum("pjx,px->pj", line.contacts.frames, hung)
    forces[:, 0] = pressure
    static, _ = proved(line, state(forces, np.array([(0, 0, 0, 0, 0, 0.0)]), 2.0**20))
    assert (static == pytest.approx(2.0**20)) if proves else np.isnan(static)


def against_a_fall(line: Line, motion: tuple[float, ...]) -> tuple[str, ...]:
    """Of a block pushed by 24 as well, a load of 40."""
    case = loaded(line.load_case, (24, 0, -32, 0, 0, 0), LIVE)
    fall = np.array([motion], dtype=float), None
    return tuple(map(str, certificate_failures(LoadedModel(line.model, line.contacts, case), fall)))


NO_WORK = ("the dead load does no work in the mechanism that should show the lack of equilibrium",)


def test_a_motion_that_falls(dry: Line) -> None:
    assert against_a_fall(dry, (2, 0, 1, 0, 0, 0)) == ()
    assert against_a_fall(dry, (-2, 0, 1, 0, 0, 0)) == NO_WORK
    assert against_a_fall(dry, (0, 0, 0, 0, 0, 0)) == NO_WORK


@pytest.mark.parametrize("size", [0.5, 2.0])
@pytest.mark.parametrize(("short", "proves"), [(0.99996e-5, True), (1.0001e-5, False), (2e-5, False)])
def test_closing_is_charged_with_ten_thousand_times_the_load(
    short: float, proves: bool, size: float, dry: Line
) -> None:
    """The load gains 48 − 32 = 16; what it lacks in rising, at four corners, is charged with 40e4."""
    failures = against_a_fall(dry, (2 * size, 0, size * (1 - short), 0, 0, 0))
    if proves:
        assert failures == ()
    else:
        (failure,) = failures
        share = f"{4 * short / 2:.1g}"
        assert failure.endswith(f"shows the lack of equilibrium closes joints by {share} of its speed")


def test_mortar_holds_it(mortar: Line) -> None:
    """16 · 2 of cohesion against 48 − 32."""
    assert against_a_fall(mortar, (2, 0, 1, 0, 0, 0)) == NO_WORK


def test_what_crushes_takes_work_and_no_charge(weak: Line) -> None:
    """Sliding by 2 without rising: the load gains 48 less 64 · 1; rising by half, 48 − 16 less 64 · 1/2."""
    assert against_a_fall(weak, (2, 0, 0, 0, 0, 0)) == NO_WORK
    assert against_a_fall(weak, (2, 0, 0.45, 0, 0, 0)) == NO_WORK  # 33.6 less 35.2
    assert against_a_fall(weak, (2, 0, 0.55, 0, 0, 0)) == ()  # 30.4 less 28.8


@pytest.mark.parametrize(("off", "proves"), [(7e-9, True), (4e-8, False)])
def test_forces_locked_in_raise_no_bound(off: float, proves: bool) -> None:
    """Corners sheared against each other by 1e8, beside which 3e-7 of the push is little, as it is not beside 32."""
    bonded = pushed_block("friction: 0.5, cohesion: 1e10")
    found = of_block(bonded, 2.0 + off, 4.0)
    points, frames = bonded.contacts.points, bonded.contacts.frames
    along = points[1] - points[0]
    forces = found.contact_forces.copy()
    for corner, side in ((0, 1e8), (1, -1e8)):
        forces[corner, 1:] += side * (frames[corner] @ along)[1:]
    assert np.isfinite(proved(bonded, replace(found, contact_forces=forces))[0]) == proves
