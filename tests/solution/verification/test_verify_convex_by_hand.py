"""Interfaces of one block with the ground, by hand: what each condition and each motion of an interface counts for."""

from __future__ import annotations

import math
from dataclasses import replace
from importlib import import_module
from typing import Any

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program.assemble import yield_limits
from mbla.solution.solution import Checks, Mechanics, Status
from mbla.solution.verification.interface_laws import InterfaceLaws
from mbla.solution.verification.proofs import associative_bounds
from mbla.solution.verification.verify_convex import InterfaceCase, convex_lock_failures, verify_convex
from tests.line import BLOCK, Line, line_of
from tests.solution.by_hand import DEAD, LIVE, RISES, claim, cube, loaded, on_ground, state

MODULE = import_module("mbla.solution.verification.verify_convex")

# The block slides and rises by μ, or does not rise.

SLIDES = (0.125, 0, 0, 0, 0, 0)
SPEED = math.hypot(0.125, 0.0625)


@pytest.fixture
def laws(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """What the laws of the interface say: excess and power, by their names."""
    of: dict[str, Any] = {"torsion_excess": -1.0, "crushing_excess": -1.0, "torsion_power": (0.0, 0.0)}
    of |= {"crushing_power": 0.0, "sliding_power": 0.0, "asked": []}

    def said(name: str) -> Any:
        def law(*arguments: Any) -> Any:
            of["asked"].append((name, arguments))
            value = of[name]
            return tuple(np.array([one]) for one in value) if isinstance(value, tuple) else np.array([value])

        return law

    for name in ("torsion_excess", "crushing_excess", "torsion_power", "crushing_power", "sliding_power"):
        monkeypatch.setattr(MODULE, name, said(name))
    return of


def resultants_of(line: Line, forces: FloatArray) -> FloatArray:
    """Sums over the corners, each at its arm along the tangents."""
    contacts, total = line.contacts, np.zeros((1, 6))
    for point, (normal, first, second) in zip(range(4), forces, strict=True):
        arm = contacts.frames[point] @ (contacts.points[point] - contacts.centroids[0])
        moments = (arm[1] * second - arm[2] * first, arm[2] * normal, -arm[1] * normal)
        total[0] += (normal, first, second, *moments)
    return total


def answer(
    line: Line,
    pressed: tuple[float, float, float] = (8, -4, 0),
    motion: tuple[float, ...] = RISES,
    factor: float = 2.0,
    motions: FloatArray | None = None,
) -> Mechanics:
    forces = on_ground(line.model, line.contacts, pressed)
    found = state(forces, np.array([motion], dtype=float), factor)
    motions = np.zeros((1, 2, 6)) if motions is None else motions
    return replace(found, resultants=resultants_of(line, forces), interface_motions=motions)


def motion_of(torsion: tuple[float, ...] = (0.0,) * 6, crushing: tuple[float, ...] = (0.0,) * 6) -> FloatArray:
    return np.array([[torsion, crushing]], dtype=float)


def judged(line: Line, mechanics: Mechanics, rule: str = "associative", **changes: Any) -> Checks:
    solution = claim(mechanics, flow_rule=rule, contact_model="convex", **changes)
    return verify_convex(line.model, line.contacts, line.load_case, solution)


@pytest.mark.parametrize(("rule", "motion"), [("associative", RISES), ("non_associative", SLIDES)])
def test_the_exact_answer(rule: str, motion: tuple[float, ...], dry: Line) -> None:
    checks = judged(dry, answer(dry, motion=motion), rule, associative=answer(dry))
    assert checks.verified, checks.failures
    bounds = (checks.static_bound, checks.kinematic_bound, checks.live_power)
    assert bounds == pytest.approx((2.0, 2.0, 1.0), abs=1e-8)
    left = (checks.equilibrium_residual, checks.yield_violation, checks.complementarity_residual, checks.gap)
    assert left == pytest.approx((0.0, 0.0, 0.0, 0.0), abs=1e-8)
    others = (checks.penetration, checks.power_balance, checks.tension_violation, checks.slip_residual)
    assert others == pytest.approx((0.0, 0.0, 0.0, 0.0), abs=1e-12)


def test_unbalanced_forces_tension_and_shear(dry: Line, mortar: Line) -> None:
    checks = judged(dry, answer(dry, factor=2.5))
    assert checks.equilibrium_residual == pytest.approx(4 / 32)
    assert checks.power_balance == pytest.approx(0.5 / 2.5)
    assert judged(dry, answer(dry, (8, -5, 0))).yield_violation == pytest.approx(4 / 32)  # of the whole interface
    pulled = judged(mortar, answer(mortar, (-3, 0, 0)))
    assert pulled.tension_violation == pytest.approx(1 / 32)
    assert judged(mortar, answer(mortar, (-2, 0, 0))).tension_violation == pytest.approx(0.0, abs=1e-15)


def test_sinking_into_the_ground(dry: Line) -> None:
    checks = judged(dry, answer(dry, motion=(0.125, 0, -0.0625, 0, 0, 0)), "non_associative", associative=None)
    assert checks.penetration == pytest.approx(0.0625 / SPEED)
    assert checks.complementarity_residual == pytest.approx(1.0)
    assert np.isnan([checks.static_bound, checks.kinematic_bound, checks.gap]).all()


def test_opening_under_force_and_slip_without_friction_add_up(dry: Line) -> None:
    """32 up by 1/16, and half of the friction missing: 2 and 1 of 2."""
    checks = judged(dry, answer(dry, (8, -2, 0)), "non_associative", associative=None)
    assert checks.slip_residual == pytest.approx(0.5)
    assert checks.complementarity_residual == pytest.approx(1.5)


@pytest.mark.parametrize("name", ["torsion_excess", "crushing_excess"])
def test_excess_of_the_interface(name: str, dry: Line, laws: dict[str, Any]) -> None:
    assert judged(dry, answer(dry)).yield_violation == pytest.approx(0.0, abs=1e-15)
    laws[name] = 1.0
    assert judged(dry, answer(dry)).yield_violation == pytest.approx(1 / 32)
    assert judged(dry, answer(dry, (8, -5, 0))).yield_violation == pytest.approx(1 / 32)
    assert judged(dry, answer(dry, (8, -6, 0))).yield_violation == pytest.approx(2 / 32)  # of each corner


def test_power_of_the_interface_without_dilatancy(dry: Line, laws: dict[str, Any]) -> None:
    """Friction of the corners takes 2, the interface 1/2 by torsion and 1/4 by crushing, for which nothing moves."""
    laws["sliding_power"], laws["crushing_power"], laws["torsion_power"] = 0.5, 0.25, (7.0, 7.0)
    checks = judged(dry, answer(dry, motion=SLIDES), "non_associative", associative=None)
    assert checks.complementarity_residual == pytest.approx(0.75 / 2.5)
    assert checks.slip_residual == pytest.approx(0.5 / 2.5)
    assert checks.power_balance == pytest.approx(0.75 / 2.5)


@pytest.mark.parametrize(
    ("lack", "joint", "twisted"), [(0.5, "dry", 3.0 + 16.0), (-0.5, "dry", 3.0), (0.5, "mortar", 23.0)]
)
def test_power_of_the_interface_by_associative_flow(
    lack: float,
    joint: str,
    twisted: float,
    laws: dict[str, Any],
    request: pytest.FixtureRequest,
) -> None:
    """What torsion lacks in opening costs N + f_t A, 32 or 40."""
    line: Line = request.getfixturevalue(joint)
    laws["torsion_power"], laws["crushing_power"], laws["sliding_power"] = (3.0, lack), 0.25, 0.5
    shear, factor, friction = (-4, 2.0, 2.0) if joint == "dry" else (-8, 4.0, 4.0)
    checks = judged(line, answer(line, (8, shear, 0), factor=factor))
    balance = friction + 0.5
    assert checks.complementarity_residual == pytest.approx((twisted + 0.25) / balance)
    assert checks.slip_residual == pytest.approx(twisted / balance)
    assert checks.power_balance == pytest.approx((twisted + 0.25) / balance)


def test_tension_does_not_pay_for_opening(mortar: Line, laws: dict[str, Any]) -> None:
    """Beyond the tensile strength, N + f_t A below zero, the lack costs nothing."""
    laws["torsion_power"] = (3.0, 0.5)
    case = replace(mortar, load_case=loaded(mortar.load_case, (0, 0, 48, 0, 0, 0), LIVE))
    checks = judged(case, answer(case, (-12, 0, 0), (0.125, 0, 0.0625, 0, 0, 0), 0.0))
    balance = 48 * 0.0625
    # tension of 12 − 2 too much at four corners that neither open nor close but by the rule, strength 4 − 6
    assert checks.slip_residual == pytest.approx((3.0 + 8.0 * 0.125) / balance)


WAYS = [tuple(0.25 * row) for row in np.eye(6)]


def taken(line: Line, motion: tuple[float, ...]) -> tuple[float, ...]:
    """The motion of the block as one of its interface, about its centroid in its frame."""
    contacts, frame = line.contacts, line.contacts.frames[0]
    arm = contacts.centroids[0] - line.model.blocks.centroids[0]
    velocity = np.array(motion[:3]) + np.cross(motion[3:], arm)
    return (*(frame @ velocity), *(frame @ np.array(motion[3:])))


@pytest.mark.parametrize("rule", ["associative", "non_associative"])
@pytest.mark.parametrize("motion", WAYS, ids=str)
def test_what_an_interface_takes_of_a_motion_its_corners_do_not(
    motion: tuple[float, ...], rule: str, mortar: Line, laws: dict[str, Any]
) -> None:
    """By torsion, by crushing, or by half of each: nothing is left but what the laws say of the interface."""
    case = replace(mortar, load_case=loaded(mortar.load_case, DEAD, tuple(4.0 * np.array(motion) / 0.25)))
    laws["torsion_power"], laws["crushing_power"], laws["sliding_power"] = (3.0, 0.0), 0.75, 3.0
    whole = np.array(taken(mortar, motion))
    forces = np.array([[8.0, 1, 2], [4, 3, -1], [6, 0.5, 0.5], [2, -2, -3]])
    resultants = resultants_of(mortar, forces)
    for torsion, crushing in ((1.0, 0.0), (0.0, 1.0), (0.5, 0.5)):
        motions = np.array([[torsion * whole, crushing * whole]])
        mechanics = state(forces, np.array([motion]), 1.0)
        mechanics = replace(mechanics, resultants=resultants, interface_motions=motions)
        checks = judged(case, mechanics, rule)
        for name, arguments in laws["asked"]:
            if name.endswith("power"):
                share = crushing if name == "crushing_power" else torsion
                assert arguments[1 if name == "crushing_power" else -1] == pytest.approx(share * whole[None, :])
        laws["asked"].clear()
        along = float(resultants[0] @ whole)
        of_torsion, of_crushing = abs(3.0 + torsion * along), abs(0.75 + crushing * along)
        dead = float(np.array(DEAD) @ np.array(motion))
        balance = max(1.0, abs(dead), 3.0)
        assert checks.live_power == pytest.approx(1.0)
        assert checks.slip_residual == pytest.approx(of_torsion / balance)
        assert checks.complementarity_residual == pytest.approx((of_torsion + of_crushing) / balance)
        assert checks.power_balance == pytest.approx(abs(dead + 1.0 - 3.75) / balance)


@pytest.mark.usefixtures("laws")
@pytest.mark.parametrize(
    ("crushing", "closing"),
    [
        ((0, 0, 0, 0, 0, 0), 0.0),
        ((0.25, 0, 0, 0, 0, 0), 0.1875),  # the interface opens by more than the block rises
        ((-0.25, 0, 0, 0, 0, 0), 0.0),
        ((0, 0, 0, 0, 0.25, 0), 0.125 - 0.0625),  # and at the corners, 1/2 off its centroid
        ((0, 0, 0, 0, 0, 0.25), 0.125 - 0.0625),
        ((0.0625, 0, 0, 0, 0, -0.25), 0.125),
        ((0, 0.25, 0.25, 0.25, 0, 0), 0.0),
    ],
)
def test_corners_close_by_what_crushing_does_not_leave(crushing: tuple[float, ...], closing: float, dry: Line) -> None:
    checks = judged(dry, answer(dry, motions=motion_of(crushing=crushing)), "non_associative", associative=None)
    assert checks.penetration == pytest.approx(closing / SPEED)
    other = judged(dry, answer(dry, motions=motion_of(torsion=crushing)), "non_associative", associative=None)
    assert other.penetration == 0.0


def test_what_crushes_as_a_whole_does_not_at_its_corners(weak: Line) -> None:
    checks = judged(weak, answer(weak, motion=(0.125, 0, -0.0625, 0, 0, 0)), "non_associative", associative=None)
    assert checks.penetration == pytest.approx(0.0625 / SPEED)


RESULTANTS = "the resultants of the interfaces are not those of the contact forces"


@pytest.mark.every(4)
@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("at", range(6))
def test_stored_resultants(at: int, side: float, dry: Line) -> None:
    """To 1e-9 of the largest, 32."""
    right = answer(dry)
    assert right.resultants is not None
    for off, kept in ((0.99e-9, True), (1.01e-9, False), (0.5, False), (np.nan, False)):
        stored = right.resultants.copy()
        stored[0, at] += side * off * 32
        checks = judged(dry, replace(right, resultants=stored))
        assert checks.failures == (() if kept else (RESULTANTS,))


@pytest.mark.parametrize("name", ["resultants", "interface_motions"])
def test_what_is_stored_of_interfaces_must_be_there(name: str, dry: Line) -> None:
    without: dict[str, Any] = {name: None}
    checks = judged(dry, replace(answer(dry), **without))
    assert checks.failures == ("the resultants and motions of the interfaces are missing",)
    assert checks.kinematic_bound == pytest.approx(2.0)


def test_forces_of_nothing_have_resultants_of_nothing(dry: Line) -> None:
    nothing = answer(dry, (0, 0, 0))
    assert RESULTANTS not in judged(dry, nothing).failures
    assert RESULTANTS in judged(dry, replace(nothing, resultants=np.full((1, 6), 2.0**-40))).failures


def test_resultants_of_small_forces_are_judged_by_these(dry: Line) -> None:
    right = answer(dry, (8 * 2.0**-40, -4 * 2.0**-40, 0))
    assert right.resultants is not None
    assert RESULTANTS not in judged(dry, right).failures
    assert RESULTANTS in judged(dry, replace(right, resultants=2.0 * right.resultants)).failures


# Bounds.


def proved(line: Line, mechanics: Mechanics) -> tuple[float, float]:
    return associative_bounds(InterfaceCase(line.model, line.contacts, line.load_case, "convex"), mechanics)


def test_what_may_be_left_unbalanced(dry: Line) -> None:
    """2e-9 of the weight, 8e-9 of the load factor, with which the bound is charged."""
    for off in (7.9e-9, -7.9e-9):
        assert proved(dry, answer(dry, factor=2.0 + off))[0] == pytest.approx(2.0 + off - abs(off), abs=1e-12)
    for off in (8.1e-9, -8.1e-9, 1.0):
        assert np.isnan(proved(dry, answer(dry, factor=2.0 + off))[0])


@pytest.mark.usefixtures("laws")
def test_what_corners_may_be_beyond_yield(dry: Line) -> None:
    for off, proves in ((3.1e-8, True), (3.3e-8, False), (1.0, False)):
        static, _ = proved(dry, answer(dry, (8, -4 - 2 * off, 0), factor=2.0 + off))
        # charged with what is beyond yield
        assert (2.0 - 4.0 * off <= static <= 2.0 + off) if proves else np.isnan(static)


@pytest.mark.parametrize("name", ["torsion_excess", "crushing_excess"])
def test_what_the_interface_may_be_beyond_yield(name: str, dry: Line, laws: dict[str, Any]) -> None:
    for excess, proves in ((6.3e-8, True), (2e-9 * 32.0, True), (6.5e-8, False), (1.0, False)):
        laws[name] = excess
        assert np.isnan(proved(dry, answer(dry))[0]) == (not proves)


@pytest.mark.parametrize("name", ["torsion_excess", "crushing_excess"])
def test_one_interface_beyond_yield_is_enough_to_prove_nothing(name: str, laws: dict[str, Any]) -> None:
    """Hung between two walls: the weight needs half of the friction."""
    line = cube(supports="{ground: {x: 0}}, {ground: {point: [1, 0, 0], normal: [-1, 0, 0]}}")
    line = replace(line, load_case=loaded(line.load_case, DEAD, (0, 8, 0, 0, 0, 0)))
    sign = np.where(line.contacts.bodies[line.contacts.interface_of_point][:, 1] == 0, 1.0, -1.0)
    forces = np.einsum("pjx,px->pj", line.contacts.frames, sign[:, None] * np.array([0.0, 0.0, 4.0]))
    forces[:, 0] = 16.0
    for excess, proves in (([-1.0, -1.0], True), ([-1.0, 1.0], False), ([1.0, -1.0], False), ([1.0, 1.0], False)):
        laws[name] = excess
        static, _ = proved(line, state(forces, np.zeros((1, 6)), 0.0))
        assert (static == pytest.approx(0.0)) if proves else np.isnan(static)


def test_a_factor_below_zero_is_one_where_there_is_a_dead_load(dry: Line) -> None:
    assert proved(dry, answer(dry, (8, 1, 0), factor=-0.5))[0] == pytest.approx(-0.5)


@pytest.mark.parametrize(("factor", "shear", "static"), [(-0.5, -1.0, 0.0), (0.5, 1.0, 0.5), (0.5, 1.1, 0.0)])
def test_no_forces_balance_no_load(factor: float, shear: float, static: float, mortar: Line) -> None:
    unloaded = replace(mortar, load_case=loaded(mortar.load_case, (0, 0, 0, 0, 0, 0), LIVE))
    assert proved(unloaded, answer(unloaded, (0, -shear, 0), factor=factor))[0] == pytest.approx(static)


@pytest.mark.parametrize("size", [0.25, 1.0, 4.0])
@pytest.mark.parametrize(
    ("joint", "up", "bound"),
    [
        ("dry", 0.0625, 2.0),
        ("dry", 0.125, 4.0),  # more than it must: the weight takes 32 · 0.125
        ("dry", 0.0, 4.0),  # too little by 1/16 at four corners: charged with twice 8
        ("mortar", 0.0625, 2.0 + 2.0),  # 16 · 0.125
        ("mortar", 0.125, 2.0 + 0.5 + 4.0),  # and tension 8 · 0.0625
        ("weak", 0.0, 4.0),
        ("weak", 0.0625, 2.0),
    ],
)
def test_what_a_motion_proves(joint: str, up: float, bound: float, size: float, request: pytest.FixtureRequest) -> None:
    line: Line = request.getfixturevalue(joint)
    moves = tuple(size * value for value in (0.125, 0, up, 0, 0, 0))
    assert proved(line, answer(line, motion=moves))[1] == pytest.approx(bound)


def opened(line: Line, mechanics: Mechanics) -> FloatArray:
    """Motions of the interface as they are judged."""
    case = InterfaceCase(line.model, line.contacts, line.load_case, "convex")
    motions = case.admissible(case.motion_of(mechanics))[1]
    assert motions is not None
    return motions


def test_what_the_interface_adds(dry: Line, laws: dict[str, Any]) -> None:
    """3 by torsion, 5 by crushing, and a lack of 1/2 at four corners at twice 8; the opening is added first."""
    laws["torsion_power"], laws["crushing_power"] = (3.0, 0.5), 5.0
    found = answer(dry)
    # the corners open by 1/2 less, which is charged as well
    assert proved(dry, found)[1] == pytest.approx(2.0 + 8.0 + 4 * 0.5 * 16 + 4 * 0.5 * 16)
    assert opened(dry, found) == pytest.approx(motion_of((0.5, 0, 0, 0, 0, 0)))
    laws["torsion_power"] = (3.0, -0.5)
    assert proved(dry, found)[1] == pytest.approx(2.0 + 8.0)
    assert opened(dry, found).tolist() == motion_of().tolist()
    assert found.interface_motions is not None
    assert not found.interface_motions.any()  # what was given is left as it was


@pytest.mark.usefixtures("laws")
def test_motions_of_the_interface_are_taken_from_its_corners(dry: Line) -> None:
    """An opening of 1/2 by crushing leaves the corners that much less; closing by 1/2 as much more."""
    more = answer(dry, motions=motion_of(crushing=(-0.5, 0, 0, 0, 0, 0)))
    assert proved(dry, more)[1] == pytest.approx(2.0)
    less = answer(dry, motions=motion_of(crushing=(0.5, 0, 0, 0, 0, 0)))
    assert proved(dry, less)[1] == pytest.approx(2.0 + 4 * 0.5 * 16)


def test_small_forces_charge_little(dry: Line) -> None:
    assert proved(dry, answer(dry, (0.01, 0, 0), SLIDES))[1] == pytest.approx(0.005)


@pytest.mark.usefixtures("laws")
@pytest.mark.parametrize(("off", "proves"), [(0.9, True), (1.1, False)])
def test_of_large_forces_more_may_be_rounding(off: float, proves: bool) -> None:
    """Pressed between two walls with 2^34 at each of eight corners, with the weight and a push of 2^23 on them: 1e-6 of
    the forces on the cube times 2e-9, as where joints crush at their points."""
    line = cube(supports="{ground: {x: 0}}, {ground: {point: [1, 0, 0], normal: [-1, 0, 0]}}")
    line = replace(line, load_case=loaded(line.load_case, DEAD, (0, 8, 0, 0, 0, 0)))
    sign = np.where(line.contacts.bodies[line.contacts.interface_of_point][:, 1] == 0, 1.0, -1.0)
    hung = sign[:, None] * np.array([0.0, -(2.0**20), (32.0 - off * 2e-15 * 8 * 2.0**34) / 8])
    forces = np.einsum("pjx,px->pj", line.contacts.frames, hung)
    forces[:, 0] = 2.0**34
    static, _ = proved(line, state(forces, np.zeros((1, 6)), 2.0**20))
    assert (static == pytest.approx(2.0**20)) if proves else np.isnan(static)


@pytest.mark.usefixtures("laws")
@pytest.mark.parametrize(("off", "proves"), [(0.9, True), (1.1, False)])
def test_forces_locked_in_raise_no_bound(off: float, proves: bool) -> None:
    """Without the push no more is rounding than 2e-9 of the weight, be the pressure what it may."""
    line = cube(supports="{ground: {x: 0}}, {ground: {point: [1, 0, 0], normal: [-1, 0, 0]}}")
    line = replace(line, load_case=loaded(line.load_case, DEAD, (0, 8, 0, 0, 0, 0)))
    sign = np.where(line.contacts.bodies[line.contacts.interface_of_point][:, 1] == 0, 1.0, -1.0)
    hung = sign[:, None] * np.array([0.0, 0.0, (32.0 - off * 2e-9 * 32.0) / 8])
    forces = np.einsum("pjx,px->pj", line.contacts.frames, hung)
    forces[:, 0] = 2.0**34
    static, _ = proved(line, state(forces, np.zeros((1, 6)), 0.0))
    assert (static == pytest.approx(0.0)) if proves else np.isnan(static)


# Claims without a load factor.


def test_an_answer_without_mechanics_is_judged_by_its_reason(dry: Line) -> None:
    for status, failures in ((Status.TIME_LIMIT, ("time is up",)), (Status.UNBOUNDED, ())):
        solution = claim(None, status, reason="time is up")
        checks = verify_convex(dry.model, dry.contacts, dry.load_case, solution)
        assert checks.failures == failures
        assert checks.verified == (not failures)
        assert np.isnan([checks.equilibrium_residual, checks.live_power, checks.static_bound, checks.gap]).all()


NO_WORK = ("the dead load does no work in the mechanism that should show the lack of equilibrium",)


def against_a_fall(line: Line, motion: tuple[float, ...], motions: FloatArray | None = None) -> tuple[str, ...]:
    """Of a block pushed by 24 as well, a load of 40."""
    case = loaded(line.load_case, (24, 0, -32, 0, 0, 0), LIVE)
    certificate = np.array([motion], dtype=float)
    solution = claim(None, Status.NO_EQUILIBRIUM, reason="it falls", certificate=certificate)
    solution = replace(solution, certificate_motions=motions)
    checks = verify_convex(line.model, line.contacts, case, solution)
    assert checks.verified == (not checks.failures)
    return checks.failures


def test_a_motion_that_falls(dry: Line, mortar: Line) -> None:
    assert against_a_fall(dry, (2, 0, 1, 0, 0, 0)) == ()
    assert against_a_fall(dry, (2, 0, 1, 0, 0, 0), motion_of()) == ()
    assert against_a_fall(dry, (-2, 0, 1, 0, 0, 0)) == NO_WORK
    assert against_a_fall(dry, (0, 0, 0, 0, 0, 0)) == NO_WORK
    assert against_a_fall(mortar, (2, 0, 1, 0, 0, 0)) == NO_WORK  # 16 · 2 of cohesion against 48 − 32


def test_what_the_interface_takes_counts_against_a_fall(dry: Line, laws: dict[str, Any]) -> None:
    for name, taken_by_it, told in (
        ("crushing_power", 15.9, ()),
        ("crushing_power", 16.1, NO_WORK),
        ("torsion_power", (15.9, 0.0), ()),
        ("torsion_power", (16.1, 0.0), NO_WORK),
    ):
        laws["crushing_power"], laws["torsion_power"] = 0.0, (0.0, 0.0)
        laws[name] = taken_by_it
        assert against_a_fall(dry, (2, 0, 1, 0, 0, 0)) == told


@pytest.mark.parametrize("size", [0.5, 2.0])
@pytest.mark.parametrize(("short", "proves"), [(0.9999e-5, True), (1.0001e-5, False), (2e-5, False)])
def test_closing_is_charged_with_ten_thousand_times_the_load(
    short: float, proves: bool, size: float, dry: Line
) -> None:
    """The load gains 48 − 32 = 16; what it lacks in rising, at four corners, is charged with 40e4."""
    failures = against_a_fall(dry, (2 * size, 0, size * (1 - short), 0, 0, 0))
    if proves:
        assert failures == ()
    else:
        (failure,) = failures
        assert failure.endswith(f"shows the lack of equilibrium closes joints by {4 * short / 2:.1g} of its speed")


NOT_WITHIN = ("the forces that should show that the structure locks do not stay within the conditions on interfaces",)


def test_a_lock_within_the_friction_of_the_interface(dry: Line) -> None:
    for shear, expected in ((-4.0, ()), (-4.1, NOT_WITHIN), (3.9, ())):
        lock = on_ground(dry.model, dry.contacts, (8, shear, 0))
        assert convex_lock_failures(dry.model, dry.contacts, dry.load_case, lock, "convex") == expected


def test_a_lock_may_be_beyond_by_a_millionth_of_its_largest_force(mortar: Line, laws: dict[str, Any]) -> None:
    """sqrt(8² + 1²); cohesion and tension do not last."""
    lock = on_ground(mortar.model, mortar.contacts, (8, -1, 0))
    lock[0] *= 0.5
    for share, expected in ((0.99e-6, ()), (1.01e-6, NOT_WITHIN)):
        laws["torsion_excess"] = share * math.sqrt(65.0)
        assert convex_lock_failures(mortar.model, mortar.contacts, mortar.load_case, lock, "convex") == expected
    _, (given, resultants) = laws["asked"][-1]
    assert isinstance(given, InterfaceLaws)
    assert given.cohesion.tolist() == given.tension.tolist() == [0.0]
    assert given.friction.tolist() == [0.5]
    assert resultants == pytest.approx(resultants_of(mortar, lock))


def test_a_lock_on_what_crushes(weak: Line) -> None:
    none = np.zeros((4, 3))
    assert convex_lock_failures(weak.model, weak.contacts, weak.load_case, none, "convex") == ()
    pressed = on_ground(weak.model, weak.contacts, (8, 0, 0))
    assert convex_lock_failures(weak.model, weak.contacts, weak.load_case, pressed, "convex") == NOT_WITHIN


def test_one_interface_that_crushes_is_enough() -> None:
    """A block on the ground, and one beside it on ground that crushes."""
    text = BLOCK.replace(
        "blocks:\n", "blocks:\n  - box: {group: two, material: stone, min: [5, 0, 1], max: [6, 1, 2]}\n"
    )
    text = text.replace("{ground: {z: 0}}", "{ground: {z: 0}}, {ground: {z: 1}, joint: weak, blocks: two}").replace(
        "joints: {", "joints: {weak: {friction: 0.5, compressive_strength: 64}, "
    )
    line = line_of(text, "parameters.h=0.5")
    lock = on_ground(line.model, line.contacts, (8, 0, 0))
    assert len(line.contacts) == 2
    assert convex_lock_failures(line.model, line.contacts, line.load_case, lock, "convex") == NOT_WITHIN
    weak = np.isfinite(yield_limits(line.model, line.contacts).compression)
    lock[weak] = 0.0
    assert convex_lock_failures(line.model, line.contacts, line.load_case, lock, "convex") == ()
