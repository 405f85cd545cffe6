"""Glue beside guided blocks and settling supports: heeded where it can be, refused in words where not."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.assembly.rigid_bodies import guides_at_odds
from mbla.errors import DeckError
from mbla.model.supports.guides import Guides
from tests.asked import settlement_of
from tests.line import HEAD, case_of, factor_of

TOWER = (
    HEAD
    + """\
joints: {dry: {friction: 0.6}}
blocks:
  - box: {group: a, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: b, material: stone, min: [0, 0, 1], max: [1, 1, 2]}
  - box: {group: c, material: stone, min: [0, 0, 2], max: [1, 1, 3]}
supports: [{ground: {z: 0}}SUPPORTS]
load_cases: {push: CASE}
analysis: {flow_rule: associative}
"""
)
PUSH = "{live: [{acceleration: [1, 0, 0]}]}"


def tower(pairs: str, supports: str = "", case: str = PUSH) -> str:
    """Three cubes on top of each other, of which some are glued."""
    overrides = ", ".join(f"{{between: {pair}, joint: glued}}" for pair in pairs.split(" "))
    text = TOWER.replace("contacts: {joint: dry}", f"contacts: {{joint: dry, overrides: [{overrides}]}}")
    return text.replace("SUPPORTS", supports).replace("CASE", case)


def message(text: str) -> str:
    with pytest.raises(DeckError) as caught:
        case_of(text)
    (fault,) = caught.value.faults
    return f"{fault.key}: {fault.message}"


def test_a_guided_block_guides_the_body_it_is_glued_into() -> None:
    """The upper pair may not turn, so that the tower slides instead of falling over its foot."""
    guide = ", {blocks: c, fixed: [y, rx, ry, rz]}"
    assert factor_of(tower("[b,c]")) == pytest.approx(1 / 3, rel=1e-6)
    assert factor_of(tower("[b,c]", guide)) == pytest.approx(0.6, rel=1e-6)


def test_the_guide_of_a_body_turns_it_about_the_line_of_its_block() -> None:
    """Glued to a cube that turns about the edge x = 1, z = 1, a pair falls over as it would without a guide."""
    guide = ", {blocks: c, turn: {axis: [0, 1, 0], about: [1, 0, 1]}}"
    model, case = case_of(tower("[b,c]", guide))
    assert case.solution.mechanics is not None, case.solution.reason
    assert case.solution.mechanics.load_factor == pytest.approx(0.5, rel=1e-6)
    motion = case.solution.mechanics.mechanism
    assert motion[1, 3:] == pytest.approx(motion[2, 3:])
    assert model.guides.blocks.tolist() == [2]
    assert case.checks.verified


def test_guides_that_differ_on_one_body_are_refused() -> None:
    guides = ", {blocks: c, fixed: [y, z, rx, ry, rz]}, {blocks: b, fixed: [x, z, rx, ry, rz]}"
    words = message(tower("[b,c]", guides))
    assert words.startswith("supports")
    assert "c[0] and b[0] are glued to one rigid body, but may move in different ways: guide one" in words


def test_one_guide_of_two_blocks_that_are_glued_is_none_too_many() -> None:
    guide = ", {blocks: [b, c], turn: {axis: [0, 1, 0], about: [1, 0, 1]}, together: true}"
    assert factor_of(tower("[b,c]", guide)) == pytest.approx(0.5, rel=1e-6)


def test_a_guided_block_glued_to_a_support_is_refused() -> None:
    guide = ", {blocks: a, fixed: [y, z, rx, ry, rz]}"
    assert "a[0] may move in some way, but glue holds it to a support" in message(tower("[a,ground]", guide))


def test_what_is_glued_to_a_support_that_gives_way_is_refused() -> None:
    text = tower("[a,b]", ", {blocks: a}", "{settlement: {on: a, direction: [0, 0, -1]}}")
    words = message(text.replace("{ground: {z: 0}}, ", ""))
    assert "settlement.on" in words
    assert "b[0] held by glue on a settling support: fix that too, so that it settles along" in words


def test_a_body_on_a_support_that_gives_way() -> None:
    """Two glued cubes on one that sinks: its reaction is their weight."""
    text = tower("[b,c]", ", {blocks: a}", "{settlement: {on: a, direction: [0, 0, -1]}}")
    _, case = case_of(text.replace("{ground: {z: 0}}, ", ""))
    assert case.solution.mechanics is not None, case.solution.reason
    settlement = settlement_of(case.load_case)
    reaction = settlement.reaction(case.solution.mechanics.load_factor)
    assert reaction == pytest.approx(2 * 2000 * 9.81, rel=1e-6)


def test_loads_that_cancel_on_one_body_beside_another_that_has_none() -> None:
    """0.1 + 0.2 − 0.3 is no zero in binary."""
    forces = ", ".join(f"{{force: [0, 0, {size}], on: {on}}}" for size, on in ((0.1, "b"), (0.2, "b"), (-0.3, "c")))
    words = message(tower("[b,c]", case=f"{{live: [{forces}]}}"))
    assert "the live loads have no effect" in words


def guides_of(motions: list[FloatArray], bodies: list[int]) -> Guides:
    return Guides(np.arange(len(motions)), np.array(bodies), np.array(motions))


def test_guides_that_differ_in_one_motion_alone() -> None:
    """Two blocks of one body, one above the other; turning about y moves the upper one along x."""
    label, arms = np.array([0, 0]), np.array([[0, 0, -0.5], [0, 0, 0.5]])
    lower, upper = np.zeros((6, 6)), np.zeros((6, 6))
    lower[:, 0], upper[:, 0] = (-0.5, 0, 0, 0, 1, 0), (0.5, 0, 0, 0, 1, 0)
    assert guides_at_odds(guides_of([lower, upper], [0, 0]), label, arms) is None
    assert guides_at_odds(guides_of([lower, upper], [0, 1]), label, arms) == (0, 1)
    for off, odd in ((1e-12, None), (1e-3, (0, 1))):
        slipped = upper.copy()
        slipped[0, 0] += off
        assert guides_at_odds(guides_of([lower, slipped], [0, 0]), label, arms) == odd
    assert guides_at_odds(guides_of([lower, slipped], [0, 0]), np.array([0, 1]), arms) is None
