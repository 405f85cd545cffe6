from __future__ import annotations

import pytest

from mbla.contacts import Contacts, find_contacts
from tests.contacts.structures import blocks_of, boxes, ground, model_of, section

TOWER = boxes(*(([0, 0, i], [1, 1, i + 1]) for i in range(4)))
GROUPS = ["pier", "pier", "arch", "ground"]


def joints(contacts: Contacts) -> list[str]:
    """Joint law of every interface, bottom to top."""
    rows = sorted(range(len(contacts)), key=lambda i: float(contacts.centroids[i, 2]))
    return [contacts.joint_names[contacts.joints[i]] for i in rows]


@pytest.mark.parametrize(
    ("overrides", "expected"),
    [
        ([], ["lead", "dry", "dry", "dry"]),
        ([("pier", "arch", "mortar")], ["lead", "dry", "mortar", "dry"]),
        ([("arch", "pier", "mortar")], ["lead", "dry", "mortar", "dry"]),
        ([("pier", "pier", "mortar")], ["lead", "mortar", "dry", "dry"]),
        ([("ground", "pier", "mortar")], ["mortar", "dry", "dry", "dry"]),
        ([("pier", "arch", "mortar"), ("arch", "pier", "lead")], ["lead", "dry", "lead", "dry"]),
        ([("pier", "arch", "mortar"), ("pier", "pier", "lead")], ["lead", "lead", "mortar", "dry"]),
    ],
    ids=["none", "pair", "other order", "within a group", "ground plane", "last one holds", "two pairs"],
)
def test_joint_of_each_interface(overrides: list[tuple[str, str, str]], expected: list[str]) -> None:
    model = model_of(blocks_of(TOWER, GROUPS), grounds=(ground(joint="lead"),))
    assert joints(find_contacts(model, section(overrides=overrides))) == expected


def test_a_group_called_ground_is_not_the_ground() -> None:
    model = model_of(blocks_of(TOWER, GROUPS), fixed=[0])
    contacts = find_contacts(model, section(overrides=[("arch", "ground", "mortar")]))
    assert joints(contacts) == ["dry", "dry", "dry"]
    assert [notice.identifier for notice in contacts.report.notices] == ["override-without-contact"]


def test_only_laws_in_use_are_listed_in_the_order_of_the_deck() -> None:
    model = model_of(blocks_of(TOWER, GROUPS), grounds=(ground(joint="lead"),))
    contacts = find_contacts(model, section(overrides=[("pier", "pier", "mortar")]))
    assert contacts.joint_names == ("dry", "mortar", "lead")
