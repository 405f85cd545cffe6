"""Pushovers under a load that travels: at its worst position, or at the one that is asked for."""

from __future__ import annotations

import io
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.deck import Deck, read_deck
from mbla.process.run_options import RunOptions
from mbla.results.results import CaseResult, Results
from mbla.results.status_file import StatusFile
from mbla.results.verification.asked import differences_of_positions
from mbla.run import solve_deck
from tests.line import HEAD

DECK = (
    HEAD
    + """\
joints: {dry: {friction: 0.6}}
blocks:
  - box: {group: pier, material: stone, min: [2, 0, 0], max: [2.5, 0.5, 2]}
  - box: {group: pier, material: stone, min: [5.5, 0, 0], max: [6, 0.5, 2]}
  - box: {group: beam, material: stone, min: [0, 0, 2], max: [8, 0.5, 2.4]}
supports: [{blocks: pier}]
load_cases:
  crane:
    live: [{travel: {force: [0, 0, -10000], path: [[0, 0.25, 3.4], [7, 0.25, 3.4]], positions: 4}}]
    pushover: {step: 0.1, until: 0.4, error: false}
"""
)
WEIGHT = 8 * 0.5 * 0.4 * 2000 * 9.81
"""Beam on two piers, which tips about the edge of one of them; the load is drawn 1 m above it."""


def solved(folder: Path, *overrides: str) -> tuple[Deck, Results]:
    """All positions of the deck."""
    (path := folder / "deck.yaml").write_text(DECK, encoding="utf-8")
    deck = read_deck(path, overrides)
    status_file = StatusFile(io.StringIO(), "test")
    return deck, solve_deck(deck, RunOptions(), status_file, None, time.perf_counter())


def pushed(results: Results) -> list[CaseResult]:
    """Positions at which the structure was pushed."""
    return [case for case in results.cases if case.load_case.pushover is not None]


@pytest.mark.parametrize("follows", [False, True])
def test_the_structure_is_pushed_at_the_worst_position_where_the_load_stands(follows: bool, tmp_path: Path) -> None:
    """F (2 cos + 1.4 sin) = W (2 cos - 0.2 sin) as the end under the load sinks; 2 F for both where F turns, too."""
    (case,) = pushed(solved(tmp_path, f"load_cases.crane.live.0.follows={str(follows).lower()}")[1])
    assert case.load_case.name == "crane@1"
    moved, factors = np.array([[row.displacement, row.load_factor] for row in case.solution.further.pushover.curve]).T
    turns = np.linspace(0.0, 0.3, 3001)
    turned = np.interp(moved, 2.0 * np.sin(turns) + 1.4 * (1.0 - np.cos(turns)), turns)
    cos, sin = np.cos(turned), np.sin(turned)
    arm = 2.0 if follows else 2.0 * cos + 1.4 * sin
    assert len(moved) == 5
    assert 10000 * factors * arm == pytest.approx(WEIGHT * (2.0 * cos - 0.2 * sin), rel=1e-4)


def test_a_position_can_be_asked_for(tmp_path: Path) -> None:
    (case,) = pushed(solved(tmp_path, "load_cases.crane.pushover.position=4", "load_cases.crane.pushover.steps=2")[1])
    assert case.load_case.name == "crane@4"
    assert len(case.solution.further.pushover.curve) == 3


def test_another_position_than_the_worst_is_no_answer(tmp_path: Path) -> None:
    deck, results = solved(tmp_path, "load_cases.crane.pushover.steps=1")
    assert not list(differences_of_positions(deck, results))
    first, *others, last = results.cases
    asked = first.load_case.pushover
    first, last = (
        replace(case, load_case=replace(case.load_case, pushover=each)) for case, each in ((first, None), (last, asked))
    )
    forged = replace(results, cases=(first, *others, last))
    (words,) = differences_of_positions(deck, forged)
    assert words == "crane: the structure is pushed at crane@4, where the deck asks for crane@1"
