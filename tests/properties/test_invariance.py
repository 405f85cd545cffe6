"""Decks that say the same in another way have the same associative load factors, exit status and angles."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.arrays import FloatArray
from tests.properties.random_decks import random_deck
from tests.properties.random_items import Tree
from tests.properties.rewritten import copies_written_out, in_units, moved, shuffled
from tests.properties.run_deck import Run, run_deck, write_deck

pytestmark = pytest.mark.long

SAME = 3e-6
"""relative difference of load factors: the bounds of each may be 1e-6 apart, or a little more near an edge"""
NOTHING = 1e-7
"""difference of load factors that are 0, where nothing but a frictionless joint holds, say"""
SAME_ANGLE = 1e-4
"""degrees"""
FEW = (0, 18, 22)
SEEDS = (*FEW, *range(60, 90))


def associative_deck(seed: int) -> Tree:
    """A random deck of the kind whose load factor is unique, with circular friction: polyhedra turn with frames."""
    deck = random_deck(seed)
    analysis = deck["analysis"] | {"flow_rule": "associative", "accuracy": "standard", "friction_cone": "circular"}
    return deck | {"analysis": analysis, "output": {"vtu": False}}


def variants(deck: Tree) -> dict[str, Tree]:
    """The same in other words; what speaks of axes (boxes, beds, depths, held components) is only shifted level."""
    text = json.dumps(deck)
    found = {
        "millimetres": in_units(deck, "mm", "kN", "t"),
        "feet": in_units(deck, "ft", "lbf", "lb"),
        "unreduced": deck | {"analysis": deck["analysis"] | {"reductions": False}},
    }
    if '"copy"' not in text:
        found["copies"] = copies_written_out(deck)
    if '"index"' not in text and "glued" not in text:
        found["shuffled"] = shuffled(deck, 1)
    if '"box": [' in text:
        return found
    level = any(word in text for word in ('"orientation": "', "per_depth", '"pattern"', '"fixed"'))
    axis, degrees = ([0, 0, 1], 33.0) if level else ([1, 2, -1], 33.0)
    degrees = 0.0 if '"fixed"' in text else degrees
    found["moved"] = _moved(deck, axis, degrees, (3.0, -2.0, 0.0 if level else 1.5))
    found["far_away"] = _moved(deck, axis, 0.0, (1e5, -3e4, 0.0 if level else 2e4))
    return found


def _moved(deck: Tree, axis: list[int], degrees: float, shift: tuple[float, float, float]) -> Tree:
    return moved(deck, _turn(axis, math.radians(degrees)), {"axis": axis, "angle": degrees}, shift)


def _turn(axis: list[int], angle: float) -> FloatArray:
    """Rodrigues' formula."""
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    turn: FloatArray = np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * cross @ cross
    return turn


def check(seed: int, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    deck = associative_deck(seed)
    first = run_deck(write_deck(deck, folder), capsys)
    for name, other in variants(deck).items():
        run = run_deck(write_deck(other, folder, name), capsys)
        assert run.code == first.code, (name, run.errors)
        _compare(first, run, name)


def _compare(first: Run, run: Run, name: str) -> None:
    for one, other in zip(first.cases, run.cases, strict=True):
        assert other["status"] == one["status"], name
        assert _number(other["load_factor"]) == pytest.approx(
            _number(one["load_factor"]), rel=SAME, abs=NOTHING, nan_ok=True
        ), name
        assert _number(other["angle"]) == pytest.approx(_number(one["angle"]), abs=SAME_ANGLE, nan_ok=True), name


def _number(value: Any) -> float:
    return math.nan if value is None else float(value)


@pytest.mark.parametrize("seed", SEEDS)
def test_random_decks(seed: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    check(seed, tmp_path, capsys)
