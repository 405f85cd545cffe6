"""The analysis with interface resultants where it locks, or nothing resists."""

from __future__ import annotations

import math

import pytest

from mbla.solution.solution import Standing, Status
from tests.line import BLOCK, line_of
from tests.solution.convex_structures import DECKS
from tests.solution.convex_structures import convex as convex_of


def test_what_locks_with_dilatancy_slides_without() -> None:
    """A block in a groove: tan of the tilt μ/cos 30°, to which the path still rises."""
    line = line_of((DECKS / "groove.yaml").read_text(encoding="utf-8"), "parameters.mu=2", "expected={}")
    solution, checks = convex_of(line, "non_associative")
    assert solution.associative is None
    assert checks.verified, checks.failures
    assert solution.mechanics is not None
    assert solution.mechanics.load_factor == pytest.approx(2.0 / math.cos(math.pi / 6.0), rel=0.01)


def test_a_bar_between_two_walls_that_locks_with_dilatancy_has_no_load_factor_without() -> None:
    line = line_of((DECKS / "bar_between_walls.yaml").read_text(encoding="utf-8"))
    solution, _ = convex_of(line, "non_associative")
    assert (solution.associative, solution.mechanics) == (None, None)
    assert solution.standing is not None
    assert solution.standing.verdict is Standing.SELF_STRESS
    assert solution.status is Status.NOT_VERIFIED


@pytest.mark.parametrize("rule", ["associative", "non_associative"])
def test_a_block_that_hangs_on_a_guide_without_an_interface_is_moved_by_any_push(rule: str) -> None:
    """A pendulum about an axis above it: at rest under its weight, and nothing resists."""
    text = BLOCK.replace("{ground: {z: 0}}", "{blocks: block, turn: {axis: [0, 1, 0], about: [0.5, 0, 3]}}")
    line = line_of(text)
    assert len(line.contacts) == 0
    solution, checks = convex_of(line, rule)
    assert solution.status is Status.SOLVED
    assert checks.verified
    assert solution.mechanics is not None
    assert solution.mechanics.load_factor == pytest.approx(0.0, abs=1e-12)


PRESSED = """  - box: {group: fixed, material: stone, min: [9, 0, 19], max: [10, 1, 20]}
  - box: {group: fixed, material: stone, min: [9, 1, 19], max: [10, 2, 21]}
  - box: {group: pressed, material: stone, min: [9, 0, 20], max: [10, 1, 21]}

contacts: {joint: dry}"""


@pytest.mark.parametrize("beside", [False, True], ids=["alone", "beside a block that locks by its points"])
def test_a_wedge_that_locks_does_so_in_proved_forces(beside: bool) -> None:
    text = (DECKS / "groove_locked.yaml").read_text(encoding="utf-8")
    if beside:
        text = text.replace("contacts: {joint: dry}", PRESSED).replace(
            "supports:\n", "supports:\n  - {blocks: fixed}\n"
        )
    solution, checks = convex_of(line_of(text), "associative")
    assert solution.status is Status.UNBOUNDED
    assert checks.verified, checks.failures
    assert solution.lock is not None
