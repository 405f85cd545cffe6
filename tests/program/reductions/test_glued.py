"""What glue saves, and that a glued joint is one whose strength is never reached."""

from __future__ import annotations

import pytest

from mbla.contacts import find_contacts
from mbla.contacts.glue import held_model, solids_of
from mbla.program import assemble
from mbla.program.reductions import StepState
from mbla.program.reductions.steps import ReductionStep, glued_step, size_of
from tests.line import HEAD, case_of, factor_of, line_of

PIERS = (
    HEAD
    + """\
joints: {dry: {friction: 0.55}, strong: {friction: 1, cohesion: 1.e7, tensile_strength: 1.e7}}
contacts: {joint: dry, overrides: [{between: [pier, lintel], joint: LAW}, {between: [foot, pier], joint: FOOT}]}
blocks:
  - box: {group: foot, material: stone, min: [0, 0, -1], max: [1, 1, 0]}
  - box: {group: pier, material: stone, min: [0, 0, 0], max: [1, 1, 2]}
  - box: {group: pier, material: stone, min: [3, 0, 0], max: [4, 1, 2]}
  - box: {group: lintel, material: stone, min: [0, 0, 2], max: [4, 1, 3]}
supports: [{blocks: foot}, {ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
"""
).replace("contacts: {joint: dry}\n", "")


def text(law: str, foot: str) -> str:
    return PIERS.replace("LAW", law).replace("FOOT", foot)


def step_of(law: str, foot: str) -> ReductionStep:
    model, case = case_of(text(law, foot), "analysis.flow_rule=associative")
    (step,) = (step for step in case.solution.reductions if step.name == "glued")
    assert len(model.blocks) == 4
    return step


@pytest.mark.parametrize(
    ("law", "foot", "found", "before", "after"),
    [
        ("dry", "dry", 0, 18, 18),  # two piers and the lintel
        ("glued", "dry", 3, 18, 6),  # one body
    ],
)
def test_unknowns_before_and_after(law: str, foot: str, found: int, before: int, after: int) -> None:
    step = step_of(law, foot)
    assert (step.found, step.before.unknowns, step.after.unknowns) == (found, before, after)
    assert step.state is (StepState.APPLIED if found else StepState.NONE)


@pytest.mark.parametrize("flow_rule", ["associative", "non_associative"])
def test_a_joint_that_is_never_overcome_is_glued(flow_rule: str) -> None:
    """The frame slides on its two feet at the friction coefficient, or rocks about the edge of its right foot."""
    flow = f"analysis.flow_rule={flow_rule}"
    glued, strong = (factor_of(text(law, "dry"), flow) for law in ("glued", "strong"))
    assert glued == pytest.approx(0.55, rel=1e-6)
    assert strong == pytest.approx(glued, rel=1e-6)


def test_blocks_held_by_glue_have_no_unknowns() -> None:
    line = line_of(text("dry", "glued"))
    contacts = find_contacts(line.model, line.deck.contacts)
    model = held_model(line.model, contacts)
    solids = solids_of(model, contacts)
    program = assemble(solids.model, solids.contacts, solids.load_case(line.load_case))
    step = glued_step(solids, size_of([program]))
    assert (step.found, step.before.unknowns, step.after.unknowns) == (1, 18, 12)
