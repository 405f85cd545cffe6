"""Slopes of the load factor: closed forms, differences of full solutions on random decks, what is said and refused."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from random import Random

import pytest

from mbla.solution.further.sensitivity.slopes import Side, Slope
from mbla.solution.solution import Status
from tests.decks.folder import ROOT
from tests.line import BLOCK, WALL, case_of
from tests.solution.further.sensitivity.differences import STEP, differences, random_text, tied_text

LAW, OF_GAP = 1e-5, 5.0
"""Share of the load factor over the parameter, or of the slope, that is exact; in space and where joints crush
mechanisms are good to a few times the square root of the gap of the bounds."""


def slopes_of(text: str, *overrides: str, flow_rule: str = "associative", keys: str = "true") -> dict[str, Slope]:
    """Slopes of a deck by parameter."""
    analysis = f"{{flow_rule: {flow_rule}, accuracy: reference, sensitivity: {keys}}}"
    text = text.replace("analysis: {flow_rule: associative}", f"analysis: {analysis}")
    _, case = case_of(text, *overrides)
    return {slope.parameter: slope for slope in case.solution.further.sensitivity}


def near(slope: Slope, value: float, elasticity: float) -> bool:
    return (slope.slope, slope.elasticity) == pytest.approx((value, elasticity), rel=1e-7, abs=1e-8)


def test_block_that_slides() -> None:
    found = slopes_of(BLOCK, "parameters.h=0.5", "parameters.c=1000")
    weight = 2000 * 9.81 * 0.5
    factor = 0.5 + 1000 / weight
    assert near(found["joints.dry.friction"], 1.0, 0.5 / factor)
    assert near(found["joints.dry.cohesion"], 1 / weight, 1 - 0.5 / factor)
    assert near(found["joints.dry.tensile_strength"], 0.0, 0.0)
    assert found["joints.dry.tensile_strength"].side is Side.ABOVE
    assert near(found["materials.stone.density"], -1000 / weight / 2000, -(1 - 0.5 / factor))
    assert near(found["dead load"], 0.5, 0.5 / factor)
    assert near(found["live load"], -factor, -1.0)


def test_block_that_rocks() -> None:
    found = slopes_of(BLOCK, "parameters.h=4", keys="[parameters.b, parameters.h, blocks.0.box.max.1]")
    assert near(found["parameters.b"], 1 / 4, 1.0)
    assert near(found["parameters.h"], -1 / 16, -1.0)
    assert near(found["blocks.0.box.max.1"], 0.0, 0.0)
    assert found["blocks.0.box.max.1"].unit == "m"


def test_mortar_without_cohesion_gains_by_it() -> None:
    """A block of height h with cohesion c slides at μ + c/(ρ g h)."""
    found = slopes_of(BLOCK, "parameters.h=0.5")["joints.dry.cohesion"]
    assert near(found, 1 / (2000 * 9.81 * 0.5), 0.0)
    assert found.side is Side.ABOVE


def test_a_friction_angle_counts_in_degrees() -> None:
    text = BLOCK.replace('friction: "=mu"', "friction_angle: 20")
    found = slopes_of(text, "parameters.h=0.5")["joints.dry.friction_angle"]
    assert found.unit == "degree"
    assert found.slope == pytest.approx((1 + 0.36397023**2) * 3.14159265 / 180, rel=1e-7)


def test_joint_laws_by_key_and_by_parameter_are_the_same() -> None:
    found = slopes_of(WALL, keys="[joints.dry.friction, parameters.mu]")
    assert found["joints.dry.friction"].slope == pytest.approx(found["parameters.mu"].slope, rel=1e-7)


def test_slopes_do_not_depend_on_units() -> None:
    small = WALL.replace("mbla: 1", "mbla: 1\nunits: {length: mm}").replace("0.4, 0.2, 0.175", "400, 200, 175")
    small = small.replace("density: 2000", "density: 2.e-6").replace('"=0.4*n"', '"=400*n"')
    one, other = slopes_of(WALL, "parameters.mu=0.4"), slopes_of(small, "parameters.mu=0.4")
    assert [each.elasticity for each in one.values()] == pytest.approx(
        [each.elasticity for each in other.values()], abs=1e-7
    )


TOP = '  - box: {group: top, material: stone, min: [0, 0, "=h"], max: ["=w", 1, "=h+4"]}\nsupports:'


def test_a_kink_has_two_slopes() -> None:
    """A block of width w and height 4 rocks about its own edge, or about that of a block of width 1 below it."""
    text = BLOCK.replace("supports:", TOP).replace("ft: 0", "ft: 0, w: 1")
    text = text.replace("[1, 0, 0]}]", "[1, 0, 0], on: top}]").replace("{ground: {z: 0}}", "{blocks: block}")
    found = slopes_of(text, "parameters.mu=2", keys="[parameters.w]")["parameters.w"]
    assert found.side is Side.KINK
    assert near(found, -0.25, -1.0)
    assert found.remark == "below 0.25"


def test_one_sided_where_the_deck_ends() -> None:
    """The friction cone ends at the tension c/μ, beyond which there is no joint law."""
    at_apex = ("parameters.h=4", "parameters.c=1000", "parameters.ft=2000")
    laws = "joints.dry.cohesion, joints.dry.tensile_strength, joints.dry.friction"
    found = slopes_of(BLOCK, *at_apex, keys=f"[parameters.c, parameters.ft, parameters.mu, {laws}]")
    sides = (Side.ABOVE, Side.BELOW, Side.BELOW)
    assert tuple(each.side for each in found.values()) == (*sides, *sides)
    own = [each.slope for each in found.values()]
    assert own[:3] == pytest.approx(own[3:], rel=1e-7, abs=1e-9)


def test_one_sided_where_blocks_come_to_it() -> None:
    """A wall that is longer than whole units has a piece of a unit more."""
    found = slopes_of(WALL, keys="[blocks.0.wall.length]")["blocks.0.wall.length"]
    assert near(found, 0.0, 0.0)
    assert (found.side, found.remark) == (Side.BELOW, "on the other side another number of blocks")


def test_not_known_where_no_change_is_possible() -> None:
    """Less friction than dilatancy, or more than cohesion over tensile strength, is no joint law."""
    text = BLOCK.replace("tensile_strength:", 'dilatancy: "=atan(0.5)", tensile_strength:')
    at_apex = ("parameters.h=4", "parameters.c=1000", "parameters.ft=2000")
    found = slopes_of(text, *at_apex, keys="[parameters.mu]")["parameters.mu"]
    assert found.side is Side.NONE
    assert found.slope != found.slope
    assert found.remark


def test_ties() -> None:
    """λ W h/2 = W b/2 + T h_t + C h_s: a wall that overturns about its toe, with two rods and a strut."""
    text = (ROOT / "decks/benchmarks/closed_forms/tied_wall.yaml").read_text(encoding="utf-8")
    moment, rods = 15696 * 2 / 2, math.pi / 4 * 0.012**2 * 235e6
    factor = (15696 * 0.4 / 2 + rods * 1.8 + 5000) / moment
    usual = slopes_of(text, flow_rule="associative")
    for name, slope, share in (("rod[0]", 1.8 / moment, 0.9 * rods / moment), ("strut[0]", 1 / moment, 5000 / moment)):
        assert near(usual[f"tie {name}"], slope, share / factor)
    assert near(usual["dead load"], 0.2, 0.2 / factor)
    own = slopes_of(text, keys="[parameters.ht, parameters.d, ties.1.capacity]")
    assert near(own["parameters.ht"], rods / moment, 1.8 * rods / moment / factor)
    assert near(own["parameters.d"], 2 / 0.012 * rods * 1.8 / moment, 2 * rods * 1.8 / moment / factor)
    assert near(own["ties.1.capacity"], 1 / moment, 5000 / moment / factor)


@pytest.mark.parametrize("way", [1, -1])
def test_a_bar_that_takes_both(way: int) -> None:
    """λ W h/2 = W b/2 + C z whichever way it overturns: both limits of a bar are its capacity."""
    bar = "{name: bar, through: [[1, 0.5, 1.6], [3, 0.5, 1.6]], on: [block, ground], capacity: 800, acts: both}"
    text = BLOCK.replace("load_cases:", f"ties: [{bar}]\nload_cases:")
    text = text.replace("acceleration: [1, 0, 0]", f"acceleration: [{way}, 0, 0]")
    weight = 2000 * 9.81 * 4
    factor = 1 / 4 + 800 * 1.6 / (weight * 2)
    found = slopes_of(text, "parameters.h=4", "parameters.mu=2")["tie bar[0]"]
    assert near(found, 1.6 / (weight * 2), 1 - 1 / 4 / factor)
    assert found.side is Side.BOTH


def miss_of(text: str, slope: Slope, found: float, factor: float, step: float) -> float:
    """By how much a slope lies outside of the differences to both sides; 0 where a solution nearby is not solved."""
    sides = differences(text, slope, factor, step)
    if sides is None:
        return 0.0
    least, most = sorted([sides.below, sides.above])
    return max(0.0, least - found, found - most)


@pytest.mark.parametrize(
    "seed", [pytest.param(seed, marks=pytest.mark.trust if seed % 8 else pytest.mark.long) for seed in range(64)]
)
def test_random_ties(seed: int) -> None:
    """Slopes by the strength of each tie, summed up over its lines, lie between the differences to both sides.

    Where the load factor bends within the step, a tenth of the step tells.
    """
    text = tied_text(seed)
    _, case = case_of(text)
    assert case.status is Status.SOLVED
    assert case.solution.associative is not None
    factor = case.solution.associative.load_factor
    for number, value in enumerate(re.findall(r"s\d: ([\d.]+)", text)):
        own = [each for each in case.solution.further.sensitivity if each.parameter.startswith(f"tie t{number}[")]
        share = sum(each.elasticity for each in own)
        slope = replace(own[0], parameter=f"parameters.s{number}", value=float(value))
        found, room = share * factor / float(value), LAW * factor / float(value)
        assert any(miss_of(text, slope, found, factor, step) <= room for step in (STEP, STEP / 10))


def test_without_dilatancy_they_are_of_the_associative_factor() -> None:
    found = slopes_of(BLOCK, "parameters.h=4", flow_rule="non_associative", keys="[parameters.h]")
    assert near(found["parameters.h"], -1 / 16, -1.0)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("live: [{acceleration: [1, 0, 0]}]", "settlement: {on: block, direction: [0, 0, -1]}"), "settling support"),
        (('cohesion: "=c"', "cohesion: 0"), ""),
    ],
)
def test_what_has_no_slope_says_so(change: tuple[str, str], words: str) -> None:
    text = BLOCK.replace(*change).replace("flow_rule: associative", "flow_rule: associative, sensitivity: true")
    if words:
        text = text.replace(
            "supports:",
            "  - box: {group: top, material: stone, min: [0, 0, 2], max: [1, 1, 4]}\nsupports:",
        ).replace("supports: [{ground: {z: 0}}]", "supports: [{blocks: block}]")
    _, case = case_of(text)
    said = [remark.words for remark in case.solution.remarks if remark.identifier == "sensitivity-not-done"]
    assert bool(said) == bool(words)
    assert all(words in text for text in said)
    assert bool(case.solution.further.sensitivity) != bool(words)


@pytest.mark.every(2)
@pytest.mark.parametrize("seed", [0, 1])
def test_random_decks(seed: int) -> None:
    compare(seed)


@pytest.mark.parametrize(
    "seed", [pytest.param(seed, marks=pytest.mark.trust if seed % 8 else pytest.mark.long) for seed in range(200)]
)
def test_many_random_decks(seed: int) -> None:
    compare(seed)


def compare(seed: int) -> None:
    """Every slope of a random deck lies between the differences to both sides, which mostly agree."""
    text = random_text(seed)
    _, case = case_of(text)
    mechanics = case.solution.mechanics
    if case.status is not Status.SOLVED or mechanics is None:
        pytest.skip("not solved")
    assert case.solution.further.sensitivity
    law = max(LAW, OF_GAP * case.checks.gap**0.5)
    for slope in Random(seed).sample(case.solution.further.sensitivity, 3):
        found = differences(text, slope, mechanics.load_factor)
        if found is None:
            continue
        least, most = sorted([found.below, found.above])
        room = law * max(abs(least), abs(most), abs(mechanics.load_factor / slope.value))
        assert least - room <= slope.slope <= most + room, (slope, found)
