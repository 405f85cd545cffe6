from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from mbla.contacts import Contacts, find_contacts
from mbla.deck.sections.contacts import ContactOverride, ContactsSection
from mbla.model.solids.polyhedra import join_polyhedra
from tests.contacts.structures import blocks_of, boxes, ground, model_of, moved, prism, running_bond, section
from tests.line import HEAD, line_of

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


def laws(overrides: list[dict[str, Any]], tilt: float = 0.0) -> list[tuple[str, bool]]:
    """Joint law of every interface of a wall of three courses, and whether it is a bed; turned about the y axis."""
    cosine, sine = math.cos(math.radians(tilt)), math.sin(math.radians(tilt))
    turn = np.array([[cosine, 0, sine], [0, 1, 0], [-sine, 0, cosine]])
    wall = moved(running_bond(2, 3), turn=turn)
    given = [ContactOverride.model_validate({"joint": "mortar"} | override) for override in overrides]
    contacts = find_contacts(model_of(blocks_of(wall), fixed=[0]), ContactsSection(joint="dry", overrides=given))
    beds = np.abs(contacts.normals @ turn[:, 2]) > 0.9
    names = [contacts.joint_names[joint] for joint in contacts.joints]
    return list(zip(names, beds.tolist(), strict=True))


@pytest.mark.parametrize("tilt", [0.0, 44.9, -44.9])
def test_bed_and_head_joints(tilt: float) -> None:
    found = laws([{"orientation": "bed"}, {"orientation": "head", "joint": "lead"}], tilt)
    assert set(found) == {("mortar", True), ("lead", False)}


@pytest.mark.parametrize("tilt", [45.1, 90.0, -60.0])
def test_a_wall_on_its_side_has_its_beds_as_heads(tilt: float) -> None:
    found = laws([{"orientation": "bed"}, {"orientation": "head", "joint": "lead"}], tilt)
    assert set(found) == {("lead", True), ("mortar", False)}


@pytest.mark.parametrize("tilt", [45.0, 135.0])
def test_at_45_degrees_everything_is_a_head_joint_in_spite_of_rounding(tilt: float) -> None:
    assert {law for law, _ in laws([{"orientation": "bed"}, {"orientation": "head", "joint": "lead"}], tilt)} == {
        "lead"
    }


@pytest.mark.parametrize(("within", "fits"), [(30.0, True), (29.9, False), (90.0, True)])
def test_angle_to_a_direction_either_way_round(within: float, fits: bool) -> None:
    for size in (1e-200, 1.0, -1e200):
        normal = [0.0, 0.0, size]
        found = laws([{"orientation": {"normal": normal, "within": within}}], tilt=30.0)
        assert {law for law, bed in found if bed} == ({"mortar"} if fits else {"dry"})


def test_box_of_centroids() -> None:
    """Bed joints of a wall of courses of 0.175 m, those at the foot of the second course."""
    found = laws([{"box": [[-1, -1, 0.17], [1, 1, 0.18]]}])
    contacts = find_contacts(model_of(blocks_of(running_bond(2, 3)), fixed=[0]), section())
    inside = np.abs(contacts.centroids[:, 2] - 0.175) < 1e-9
    assert [law == "mortar" for law, _ in found] == inside.tolist()
    assert 0 < inside.sum() < len(inside)


def test_all_conditions_of_an_override_must_hold() -> None:
    box = [[-1, -1, 0.0], [0.9, 1, 0.2]]
    both = laws([{"box": box, "orientation": "head"}])
    boxed, heads = laws([{"box": box}]), laws([{"orientation": "head"}])
    expected = [a == b == "mortar" for (a, _), (b, _) in zip(boxed, heads, strict=True)]
    assert [law == "mortar" for law, _ in both] == expected
    assert 0 < sum(expected) < min(sum(law == "mortar" for law, _ in one) for one in (boxed, heads))


def test_the_last_override_that_fits_holds() -> None:
    found = laws([{"orientation": "bed"}, {"box": [[-9, -9, -9], [9, 9, 9]], "joint": "lead"}])
    assert {law for law, _ in found} == {"lead"}


def test_an_override_that_fits_nothing_is_told() -> None:
    given = ContactOverride.model_validate(
        {
            "between": [{"group": "pier", "index": 1}, ["arch", "ground"]],
            "orientation": {"normal": [1, 0, 0], "within": 20},
            "box": [[0, 0, 0], [1, 1, 1]],
            "joint": "mortar",
        }
    )
    model = model_of(blocks_of(TOWER, GROUPS), grounds=(ground(),))
    (notice,) = find_contacts(model, ContactsSection(joint="dry", overrides=[given])).report.notices
    assert notice.identifier == "override-without-contact"
    assert "overrides[0]" in notice.message


STACK = (
    HEAD
    + """\
joints: {dry: {friction: 0.6}, smooth: {friction: 0.2}}
blocks:
  - box:
      {group: stack, material: stone, min: [0, 0, 0], max: [1, 1, 0.2], repeat: {count: 4, translate: [0, 0, 0.2]}}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""
).replace("contacts: {joint: dry}\n", "")


@pytest.mark.parametrize(
    ("between", "heights"),
    [
        ("[{group: stack, copy: 1}, [{group: stack, copy: 2}]]", [0.4]),
        ("[{group: stack, copy: [1, -1]}, {group: stack, copy: [1, -1]}]", [0.4, 0.6]),
        ("[stack, [ground, {group: stack, index: 3}]]", [0.0, 0.6]),
        ("[{box: [[0, 0, 0], [1, 1, 0.55]]}, stack]", [0.2, 0.4, 0.6]),
    ],
    ids=["labels in a list", "ranges", "ground in a list", "box of blocks"],
)
def test_selectors(between: str, heights: list[float]) -> None:
    line = line_of(f"{STACK}contacts: {{joint: dry, overrides: [{{between: {between}, joint: smooth}}]}}\n")
    chosen = line.contacts.joints == line.contacts.joint_names.index("smooth")
    assert sorted(line.contacts.centroids[chosen, 2].tolist()) == pytest.approx(heights, abs=1e-12)


def test_frictionless_is_known_without_declaring_it() -> None:
    declared = "joints: {dry: {friction: 0.6}, smooth: {friction: 0.2}}\n"
    line = line_of(STACK.replace(declared, "") + "contacts: {joint: frictionless}\n")
    assert line.contacts.joint_names == ("frictionless",)
    assert line.model.joints["frictionless"].friction == 0.0
    assert "frictionless" not in line_of(STACK + "contacts: {joint: dry}\n").model.joints


def test_an_interface_at_the_limit_of_a_sloping_face() -> None:
    """A wedge on a wedge, its joint 40 degrees from the horizontal: a bed joint."""
    rise = math.tan(math.radians(40))
    turn = np.array([[1, 0, 0], [0, 0, -1.0], [0, 1.0, 0]])
    wedge = moved(prism([[0, 0], [1, 0], [0, rise]], 0.0, 1.0), turn=turn)
    block = moved(prism([[0, rise], [1, 0], [1, 1 + rise], [0, 1 + rise]], 0.0, 1.0), turn=turn)
    model = model_of(blocks_of(join_polyhedra([wedge, block]), ["w", "b"]), fixed=[0])
    for orientation, law in (("bed", "mortar"), ("head", "dry")):
        given = ContactOverride.model_validate({"orientation": orientation, "joint": "mortar"})
        assert joints(find_contacts(model, ContactsSection(joint="dry", overrides=[given]))) == [law]
