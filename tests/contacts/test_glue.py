"""Guides and settlements of structures with glued blocks."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.contacts import Contacts, find_contacts
from mbla.contacts.glue import glue_blocks, held_model, solids_of
from mbla.deck.sections.contacts import ContactOverride, ContactsSection
from mbla.model.model import LoadCase, Model
from mbla.results.outcome import reaction_of
from mbla.run import RunOptions, run
from tests.contacts.structures import blocks_of, boxes, ground, model_of

TOWER = boxes(*(([0, 0, i], [1, 1, i + 1]) for i in range(5)))
GROUPS = ["a", "b", "c", "d", "e"]


def glued(*pairs: tuple[str, str], joint: str = "glued") -> tuple[Model, Contacts]:
    """The tower on the ground with some of its beds glued."""
    model = model_of(blocks_of(TOWER, GROUPS), grounds=(ground(),))
    overrides = [ContactOverride(between=pair, joint=joint) for pair in pairs]
    contacts = find_contacts(model, ContactsSection(joint="dry", overrides=overrides))
    return held_model(model, contacts), contacts


def identifiers(contacts: Contacts) -> list[str]:
    return [notice.identifier for notice in contacts.report.notices]


def test_nothing_glued_is_the_same_model() -> None:
    model, contacts = glued()
    solids = solids_of(model, contacts)
    assert solids.model is model
    assert solids.contacts is contacts
    assert contacts.solid_of_block is None
    loads = np.ones((5, 6))
    assert np.array_equal(solids.loads(loads), loads)
    assert np.array_equal(solids.block_motions(loads), loads)


def test_glue_joins_blocks_through_others() -> None:
    model, contacts = glued(("b", "c"), ("c", "d"))
    assert contacts.solid_of_block is not None
    assert contacts.solid_of_block.tolist() == [0, 1, 1, 1, 2]
    assert len(contacts) == 3
    assert contacts.report.glued.tolist() == [[1, 2], [2, 3]]
    assert identifiers(contacts) == ["blocks-glued"]
    assert "3 blocks make 1 rigid body" in contacts.report.notices[0].message
    solids = solids_of(model, contacts)
    assert len(solids.model.blocks) == 3
    np.testing.assert_allclose(solids.model.blocks.volumes, [1, 3, 1])
    np.testing.assert_allclose(solids.model.blocks.centroids[:, 2], [0.5, 2.5, 4.5])
    assert solids.contacts.bodies.tolist() == [[0, 1], [1, 2], [3, 0]]
    assert [solids.model.blocks.name(solid) for solid in range(3)] == ["a[0]", "b[0]", "e[0]"]


def test_what_is_glued_to_a_support_does_not_move() -> None:
    model, contacts = glued(("ground", "a"), ("a", "b"), ("d", "e"))
    assert model.fixed.tolist() == [True, True, False, False, False]
    assert contacts.report.held.tolist() == [0, 1]
    assert contacts.bodies.tolist() == [[1, 2], [2, 3]]
    assert contacts.solid_of_block is not None
    assert contacts.solid_of_block.tolist() == [0, 1, 2, 3, 3]
    assert "2 blocks glued to a support do not move" in contacts.report.notices[-1].message
    assert len(contacts.report.unsupported) == 0


def test_a_support_does_not_join_what_is_glued_to_it() -> None:
    glue = glue_blocks(model_of(blocks_of(TOWER, GROUPS), fixed=[1]), np.array([[0, 1], [1, 2]]))
    assert glue.solid_of_block is None
    assert glue.held.tolist() == [True, False, True, False, False]


def test_a_dry_joint_inside_of_a_rigid_body_is_left_out() -> None:
    """Three blocks touch each other in pairs; two of the three joints are glued."""
    ring = boxes(([0, 0, 0], [2, 1, 1]), ([0, 0, 1], [1, 1, 2]), ([1, 0, 1], [2, 1, 2]))
    model = model_of(blocks_of(ring, ["base", "left", "right"]), grounds=(ground(),))
    overrides = [ContactOverride(between=("base", ["left", "right"]), joint="glued")]
    contacts = find_contacts(model, ContactsSection(joint="dry", overrides=overrides))
    assert contacts.bodies.tolist() == [[3, 0]]
    assert len(contacts.report.glued) == 3
    assert contacts.report.fixed_contacts == 0


@pytest.mark.parametrize("fixed", [[], [1], [0, 1]])
def test_a_dry_joint_between_blocks_that_glue_or_a_support_holds_is_left_out(fixed: list[int]) -> None:
    """Two cubes side by side on the ground, glued to it where they are not fixed, and one more on both."""
    row = boxes(([0, 0, 0], [1, 1, 1]), ([1, 0, 0], [2, 1, 1]), ([0, 0, 1], [2, 1, 2]))
    model = model_of(blocks_of(row, ["a", "b", "c"]), fixed=fixed, grounds=(ground(),))
    overrides = [ContactOverride(between=("ground", ["a", "b"]), joint="glued")]
    contacts = find_contacts(model, ContactsSection(joint="dry", overrides=overrides))
    assert contacts.bodies.tolist() == [[0, 2], [1, 2]]


def test_loads_and_motions_keep_their_power() -> None:
    rng = np.random.default_rng(3)
    model, contacts = glued(("b", "c"), ("d", "e"))
    model = replace(model, load_cases=(LoadCase("x", rng.normal(size=(5, 6)), rng.normal(size=(5, 6)), (), ()),))
    solids = solids_of(model, contacts)
    motions = rng.normal(size=(3, 6))
    on_blocks = solids.block_motions(motions)
    np.testing.assert_allclose(solids.solid_motions(on_blocks), motions, atol=1e-14)
    case, of_solids = model.load_cases[0], solids.model.load_cases[0]
    assert np.sum(of_solids.dead_load * motions) == pytest.approx(np.sum(case.dead_load * on_blocks), rel=1e-12)
    assert np.sum(of_solids.live_load * motions) == pytest.approx(np.sum(case.live_load * on_blocks), rel=1e-12)


def test_open_joints_are_no_contacts() -> None:
    _, contacts = glued(("b", "c"), joint="open")
    assert len(contacts) == 4
    assert contacts.report.open_interfaces == 1
    assert [part.tolist() for part in contacts.report.unsupported] == [[2, 3, 4]]
    assert set(identifiers(contacts)) == {"open-interfaces-left-out", "unsupported-parts"}


def test_blocks_that_are_glued_may_not_overlap_either() -> None:
    pair = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 0.9], [1, 1, 2]))
    model = model_of(blocks_of(pair), grounds=(ground(),))
    assert len(find_contacts(model, ContactsSection(joint="glued")).report.overlaps) == 1


DECK = """
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
blocks:
  - box: {group: base, material: stone, min: [0, 0, -1], max: [3, 1, 0]}
  - box: {group: far, material: stone, min: [4, 0, -1], max: [5, 1, 0]}
  - box: {group: lower, material: stone, min: [0.5, 0, 0], max: [1.5, 1, 1]}
  - box: {group: upper, material: stone, min: [0.5, 0, 1], max: [1.5, 1, 2]}
  - box: {group: beam, material: stone, min: [2, 0, 0], max: [3.5, 1, 0.5]}
  - box: {group: beam, material: stone, min: [3.5, 0, 0], max: [5, 1, 0.5]}
contacts: {joint: dry, overrides: [{between: [lower, upper], joint: glued}, {between: [beam, beam], joint: glued}%s]}
supports:
  - {blocks: [base, far]}
  - {blocks: %s, turn: {axis: [0, 1, 0], about: [1.5, 0, 0]}}%s
load_cases:
  push: {live: [{acceleration: [1, 0, 0], on: [lower, upper]}]}
  settle: {settlement: {on: far, direction: [0, 0, -1]}}
analysis: {flow_rule: associative}
output: {vtu: false}
"""


@pytest.mark.parametrize("blocks", ["lower", "upper", "[lower, upper]"])
def test_a_solid_moves_as_its_guided_block_may(tmp_path: Path, blocks: str) -> None:
    together = ", together: true" if "[" in blocks else ""
    path = tmp_path / "deck.yaml"
    path.write_text((DECK % ("", blocks, "")).replace("0, 0]}}", f"0, 0]}}{together}}}", 1), encoding="utf-8")
    results = run(path, RunOptions(folder=tmp_path / "out", force=True))
    push, settle = results.case("push"), results.case("settle")
    assert push.checks.verified
    assert push.solution.mechanics is not None
    assert push.solution.mechanics.load_factor == pytest.approx(0.5, rel=1e-7)  # b/h, about the hinge at its edge
    # the beam of 3 m turns about the edge of the base, 0.5 m from its middle and 2 m from the far end
    assert reaction_of(settle) == pytest.approx(3 * 0.5 * 2000 * 9.81 / 4, rel=1e-7)
