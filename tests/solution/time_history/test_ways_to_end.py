"""How histories end: rest stays rest, a tie yields or breaks, what does not stand is not followed, a run is resumed."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest

import mbla
from mbla.solution.time_history.checkpoint import Unfinished
from mbla.solution.time_history.step_rows import HistoryEnd
from tests.solution.time_history.followed import deck_text, followed, out_of_balance
from tests.solution.time_history.random_scenes import random_scene

PILE = """
  - box: {material: stone, min: [0, 0, 0], max: [0.5, 0.4, 0.5]}
  - box: {material: stone, min: [0.02, 0, 0.5], max: [0.5, 0.36, 0.9]}
  - box: {material: stone, min: [0.05, 0.03, 0.9], max: [0.45, 0.4, 1.4]}"""
STILL = "motion: {pulse: sine, amplitude: 0.3 g, duration: 0.5, direction: x, scale: 0}"


def test_what_rests_stays_at_rest() -> None:
    """For 1 s."""
    found, _, _ = followed(deck_text(PILE, f"{STILL}, duration: 1, step: 0.004"))
    assert found.peaks is not None
    assert found.end is HistoryEnd.DURATION
    assert found.peaks.peak < 1e-3 * found.sag


def test_it_comes_to_rest_and_ends() -> None:
    motion = "motion: {pulse: sine, amplitude: 0.1 g, duration: 0.1, direction: x}"
    found, _, _ = followed(deck_text(PILE, f"{motion}, duration: 9, damping: 0.2, stop: {{rest: true}}"))
    assert found.rows is not None
    assert found.end is HistoryEnd.AT_REST
    assert 0.1 < found.rows.times[-1] < 3.0


def test_what_does_not_stand_is_not_followed(tmp_path: Path) -> None:
    """A block whose centroid is beyond the edge of the one below: the load case has no equilibrium."""
    boxes = """
  - box: {material: stone, min: [0, 0, 0], max: [0.2, 0.3, 0.2]}
  - box: {material: stone, min: [0.15, 0, 0.2], max: [0.6, 0.3, 0.4]}"""
    (tmp_path / "falls.yaml").write_text(deck_text(boxes, STILL), encoding="utf-8")
    case = mbla.run(tmp_path / "falls.yaml").case("case")
    assert str(case.status) == "no_equilibrium"
    assert "does not stand" in case.reason


@pytest.mark.long
def test_a_tie_holds_a_block_or_breaks() -> None:
    """A rod at the top of a slender block to a fixed point, under a pulse that overturns the block without it."""
    box = "[{box: {group: b, material: stone, min: [0, 0, 0], max: [0.2, 0.3, 1]}}]"
    motion = "motion: {pulse: half_sine, amplitude: 0.5 g, duration: 0.4, direction: x}, step: 0.004, duration: 1.6"
    taken = []
    for breaks_at, end in (("never", HistoryEnd.DURATION), ("0", HistoryEnd.COLLAPSE)):
        tie = f"through: [[0.2, 0.15, 0.9], [2, 0.15, 0.9]], on: [b, ground], capacity: 150, breaks_at: {breaks_at}"
        found, _, _ = followed(deck_text(box, motion, "friction: 2", f"ties: [{{{tie}}}]"))
        assert found.rows is not None
        assert found.end is end
        assert out_of_balance(found.rows) < 1e-12
        taken.append(float(found.rows.ties[-1]))
    assert taken[0] > 10.0 * taken[1] > 0.0  # it yields, or breaks as soon as it would


@pytest.mark.parametrize(("capacity", "breaks"), [(1e6, False), (400.0, True)])
def test_a_brittle_tie_stretches_before_it_breaks(capacity: float, *, breaks: bool) -> None:
    """Of what its spring gives it does not break, but at its capacity: the base pulls with some 600 N."""
    box = "[{box: {group: b, material: stone, min: [0, 0, 0], max: [0.2, 0.3, 1]}}]"
    motion = "motion: {pulse: rectangle, amplitude: 0.5 g, duration: 0.1, direction: x}, step: 0.005, duration: 0.1"
    tie = f"through: [[0.2, 0.15, 0.5], [2, 0.15, 0.5]], on: [b, ground], capacity: {capacity}, breaks_at: 0"
    found, _, _ = followed(deck_text(box, motion + ", record: {every: 0.005}", "friction: 0.01", f"ties: [{{{tie}}}]"))
    assert found.frames is not None
    assert bool((found.frames.sets[-1].bodies[:, 0] < 0).any()) is not breaks


def test_a_tie_has_its_prestress_at_rest() -> None:
    """15 kN down through a stack: the foot carries it with the weight."""
    stack = "[{stack: {group: s, material: stone, block: [0.4, 0.4, 0.6], count: 3}}]"
    motion = "motion: {pulse: sine, amplitude: 0.01 g, duration: 0.1, direction: x}, step: 0.01, duration: 0.02"
    tie = "through: [[0.2, 0.2, 1.8], [0.2, 0.2, -0.5]], on: [{group: s, drum: 2}, ground], capacity: 30000"
    record = ", record: {interfaces: {foot: {between: [{group: s, drum: 0}, ground]}}}"
    found, _, _ = followed(deck_text(stack, motion + record, more=f"ties: [{{{tie}, prestress: 15000}}]"))
    assert found.histories is not None
    weight = 2000.0 * 0.4 * 0.4 * 1.8 * 9.81
    assert abs(found.histories.forces[0, 0, 2]) == pytest.approx(15000.0 + weight, rel=1e-4)


def test_a_history_goes_on_to_the_same_figures() -> None:
    """From a step on."""
    text = random_scene(5, 0.2)
    whole, _, kept = followed(text, stop=40)
    begun, _, checkpoint = kept[0]
    assert checkpoint is not None
    resumed, _, _ = followed(text, Unfinished(begun, checkpoint))
    for one, other in ((whole.rows, resumed.rows), (whole.peaks, resumed.peaks)):
        assert one is not None
        assert other is not None
        for name in (field.name for field in fields(one)):
            assert np.array_equal(getattr(one, name), getattr(other, name), equal_nan=True), name


def test_half_of_the_step_is_told() -> None:
    motion = "motion: {pulse: half_sine, amplitude: 0.5 g, duration: 0.1, direction: x}"
    found, _, _ = followed(deck_text(PILE, f"{motion}, duration: 0.2, step: 0.004, check: true"))
    assert found.half is not None
    assert found.peaks is not None
    assert found.half.peak == pytest.approx(found.peaks.peak, rel=0.05)


@pytest.mark.parametrize(
    ("joint", "told"),
    [
        ("friction: 0.6", []),
        ("friction: 0.6, cohesion: 30000, tensile_strength: 20000", ["opened", "slid"]),
        ("friction: 0.6, cohesion: 300000, tensile_strength: 200000", []),
    ],
)
def test_joints_that_tear_and_hold_all_the_same_are_told(joint: str, told: list[str]) -> None:
    """A dry block rocks and is none, mortar is torn by the pulse, and one ten times as strong holds."""
    box = "[{box: {material: stone, min: [0, 0, 0], max: [0.3, 0.5, 0.9]}}]"
    motion = "motion: {pulse: half_sine, amplitude: 1.2 g, duration: 0.4, direction: x}, step: 0.004, duration: 0.3"
    _, remarks, _ = followed(deck_text(box, motion, joint))
    words = " ".join(remark for remark in remarks if remark.identifier == "time-history-ductile")
    assert [how for how in ("opened", "slid") if f"{how} by" in words] == told
