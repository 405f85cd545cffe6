"""Guides and settlements as the model has them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.model import Model, build_model
from mbla.model.settlement import with_reference
from tests.asked import settlement_of
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
        "supports[0].ground: blocks reach below it, by up to 1.25: block[0], slab[0]; "
        "move the plane, or list the blocks that stand on it under the key blocks"
    ]


@pytest.mark.parametrize(("depth", "refused"), [(1e-4, False), (1e-2, True)])
def test_depth_below_ground_within_the_tolerance(tmp_path: Path, depth: float, refused: bool) -> None:
    supports = f"[{{ground: {{z: {depth}}}}}]"
    if refused:
        assert " below it" in messages(tmp_path, supports)[0]
    else:
        assert len(build_model(deck(tmp_path, [BLOCK], supports)).grounds) == 1


def test_an_edge_on_the_ground_is_no_face(tmp_path: Path) -> None:
    turned = LEANING.replace("angle: 20", "angle: -20")
    (message,) = messages(tmp_path, "[{ground: {z: 0}}]", turned)
    assert message.startswith(
        "supports[0].ground: no face of a block that can move lies on it; block[0] touches it along an edge only: "
    )


def test_ground_under_fixed_blocks_only(tmp_path: Path) -> None:
    found = messages(tmp_path, "[{ground: {z: -1}}, {blocks: slab}]", BLOCK, SLAB)
    assert found == [
        "supports[0].ground: no face of a block that can move lies on it; the nearest block begins 1 above it"
    ]


DECK = """
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
blocks:
  - box: {group: base, material: stone, min: [0, 0, -1], max: [1, 1, 0]}
  - box: {group: base, material: stone, min: [2, 0, -1], max: [3, 1, 0]}
  - box: {group: pier, material: stone, min: [0, 0, 0], max: [1, 1, 2]}
  - box: {group: pier, material: stone, min: [2, 0, 0], max: [3, 1, 4]}
contacts: {joint: dry}
supports:
  - {blocks: base}
%s
load_cases:
  case: {%s}
"""
PUSH = "live: [{acceleration: [1, 1, 1]}]"


def model_of(tmp_path: Path, support: str = "", case: str = PUSH) -> Model:
    path = tmp_path / "deck.yaml"
    path.write_text(DECK % (support, case), encoding="utf-8")
    return build_model(read_deck(path))


def test_held_components_leave_the_others(tmp_path: Path) -> None:
    guides = model_of(tmp_path, "  - {blocks: pier, fixed: [y, rx, rz]}").guides
    assert guides.blocks.tolist() == [2, 3]
    assert guides.bodies.tolist() == [0, 1]
    for motions in guides.motions:
        np.testing.assert_array_equal(motions @ motions.T, np.diag([1, 0, 1, 0, 1, 0]))
    assert guides.words == ("2 blocks held in y, rx, rz",)


def test_all_six_held_is_fixed(tmp_path: Path) -> None:
    model = model_of(tmp_path, "  - {blocks: {group: pier, index: 0}, fixed: [x, y, z, rx, ry, rz]}")
    assert model.fixed.tolist() == [True, True, True, False]
    assert not len(model.guides)


@pytest.mark.parametrize("length", [1e-200, 1.0, 1e200])
def test_a_slide_and_a_turn_are_two_ways(tmp_path: Path, length: float) -> None:
    support = (
        f"  - {{blocks: {{group: pier, index: 1}}, slide: [0, 0, {length}], "
        f"turn: {{axis: [0, 0, {length}], about: [0, 0, 7]}}}}"
    )
    motions = model_of(tmp_path, support).guides.motions[0]
    np.testing.assert_allclose(motions[:, 0], [0, 0, 1, 0, 0, 0])
    np.testing.assert_allclose(motions[:, 1], [-0.5, 2.5, 0, 0, 0, 1])  # z × (centroid − point)
    assert not motions[:, 2:].any()


def test_blocks_held_together_move_about_their_common_centroid(tmp_path: Path) -> None:
    support = "  - {blocks: pier, fixed: [x, y, z, rx, rz], together: true}"
    with pytest.raises(DeckError, match="the supports take every live load"):
        model_of(tmp_path, support)  # pushed alike they do not turn
    guides = model_of(tmp_path, support, "live: [{acceleration: [1, 0, 0], on: {group: pier, index: 1}}]").guides
    assert guides.bodies.tolist() == [0, 0]
    masses = np.array([2.0, 4.0])
    way = guides.motions[:, :, 0]
    np.testing.assert_allclose(way[:, 3:], [[0, 1, 0], [0, 1, 0]])
    np.testing.assert_allclose(masses @ way[:, :3], 0.0, atol=1e-12)
    assert guides.words == ("2 blocks as one body held in x, y, z, rx, rz",)


def test_a_settlement_frees_its_blocks_in_its_case_alone(tmp_path: Path) -> None:
    model = model_of(tmp_path, "  - {blocks: {group: pier, index: 0}, fixed: [rx]}",
                     "settlement: {on: {group: base, index: 1}, direction: [3, 0, -4]}")  # fmt: skip
    case = model.load_cases[0]
    moving = model.of_case(case)
    assert model.fixed.tolist() == [True, True, False, False]
    assert moving.fixed.tolist() == [True, False, False, False]
    assert moving.guides.blocks.tolist() == [2, 1]
    np.testing.assert_allclose(moving.guides.motions[1, :, 0], [0.6, 0, -0.8, 0, 0, 0])
    assert not moving.guides.motions[1, :, 1:].any()


def test_the_loads_of_a_settlement_take_its_reaction(tmp_path: Path) -> None:
    case = model_of(tmp_path, case="settlement: {on: base, direction: [0, 0, -1]}").load_cases[0]
    settlement = settlement_of(case)
    weight = 6 * 2000 * 9.81
    assert settlement.unit == pytest.approx(weight, rel=1e-12)
    assert np.isnan(settlement.reference)
    posed = with_reference(case, 300.0)
    np.testing.assert_allclose(posed.dead_load[:2, 2], 150.0)  # of two blocks, against the motion; own weight left out
    np.testing.assert_allclose(posed.live_load[:2, 2], -weight / 2)
    np.testing.assert_array_equal(posed.dead_load[2:], case.dead_load[2:])
    assert settlement_of(posed).reaction(0.0) == 300.0
    assert settlement_of(posed).reaction(1.0) == pytest.approx(300.0 - weight, rel=1e-12)


def test_a_turning_support_counts_in_moments(tmp_path: Path) -> None:
    case = model_of(
        tmp_path, case="settlement: {on: {group: base, index: 1}, turn: {axis: [0, 2, 0], about: [2, 0, 0]}}"
    ).load_cases[0]
    settlement = settlement_of(case)
    assert settlement.turns
    distances = [np.hypot(1.5, 1.0), np.hypot(0.5, 2.0)]
    assert settlement.unit == pytest.approx(6 * 2000 * 9.81 * np.mean(distances), rel=1e-12)
    np.testing.assert_allclose(settlement.motions, [[-0.5, 0, -0.5, 0, 1, 0]])
    assert float((case.live_load[[1]] * settlement.motions).sum()) == pytest.approx(settlement.unit, rel=1e-12)
