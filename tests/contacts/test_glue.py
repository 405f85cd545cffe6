"""Glue while contacts are found: what it joins and holds, and which interfaces it leaves out."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.contacts import Contacts, find_contacts
from mbla.contacts.glue import glue_blocks
from mbla.deck.sections.contacts import ContactOverride, ContactsSection
from tests.assembly.towers import GROUPS, TOWER, glued
from tests.contacts.structures import blocks_of, boxes, ground, model_of


def identifiers(contacts: Contacts) -> list[str]:
    return [notice.identifier for notice in contacts.report.notices]


def test_glue_joins_blocks_through_others() -> None:
    contacts = glued(("b", "c"), ("c", "d")).contacts
    assert contacts.solid_of_block is not None
    assert contacts.solid_of_block.tolist() == [0, 1, 1, 1, 2]
    assert len(contacts) == 3
    assert contacts.report.glued.tolist() == [[1, 2], [2, 3]]
    assert identifiers(contacts) == ["blocks-glued"]
    assert "3 blocks make 1 rigid body" in contacts.report.notices[0].message


def test_what_is_glued_to_a_support_does_not_move() -> None:
    assembly = glued(("ground", "a"), ("a", "b"), ("d", "e"))
    model, contacts = assembly.model, assembly.contacts
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


def test_open_joints_are_no_contacts() -> None:
    contacts = glued(("b", "c"), joint="open").contacts
    assert len(contacts) == 4
    assert contacts.report.open_interfaces == 1
    assert [part.tolist() for part in contacts.report.unsupported] == [[2, 3, 4]]
    assert set(identifiers(contacts)) == {"open-interfaces-left-out", "unsupported-parts"}


def test_blocks_that_are_glued_may_not_overlap_either() -> None:
    pair = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 0.9], [1, 1, 2]))
    model = model_of(blocks_of(pair), grounds=(ground(),))
    assert len(find_contacts(model, ContactsSection(joint="glued")).report.overlaps) == 1
