"""Residuals of a point or a block, by hand: each term of the law by itself."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.solution.verification.case import LoadedModel
from mbla.solution.verification.residuals import flow_power, penetration_of, residuals_of, share_of
from tests.line import BLOCK, Line, line_of
from tests.solution.by_hand import EXACT, cube, limits_of, loaded, on_ground, state

# One point, friction 1/2, cohesion 3, tension 2; N = 8 and T of size 5 against the slip of 5 make 7 · 5 − 25 = 10.


@pytest.mark.parametrize(
    ("opening", "dilatancy", "compression", "normal", "dissipated"),
    [
        (0.0, 0.0, np.inf, 0.0, 35.0),
        (0.5, 0.0, np.inf, 10 * 0.5, 35.0 + 2 * 0.5),  # opens under N + f_t
        (1.0, 0.1, np.inf, 10 * 0.5, (7 - 0.8) * 5 + 2 * 0.5),
        (0.5, 0.1, np.inf, 0.0, 31.0),  # as the rule has it
        (0.5, 0.2, np.inf, 8 * 0.5, (7 - 1.6) * 5),  # opens too little where it cannot crush: by N
        (0.5, 0.2, 20.0, 12 * 0.5, (7 - 1.6) * 5 + 20 * 0.5),  # or crushes: by what N lacks of the strength
        (0.5, 0.2, 6.0, 2 * 0.5, (7 - 1.6) * 5 + 6 * 0.5),  # or has beyond it
        (1.0, 0.1, 20.0, 10 * 0.5, (7 - 0.8) * 5 + 2 * 0.5),
    ],
)
def test_power_of_a_point(
    opening: float, dilatancy: float, compression: float, normal: float, dissipated: float
) -> None:
    limits = limits_of(1, 0.5, 3.0, 2.0, compression)
    x, v = np.array([[8.0, -3.0, -4.0]]), np.array([[opening, 3.0, 4.0]])
    flow = flow_power(limits, np.array([dilatancy]), x, v, np.array([5.0]), np.array([7.0]))
    assert flow.normal == pytest.approx(normal, abs=1e-13)
    assert flow.slip == pytest.approx(10.0)
    assert flow.dissipated == pytest.approx(dissipated)


@pytest.mark.parametrize(("shear", "slip"), [((-4.2, -5.6), 0.0), ((-6.0, -8.0), 15.0), ((3.0, 4.0), 60.0)])
def test_slip_is_what_shear_does_not_explain(shear: tuple[float, float], slip: float) -> None:
    x, v = np.array([[8.0, *shear]]), np.array([[0.0, 3.0, 4.0]])
    flow = flow_power(limits_of(1, 0.5, 3.0), np.zeros(1), x, v, np.array([5.0]), np.array([7.0]))
    assert flow.slip == pytest.approx(slip, abs=1e-13)


def test_tension_beyond_the_strength_counts_as_much_as_short_of_it() -> None:
    for normal in (-1.0, -3.0):
        x, v = np.array([[normal, 0.0, 0.0]]), np.array([[0.5, 0.0, 0.0]])
        flow = flow_power(limits_of(1, 0.5, 3.0, 2.0), np.zeros(1), x, v, np.zeros(1), np.zeros(1))
        assert flow.normal == 0.5


def test_points_add_up_without_their_signs() -> None:
    x = np.array([[8.0, -3.0, -4.0], [8.0, -6.0, -8.0]])
    v = np.array([[0.0, 3.0, 4.0], [0.0, 3.0, 4.0]])
    flow = flow_power(limits_of(2, 0.5, 3.0), np.zeros(2), x, v, np.full(2, 5.0), np.full(2, 7.0))
    assert flow.slip == pytest.approx(25.0)
    assert flow.dissipated == pytest.approx(70.0)


@pytest.mark.parametrize(
    ("closing", "speed", "mechanism", "expected"),
    [
        ([0.25, 0.5], 2.0, [[1, 0, 0, 0, 0, 0]], 0.25),
        ([0.0, 0.0], 2.0, [[1, 0, 0, 0, 0, 0]], 0.0),
        ([0.0, 1e-9], 1e-9, [[1, 0, 0, 0, 0, 0]], 0.0),  # at rest: as accurate as the cone programs
        ([0.0, 2e-9], 2e-9, [[1, 0, 0, 0, 0, 0]], 1.0),
        ([0.0, 2e-9], 2e-9, [[4, 0, 0, 0, 0, 0]], 0.0),
        ([0.0, 2e-9], 2e-9, [[0, 0, 0, 0, 0, 4]], 0.0),  # arm 1/2
        ([0.0, 3e-9], 3e-9, [[0, 0, 0, 0, 0, 4]], 1.0),
        ([0.0, 2e-9], 2e-9, [[0, 0, 0, 4, 0, 0]], 0.0),
        ([0.0, 3e-9], 3e-9, [[0, 0, 0, 4, 0, 0]], 1.0),
        ([0.0, 2.5e-9], 2.5e-9, [[1, 0, 0, 0, 0, 4]], 0.0),
        ([0.0, 2e-9], 2e-9, [[0.5, 0, 0, 0, 0, 0], [4, 0, 0, 0, 0, 0]], 0.0),
        ([0.0, 0.0], 0.0, [[0.25, 0, 0, 0, 0, 0]], 0.0),
        ([0.0, 0.0], 0.0, [[0, 0, 0, 0, 0, 0]], np.nan),
    ],
)
def test_penetration(closing: list[float], speed: float, mechanism: list[list[float]], expected: float) -> None:
    arms = np.full(len(mechanism), 0.5)
    found = penetration_of(np.array(closing), speed, np.array(mechanism, dtype=float), arms)
    assert found == pytest.approx(expected, nan_ok=True)


def test_a_share_of_nothing_is_no_number() -> None:
    assert share_of(1.0, 4.0) == 0.25
    assert share_of(1.0, 0.5) == 2.0
    assert np.isnan(share_of(1.0, 0.0))
    assert np.isnan(share_of(0.0, 0.0))
    assert np.isnan(share_of(1.0, np.nan))


NAMES = ("equilibrium", "yielding", "penetration", "complementarity", "power_balance")


@pytest.mark.parametrize("name", NAMES)
def test_the_largest_is_any_of_them(name: str) -> None:
    assert EXACT.largest == 0.0
    assert replace(EXACT, **{name: 0.25}).largest == 0.25
    assert np.isnan(replace(EXACT, **{name: np.nan}).largest)


def test_the_live_power_may_be_off_either_way_and_parts_do_not_count_again() -> None:
    assert replace(EXACT, live_power=1.25).largest == 0.25
    assert replace(EXACT, live_power=0.75).largest == 0.25
    assert replace(EXACT, tension=0.25, slip=0.25).largest == 0.0


# A block 1 x 1 x 0.5 on the ground, weight 32 and a push of 8 λ at its base: 8 N of weight on each corner. Lever arm of
# its corners: sqrt(0.5 + 1/16) = 0.75.


@pytest.fixture(scope="module")
def dry() -> Line:
    return cube()


@pytest.fixture(scope="module")
def mortar() -> Line:
    """Cohesion 4, tension 2 at each corner."""
    return cube("friction: 0.5, cohesion: 16, tensile_strength: 8")


@pytest.fixture(scope="module")
def weak() -> Line:
    """Strength 16 at each corner."""
    return cube("friction: 0.5, compressive_strength: 64")


def of_block(
    line: Line, pressed: tuple[float, float, float], motion: tuple[float, ...], factor: float, **options: Any
) -> dict[str, float]:
    case = loaded(line.load_case, (0, 0, -32, 0, 0, 0), (8, 0, 0, 0, -2, 0))
    forces = on_ground(line.model, line.contacts, pressed)
    mechanics = state(forces, np.array([motion], dtype=float), factor)
    dilatancy = np.full(4, options.pop("dilatancy", 0.0))
    return vars(residuals_of(LoadedModel(line.model, line.contacts, case), mechanics, dilatancy, **options))


SLIDES = (0.125, 0.0, 0.0, 0.0, 0.0, 0.0)


def only(found: dict[str, float], **expected: float) -> None:
    """These residuals and no other."""
    assert found == pytest.approx(vars(EXACT) | expected, abs=1e-13)


def test_a_block_that_slides(dry: Line) -> None:
    only(of_block(dry, (8, -4, 0), SLIDES, 2.0))


def test_a_block_that_slides_in_mortar(mortar: Line) -> None:
    """Per corner 8 = 8/2 + 4."""
    only(of_block(mortar, (8, -8, 0), SLIDES, 4.0))


def test_unbalanced_forces(dry: Line) -> None:
    """Of 32 on a block that bears 32 and forces of 4 sqrt(80): at most its mean load, 32."""
    found = of_block(dry, (8, -4, 0), SLIDES, 2.5)
    only(found, equilibrium=4 / 32, power_balance=0.5 / 2.5)
    found = of_block(dry, (8, -4, 0), SLIDES, 1.5)  # half of what friction does is missing
    only(found, equilibrium=4 / 32, power_balance=0.5 / 2.0)


def test_unbalanced_moments_count_over_the_lever_arm(dry: Line) -> None:
    """The push of 8 λ a quarter above the base, but the moment of only 1 λ with it."""
    case = loaded(dry.load_case, (0, 0, -32, 0, 0, 0), (8, 0, 0, 0, 4, 0))
    forces = on_ground(dry.model, dry.contacts, (8, -4, 0))
    mechanics = state(forces, np.array([SLIDES]), 2.0)
    found = residuals_of(LoadedModel(dry.model, dry.contacts, case), mechanics, np.zeros(4))
    assert found.equilibrium == pytest.approx(2.0 * 6.0 / 0.75 / 32)


def test_forces_beyond_yield(mortar: Line) -> None:
    found = of_block(mortar, (8, -9, 0), SLIDES, 4.5)
    assert found["yielding"] == pytest.approx(1 / 32)
    assert found["tension"] == 0.0
    pulled = of_block(mortar, (-3, 0, 0), SLIDES, 4.0)
    assert pulled["tension"] == pytest.approx(1 / 32)
    assert pulled["yielding"] == pytest.approx(1 / 32)
    held = of_block(mortar, (-2, 0, 0), SLIDES, 4.0)
    assert (held["tension"], held["yielding"]) == pytest.approx((0.0, 0.0), abs=1e-15)


def test_opening_under_force(dry: Line) -> None:
    """Up by 1/16 of its weight, 2, which the dead load takes: over that of the friction, 2."""
    found = of_block(dry, (8, -4, 0), (0.125, 0, 0.0625, 0, 0, 0), 2.0)
    only(found, complementarity=1.0, power_balance=1.0)


def test_tension_dissipates_as_the_joint_opens(mortar: Line) -> None:
    """Pulled up at both ends of its strength: 4 · 2 at the corners, and the weight."""
    case = loaded(mortar.load_case, (0, 0, -32, 0, 0, 0), (0, 0, 8, 0, 0, 0))
    forces = on_ground(mortar.model, mortar.contacts, (-2, 0, 0))
    mechanics = state(forces, np.array([[0, 0, 0.125, 0, 0, 0]]), 5.0)
    found = vars(residuals_of(LoadedModel(mortar.model, mortar.contacts, case), mechanics, np.zeros(4)))
    only(found)


def test_sinking_into_the_ground(dry: Line) -> None:
    """By half of its sliding: of the contact speed sqrt(5)/2."""
    found = of_block(dry, (8, -4, 0), (0.125, 0, -0.0625, 0, 0, 0), 2.0)
    only(found, penetration=1 / np.sqrt(5), complementarity=1.0, power_balance=1.0)


def test_sinking_into_what_crushes_is_allowed(weak: Line) -> None:
    """Four corners of 16 are worth 4 in it, of which the weight takes 2 and leaves 2 of 2."""
    found = of_block(weak, (8, -4, 0), (0.125, 0, -0.0625, 0, 0, 0), 2.0)
    only(found, complementarity=1.0, power_balance=1.0)


def test_the_largest_of_speeds_counts(dry: Line) -> None:
    """Turned about one edge: the other side opens, twice the mean, and nothing closes."""
    found = of_block(dry, (8, -4, 0), (0.25, 0, -0.5, 0, 1.0, 0), 2.0)
    assert found["penetration"] == pytest.approx(1.0)  # the right edge goes down by 1, the left one is at rest


def test_sliding_across_the_friction(dry: Line) -> None:
    only(of_block(dry, (8, 0, -4), SLIDES, 2.0), slip=1.0, complementarity=1.0, equilibrium=16 / 32)


def test_dilatancy_opens(dry: Line) -> None:
    """Opening by a quarter of the sliding, as the rule says: the weight takes 1 of the 2 that the friction does."""
    found = of_block(dry, (8, -4, 0), (0.125, 0, 0.03125, 0, 0, 0), 2.0, dilatancy=0.25)
    only(found)


def test_fixed_blocks_need_no_balance(dry: Line) -> None:
    model = replace(dry.model, fixed=np.array([True]))
    forces, cases = (
        on_ground(dry.model, dry.contacts, (0, 0, 0)),
        [LoadedModel(dry.model, dry.contacts, dry.load_case)] * 2,
    )
    cases[0] = replace(cases[0], model=model)
    vars(cases[0])["scale"] = cases[1].scale  # there is none of fixed blocks alone
    left = [case.unbalanced_loads(forces, 1.0) for case in cases]
    assert left[0].tolist() == [0.0]
    assert left[1][0] > 0.0


@pytest.mark.parametrize("share", [1.0, 1e-4, 1e-8])
def test_an_unbalanced_light_block_is_judged_by_its_own_weight(share: float) -> None:
    """Beside a heavy block that its forces carry: whatever its weight, the whole of it is unbalanced."""
    light = "  - box: {group: light, material: feather, min: [5, 0, 0], max: [6, 1, 1]}\n"
    text = BLOCK.replace("blocks:\n", f"blocks:\n{light}").replace(
        "stone: {density: 2000}", f"stone: {{density: 2000}}, feather: {{density: {2000 * share!r}}}"
    )
    line = line_of(text)
    weights, contacts = -line.load_case.dead_load[:, 2], line.contacts
    motion = np.zeros((2, 6))
    motion[:, 0] = 1.0 / line.load_case.live_load[:, 0].sum()
    heavy = (contacts.bodies[contacts.interface_of_point] == np.argmax(weights)).any(axis=1)
    carried = np.zeros((len(contacts.points), 3))
    carried[heavy, 0] = weights.max() / heavy.sum()
    found = residuals_of(
        LoadedModel(line.model, contacts, line.load_case), state(carried, motion, 0.0), np.zeros(len(heavy))
    )
    assert found.equilibrium == pytest.approx(1.0)
