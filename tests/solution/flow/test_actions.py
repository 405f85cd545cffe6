"""The path under every kind of load, held in every way: closed forms, and words where there is no figure."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.questions.tilt import chord
from mbla.solution.associative.solve_associative import AssociativeResult, solve_associative
from mbla.solution.flow.path_of_part import path_of_part
from mbla.solution.flow.path_record import Stop
from mbla.solution.flow.settings import PathSettings
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from tests.asked import tilt_of
from tests.decks.folder import BENCHMARKS, PATHS
from tests.line import BLOCK, line_of
from tests.solution.flow.paths import DEFAULT, case_of

CLOSE = 1e-5
DECK = {path.stem: path for path in PATHS}
CUBE = BLOCK.replace("h: 2", "h: 1")
"""A block of 19.62 kN on a joint of friction 0.5."""


def pressed(x: float, z: float) -> str:
    return CUBE.replace("acceleration: [1, 0, 0]", f"force: [{x}, 0, {z}], on: block")


@pytest.mark.parametrize(
    ("deck", "name", "expected"),
    [
        ("guided_blocks", "free", 0.25),
        ("guided_blocks", "upright", 0.6),
        ("guided_blocks", "on_a_rail", 1.0),
        ("guided_blocks", "on_a_hinge", 0.55),
        ("guided_blocks", "pair", 0.5),
        ("glued_lintel", "in_plane", 0.675676),
        ("glued_lintel", "across", 0.168919),
        ("filled_slab", "on_fill", 6.766355),
        ("filled_slab", "push", 0.441558),
        ("filled_slab", "rolls@1", 2.691),
        ("filled_slab", "rolls@2", 4.3056),
        ("filled_slab", "rolls@3", 10.764),
        ("filled_arch", "lorry", 8.0592),
        ("filled_arch_restrained", "lorry", 9.798315),
        ("earth_pressure_with_wall_friction", "slides", 2.843106),
        ("combined_loads", "both", 0.241962),
        ("dead_force_only", "weightless", 3.0),
        ("block_on_a_large_cube", "alone", 0.5),
        ("block_on_a_large_cube", "both", 0.5),
    ],
)
def test_closed_forms(deck: str, name: str, expected: float) -> None:
    """Motions held by guides, what is glued, fill and its struts, loads that travel, no weight, light blocks."""
    assert case_of(DECK[deck], name).load_factor() == pytest.approx(expected, rel=CLOSE)


@pytest.mark.parametrize(("down", "expected"), [(1.0, 19.62), (0.5, 13.08)])
def test_a_load_that_also_presses(down: float, expected: float) -> None:
    """μ (W + λ d) = λ, in kN."""
    found = case_of(pressed(1000.0, -1000.0 * down), "push").load_factor()
    assert found == pytest.approx(expected, rel=CLOSE)


@pytest.mark.parametrize(("x", "z"), [(1.0, -2.1), (0.0, -1.0)])
def test_a_load_that_friction_holds_or_that_does_no_work_is_unbounded(x: float, z: float) -> None:
    found = case_of(pressed(1000.0 * x, 1000.0 * z), "push").path()
    assert found.stop is Stop.UNBOUNDED
    assert found.load_factor == math.inf
    assert not found.is_answer


@pytest.mark.parametrize("force", [1.0, 1e-4, 1e4])
def test_what_locks_with_normality_slides_without(force: float) -> None:
    """μ/cos b, whatever the size of the load: measured by what is found."""
    text = BENCHMARKS["groove_steep_friction"].read_text().replace("[0, 1, 0]", f"[0, {force}, 0]")
    found = case_of(text, "along").path()
    factor = case_of(text, "along").loaded.scaling.load_factor(found.load_factor)
    assert found.is_answer
    assert force * factor == pytest.approx(1.8 / math.cos(math.radians(30.0)), rel=1e-2)


@pytest.mark.parametrize("deck", ["tilting_block", "tilting_block_cohesion"])
@pytest.mark.parametrize("name", ["slides", "tips"])
def test_the_load_on_a_tilting_table_is_borne_up_to_its_angle(deck: str, name: str) -> None:
    """From the level table to the angle of the closed form the load factor is 1."""
    angle = read_deck(DECK[deck]).content.expected[name].angle
    assert angle is not None
    level = case_of(DECK[deck], name)
    tilt = tilt_of(level.load_case)
    there = case_of(DECK[deck], name, live=chord(tilt, math.radians(angle)))
    assert there.load_factor() == pytest.approx(1.0, rel=CLOSE)


@pytest.mark.parametrize(
    ("deck", "name", "expected"),
    [
        ("beam_on_three_supports", "right_settles", 5232.0),
        ("spreading_arch", "spreads", 11143.2458941),
        ("spreading_arch", "pushed_in", -23955.5250930),
        ("spreading_arch", "sinks", 39048.1656692),
    ],
)
def test_least_reactions_of_supports_that_give_way(deck: str, name: str, expected: float) -> None:
    assert case_of(DECK[deck], name).reaction() == pytest.approx(expected, rel=CLOSE)


@pytest.mark.parametrize(("name", "expected"), [("sinks", 3770.71533), ("turns", 5206.63437)])
def test_a_wall_on_a_footing_that_settles(name: str, expected: float) -> None:
    """With normality by statics; without it hangs on less of the wall."""
    case = case_of(DECK["settling_wall"], name)
    far = PathSettings(until=1000.0)
    assert case.reaction(far, slope=1.0) == pytest.approx(expected, rel=2e-4)
    least = {"sinks": 4121.5, "turns": 5211.2}[name]
    assert case.reaction() == pytest.approx(least, rel=1e-3)


@pytest.mark.long
def test_the_reaction_from_which_a_settlement_starts_does_not_count() -> None:
    case = case_of(DECK["settling_wall"], "turns")
    program = case.loaded
    higher = replace(program, dead_load=program.dead_load - 0.3 * program.live_load)
    found = path_of_part(higher, case.associative(), DEFAULT)
    assert found.load_factor - 0.3 == pytest.approx(case.path().load_factor, rel=1e-4)


@pytest.mark.parametrize("deck", ["incline_too_steep", "overhang_too_far"])
def test_what_does_not_stand_has_no_figure(deck: str) -> None:
    names = {"incline_too_steep": "too_steep", "overhang_too_far": "tip_load"}
    found = case_of(DECK[deck], names[deck]).path()
    assert found.stop is Stop.DOES_NOT_STAND
    assert found.path is None
    assert math.isnan(found.load_factor)


def test_what_nothing_presses_moves_at_once() -> None:
    text = BLOCK.replace("live:", "dead: [{gravity: none}], live:")
    found = case_of(text, "push").path()
    assert found.stop is Stop.AT_ONCE
    assert found.is_answer
    assert found.load_factor == 0.0


def test_a_part_without_live_load_has_no_path() -> None:
    case = case_of(DECK["slopes_of_blocks"], "rocks")
    unloaded, loaded = (
        path_of_part(part, _without_figure(case.associative(), part is case.loaded), DEFAULT) for part in case.parts
    )
    assert unloaded.stop is Stop.UNLOADED
    assert loaded.is_answer


def test_joints_that_dilate_come_to_rest_as_such() -> None:
    """Standing is found of joints without dilatancy; whether it was found before changes no figure of others."""
    program = line_of(BLOCK).program
    known = solve_associative(program, SolverSettings(1e-8), lambda record: None, stress_free=True)
    assert known.stress_free is not None
    for dilatancy, same in ((None, True), (np.full(program.n_points, 0.1), False)):
        rest = path_of_part(program, known, DEFAULT, dilatancy).rest
        assert rest is not None
        assert (rest.gravity is known.stress_free.gravity) is same


def _without_figure(associative: AssociativeResult, keep: bool) -> AssociativeResult:
    none = AssociativeResult(Status.UNBOUNDED, None, None, "", ())
    return associative if keep else none
