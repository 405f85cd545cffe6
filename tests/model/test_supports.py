from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.errors import DeckError
from mbla.model import build_model
from tests.model.shapes import deck

BLOCK = "box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 2]}"
SLAB = "box: {group: slab, material: stone, min: [0, 0, -1], max: [1, 1, 0]}"
TURN = "transform: {rotate: {axis: [0, 1, 0], angle: 20}}"
LEANING = f"box: {{group: block, material: stone, min: [0, 0, 0], max: [1, 1, 2], {TURN}}}"


def messages(folder: Path, supports: str, *blocks: str, tolerance: float = 1e-3) -> list[str]:
    with pytest.raises(DeckError) as caught:
        build_model(deck(folder, blocks or (BLOCK,), supports, tolerance=tolerance))
    return [f"{fault.key}: {fault.message}" for fault in caught.value.faults]


@pytest.mark.parametrize("axis", "xyz")
def test_planes_along_the_axes(tmp_path: Path, axis: str) -> None:
    (ground,) = build_model(deck(tmp_path, [BLOCK], f"[{{ground: {{{axis}: 0}}, joint: rough}}]")).grounds
    assert ground.label == f"ground {axis} = 0"
    assert ground.joint == "rough"
    assert ground.normal.tolist() == np.eye(3)["xyz".index(axis)].tolist()
    assert ground.blocks is None


def test_joint_of_contacts_unless_given(tmp_path: Path) -> None:
    (ground,) = build_model(deck(tmp_path, [BLOCK], "[{ground: {z: 0}}]")).grounds
    assert ground.joint == "dry"


@pytest.mark.parametrize("length", [1e-200, 1.0, 1e200])
def test_plane_by_point_and_normal(tmp_path: Path, length: float) -> None:
    angle = np.radians(20)
    normal = f"[{length * np.sin(angle)}, 0, {length * np.cos(angle)}]"
    (ground,) = build_model(deck(tmp_path, [LEANING], f"[{{ground: {{point: [0, 0, 0], normal: {normal}}}}}]")).grounds
    assert ground.normal == pytest.approx([np.sin(angle), 0, np.cos(angle)])
    assert ground.label == "ground at (0, 0, 0) with normal (0.34202, 0, 0.939693)"


def test_fixed_blocks(tmp_path: Path) -> None:
    model = build_model(deck(tmp_path, [BLOCK, SLAB], "[{blocks: slab}]"))
    assert model.fixed.tolist() == [False, True]
    assert model.grounds == ()


def test_ground_limited_to_blocks(tmp_path: Path) -> None:
    beside = SLAB.replace("[0, 0, -1]", "[2, 0, -1]").replace("[1, 1, 0]", "[3, 1, 0]")
    model = build_model(
        deck(tmp_path, [BLOCK, beside], "[{ground: {z: 0}, blocks: block}, {ground: {z: -1}, blocks: slab}]")
    )
    assert [ground.blocks.tolist() for ground in model.grounds if ground.blocks is not None] == [[0], [1]]


def test_fixed_blocks_may_reach_below_ground(tmp_path: Path) -> None:
    beside = SLAB.replace("[0, 0, -1]", "[2, 0, -1]").replace("[1, 1, 0]", "[3, 1, 0]")
    model = build_model(deck(tmp_path, [BLOCK, beside], "[{ground: {z: 0}}, {blocks: slab}]"))
    assert model.fixed.tolist() == [False, True]


def test_blocks_below_ground(tmp_path: Path) -> None:
    assert messages(tmp_path, "[{ground: {z: 0.25}}]", BLOCK, SLAB) == [
        "supports[0].ground: block[0], slab[0] reach below it, slab[0] by 1.25; "
        "move the plane, or name the blocks it carries with blocks"
    ]


@pytest.mark.parametrize(("depth", "refused"), [(1e-4, False), (1e-2, True)])
def test_depth_below_ground_within_the_tolerance(tmp_path: Path, depth: float, refused: bool) -> None:
    supports = f"[{{ground: {{z: {depth}}}}}]"
    if refused:
        assert "reaches below it" in messages(tmp_path, supports)[0]
    else:
        assert len(build_model(deck(tmp_path, [BLOCK], supports)).grounds) == 1


def test_ground_without_a_face_on_it(tmp_path: Path) -> None:
    assert messages(tmp_path, "[{ground: {z: -0.5}}]") == [
        "supports[0].ground: no face of a block that can move lies on it; the nearest block begins 0.5 above it"
    ]


def test_an_edge_on_the_ground_is_no_face(tmp_path: Path) -> None:
    turned = LEANING.replace("angle: 20", "angle: -20")
    (message,) = messages(tmp_path, "[{ground: {z: 0}}]", turned)
    assert message == "supports[0].ground: no face of a block that can move lies on it"


def test_ground_under_fixed_blocks_only(tmp_path: Path) -> None:
    found = messages(tmp_path, "[{ground: {z: -1}}, {blocks: slab}]", BLOCK, SLAB)
    assert found == [
        "supports[0].ground: no face of a block that can move lies on it; the nearest block begins 1 above it"
    ]


def test_no_support(tmp_path: Path) -> None:
    assert messages(tmp_path, "[]") == ["supports: nothing holds the structure: give ground or fixed blocks"]


def test_nothing_can_move(tmp_path: Path) -> None:
    found = messages(tmp_path, "[{blocks: block}]")
    assert found[0] == "supports: every block is fixed: nothing can move"
