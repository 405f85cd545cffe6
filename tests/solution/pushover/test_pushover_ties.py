"""Pushovers of structures with ties against a closed form."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.results.listing.sections.pushover import energy_missing
from mbla.solution.pushover.curve import dropped
from mbla.solution.pushover.curve_rows import CurveEnd
from tests.line import HEAD, case_of

DECK = (
    HEAD
    + """\
parameters: {T: 3000, ht: 1.6}
joints: {dry: {friction: 5}}
blocks:
  - box: {group: block, material: stone, min: [0, 0, 0], max: [0.4, 1, 2]}
supports: [{ground: {z: 0}}]
ties:
  - {through: [[0, 0.5, "=ht"], [-3, 0.5, "=ht"]], on: [block, ground], capacity: "=T"}
load_cases: {push: {live: [{acceleration: [1, 0, 0]}], pushover: {step: 0.01}}}
"""
)
WEIGHT = 0.4 * 2 * 2000 * 9.81


def closed_form(turn: float) -> tuple[float, float, float]:
    """Displacement of the centroid, load factor and elongation of the tie of the block turned about its toe."""
    cos, sin = np.cos(turn), np.sin(turn)
    turned = np.array([[cos, sin], [-sin, cos]])
    centroid, top = turned @ [-0.2, 1.0] + [0.4, 0.0], turned @ [-0.4, 1.6] + [0.4, 0.0]
    way = np.array([-3.0, 1.6]) - top
    length = float(np.linalg.norm(way))
    arm, pull = top - [0.4, 0.0], 3000 * way / length
    holds = arm[0] * pull[1] - arm[1] * pull[0] + WEIGHT * (0.4 - centroid[0])
    return float(centroid[0] - 0.2), holds / (WEIGHT * centroid[1]), length - 3.0


TURNS = np.linspace(0.0, 0.9, 4000)
MOVED, FACTORS, LONGER = np.array([closed_form(turn) for turn in TURNS]).T


@pytest.mark.long
def test_a_tie_that_yields_without_end_holds_a_wall_as_it_turns() -> None:
    """The tie pulls along its line as it lies then; energies add up, and what ties take is no drop."""
    _, case = case_of(DECK)
    curve = case.solution.further.pushover.curve
    found = np.array([[row.displacement, row.load_factor] for row in curve])
    assert len(curve) > 20
    assert found[:, 1] == pytest.approx(np.interp(found[:, 0], MOVED, FACTORS), abs=2e-5)
    assert max(row.residual for row in curve) < 1e-6
    assert abs(energy_missing(curve)) < 5e-3
    assert curve[-1].tie_work == pytest.approx(3000 * np.interp(found[-1, 0], MOVED, LONGER), rel=1e-2)
    assert dropped(curve) is None


@pytest.mark.parametrize("most", [0.0, 0.03])
def test_a_tie_breaks_where_it_has_yielded_by_as_much_as_it_can(most: float) -> None:
    """From there on the curve is that of the wall alone."""
    _, case = case_of(DECK.replace("capacity:", f"breaks_at: {most}, capacity:").replace("step: 0.01", "step: 0.02"))
    curve = case.solution.further.pushover.curve
    first = next(row for row in curve if row.broken)
    longer = np.interp([first.displacement - 0.02, first.displacement], MOVED, LONGER) / 3.0
    assert longer[0] <= most + 2e-3
    assert longer[1] > most
    alone = np.array([[row.displacement, row.load_factor] for row in curve if row.broken])
    radius, corner = np.hypot(0.2, 1.0), np.arctan(0.2)
    turned = corner - np.arcsin(np.sin(corner) - alone[:, 0] / radius)
    # the first pose lies along the motion of joints that give way a little as the tie breaks
    assert alone[:, 1] == pytest.approx(np.tan(corner - turned), abs=6e-3)
    assert case.solution.further.pushover.curve_end is CurveEnd.NOTHING_LEFT


def test_a_tie_that_goes_slack_carries_nothing_until_it_is_as_long_again() -> None:
    """On the side to which the wall falls: it gets shorter, and the wall falls as if it were alone."""
    deck = DECK.replace("[[0, 0.5", "[[0.4, 0.5").replace("[-3, 0.5", "[3, 0.5")
    _, case = case_of(deck)
    assert case.solution.mechanics is not None
    assert case.solution.mechanics.load_factor == pytest.approx(0.2, rel=1e-6)
    assert case.solution.further.pushover.curve[-1].tie_work == pytest.approx(0.0, abs=1e-3)
    assert case.solution.further.pushover.curve[-1].displacement == pytest.approx(0.2, rel=1e-3)


SLIDING = (
    HEAD
    + """\
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
supports: [{ground: {z: 0}}]
ties:
  - {through: [[0.5, 0.5, 1], [0.9, 0.5, 5]], on: [block, ground], capacity: 4000, breaks_at: 0.002}
load_cases: {push: {live: [{acceleration: [1, 0, 0]}], pushover: {step: 0.04, until: 1}}}
"""
)


@pytest.mark.long
def test_a_slack_tie_does_not_break_as_it_gets_as_long_again() -> None:
    """Under its tie a block slides by 0.8 m until that is as long as at first, and by 0.874 m until it breaks."""
    _, case = case_of(SLIDING)
    moved, broken = np.array([[row.displacement, row.broken] for row in case.solution.further.pushover.curve]).T
    length = np.sqrt(16 + (moved - 0.4) ** 2)
    assert list(broken) == list((moved > 0.4) & (length > 1.002 * np.hypot(4, 0.4)))


@pytest.mark.parametrize(("acts", "ends"), [("compression", (0.4, 3)), ("both", (0.4, 3)), ("both", (0, -3))])
def test_what_is_brittle_breaks_in_either_sense(acts: str, ends: tuple[float, float]) -> None:
    """A strut before the wall, a bar before or behind it: behind the peak the wall is alone."""
    deck = DECK.replace("[[0, 0.5", f"[[{ends[0]}, 0.5").replace("[-3, 0.5", f"[{ends[1]}, 0.5")
    deck = deck.replace("capacity:", f"acts: {acts}, breaks_at: 0, capacity:").replace("0.01}", "0.02, steps: 3}")
    _, case = case_of(deck)
    first, *others = case.solution.further.pushover.curve
    assert first.load_factor > 0.25
    alone = [row.broken for row in others if row.displacement > 1e-3]
    assert alone == [1] * len(alone)
    assert alone


STRIP = DECK.replace(
    '  - {through: [[0, 0.5, "=ht"], [-3, 0.5, "=ht"]], on: [block, ground],',
    "  - {strip: [[0, 0.5, -0.4], [0, 0.5, 0.4]],",
).replace(
    "supports: [{ground: {z: 0}}]",
    "  - box: {group: base, material: stone, min: [0, 0, -0.5], max: [0.6, 1, 0]}\nsupports: [{blocks: base}]",
)
"""The wall on a base, with a strip over the joint that opens."""


def test_a_strip_comes_off_as_it_slips_unless_the_deck_says_otherwise() -> None:
    """Held it counts with F b = W b/2 as the wall turns; else the wall is alone from there on."""
    for more, held in (("", 0.0), ("breaks_at: never, ", 1.0)):
        _, case = case_of(STRIP.replace("capacity:", f"{more}capacity:"), "load_cases.push.pushover.steps=3")
        first, *rows = case.solution.further.pushover.curve
        whole = 0.2 + 3000 * 0.4 / WEIGHT
        if held:
            assert first.load_factor == pytest.approx(whole, rel=1e-5)
        else:  # it comes off before the joint is open, as stiff as a point of the joint
            assert 0.2 < first.load_factor < whole * (1.0 + 1e-9)  # rounding
        for row in rows:
            turned = np.arctan(0.2) - np.arcsin(np.sin(np.arctan(0.2)) - row.displacement / np.hypot(0.2, 1.0))
            height = 0.2 * np.sin(turned) + np.cos(turned)
            # the strip stays along the base, and acts where it leaves the wall: the lower corner of that
            expected = np.tan(np.arctan(0.2) - turned) + held * 3000 * 0.4 * np.cos(turned) / (WEIGHT * height)
            assert row.load_factor == pytest.approx(expected, abs=6e-3)
        assert rows[-1].broken == (0 if held else 1)
