"""Modes against closed forms, and what may not change them."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.assembly import build_assembly
from mbla.assembly.structure_at import StructureAt
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.solution.modes.find import modes_of
from mbla.solution.modes.modes import Modes
from mbla.solution.modes.rest import FALLS

DENSITY, STIFFNESS, RATIO = 2620.0, 1e9, 0.4

DECK = """mbla: 1
units: {units}
materials: {{stone: {{density: {density}}}}}
joints: {{bed: {joint}}}
blocks: [{blocks}]
contacts: {contacts}
supports: [{supports}]
{others}
load_cases: {{push: {{live: [{{acceleration: [1, 0, 1]}}]}}}}
"""
BED = f"{{friction: 0.7, stiffness: {{normal: {STIFFNESS}, ratio: {RATIO}}}}}"


def modes(
    folder: Path,
    blocks: str,
    count: int,
    joint: str = BED,
    units: str = "{}",
    density: float = DENSITY,
    supports: str = "{ground: {z: 0}}",
    others: str = "",
    contacts: str = "{joint: bed}",
) -> Modes:
    path = folder / "deck.yaml"
    given = {"units": units, "density": density, "joint": joint, "blocks": blocks, "supports": supports}
    path.write_text(DECK.format(**given, others=others, contacts=contacts))
    deck = read_deck(path)
    model = build_model(deck)
    return modes_of(StructureAt.as_built(build_assembly(deck, model), model.load_cases[0]), count)


def tower(count: int, sides: tuple[float, float, float], transform: str = "") -> str:
    """Blocks of one size on each other."""
    repeat = f", repeat: {{count: {count}, translate: [0, 0, {sides[2]}]}}" if count > 1 else ""
    return f"{{box: {{group: b, material: stone, min: [0, 0, 0], max: {list(sides)}{transform}{repeat}}}}}"


def rates(found: Modes) -> FloatArray:
    """ω, rad/s."""
    return np.asarray(2.0 * np.pi / found.periods)


def test_one_block_rocks_slides_and_bounces(tmp_path: Path) -> None:
    """m J ω⁴ − [m (k_r + k_h h²) + J k_h] ω² + k_h k_r = 0 in its plane, and √(k_v/m)."""
    found = modes(tmp_path, tower(1, (0.5, 1.0, 1.0)), 6)
    assert len(found) == 6
    mine = rates(found)[(found.masses[:, 0] > 1e-6) | (found.masses[:, 2] > 1e-6)]
    assert mine == pytest.approx([142.348, 617.802, 758.391], abs=5e-4)
    mass, area, arm = DENSITY * 0.5, 0.5, 0.5
    inertia, k_h, k_r = mass / 12 * 1.25, RATIO * STIFFNESS * area, STIFFNESS * area * 0.25 / 12
    squares = np.roots([mass * inertia, -(mass * (k_r + k_h * arm**2) + inertia * k_h), k_h * k_r])
    exact = sorted([*np.sqrt(squares), math.sqrt(STIFFNESS * area / mass)])
    assert mine == pytest.approx(exact, rel=1e-12)
    assert found.masses.sum(axis=0) == pytest.approx([1.0, 1.0, 1.0], rel=1e-12)
    assert found.moving == pytest.approx(np.full(3, mass))
    twist = rates(found)[found.masses.sum(axis=1) < 1e-12]
    polar, area_moment = mass * 1.25 / 12, (0.5 + 0.125) / 12
    assert twist == pytest.approx([math.sqrt(RATIO * STIFFNESS * area_moment / polar)], rel=1e-12)
    assert found.sag == pytest.approx(mass * 9.81 / (STIFFNESS * area), rel=1e-6)


@pytest.mark.parametrize("count", [1, 7, 90])
def test_a_chain_along_its_axis(tmp_path: Path, count: int) -> None:
    """ω_i = 2 √(k/m) sin((2i − 1) π/(4n + 2)); 90 blocks are beyond what is solved whole."""
    found = modes(tmp_path, tower(count, (0.5, 1.0, 0.5)), min(6 * count, 120))
    mine = np.sort(rates(found)[found.masses[:, 2] > 1e-12])[: 10 if count == 90 else None]
    number = np.arange(1, len(mine) + 1)
    k, mass = STIFFNESS * 0.5, DENSITY * 0.25
    exact = 2.0 * math.sqrt(k / mass) * np.sin((2 * number - 1) * math.pi / (4 * count + 2))
    assert mine == pytest.approx(exact, rel=1e-10)
    assert count == 90 or len(mine) == count


@pytest.mark.parametrize(("count", "off"), [(10, -0.092), (20, -0.048), (40, -0.025)])
def test_a_cantilever_bends(tmp_path: Path, count: int, off: float) -> None:
    """1.8751² √(EI/(ρ A L⁴)) where k_N = E/a and joints do not slip; a joint of its own at the foot makes it softer."""
    stiff = f"{{friction: 0.7, stiffness: {{modulus: {STIFFNESS}, thickness: 1, ratio: 1.e4}}}}"
    found = modes(tmp_path, tower(count, (0.5, 1.0, 1.0)), 1, stiff)
    bending = STIFFNESS * 0.5**3 / 12
    exact = 1.8751**2 * math.sqrt(bending / (DENSITY * 0.5 * count**4))
    assert rates(found)[0] / exact - 1.0 == pytest.approx(off, abs=1e-3)


WALL = "{wall: {group: wall, material: stone, unit: [0.4, 0.2, 0.2], length: 1.2, courses: 5, transform: [TURN]}}"


def test_periods_do_not_hang_on_where_a_wall_stands_and_in_which_units(tmp_path: Path) -> None:
    plain = modes(tmp_path, WALL.replace("TURN", "translate: [0, 0, 0]"), 12)
    for turn in ("rotate: {axis: [0, 0, 1], angle: 37}", "mirror: {normal: [1, 0, 0]}", "translate: [300, -20, 0]"):
        other = modes(tmp_path, WALL.replace("TURN", turn), 12)
        assert other.periods == pytest.approx(plain.periods, rel=1e-8)
        assert other.masses.sum() == pytest.approx(plain.masses.sum(), rel=1e-6)
    mm = WALL.replace("TURN", "scale: 1000")
    units, joint = "{length: mm, force: kN, mass: t}", BED.replace(str(STIFFNESS), str(STIFFNESS * 1e-12))
    small = modes(tmp_path, mm, 12, joint, units, DENSITY * 1e-12)
    assert small.periods == pytest.approx(plain.periods, rel=1e-8)
    assert small.masses == pytest.approx(plain.masses, abs=1e-6)
    assert small.moving == pytest.approx(plain.moving / 1000)


def test_blocks_that_are_glued_vibrate_as_one(tmp_path: Path) -> None:
    whole = modes(tmp_path, tower(1, (0.5, 1.0, 2.0)), 6)
    two = "{box: {group: low, material: stone, min: [0, 0, 0], max: [0.5, 1, 0.7]}}, "
    two += "{box: {group: high, material: stone, min: [0, 0, 0.7], max: [0.5, 1, 2]}}"
    mortar = "overrides: [{between: [low, high], joint: glued}]"
    glued = modes(tmp_path, two, 6, contacts=f"{{joint: bed, {mortar}}}")
    assert glued.periods == pytest.approx(whole.periods, rel=1e-9)
    assert glued.masses == pytest.approx(whole.masses, abs=1e-9)
    assert glued.shapes.shape == (6, 2, 6)


def test_a_mass_on_a_block_counts_where_it_is(tmp_path: Path) -> None:
    """As a mass at the top of a block that weighs next to nothing: ω² = k/m of its joint alone."""
    mass = "masses: [{on: b, mass: 1000, at: [0.25, 0.5, 1]}]"
    found = modes(tmp_path, tower(1, (0.5, 1.0, 1.0)), 3, density=1e-3, others=mass)
    area, k_r = 0.5, STIFFNESS * 0.5 * 0.25 / 12
    k_h = RATIO * STIFFNESS * area
    exact = math.sqrt(1.0 / (1000.0 * (1.0 / k_h + 1.0 / k_r)))
    assert rates(found)[0] == pytest.approx(exact, rel=1e-5)


def test_what_falls_has_no_modes_and_says_why(tmp_path: Path) -> None:
    leaning = tower(1, (0.5, 1.0, 1.0), ", transform: {rotate: {axis: [0, 1, 0], angle: 0}}")
    over = leaning + ", {box: {group: top, material: stone, min: [0.4, 0, 1], max: [1.4, 1, 2]}}"
    found = modes(tmp_path, over, 3)
    assert (len(found), found.reason) == (0, FALLS)


def test_without_friction_it_slides_at_no_frequency(tmp_path: Path) -> None:
    """Three motions without stiffness: along x and y, and about z; the others are modes."""
    found = modes(tmp_path, tower(1, (0.5, 1.0, 1.0)), 6, BED.replace("0.7", "0"))
    assert len(found) == 3
    assert found.loose.tolist() == [True]
    assert found.reason == ""


def test_a_guided_block_has_the_mode_that_its_guide_allows(tmp_path: Path) -> None:
    held = "{ground: {z: 0}}, {blocks: b, fixed: [x, y, rx, ry, rz]}"
    found = modes(tmp_path, tower(1, (0.5, 1.0, 1.0)), 6, supports=held)
    assert rates(found) == pytest.approx([math.sqrt(STIFFNESS / DENSITY)], rel=1e-10)
    assert found.masses == pytest.approx(np.array([[0.0, 0.0, 1.0]]))


def test_joints_are_next_to_rigid_by_default(tmp_path: Path) -> None:
    """k = W/(A 1e-6 s): the block sags by a millionth of its size."""
    found = modes(tmp_path, tower(1, (0.5, 1.0, 1.0)), 1, "{friction: 0.7}")
    assert found.sag == pytest.approx(1e-6 * 0.5 ** (1 / 3), rel=1e-6)
    assert found.default == pytest.approx(DENSITY * 0.5 * 9.81 / (0.5 * 1e-6 * 0.5 ** (1 / 3)))


def test_a_tie_that_is_stretched_holds_as_one_more_spring(tmp_path: Path) -> None:
    """As stiff as a contact point, a quarter of the joint: along x and about y, in one mode of a stocky block."""
    tie = "ties: [{{on: [b, ground], through: [[1, 0.5, 0.5], [3, 0.5, 0.5]], capacity: 1.e6{}}}]"
    block = tower(1, (1.0, 1.0, 1.0))
    free = modes(tmp_path, block, 6)
    slack, held = (modes(tmp_path, block, 6, others=tie.format(force)) for force in ("", ", prestress: 1000"))
    assert (slack.slack, held.slack) == (1, 0)
    assert slack.periods == pytest.approx(free.periods, rel=1e-9)
    mass, k_h, k_r = DENSITY, RATIO * STIFFNESS, STIFFNESS / 12
    stiffness = np.array([[k_h + STIFFNESS / 4, -k_h / 2], [-k_h / 2, k_h / 4 + k_r]])
    squares = np.linalg.eigvals(np.diag([1.0 / mass, 6.0 / mass]) @ stiffness)
    mine = rates(held)[held.masses[:, 0] > 1e-6]
    assert mine == pytest.approx(np.sqrt(np.sort(squares)), rel=1e-9)
