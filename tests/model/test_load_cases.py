"""Combinations: named loads with the product of their factors."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.model import build_model
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


def test_loads_add_up(tmp_path: Path) -> None:
    force = "{{force: [{}, 0, 0], on: {{group: top, index: 0}}}}"
    loads = f"live: [{force.format(1)}, {force.format(2)}, {{acceleration: [0, 1, 0]}}]"
    found = case(tmp_path, loads)
    assert found.live_load[1] == pytest.approx([3, 9.81 * 4000, 0, 0, 0, 0])
    assert len(found.live_words) == 3


def test_loads_on_fixed_blocks_are_kept(tmp_path: Path) -> None:
    found = case(tmp_path, "live: [{acceleration: [1, 0, 0]}]")
    assert found.live_load[0, 0] == pytest.approx(9.81 * 2000)


def test_dead_force_on_a_fixed_block_is_remarked_on(tmp_path: Path) -> None:
    found = model(tmp_path, "dead: [{gravity: none}, {force: [0, 0, -5], on: base}], live: [{acceleration: [1, 0, 0]}]")
    assert found.load_cases[0].dead_load[0].tolist() == [0, 0, -5, 0, 0, 0]
    assert [(notice.severity, notice.identifier) for notice in found.notices] == [("warning", "dead-load-on-support")]


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
