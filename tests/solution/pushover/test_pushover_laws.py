"""Laws that every pushover keeps: energy, invariance under rigid motion, glue, debris, statics of what settles."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest

from mbla.results.listing.sections.pushover import energy_missing
from mbla.results.outcome import ultimate_displacement
from mbla.results.results import CaseResult
from mbla.solution.pushover.curve_rows import CurveEnd
from mbla.solution.solution import Status
from tests.asked import settlement_of
from tests.line import case_of
from tests.solution.pushover.test_pushover import DECKS, columns

HEAD = "mbla: 1\nmaterials: {stone: {density: 2000}}\n"


def random_deck(seed: int) -> str:
    """A wall in running bond, an arch, a leaning column or a block on a slab, pushed by small steps."""
    pick = random.Random(seed)
    friction, kind, ground = pick.uniform(0.3, 0.9), seed % 4, 0.0
    if kind == 0:
        height, length, courses = pick.uniform(0.12, 0.3), pick.choice([1.6, 2.0, 2.4]), pick.randint(3, 7)
        unit = f"[0.4, 0.2, {height:.4f}]"
        items = [f"wall: {{material: stone, unit: {unit}, length: {length}, courses: {courses}}}"]
        step = height * courses / 400
    elif kind == 1:
        friction, thickness, voussoirs = pick.uniform(0.5, 0.9), pick.uniform(0.3, 0.6), pick.randint(5, 15)
        shape = f"shape: semicircular, span: 4, thickness: {thickness:.4f}, width: 0.5, voussoirs: {voussoirs}"
        items, step = [f"arch: {{material: stone, {shape}}}"], 0.0005
    elif kind == 2:
        shifts = [0.02 * row * pick.uniform(-1, 1) for row in range(pick.randint(2, 6))]
        corners = [
            f"min: [{x:.4f}, 0, {0.4 * z:.1f}], max: [{x + 0.5:.4f}, 0.5, {0.4 * z + 0.4:.1f}]"
            for z, x in enumerate(shifts)
        ]
        items, step = [f"box: {{material: stone, {each}}}" for each in corners], 0.0025
    else:
        width, height = pick.uniform(0.2, 1.0), pick.uniform(0.4, 1.5)
        corners = [f"min: [0, 0, 0], max: [{width:.4f}, 0.5, {height:.4f}]", "min: [0.05, 0, -0.3], max: [2, 0.5, 0]"]
        items, step, ground = [f"box: {{material: stone, {each}}}" for each in corners], 0.0025, -0.3
    blocks = "".join(f"  - {item}\n" for item in items)
    steps = pick.choice([10, 20, 40])
    return (
        f"{HEAD}joints: {{dry: {{friction: {friction:.4f}}}}}\nblocks:\n{blocks}contacts: {{joint: dry}}\n"
        f"supports: [{{ground: {{z: {ground}}}}}]\n"
        f"load_cases: {{push: {{live: [{{acceleration: [1, 0, 0]}}], pushover: {{step: {step}, steps: {steps}}}}}}}\n"
    )


def pushed_case(text: str, *overrides: str) -> CaseResult:
    """The first load case of a deck, as a run gives it."""
    return case_of(text, *overrides)[1]


SPREADING = (DECKS / "tutorials" / "arch_that_spreads.yaml").read_text(encoding="utf-8")


def length_of(seed: int) -> tuple[pytest.MarkDecorator, ...]:
    """Two seeds are short, ten of all kinds long, the others full checks."""
    return () if seed % 25 == 0 else (pytest.mark.long if seed % 5 == 1 else pytest.mark.trust,)


@pytest.mark.parametrize("seed", [pytest.param(seed, marks=length_of(seed)) for seed in range(50)])
def test_live_work_is_friction_and_what_the_dead_load_gained(seed: int) -> None:
    """On random structures; what is missing is the work of gaps that close, of first order in the step."""
    case = pushed_case(random_deck(seed))
    assert case.status is Status.SOLVED
    curve = case.solution.further.pushover.curve
    assert len(curve) > 10 or case.solution.further.pushover.curve_end is CurveEnd.NOTHING_LEFT
    assert abs(energy_missing(curve)) < 0.01
    assert max(row.residual for row in curve[1:]) < 1e-4  # as built joints are elastic
    assert np.diff([row.friction for row in curve]).min() > -1e-6 * abs(curve[-1].live_work)


@pytest.mark.parametrize("seed", [pytest.param(0, marks=pytest.mark.long), 1])
def test_a_rigid_motion_of_everything_changes_nothing(seed: int) -> None:
    text = random_deck(seed)
    item = "{translate: [3, -2, 0]}]}"
    turned = text.replace("}\ncontacts", f", transform: [{{rotate: {{axis: [0, 0, 1], angle: 37}}}}, {item}\ncontacts")
    across = math.cos(math.radians(37)), math.sin(math.radians(37))
    turned = turned.replace("acceleration: [1, 0, 0]", f"acceleration: [{across[0]:.15f}, {across[1]:.15f}, 0]")
    own, other = (columns(pushed_case(each).solution.further.pushover.curve) for each in (text, turned))
    assert turned.count("rotate") == 1
    assert other[0] == pytest.approx(own[0], rel=1e-5)
    assert other[1] == pytest.approx(own[1], rel=1e-5)


def test_glued_blocks_are_one() -> None:
    """A block in three pieces that are glued to each other rocks as the whole one does."""
    piece = "  - box: {{material: stone, min: [0, 0, {}], max: [0.2, 0.5, {}]}}\n"
    pieces = "".join(piece.format(z, z + 0.25) for z in (0, 0.25, 0.5, 0.75))
    text = (
        f"{HEAD}joints: {{dry: {{friction: 0.8}}}}\nblocks:\n{pieces}"
        "contacts: {joint: dry, overrides: [{joint: glued, orientation: bed, box: [[-1, -1, 0.1], [1, 1, 1]]}]}\n"
        "supports: [{ground: {z: 0}}]\n"
        "load_cases: {push: {live: [{acceleration: [1, 0, 0]}], pushover: {step: 0.005}}}\n"
    )
    case = pushed_case(text)
    moved, factors = columns(case.solution.further.pushover.curve)
    alpha, radius = math.atan(0.2), math.hypot(0.2, 1.0) / 2
    assert case.solution.further.pushover.curve_end is CurveEnd.NOTHING_LEFT
    assert factors == pytest.approx(np.tan(np.arcsin(np.sin(alpha) - moved / radius)), abs=1e-5)


@pytest.mark.long
def test_the_thrust_of_an_arch_that_spreads_is_that_of_statics() -> None:
    """W x / z of a half as it lies, its hinges as far apart as the span has grown."""
    case = pushed_case(SPREADING)
    half, centroid = 3384.45, (0.42173913, 0.57826087)
    rows = case.solution.further.pushover.curve
    spread = np.array([row.displacement for row in rows])
    across = 1.0 + spread / 2
    up = np.sqrt(1.0 + 1.3**2 - across**2)
    turned = np.arctan2(1.3, 1.0) - np.arctan2(up, across)
    lever = centroid[0] * np.cos(turned) + centroid[1] * np.sin(turned)
    thrust = np.array([row.reaction for row in rows])
    assert thrust == pytest.approx(half * lever / up, rel=5e-4)
    assert thrust[0] == pytest.approx(half * lever[0] / up[0], rel=1e-6)
    errors = np.array([row.error for row in rows]) * settlement_of(case.load_case).unit / thrust
    assert np.nanmax(errors) < 1e-5
    assert max(row.residual for row in rows[1:]) < 1e-5


@pytest.mark.long
def test_a_support_is_followed_until_nothing_is_carried() -> None:
    """The two halves fall between their supports before these are as far apart as both halves are long.

    With friction as stone has it: a friction of 10 hooks the halves into each other once they fold.
    """
    further = "load_cases.spreads.settlement.amount=3", "load_cases.spreads.settlement.step=0.02"
    case = pushed_case(SPREADING, *further, "joints.dry.friction=1")
    assert case.solution.further.pushover.curve_end is CurveEnd.NOT_CARRIED
    assert 0.9 < case.solution.further.pushover.curve[-1].displacement < 2.0 * math.hypot(1.0, 1.3) - 2.0


@pytest.mark.long
def test_what_falls_alone_is_left_out() -> None:
    """A plank between a block that rocks and a post drops as the block leaves it; that rocks on by its closed form."""
    text = (
        f"{HEAD}joints: {{dry: {{friction: 0.8}}}}\nblocks:\n"
        "  - box: {group: tall, material: stone, min: [0, 0, 0], max: [0.2, 0.5, 1]}\n"
        "  - box: {group: post, material: stone, min: [0.9, 0, 0], max: [1.2, 0.5, 1]}\n"
        "  - box: {group: plank, material: stone, min: [0.15, 0, 1], max: [0.95, 0.5, 1.02]}\n"
        "contacts: {joint: dry}\nsupports: [{ground: {z: 0}}, {blocks: post}]\n"
        "load_cases: {push: {live: [{acceleration: [-1, 0, 0]}], pushover: {step: 0.004, control: {on: tall}}}}\n"
    )
    case = pushed_case(text)
    assert case.solution.further.pushover.curve[-1].debris == 1
    assert case.solution.further.pushover.curve_end is CurveEnd.NOTHING_LEFT
    alpha, radius = math.atan(0.2), math.hypot(0.2, 1.0) / 2
    alone = [row for row in case.solution.further.pushover.curve if row.debris]
    moved, factors = columns(tuple(alone))
    assert len(alone) > 10
    assert factors == pytest.approx(np.tan(np.arcsin(np.sin(alpha) - moved / radius)), abs=1e-3)


def test_the_normal_is_that_of_the_face_stood_on() -> None:
    """A beam on two piers, one of which sinks: its face on the edge of one, its own edge on the face of the other."""
    text = (
        f"{HEAD}joints: {{dry: {{friction: 0.6}}}}\ncontacts: {{joint: dry}}\nsupports: [{{blocks: pier}}]\nblocks:\n"
        "  - box: {group: pier, material: stone, min: [0, 0, -0.5], max: [0.5, 0.5, 0]}\n"
        "  - box: {group: pier, material: stone, min: [1.5, 0, -0.5], max: [2, 0.5, 0]}\n"
        "  - box: {group: beam, material: stone, min: [0, 0, 0], max: [2, 0.5, 0.3]}\nload_cases:\n"
        "  sinks: {settlement: {on: {group: pier, index: 1}, direction: [0, 0, -1], amount: 0.25, step: 0.01}}\n"
    )
    case = pushed_case(text)
    weight = 2000 * 2 * 0.5 * 0.3 * 9.81
    # about the edge of the left pier: W (0.5 cos + 0.15 sin) = R 1.5 cos + 0.6 R u, as its end slides on the right one
    sunk = np.array([row.displacement for row in case.solution.further.pushover.curve])
    turned = np.arcsin(sunk / 1.5)
    cos, sin = np.cos(turned), np.sin(turned)
    closed = weight * (0.5 * cos + 0.15 * sin) / (1.5 * cos + 0.6 * sunk)
    reaction = np.array([row.reaction for row in case.solution.further.pushover.curve])
    assert reaction == pytest.approx(closed, rel=3e-6)


@pytest.mark.parametrize("breadth", [0.6, pytest.param(1.0, marks=pytest.mark.long)])
def test_a_block_tips_on_a_narrow_base_as_on_a_wide_one(breadth: float) -> None:
    """By a moment about its edge, until its centre of gravity is above it, whatever the friction."""
    inside = (1.0 - breadth) / 2
    text = (
        f"{HEAD}joints: {{dry: {{friction: 0.3}}}}\ncontacts: {{joint: dry}}\nsupports: [{{blocks: base}}]\nblocks:\n"
        f"  - box: {{group: base, material: stone, min: [-0.2, {inside}, 0], max: [1.2, {1 - inside}, 0.5]}}\n"
        "  - box: {group: cube, material: stone, min: [0, 0, 0.5], max: [1, 1, 1.5]}\nload_cases:\n"
        "  tips:\n    live: [{moment: [0, 1000, 0], on: cube}]\n"
        "    pushover: {step: 0.05, control: {on: cube, direction: [1, 0, 0]}}\n"
    )
    case = pushed_case(text)
    assert case.solution.further.pushover.curve_end is CurveEnd.NOTHING_LEFT
    assert ultimate_displacement(case) == pytest.approx(0.5, rel=1e-3)


WALLS = (
    f"{HEAD}joints: {{dry: {{friction: 0.6}}}}\ncontacts: {{joint: dry}}\nblocks:\n"
    "  - box: {group: a, material: stone, min: [0, 0, 0], max: [0.2, 0.5, 1]}\n"
    "  - box: {group: b, material: stone, min: [0.22, 0, 0], max: [0.62, 0.5, 1]}\n"
)
"""Two walls 20 mm apart."""


def test_a_control_point_that_does_not_move_is_said() -> None:
    push = "load_cases: {one: {live: [{acceleration: [1, 0, 0], on: a}], pushover: {step: 0.005, control: {on: b}}}}\n"
    solution = pushed_case(f"{WALLS}supports: [{{ground: {{z: 0}}}}]\n{push}").solution
    assert not solution.further.pushover.curve
    assert "the control point does not move" in solution.remarks[-1].words


@pytest.mark.long
def test_blocks_that_meet_do_not_overlap() -> None:
    """A wall that rocks against its neighbour, and both as one from there on, or none where the neighbour is fixed."""
    push = "load_cases: {all: {live: [{acceleration: [1, 0, 0]}], pushover: {step: 0.005, control: {on: a}}}}\n"
    free = pushed_case(f"{WALLS}supports: [{{ground: {{z: 0}}}}]\n{push}").solution.further.pushover
    assert max(row.overlap for row in free.curve) < 1e-4
    assert max(row.load_factor for row in free.curve) > 1.5 * free.curve[0].load_factor
    assert abs(energy_missing(free.curve)) < 2e-3  # joints are pressed
    one = push.replace("[1, 0, 0]}", "[1, 0, 0], on: a}")
    held = pushed_case(f"{WALLS}supports: [{{ground: {{z: 0}}}}, {{blocks: b}}]\n{one}").solution.further.pushover
    assert held.curve_end is CurveEnd.BLOCKED
    assert max(row.load_factor for row in held.curve if row.displacement < 0.0099) <= held.curve[0].load_factor
    assert held.curve[-1].displacement < 0.0201  # its foot slides on while its top is held, and joints are pressed
    assert held.curve[-1].load_factor > 5.0 * held.curve[0].load_factor


@pytest.mark.long
def test_the_error_is_of_the_size_of_the_change_with_the_step() -> None:
    """On an arch whose hinges move; at the end of its curve no longer step is known."""
    arch = "arch: {material: stone, shape: semicircular, span: 4, thickness: 0.5, width: 0.5, voussoirs: 9}"
    text = (
        f"{HEAD}joints: {{dry: {{friction: 0.8}}}}\nblocks:\n  - {arch}\ncontacts: {{joint: dry}}\n"
        "supports: [{ground: {z: 0}}]\nload_cases:\n"
        "  push: {live: [{acceleration: [1, 0, 0]}], pushover: {step: 0.004, until: 0.04, error: true}}\n"
    )
    coarse = pushed_case(text).solution.further.pushover.curve
    fine = pushed_case(text, "load_cases.push.pushover.step=0.0005").solution.further.pushover.curve
    exact = np.interp([row.displacement for row in coarse], *columns(fine))
    missed = np.abs([row.load_factor for row in coarse] - exact)
    claimed = np.array([row.error for row in coarse])
    known = np.isfinite(claimed)
    assert known.sum() >= len(coarse) // 2 - 1  # where a step of twice the size ends
    assert missed[known].max() < 2.0 * claimed[known].max()
    assert claimed[known].max() < 10.0 * missed[known].max()


@pytest.mark.long
def test_a_guided_slab_goes_along() -> None:
    """A slab that slides up and down only, on a block that rocks under it: its weight and friction at the corner."""
    text = (
        f"{HEAD}joints: {{dry: {{friction: 0.8}}}}\ncontacts: {{joint: dry}}\nblocks:\n"
        "  - box: {group: block, material: stone, min: [0, 0, 0], max: [0.2, 0.5, 1]}\n"
        "  - box: {group: slab, material: stone, min: [-0.1, 0, 1], max: [0.3, 0.5, 1.1]}\n"
        "supports: [{ground: {z: 0}}, {blocks: slab, slide: [0, 0, 1]}]\n"
        "load_cases: {push: {live: [{acceleration: [1, 0, 0], on: block}], pushover: {step: 0.004, until: 0.1}}}\n"
    )
    solution = pushed_case(text).solution
    moved, factors = columns(solution.further.pushover.curve)
    alpha, radius = math.atan(0.2), math.hypot(0.2, 1.0) / 2
    turned = alpha - np.arcsin(np.sin(alpha) - moved / radius)
    cos, sin = np.cos(turned), np.sin(turned)
    slab = 0.2 * (0.2 * cos - sin + 0.8 * (cos + 0.2 * sin))
    assert factors == pytest.approx((0.1 * cos - 0.5 * sin + slab) / (0.5 * cos + 0.1 * sin), rel=1e-4)


@pytest.mark.long
def test_a_panel_held_at_its_head_bows_until_its_middle_is_out_by_its_thickness() -> None:
    """Two halves that turn by as much against each other, the upper one along a smooth stop: from 4 t/h to nothing."""
    thick, high = 0.2, 3.0
    text = (
        f"{HEAD}joints: {{dry: {{friction: 0.8}}}}\nblocks:\n"
        f"  - box: {{group: low, material: stone, min: [0, 0, 0], max: [{thick}, 0.5, {high / 2}]}}\n"
        f"  - box: {{group: high, material: stone, min: [0, 0, {high / 2}], max: [{thick}, 0.5, {high}]}}\n"
        f"  - box: {{group: stop, material: stone, min: [{thick}, 0, {high - 0.01}], max: [0.4, 0.5, {high + 0.5}]}}\n"
        "contacts: {joint: dry, overrides: [{joint: frictionless, between: [high, stop]}]}\n"
        "supports: [{ground: {z: 0}}, {blocks: stop}]\n"
        "load_cases: {push: {live: [{acceleration: [1, 0, 0]}], pushover: {step: 0.002}}}\n"
    )
    case = pushed_case(text)
    steps = case.solution.further.pushover.rows
    assert steps is not None
    turned = np.array([pose.rotation_vectors[0, 1] for pose in steps.poses])
    cos, sin = np.cos(turned), np.sin(turned)
    closed = (2 * thick * cos - high * sin) / (high / 2 * cos + thick * sin)
    assert steps.load_factors == pytest.approx(closed, abs=0.015 * closed[0])  # held 10 mm lower
    assert steps.load_factors[0] == pytest.approx(4 * thick / high, rel=0.01)
    middle = thick - thick * cos + high / 2 * sin
    assert middle[-1] == pytest.approx(thick, abs=0.006)


@pytest.mark.long
def test_a_half_with_its_plane_of_symmetry_moves_as_the_whole() -> None:
    """A wall pushed out of its plane, by steps that follow on from symmetric ones."""
    head = (
        f"{HEAD}joints: {{dry: {{friction: 0.7}}}}\ncontacts: {{joint: dry}}\nsupports: [{{ground: {{z: 0}}}}]\n"
        "load_cases:\n  push:\n    live: [{acceleration: [0, 1, 0]}]\n"
        "    pushover: {step: 0.01, steps: 4, control: {on: wall}}\n"
    )
    item = "blocks: [{{wall: {{group: wall, material: stone, unit: [0.8, 0.3, 0.4], length: {}, courses: 4}}}}]\n"
    cut = "[{group: wall, course: 1, unit: 2}, {group: wall, course: 3, unit: 2}]"
    whole = pushed_case(head + item.format(3.2)).solution.further.pushover
    half = pushed_case(head + item.format(1.6) + f"symmetry: [{{x: 1.6, halves: {cut}}}]\n").solution.further.pushover
    assert columns(half.curve)[0] == pytest.approx(columns(whole.curve)[0], rel=2e-3)
    assert columns(half.curve)[1] == pytest.approx(np.interp(columns(half.curve)[0], *columns(whole.curve)), rel=1e-4)


def test_fill_pushes_on_the_way_it_pushes_as_built() -> None:
    """A block that rocks away from soil on its sloping side: weights act straight down, the active push is level."""
    text = (
        f"{HEAD}joints: {{dry: {{friction: 3}}}}\ncontacts: {{joint: dry}}\nsupports: [{{ground: {{z: 0}}}}]\nblocks:\n"
        "  - polyhedron:\n      group: a\n      material: stone\n"
        "      vertices: [[0, 0, 0], [1, 0, 0], [0, 0, 2], [0, 0.5, 0], [1, 0.5, 0], [0, 0.5, 2]]\n"
        "      faces: [[0, 1, 2], [3, 5, 4], [0, 3, 4, 1], [1, 4, 5, 2], [2, 5, 3, 0]]\n"
        "load_cases: {c: {live: [{acceleration: [-1, 0, 0], on: a}], pushover: {step: 0.01, until: 0.1}}}\n"
        "fill: {f: {on: a, material: soil, level: 2, passive: {}}}\n"
    ).replace("stone: {density: 2000}", "stone: {density: 2000}, soil: {density: 1500}")
    model, case = case_of(text)
    asked, loads = case.load_case.pushover, case.load_case
    assert asked is not None
    weight, push = -float(loads.dead_load[0, 2]), -float(model.ties.greatest[0])
    place = model.ties.places[0]
    x, _, z = model.blocks.centroids[0] - asked.dead_levers[0].reshape(3, 3)[:, 2] / weight  # of block and soil
    for row in case.solution.further.pushover.curve:
        turned = np.linspace(0.0, 0.5, 50001)  # about the edge at the origin
        turn = float(np.interp(row.displacement, x - (x * np.cos(turned) - z * np.sin(turned)), turned))
        cos, sin = np.cos(turn), np.sin(turn)
        holds = weight * (x * cos - z * sin) - push * (place[0] * sin + place[2] * cos)
        assert row.load_factor == pytest.approx(holds / (weight * (x * sin + z * cos)), rel=2e-4)


def test_what_a_support_carries_along_loads_it_all_the_way() -> None:
    """A block on a table that sinks, with nothing else to hold it: no joint gives, and the reaction is its weight."""
    blocks = (
        "blocks:\n  - box: {group: table, material: stone, min: [0, 0, 0], max: [1, 1, 0.2]}\n"
        "  - box: {material: stone, min: [0.2, 0.2, 0.2], max: [0.7, 0.7, 0.7]}\n"
    )
    sinks = "{on: table, direction: [0, 0, -1], amount: 0.1, step: 0.05, error: false}"
    case = pushed_case(
        f"{HEAD}joints: {{dry: {{friction: 0.5}}}}\n{blocks}contacts: {{joint: dry}}\nsupports: [{{blocks: table}}]\n"
        f"load_cases: {{c: {{settlement: {sinks}}}}}\n"
    )
    assert case.solution.further.pushover.curve_end is CurveEnd.REACHED
    reactions = [row.reaction for row in case.solution.further.pushover.curve]
    assert reactions == pytest.approx([2000 * 9.81 * 0.125] * len(reactions), rel=1e-6)
