"""Combinations: named loads with the product of their factors."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.deck.section import EXACTLY_ONE
from mbla.deck.sections.loads import LIVE_ONLY, Load
from mbla.errors import DeckError
from mbla.model import build_model
from mbla.model.loads import LOAD_KINDS
from mbla.model.model import LoadCase, Model
from tests.model.loads.test_travel import ROW
from tests.model.shapes import deck, write_deck

BLOCKS = [
    "box: {group: base, material: stone, min: [0, 0, 0], max: [1, 1, 1]}",
    "box: {group: top, material: stone, min: [0, 0, 1], max: [1, 1, 3]}",
    "box: {group: top, material: stone, min: [0, 0, 3], max: [1, 1, 4]}",
]
FIXED = "[{blocks: base}]"


def model(folder: Path, loads: str, units: str = "", supports: str = FIXED) -> Model:
    return build_model(deck(folder, BLOCKS, supports, loads, units))


def case(folder: Path, loads: str, units: str = "", supports: str = FIXED) -> LoadCase:
    return model(folder, loads, units, supports).load_cases[0]


def messages(folder: Path, loads: str) -> list[str]:
    with pytest.raises(DeckError) as caught:
        model(folder, loads)
    return [f"{fault.key}: {fault.message}" for fault in caught.value.faults]


def test_default_dead_load_is_gravity(tmp_path: Path) -> None:
    found = case(tmp_path, "live: [{acceleration: [1, 0, 0]}]")
    assert found.dead_load[:, 2] == pytest.approx(-9.81 * 2000 * np.array([1, 2, 1]))
    assert not found.dead_load[:, [0, 1, 3, 4, 5]].any()
    assert found.dead_words == ("gravity (0, 0, -9.81) m/s2",)
    assert found.name == "push"


def test_acceleration_on_a_selection(tmp_path: Path) -> None:
    found = case(tmp_path, "live: [{acceleration: [1, 0, 0], on: top}]")
    assert found.live_load[:, 0] == pytest.approx(9.81 * 2000 * np.array([0, 2, 1]))
    assert found.live_words == ("acceleration (1, 0, 0) g on 2 blocks",)


@pytest.mark.parametrize(
    ("units", "gravity"),
    [
        ("length: mm, force: kN, mass: t", 9810),
        ("length: ft, force: lbf, mass: lb", 32.185),
        ("length: m, force: kN", 9.81),
    ],
)
def test_an_acceleration_of_one_g_weighs_as_much_as_gravity(tmp_path: Path, units: str, gravity: float) -> None:
    found = case(tmp_path, f"dead: [{{gravity: [0, 0, {-gravity}]}}], live: [{{acceleration: [0, 0, -1]}}]", units)
    assert found.dead_load == pytest.approx(found.live_load, rel=1e-5)


def test_force_at_a_point_brings_its_moment(tmp_path: Path) -> None:
    found = case(tmp_path, "live: [{force: [10, 20, 30], on: {group: top, index: 0}, at: [1, 0.5, 2.5]}]")
    assert found.live_load[1] == pytest.approx([10, 20, 30, *np.cross([0.5, 0, 0.5], [10, 20, 30])])
    assert found.live_words == ("force (10, 20, 30) N on top[0] at (1, 0.5, 2.5) m",)


def test_loads_add_up(tmp_path: Path) -> None:
    force = "{{force: [{}, 0, 0], on: {{group: top, index: 0}}}}"
    loads = f"live: [{force.format(1)}, {force.format(2)}, {{acceleration: [0, 1, 0]}}]"
    found = case(tmp_path, loads)
    assert found.live_load[1] == pytest.approx([3, 9.81 * 4000, 0, 0, 0, 0])
    assert len(found.live_words) == 3


def test_no_dead_load_at_all(tmp_path: Path) -> None:
    found = case(tmp_path, "dead: [{gravity: none}], live: [{acceleration: [1, 0, 0]}]")
    assert not found.dead_load.any()
    assert found.dead_words == ("no gravity",)


@pytest.mark.parametrize(("dead", "pushed"), [("[]", 0), ("[{force: [1, 0, 0], on: {group: top, index: 0}}]", 1)])
def test_gravity_acts_beside_dead_loads_without_it(tmp_path: Path, dead: str, pushed: float) -> None:
    found = case(tmp_path, f"dead: {dead}, live: [{{acceleration: [0, 0, -1]}}]")
    assert found.dead_load[:, 2] == pytest.approx(found.live_load[:, 2])
    assert found.dead_load[1, 0] == pushed
    assert found.dead_words[0] == "gravity (0, 0, -9.81) m/s2"


def test_loads_on_fixed_blocks_are_kept(tmp_path: Path) -> None:
    found = case(tmp_path, "live: [{acceleration: [1, 0, 0]}]")
    assert found.live_load[0, 0] == pytest.approx(9.81 * 2000)


def test_dead_force_on_a_fixed_block_is_remarked_on(tmp_path: Path) -> None:
    found = model(tmp_path, "dead: [{gravity: none}, {force: [0, 0, -5], on: base}], live: [{acceleration: [1, 0, 0]}]")
    assert found.load_cases[0].dead_load[0].tolist() == [0, 0, -5, 0, 0, 0]
    assert [(notice.severity, notice.identifier) for notice in found.notices] == [("warning", "dead-load-on-support")]


@pytest.mark.parametrize(("x", "remarked"), [(1.0, False), (1.01, False), (1.05, True), (-3.0, True)])
def test_force_outside_its_block(tmp_path: Path, x: float, remarked: bool) -> None:
    found = model(tmp_path, f"live: [{{force: [1, 0, 0], on: {{group: top, index: 0}}, at: [{x}, 0.5, 2]}}]")
    assert [notice.identifier for notice in found.notices] == ["force-outside-block"] * remarked


def test_a_couple_has_an_effect(tmp_path: Path) -> None:
    where = "on: {group: top, index: 1}"
    loads = (
        f"live: [{{force: [1, 0, 0], {where}, at: [0.5, 0.5, 4]}}, {{force: [-1, 0, 0], {where}, at: [0.5, 0.5, 3]}}]"
    )
    assert case(tmp_path, loads).live_load[2] == pytest.approx([0, 0, 0, 0, 1, 0])


def test_every_kind_of_load_of_the_deck_has_its_meaning() -> None:
    assert (*LOAD_KINDS, "loads", *LIVE_ONLY) == EXACTLY_ONE[Load]


def test_moment_turns_one_block_about_its_centroid(tmp_path: Path) -> None:
    found = case(tmp_path, "live: [{moment: [1, -2, 3], on: {group: top, index: 1}}]")
    block = int(np.flatnonzero(np.any(found.live_load, axis=1)).item())
    assert found.live_load[block].tolist() == [0, 0, 0, 1, -2, 3]
    (words,) = found.live_words
    assert "moment (1, -2, 3)" in words


def model_of_named_loads(folder: Path, loads: str, case: str) -> Model:
    path = write_deck(folder, ROW, loads=case)
    path.write_text(path.read_text() + f"loads: {{{loads}}}\n")
    return build_model(read_deck(path))


def test_factors_multiply_through_names(tmp_path: Path) -> None:
    loads = (
        "weight: [{gravity: [0, 0, -9.81]}], wind: [{acceleration: [0, 0.5, 0]}, {force: [1, 0, 0], on: {group: row, "
        "index: 2}, factor: 3}], design: [{loads: weight, factor: 1.35}, {loads: wind, factor: 1.5}]"
    )
    text = "dead: [{loads: design, factor: 2}, {loads: weight}], live: [{loads: wind}]"
    case = model_of_named_loads(tmp_path, loads, text).load_cases[0]
    weight = 2000 * 9.81
    assert case.dead_load[:, 2] == pytest.approx(-weight * (2 * 1.35 + 1) * np.ones(4))
    assert case.dead_load[:, 1] == pytest.approx(weight * 0.5 * 1.5 * 2 * np.ones(4))
    assert case.dead_load[:, 0] == pytest.approx([0, 0, 9, 0])
    assert case.live_load[:, 0] == pytest.approx([0, 0, 3, 0])
    assert case.dead_words == (
        "2.7 times gravity (0, 0, -9.81) m/s2",
        "3 times acceleration (0, 0.5, 0) g",
        "9 times force (1, 0, 0) N on row[2] at its centroid",
        "gravity (0, 0, -9.81) m/s2",
    )


def test_gravity_acts_where_no_named_load_says_otherwise(tmp_path: Path) -> None:
    loads = "wind: [{acceleration: [0, 0.5, 0]}], floating: [{gravity: none}, {loads: wind}]"
    weighed = model_of_named_loads(
        tmp_path, loads, "dead: [{loads: wind}], live: [{acceleration: [0, 0, -1]}]"
    ).load_cases[0]
    assert weighed.dead_load[:, 2] == pytest.approx(weighed.live_load[:, 2])
    floating = model_of_named_loads(tmp_path, loads, "dead: [{loads: floating}], live: [{loads: wind}]").load_cases[0]
    assert floating.dead_load == pytest.approx(floating.live_load)
    assert floating.dead_words == ("no gravity", "acceleration (0, 0.5, 0) g")


def test_a_fault_in_a_named_load_is_told_once_where_it_stands(tmp_path: Path) -> None:
    loads = "far: [{line: {from: [0, 0.5, 1], to: [9, 0.5, 1], force_per_length: [0, 0, -1]}}]"
    with pytest.raises(DeckError) as caught:
        model_of_named_loads(tmp_path, loads, "dead: [{loads: far}, {loads: far}], live: [{loads: far}]")
    assert [fault.key for fault in caught.value.faults] == ["loads.far[0].line"]


def test_unused_named_loads_are_remarked_on(tmp_path: Path) -> None:
    path = write_deck(tmp_path, ROW)
    path.write_text(path.read_text() + "loads: {a: [{loads: b}], b: [{acceleration: [1, 0, 0]}]}\n")
    told = [notice.message for notice in read_deck(path).notices if notice.identifier == "load-unused"]
    assert len(told) == 1
    assert told[0].endswith("loads.a is not used")


def test_a_step_of_a_pushover_is_longer_than_what_joints_give(tmp_path: Path) -> None:
    (says,) = messages(tmp_path, "live: [{acceleration: [1, 0, 0]}], pushover: {step: 1.e-7}")
    assert says.startswith("load_cases.push.pushover.step: must be > ")
    assert "a millionth of the size of blocks, by which joints give" in says
