from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.model import build_model
from tests.model.shapes import PUSH, deck, write_deck

BLOCK = "box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 2]}"
SLAB = "box: {group: slab, material: stone, min: [0, 0, -1], max: [1, 1, 0]}"
WALL = "wall: {material: stone, unit: [0.4, 0.2, 0.175], length: 2, courses: 5}"
ARCH = "arch: {{group: arch, material: stone, shape: semicircular, span: 4, thickness: 0.3, width: 1, voussoirs: 9{}}}"

CORNERS = "[[0,0,0],[1,0,0],[0,1,0],[0,0,1]]"
TETRAHEDRON = f"polyhedron: {{{{group: p, material: stone, vertices: {CORNERS}, faces: {{}}}}}}"


def test_groups_and_indices_run_over_items(tmp_path: Path) -> None:
    other = BLOCK.replace("[0, 0, 0]", "[3, 0, 0]").replace("[1, 1, 2]", "[4, 1, 2]")
    model = build_model(
        deck(tmp_path, [BLOCK, WALL.replace("wall: {", "wall: {transform: {translate: [0, 5, 0]}, "), other])
    )
    assert model.blocks.name(0) == "block[0]"
    assert model.blocks.name(1) == "wall[0]"
    assert model.blocks.name(28) == "block[1]"


def test_repeated_item_is_one_group_with_copies(tmp_path: Path) -> None:
    row = BLOCK.replace("min:", "repeat: {count: 3, translate: [2, 0, 0]}, min:")
    model = build_model(deck(tmp_path, [row]))
    assert [model.blocks.name(block) for block in range(3)] == ["block[0]", "block[1]", "block[2]"]
    assert model.blocks.centroids[:, 0].tolist() == [0.5, 2.5, 4.5]
    assert model.blocks.labels.position("copy").tolist() == [0, 1, 2]


def test_supports_of_a_repeated_item_come_with_each_copy(tmp_path: Path) -> None:
    arches = ARCH.format(", springers: ground, repeat: {count: 2, translate: [0, 3, 0]}")
    model = build_model(deck(tmp_path, [arches], supports="[]"))
    assert [ground.label for ground in model.grounds] == [f"ground under arch[{block}]" for block in (0, 8, 9, 17)]
    assert [ground.point[1] for ground in model.grounds] == [0, 0, 3, 3]


def test_densities_and_weight(tmp_path: Path) -> None:
    model = build_model(deck(tmp_path, [BLOCK]))
    assert model.blocks.masses == pytest.approx([4000])
    assert model.total_weight == pytest.approx(4000 * 9.81)


@pytest.mark.parametrize("units", ["length: m", "length: mm, force: kN, mass: t", "length: ft, force: lbf, mass: lb"])
def test_unit_weight_is_a_weight_under_standard_gravity(tmp_path: Path, units: str) -> None:
    path = write_deck(tmp_path, [BLOCK], units=units)
    path.write_text(path.read_text().replace("{density: 2000}", '{unit_weight: "20 kN/m^3"}'))
    model = build_model(read_deck(path))
    metres = {"m": 1.0, "mm": 1e-3, "ft": 0.3048}[model.units.length]
    newtons = {"N": 1.0, "kN": 1e3, "lbf": 4.4482216152605}[model.units.force]
    assert model.total_weight * newtons == pytest.approx(20e3 * 2 * metres**3)
    assert model.load_cases[0].dead_load[0, 2] == pytest.approx(-model.total_weight)


def test_joints(tmp_path: Path) -> None:
    joints = build_model(deck(tmp_path, [BLOCK])).joints
    assert list(joints) == ["dry", "rough"]
    assert joints["dry"].friction == 0.6
    assert joints["dry"].compressive_strength == np.inf
    assert joints["rough"].friction == pytest.approx(1)
    assert joints["rough"].dilatancy == pytest.approx(np.tan(np.radians(30)))
    assert joints["rough"].cohesion == 5


def test_springers_on_ground_are_supports(tmp_path: Path) -> None:
    model = build_model(deck(tmp_path, [ARCH.format(", springers: ground, joint: rough")], supports="[]"))
    assert [ground.label for ground in model.grounds] == ["ground under arch[0]", "ground under arch[8]"]
    assert [ground.joint for ground in model.grounds] == ["rough", "rough"]
    assert [ground.blocks.tolist() for ground in model.grounds if ground.blocks is not None] == [[0], [8]]
    assert model.body_name(10) == "ground under arch[8]"
    assert not model.fixed.any()


def test_springers_as_blocks_are_fixed(tmp_path: Path) -> None:
    model = build_model(deck(tmp_path, [ARCH.format(", springers: blocks")], supports="[]"))
    assert len(model.blocks) == 11
    assert model.blocks.name(9) == "arch_springers[0]"
    assert model.fixed.tolist() == [False] * 9 + [True, True]
    assert model.free.tolist() == list(range(9))


def test_notices_of_all_steps_are_kept(tmp_path: Path) -> None:
    inward = TETRAHEDRON.format("[[0,1,2],[0,1,3],[0,2,3],[1,2,3]]")
    loads = "live: [{force: [1, 0, 0], on: p, at: [9, 0, 0]}]"
    model = build_model(deck(tmp_path, [inward], loads=loads))
    assert [notice.identifier for notice in model.notices] == ["faces-turned-outwards", "force-outside-block"]


def test_all_faults_come_at_once(tmp_path: Path) -> None:
    listed_twice = TETRAHEDRON.format("[[0,1,2],[0,1,3],[0,2,3],[0,2,1]]")
    mesh = "mesh: {material: stone, file: nothing.obj}"
    found = deck(
        tmp_path, [listed_twice, mesh, BLOCK], loads="live: [{force: [1, 0, 0], on: {group: block, index: 4}}]"
    )
    with pytest.raises(DeckError) as caught:
        build_model(found)
    assert [fault.key for fault in caught.value.faults] == [
        "blocks[0].polyhedron",
        "blocks[1].mesh.file",
        "load_cases.push.live[0].on.index",
    ]


def test_nothing_is_said_about_groups_that_could_not_be_built(tmp_path: Path) -> None:
    mesh = "mesh: {group: vault, material: stone, file: nothing.obj}"
    loads = "live: [{force: [1, 0, 0], on: {group: vault, index: 3}}]"
    with pytest.raises(DeckError) as caught:
        build_model(deck(tmp_path, [BLOCK, mesh], supports="[{ground: {z: -7}}, {blocks: vault}]", loads=loads))
    assert [fault.key for fault in caught.value.faults] == ["blocks[1].mesh.file"]


def test_many_faults_of_one_item_are_counted(tmp_path: Path) -> None:
    lines = []
    for number in range(30):
        lines += [f"o open{number}", "v 0 0 0", "v 1 0 0", "v 0 1 0", "v 0 0 1", "f -4 -3 -2", "f -4 -3 -1"]
    (tmp_path / "open.obj").write_text("\n".join(lines))
    with pytest.raises(DeckError) as caught:
        build_model(deck(tmp_path, ["mesh: {material: stone, file: open.obj}"]))
    messages = [fault.message for fault in caught.value.faults]
    assert len(messages) == 11
    assert messages[0].startswith("block mesh[0] (open0): is not closed")
    assert messages[-1] == "20 more blocks of this item are refused"


def test_the_same_deck_gives_the_same_model(tmp_path: Path) -> None:
    found = deck(tmp_path, [WALL, ARCH.format(", springers: blocks")], loads=PUSH)
    one, two = build_model(found), build_model(replace(found))
    assert one.blocks.vertices.tobytes() == two.blocks.vertices.tobytes()
    assert one.blocks.groups == two.blocks.groups


@pytest.mark.parametrize(("units", "scale"), [("length: mm", 1e3), ("length: m", 1.0)])
def test_units_scale_the_model(tmp_path: Path, units: str, scale: float) -> None:
    unit = [0.4 * scale, 0.2 * scale, 0.175 * scale]
    wall = f"wall: {{material: stone, unit: {unit}, length: {2 * scale}, courses: 5}}"
    model = build_model(deck(tmp_path, [wall], units=units))
    assert len(model.blocks) == 27
    assert model.blocks.volumes.sum() == pytest.approx(2 * 0.2 * 0.875 * scale**3)
    assert model.load_cases[0].dead_words[0] == f"gravity (0, 0, {-9.81 * scale:g}) {model.units.length}/s2"
