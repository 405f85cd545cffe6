"""Interfaces given as a table: equal to those found, and refused where they lie on no face."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from mbla.contacts import Contacts, find_contacts
from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.model import build_model
from tests.model.shapes import write_deck

HEADER = "interface,group_a,index_a,group_b,index_b,x,y,z\n"
BLOCKS = [
    "box: {group: low, material: stone, min: [0, 0, 0], max: [2, 1, 1]}",
    "box: {group: high, material: stone, min: [0.5, 0, 1], max: [3, 1, 2]}",
]
SQUARE = [(0.5, 0, 1), (2, 0, 1), (2, 1, 1), (0.5, 1, 1)]
FOOT = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)]


def rows(name: str, bodies: str, corners: Sequence[tuple[float, ...]]) -> str:
    return "".join(f"{name},{bodies},{','.join(map(str, corner))}\n" for corner in corners)


def contacts(folder: Path, text: str | None, transform: str = "") -> Contacts:
    blocks = [block[:-1] + f", {transform}}}" if transform else block for block in BLOCKS]
    path = write_deck(folder, blocks)
    if text is not None:
        (folder / "contacts.csv").write_text(HEADER + text)
        path.write_text(path.read_text().replace("contacts: {", "contacts: {table: contacts.csv, "))
    deck = read_deck(path)
    return find_contacts(build_model(deck), deck.contacts)


def refused(folder: Path, text: str) -> list[str]:
    with pytest.raises(DeckError) as caught:
        contacts(folder, text)
    return [fault.message for fault in caught.value.faults]


@pytest.mark.parametrize("bodies", ["low,0,high,0", "high,0,low,0"])
@pytest.mark.parametrize("turn", [1, -1])
def test_given_interfaces_are_those_that_are_found(tmp_path: Path, bodies: str, turn: int) -> None:
    found = contacts(tmp_path, None)
    given = contacts(tmp_path, rows("bed", bodies, SQUARE[::turn]) + rows("foot", "low,0,ground,0", FOOT[::turn]))
    assert given.bodies.tolist() == found.bodies.tolist()
    for name in ("normals", "areas", "centroids", "gaps", "outline"):
        assert getattr(given, name) == pytest.approx(getattr(found, name), abs=1e-12)
    assert np.sort(given.points, axis=0) == pytest.approx(np.sort(found.points, axis=0))
    assert given.frames == pytest.approx(found.frames)


def test_only_what_is_given_is_in_contact(tmp_path: Path) -> None:
    half = [(1, 0, 1), (2, 0, 1), (2, 1, 1), (1, 1, 1)]
    given = contacts(tmp_path, rows("bed", "low,0,high,0", half) + rows("foot", "ground,0,low,0", FOOT))
    assert sorted(given.areas.tolist()) == pytest.approx([1, 2])
    assert contacts(tmp_path, rows("foot", "ground,0,low,0", FOOT)).report.isolated.tolist() == [1]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (rows("bed", "low,0,high,0", [(x, y, z + 0.01) for x, y, z in SQUARE]), "interface bed does not lie on a"),
        (rows("bed", "low,0,high,0", [SQUARE[0]] * 4), "interface bed has no area"),
        (rows("bed", "low,0,low,0", SQUARE), "an interface is between two blocks, or a block and ground"),
        (rows("bed", "low,0,high,1", SQUARE), "index_b = 1: high has 0 to 0"),
        (rows("bed", "low,0,hihg,0", SQUARE), "unknown group hihg; did you mean high?"),
        (rows("a", "low,0,high,0", SQUARE) + rows("b", "low,0,ground,0", FOOT) + rows("a", "low,0,high,0", SQUARE),
         "the rows of interface a do not follow each other"),
        (rows("a", "low,0,high,0", SQUARE) + rows("b", "high,0,low,0", [(1, 0, 1), (2, 0, 1), (2, 0.5, 1)]),
         "contacts.csv:6: interface b overlaps interface a between the same bodies"),
        (rows("a", "low,0,ground,0", FOOT) + rows("b", "ground,0,low,0", FOOT), "interface b overlaps interface a"),
        (rows("a", "low,0,high,0", SQUARE[:2]) + rows("a", "low,0,ground,0", FOOT), "interface a is between different"),
    ],
)  # fmt: skip
def test_faults_by_file_and_line(tmp_path: Path, text: str, message: str) -> None:
    found = refused(tmp_path, text)
    assert found[0].startswith("contacts.csv:")
    assert message in found[0]


def test_interfaces_side_by_side_do_not_overlap(tmp_path: Path) -> None:
    edge = 1.0 + 0.5e-3  # a strip within contacts.tolerance
    left = rows("left", "low,0,high,0", [(0.5, 0, 1), (edge, 0, 1), (edge, 1, 1), (0.5, 1, 1)])
    # the right one turns in at its middle, so that its box covers the left one
    notched = [(1, 0, 1), (2, 0, 1), (1.2, 0.5, 1), (2, 1, 1), (1, 1, 1)]
    inside = rows("inside", "low,0,high,0", [(2, 0.2, 1), (2, 0.8, 1), (1.5, 0.5, 1)])
    given = contacts(tmp_path, left + rows("right", "low,0,high,0", notched) + inside)
    assert sorted(given.areas) == pytest.approx([0.5 * 0.5 * 0.6, 0.5 + 0.5e-3, 1 - 0.5 * 0.8])


def with_joint(text: str, joint: str) -> str:
    return "".join(f"{line},{joint}\n" for line in text.splitlines())


def joints_of(folder: Path, text: str, overrides: str = "") -> list[str]:
    path = write_deck(folder, BLOCKS)
    (folder / "contacts.csv").write_text(HEADER.strip() + ",joint\n" + text)
    path.write_text(path.read_text().replace("contacts: {", f"contacts: {{table: contacts.csv{overrides}, "))
    deck = read_deck(path)
    found = find_contacts(build_model(deck), deck.contacts)
    return [found.joint_names[row] for row in found.joints]


@pytest.mark.parametrize("joint", ["rough", "frictionless"])
def test_joint_law_of_single_interfaces_holds_before_overrides(tmp_path: Path, joint: str) -> None:
    bed, foot = rows("bed", "low,0,high,0", SQUARE), rows("foot", "low,0,ground,0", FOOT)
    assert joints_of(tmp_path, with_joint(bed, joint) + with_joint(foot, "")) == [joint, "dry"]
    assert joints_of(tmp_path, with_joint(bed, "") + with_joint(foot, joint)) == ["dry", joint]
    overrides = ", overrides: [{box: [[-9, -9, -9], [9, 9, 9]], joint: rough}]"
    assert joints_of(tmp_path, with_joint(bed, "dry") + with_joint(foot, ""), overrides) == ["dry", "rough"]


def test_open_and_glued_interfaces_of_a_table(tmp_path: Path) -> None:
    bed, foot = rows("bed", "low,0,high,0", SQUARE), rows("foot", "low,0,ground,0", FOOT)
    assert joints_of(tmp_path, with_joint(bed, "open") + with_joint(foot, "dry")) == ["dry"]
    assert joints_of(tmp_path, with_joint(bed, "glued") + with_joint(foot, "dry")) == ["dry"]


@pytest.mark.parametrize(
    ("joints", "message"),
    [
        (["ruogh"] * 4, "contacts.csv:2: unknown joint; did you mean rough? known: dry, rough, frictionless, glued"),
        (["dry", "dry", "", "dry"], "contacts.csv:2: interface bed has different joint laws in its rows"),
    ],
)
def test_faults_of_joint_laws(tmp_path: Path, joints: list[str], message: str) -> None:
    bed = zip(rows("bed", "low,0,high,0", SQUARE).splitlines(), joints, strict=True)
    with pytest.raises(DeckError) as caught:
        joints_of(tmp_path, "".join(f"{line},{joint}\n" for line, joint in bed))
    assert caught.value.faults[0].message.startswith(message)
