"""Bent faces: split in silence where nothing touches them, refused where another block does."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.assembly import build_assembly
from mbla.errors import DeckError
from tests.line import line_of_file

BOTTOM = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
BENT = [[0, 0, 1], [1, 0, 1], [1, 1, 1.2], [0, 1, 1]]
TOP = [[0, 0, 2], [1, 0, 2], [1, 1, 2], [0, 1, 2]]
FACES = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
DECK = """\
mbla: 1
materials: {{stone: {{density: 2000}}}}
joints: {{dry: {{friction: 2}}}}
blocks:
{blocks}
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}}}]
load_cases: {{push: {{live: [{{acceleration: [1, 0, 0]}}]}}}}
analysis: {{flow_rule: associative}}
"""


def deck(folder: Path, *vertices: object, more: str = "") -> Path:
    """Blocks between quadrilaterals."""
    items = [f"  - polyhedron: {{group: b, material: stone, vertices: {each}, faces: {FACES}}}" for each in vertices]
    path = folder / "deck.yaml"
    path.write_text(DECK.format(blocks="\n".join(items)) + more)
    return path


def test_a_free_bent_face_is_a_notice(tmp_path: Path) -> None:
    line = line_of_file(deck(tmp_path, [*BOTTOM, *BENT]))
    assert [notice.identifier for notice in line.model.notices] == ["bent-faces-split"]


def test_bent_faces_with_the_same_corners_touch(tmp_path: Path) -> None:
    line = line_of_file(deck(tmp_path, [*BOTTOM, *BENT], [*BENT, *TOP]))
    contacts = build_assembly(line.deck, line.model).contacts
    assert len(contacts) == 3  # two triangles, and the ground
    (notice,) = line.model.notices
    assert "2 faces of 2 blocks (b[0], b[1]) are not planar and split" in notice.message
    assert "1 pair with the same corners in two blocks alike" in notice.message


def test_bent_faces_with_other_corners_that_touch_each_other_are_refused_both(tmp_path: Path) -> None:
    higher = [*BENT[:2], [1, 1, 1.25], BENT[3]]
    line = line_of_file(deck(tmp_path, [*BOTTOM, *BENT], [*higher, *TOP]))
    with pytest.raises(DeckError) as caught:
        build_assembly(line.deck, line.model)
    assert [(fault.key, str(fault.message)) for fault in caught.value.faults] == [
        (
            "blocks[0].polyhedron.faces[1]",
            "block b[0]: face 1 is not planar: corners leave the plane by 0.0495, 4.90% of the block size; "
            "contacts.tolerance allows 0.10%, and it touches b[1] there",
        ),
        (
            "blocks[1].polyhedron.faces[0]",
            "block b[1]: face 0 is not planar: corners leave the plane by 0.0615, 6.24% of the block size; "
            "contacts.tolerance allows 0.10%, and it touches b[0] there",
        ),
    ]


def test_so_is_one_that_lies_on_the_ground_with_three_corners(tmp_path: Path) -> None:
    bent = [*BOTTOM[:2], [1, 1, 0.2], BOTTOM[3]]
    line = line_of_file(deck(tmp_path, [*bent, *TOP]))
    with pytest.raises(DeckError, match=r"face 0 is not planar: .* and it touches ground z = 0 there"):
        build_assembly(line.deck, line.model)


def test_images_of_bent_faces_are_free_as_well(tmp_path: Path) -> None:
    line = line_of_file(deck(tmp_path, [*BOTTOM, *BENT], more="symmetry: [{y: 0}]\n"))
    assert len(build_assembly(line.deck, line.model).contacts) == 3
