"""Combinations: named loads with the product of their factors."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.model import build_model
from mbla.model.model import Model
from tests.model.loads.test_travel import ROW
from tests.model.shapes import write_deck


def model(folder: Path, loads: str, case: str) -> Model:
    path = write_deck(folder, ROW, loads=case)
    path.write_text(path.read_text() + f"loads: {{{loads}}}\n")
    return build_model(read_deck(path))


def test_factors_multiply_through_names(tmp_path: Path) -> None:
    loads = (
        "weight: [{gravity: [0, 0, -9.81]}], wind: [{acceleration: [0, 0.5, 0]}, {force: [1, 0, 0], on: {group: row, "
        "index: 2}, factor: 3}], design: [{loads: weight, factor: 1.35}, {loads: wind, factor: 1.5}]"
    )
    text = "dead: [{loads: design, factor: 2}, {loads: weight}], live: [{loads: wind}]"
    case = model(tmp_path, loads, text).load_cases[0]
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
    weighed = model(tmp_path, loads, "dead: [{loads: wind}], live: [{acceleration: [0, 0, -1]}]").load_cases[0]
    assert weighed.dead_load[:, 2] == pytest.approx(weighed.live_load[:, 2])
    floating = model(tmp_path, loads, "dead: [{loads: floating}], live: [{loads: wind}]").load_cases[0]
    assert floating.dead_load == pytest.approx(floating.live_load)
    assert floating.dead_words == ("no gravity", "acceleration (0, 0.5, 0) g")


def test_a_fault_in_a_named_load_is_told_once_where_it_stands(tmp_path: Path) -> None:
    loads = "far: [{line: {from: [0, 0.5, 1], to: [9, 0.5, 1], force_per_length: [0, 0, -1]}}]"
    with pytest.raises(DeckError) as caught:
        model(tmp_path, loads, "dead: [{loads: far}, {loads: far}], live: [{loads: far}]")
    assert [fault.key for fault in caught.value.faults] == ["loads.far[0].line"]


def test_unused_named_loads_are_remarked_on(tmp_path: Path) -> None:
    path = write_deck(tmp_path, ROW)
    path.write_text(path.read_text() + "loads: {a: [{loads: b}], b: [{acceleration: [1, 0, 0]}]}\n")
    told = [notice.message for notice in read_deck(path).notices if notice.identifier == "load-unused"]
    assert len(told) == 1
    assert told[0].endswith("loads.a is not used")
