"""Modes about the state that a time history leaves: against closed forms, and why there may be none."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.assembly import build_assembly
from mbla.assembly.assembly import Assembly
from mbla.assembly.structure_at import StructureAt
from mbla.deck import Deck, read_deck
from mbla.model import build_model
from mbla.model.model import LoadCase
from mbla.solution.modes import after
from mbla.solution.modes.after import checked_modes_after
from mbla.solution.modes.find import modes_of
from mbla.solution.modes.modes import Modes
from mbla.solution.time_history.history import Peaks, TimeHistoryResult
from mbla.solution.time_history.step_rows import HistoryEnd

DENSITY, STIFFNESS, RATIO, HEIGHT = 2500.0, 1e10, 0.4, 0.5
WEIGHT = DENSITY * HEIGHT * 9.81
SAG = WEIGHT / STIFFNESS

DECK = """mbla: 1
materials: {{stone: {{density: 2500}}}}
joints: {{dry: {{friction: 0.6, stiffness: {{normal: 1.e10, ratio: 0.4}}}}}}
blocks:
  - box: {{group: low, material: stone, min: [0, 0, 0], max: [1, 1, 0.5]}}
  - box: {{group: high, material: stone, min: [0, 0, 0.5], max: [1, 1, 1]}}
contacts: {{joint: dry}}
supports: [{{blocks: low}}]
{others}
load_cases:
  quake:
    time_history: {{motion: {{pulse: half_sine, amplitude: 0.1 g, duration: 0.1, direction: x}}, duration: 1}}
    modes: 6
"""


def structure(folder: Path, others: str = "") -> tuple[Deck, Assembly, LoadCase]:
    """A stone on a fixed one."""
    path = folder / "deck.yaml"
    path.write_text(DECK.format(others=others))
    deck = read_deck(path)
    model = build_model(deck)
    return deck, build_assembly(deck, model), model.load_cases[0]


def left(shift: FloatArray, turn: FloatArray | None = None, **changed: Any) -> TimeHistoryResult:
    """What ends with the upper stone displaced and turned so."""
    ends = np.zeros((2, 6))
    ends[1, :3] = shift
    if turn is not None:
        ends[1, 3:] = turn
    none = np.zeros(2)
    peaks = Peaks(none, none, none, none, ends, none, np.zeros(1), np.zeros(1), np.full(2, np.nan))
    return replace(TimeHistoryResult(HistoryEnd.DURATION, SAG, peaks=peaks), **changed)


def found(folder: Path, history: TimeHistoryResult, others: str = "") -> tuple[Modes, list[str]]:
    """Modes after it, and remarks."""
    deck, assembly, case = structure(folder, others)
    modes, remarks = checked_modes_after(assembly, deck.contacts, case, history)
    return modes, [f"{each.identifier}: {each.words}" for each in remarks]


def periods_in_plane(overlap: float, arm: float) -> FloatArray:
    """Of the upper stone on a strip of its foot, s, falling.

    overlap : breadth of the strip, m; arm : of its middle from that of the stone, along x

    With u and w at the middle of the joint and the turn θ about y::

        2 U = k_T A (u − θ h/2)² + k_N A (w − θ a)² + k_N A b²/12 θ²
    """
    mass, inertia = DENSITY * HEIGHT, DENSITY * HEIGHT * (1.0 + HEIGHT**2) / 12.0
    along, across = np.array([1.0, 0.0, -HEIGHT / 2.0]), np.array([0.0, 1.0, -arm])
    stiffness = RATIO * STIFFNESS * overlap * np.outer(along, along) + STIFFNESS * overlap * np.outer(across, across)
    stiffness[2, 2] += STIFFNESS * overlap**3 / 12.0
    squares = np.linalg.eigvals(np.diag([1.0 / mass, 1.0 / mass, 1.0 / inertia]) @ stiffness)
    return np.asarray(2.0 * np.pi / np.sqrt(np.sort(squares)))


def test_what_has_not_moved_has_the_same_modes(tmp_path: Path) -> None:
    """But for the sag, by which the stone is lower: a millionth of its height."""
    _, assembly, case = structure(tmp_path)
    before = modes_of(StructureAt.as_built(assembly, case), 6)
    modes, remarks = found(tmp_path, left(np.array([0.0, 0.0, -SAG])))
    assert remarks == []
    assert modes.verified
    assert modes.periods == pytest.approx(before.periods, rel=1e-5)
    assert modes.masses == pytest.approx(before.masses, abs=1e-5)
    assert modes.sag < 1e-6 * SAG


@pytest.mark.parametrize("slip", [0.2, -0.4])
def test_a_stone_that_has_slid_vibrates_on_what_is_left_of_its_joint(tmp_path: Path, slip: float) -> None:
    """A stone out of its kern presses on three times the distance of its middle from the edge."""
    modes, remarks = found(tmp_path, left(np.array([slip, 0.0, -SAG])))
    assert [each.split(":")[0] for each in remarks] == ["modes-in-part"] * (abs(slip) > 0.25)
    assert modes.verified
    mine = modes.periods[modes.masses[:, 1] < 1e-9]
    away = 0.5 - abs(slip)
    strip = min(1.0 - abs(slip), 3.0 * away)
    assert mine == pytest.approx(periods_in_plane(strip, -np.sign(slip) * (strip / 2.0 - away)), rel=1e-4)


def test_a_stone_that_has_turned_about_the_vertical_vibrates_on_the_octagon_they_share(tmp_path: Path) -> None:
    """By 45 degrees: k_N A m⁻¹ along z, with the area 8 (√2 − 1) (1/2)²."""
    modes, _ = found(tmp_path, left(np.array([0.0, 0.0, -SAG]), np.array([0.0, 0.0, np.pi / 4.0])))
    assert modes.verified
    up = float(modes.periods[modes.masses[:, 2].argmax()])
    area = 2.0 * (np.sqrt(2.0) - 1.0)
    assert up == pytest.approx(2.0 * np.pi * np.sqrt(DENSITY * HEIGHT / (STIFFNESS * area)), rel=1e-5)


LEANING = """mbla: 1
materials: {{stone: {{density: 2500}}}}
joints: {{dry: {{friction: 0.6, stiffness: {{normal: {stiffness}, ratio: 0.4}}}}}}
blocks:
  - box: {{group: left, material: stone, min: [-0.2, 0, 0], max: [0, 1, 1]}}
  - box: {{group: right, material: stone, min: [0, 0, 0], max: [0.2, 1, 1]}}
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}}}]
load_cases:
  quake:
    time_history: {{motion: {{pulse: half_sine, amplitude: 0.1 g, duration: 0.1, direction: x}}, duration: 1}}
    modes: 4
"""


@pytest.mark.parametrize("stiffness", [1e10, 1e9])
def test_stones_that_lean_on_each_other_stand_on_strips_of_their_feet(tmp_path: Path, stiffness: float) -> None:
    """Turned by θ about an edge, a foot presses along a strip of the breadth w: N = k_N tan θ w²/2."""
    (tmp_path / "deck.yaml").write_text(LEANING.format(stiffness=stiffness))
    deck = read_deck(tmp_path / "deck.yaml")
    model = build_model(deck)
    turn, sag = 0.3, DENSITY * 9.81 / stiffness
    arm = np.array([-0.1 * np.cos(turn) + 0.5 * np.sin(turn), 0.1 * np.sin(turn) + 0.5 * np.cos(turn)])
    centre = np.array([-np.sin(turn) + arm[0], arm[1]])  # of the left one, whose upper corner touches the other
    ends = np.zeros((2, 6))
    ends[:, 0], ends[:, 2] = (centre[0] + 0.1) * np.array([1.0, -1.0]), centre[1] - 0.5
    ends[:, 4] = turn, -turn
    history = replace(left(np.zeros(3)), sag=sag)
    assert history.peaks is not None
    history = replace(history, peaks=replace(history.peaks, ends=ends))
    modes, remarks = checked_modes_after(build_assembly(deck, model), deck.contacts, model.load_cases[0], history)
    assert [each.identifier for each in remarks] == ["modes-in-part"]
    assert modes.verified
    strip = np.sqrt(2.0 * DENSITY * 0.2 * 9.81 / (stiffness * np.tan(turn)))
    assert modes.pressed[1:] == pytest.approx(np.full(2, strip / (0.2 * np.cos(turn))), rel=1e-4)


def test_where_a_stone_still_hangs_over_it_is_not_at_rest(tmp_path: Path) -> None:
    """Beyond half of its breadth it would fall; where it is tilted it would turn back."""
    over, remarks = found(tmp_path, left(np.array([0.55, 0.0, -SAG])))
    assert len(over) == 0
    assert remarks[0].startswith("no-modes-after: there are no modes of vibration after the time history: the struct")
    tilt = 0.01
    lift = np.array([0.5 * (np.cos(tilt) - 1.0), 0.0, 0.5 * np.sin(tilt)])
    tilted, _ = found(tmp_path, left(lift, np.array([0.0, -tilt, 0.0])))
    assert (len(tilted), tilted.reason) == (0, after.ELSEWHERE)


@pytest.mark.parametrize(
    ("end", "reason"),
    [
        (HistoryEnd.COLLAPSE, after.HAS_FALLEN),
        (HistoryEnd.DISPLACED, after.IT_MOVES),
        (HistoryEnd.STOPPED, after.TO_NO_END),
        (HistoryEnd.LATE, after.TO_NO_END),
    ],
)
def test_of_what_does_not_come_to_rest_there_are_none(tmp_path: Path, end: HistoryEnd, reason: str) -> None:
    modes, remarks = found(tmp_path, left(np.zeros(3), end=end))
    assert (len(modes), modes.reason) == (0, reason)
    assert remarks == [f"no-modes-after: there are no modes of vibration after the time history: {reason}"]


def test_of_what_ties_hold_there_are_none(tmp_path: Path) -> None:
    tie = "ties: [{on: [high, low], through: [[0.5, 0.5, 0.75], [0.5, 0.5, 0.25]], capacity: 1.e6}]"
    modes, _ = found(tmp_path, left(np.zeros(3)), tie)
    assert modes.reason == after.TIES
