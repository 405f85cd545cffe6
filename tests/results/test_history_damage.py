"""Ties that broke and yielded, and joints that crushed, from states that are kept."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.process.run_options import RunOptions
from mbla.results.history_damage import HistoryDamage, history_damage
from mbla.results.listing.history_verdict import history_verdict
from mbla.run import run
from tests.results.rocking import frames, rocks
from tests.results.synthetic import tower_results

MODEL = tower_results().model
CRUSHING = replace(
    MODEL,
    joints={name: replace(joint, compressive_strength=1e5) for name, joint in MODEL.joints.items()},
)

DECK = """mbla: 1
materials: {stone: {density: 2000}}
joints: {no: {friction: 0}}
blocks:
  - box: {group: a, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: b, material: stone, min: [0, 3, 0], max: [1, 4, 1]}
contacts: {joint: no}
supports: [{ground: {z: 0}}]
ties:
  - {name: y, through: [[-1, 0.5, 0.5], [0, 0.5, 0.5]], on: [ground, a], capacity: 3000}
  - {name: z, through: [[-1, 3.5, 0.5], [0, 3.5, 0.5]], on: [ground, b], capacity: 3000, breaks_at: 0.005}
load_cases:
  pulled:
    time_history:
      motion: {pulse: half_sine, amplitude: 0.6 g, duration: 0.3, direction: -x}
      duration: 0.3
      step: 0.004
      record: {every: 0.02}
"""


def test_joints_that_cannot_crush_and_joints_that_have_not() -> None:
    assert np.isnan(history_damage(MODEL, rocks()).crushing)
    assert history_damage(CRUSHING, rocks()) == HistoryDamage(crushing=0.0)


def test_the_joint_that_has_crushed_most() -> None:
    """By its negative normal force at no gap over its stiffness."""
    crushed = frames()
    crushed.remembered[4 * 7 + 2, 0] = -2.5e6
    crushed.remembered[4 * 7 + 3, 0] = -1e6
    damage = history_damage(CRUSHING, replace(rocks(), frames=crushed))
    assert damage.crushing == pytest.approx(0.01)
    assert damage.bodies == (0, 1)


def test_ties_of_a_run(tmp_path: Path) -> None:
    """One breaks when it is longer by half of a hundredth, the other yields without end."""
    deck = tmp_path / "pulled.yaml"
    deck.write_text(DECK, encoding="utf-8")
    results = run(deck, RunOptions())
    (case,) = results.cases
    damage = history_damage(results.model, case.solution.further.time_history)
    ((tie, time),) = damage.broken
    assert (tie, damage.yielded) == (1, (0,))
    assert "; tie z[0] breaks at about " in history_verdict(results.model, case)
    (path,) = (tmp_path / "pulled.out").glob("*.json")
    found = json.loads(path.read_text(encoding="utf-8"))["cases"][0]["time_history"]
    assert found["broken_ties"] == {"z[0]": pytest.approx(time)}
    assert found["yielded_ties"] == ["y[0]"]
    assert 0.0 < time < 0.3
    (listing,) = (tmp_path / "pulled.out").glob("*.lst")
    assert "ties that broke" in listing.read_text(encoding="utf-8")


def test_nothing_is_told_of_what_was_not_followed() -> None:
    assert history_damage(MODEL, replace(rocks(), frames=None)) == HistoryDamage()
