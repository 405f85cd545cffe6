"""``mbla find`` of structures in time: the scale of a motion at which a block falls, or moves as far as asked."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from mbla.deck import read_deck_text
from mbla.errors import DeckError, UsageError
from mbla.sweeps.find.study import FindResult, find
from tests.line import BLOCK
from tests.sweeps.find.test_find import ASKED, said

ROCKING = """\
mbla: 1
title: A block that rocks
materials: {stone: {density: 2600}}
joints: {dry: {friction: 0.7, stiffness: {normal: 1.e10}}}
contacts: {joint: dry}
blocks:
  - box: {group: block, material: stone, min: [0, 0, 0], max: [0.2, 0.5, 1]}
supports: [{ground: {z: 0}}]
load_cases:
  quake:
    time_history:
      motion: {pulse: half_sine, amplitude: "0.5 g", duration: 0.2, direction: x}
      step: 0.01
      duration: 1.2
find: {parameter: load_cases.quake.time_history.motion.scale, target: {falls: true}, bounds: [1, 2]}
"""


def found_in(text: str, **options: Any) -> FindResult:
    return find(read_deck_text(text, Path("deck.yaml")), SimpleNamespace(**(ASKED | options)))


@pytest.mark.long
def test_the_scale_at_which_a_block_falls() -> None:
    """It stands below and falls above; one upwards ends with the step in which it falls."""
    found = found_in(ROCKING.replace("duration: 1.2", "duration: 5"), scan=4, first=True, tolerance=0.05)
    (zero,) = found.zeros
    stands, falls = sorted(zero.bracket, key=lambda each: each.x)
    assert (stands.status, falls.status) == ("does not fall", "falls")
    assert 1.0 <= stands.x < falls.x <= found.scanned[-1].x < 2.0
    assert falls.x - stands.x <= 0.1
    assert zero.jumps
    assert found.exit_code == 0
    assert "it stands, with a peak of " in said(found)
    assert f"nothing above {found.scanned[-1].x:.9g} was looked at" in said(found)
    assert found.record["target"] == {"falls": True}


@pytest.mark.long
def test_the_scale_at_which_it_moves_as_far() -> None:
    found = found_in(ROCKING, target=("peak", 0.03), bounds=(0.5, 1.0), tolerance=0.01)
    (zero,) = found.zeros
    assert zero.rises
    assert abs(zero.best.y) < 0.005
    assert "a stronger motion may do less" in said(found)


def test_a_history_that_is_cut_off_says_nothing_of_falls() -> None:
    stopped = ROCKING.replace("duration: 1.2", "duration: 1.2\n      stop: {displacement: 0.02}")
    found = found_in(stopped, bounds=(1.0, 1.1), scan=1)
    assert found.exit_code == 4
    assert "It moved as far as stop.displacement allows, and might have fallen otherwise" in said(found)


def test_a_history_that_ends_while_it_moves_says_nothing_of_falls() -> None:
    found = found_in(ROCKING.replace("duration: 1.2", "duration: 0.5"), bounds=(1.0, 1.1), scan=1)
    assert {each.status for each in found.answers} == {"still moves"}
    assert found.exit_code == 4
    assert not found.zeros
    assert said(found).count("ends while the structure still moves tells nothing of falls: give a longer duration") == 1


def test_what_has_no_time_history_does_not_fall() -> None:
    deck = read_deck_text(BLOCK, Path("deck.yaml"))
    asked = ASKED | {"parameter": "parameters.mu", "target": ("falls", 0.0), "bounds": (0.1, 1.0)}
    with pytest.raises(UsageError, match="has no time_history, of which falls is asked"):
        find(deck, SimpleNamespace(**asked))


def test_a_load_factor_of_a_structure_in_time_is_refused() -> None:
    with pytest.raises(UsageError, match="look for the target falls or peak"):
        found_in(ROCKING, target=("load_factor", 0.3))


@pytest.mark.parametrize(
    ("target", "words"),
    [("{falls: false}", "begins to fall is looked for"), ("{peak: 0}", "> 0"), ("{peak: 1, falls: true}", "one of")],
)
def test_targets_that_are_none(target: str, words: str) -> None:
    with pytest.raises(DeckError, match=words):
        read_deck_text(ROCKING.replace("{falls: true}", target), Path("deck.yaml"))
