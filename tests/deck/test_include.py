from __future__ import annotations

import os
from pathlib import Path

from mbla.deck import read_deck
from mbla.errors import Message
from tests.deck.decks import BLOCK, changed, faults, refusal, write

INCLUDING = changed("title: A block on the ground\n", "title: A block on the ground\ninclude: [more.yaml]\n")


def test_sections_are_merged_key_by_key(tmp_path: Path) -> None:
    write(tmp_path, "materials: {brick: {density: 1800}}\nparameters: {width: 2}\noutput: {frames: 5}\n", "more.yaml")
    deck = read_deck(write(tmp_path, INCLUDING + "output: {vtu: false}\n"))
    assert list(deck.content.materials) == ["brick", "stone"]
    assert deck.content.parameters == {"width": 2.0, "mu": 0.6}
    assert (deck.content.output.frames, deck.content.output.vtu) == (5, False)
    assert [source.path.name for source in deck.sources] == ["deck.yaml", "more.yaml"]


def test_lists_are_joined_included_items_first(tmp_path: Path) -> None:
    item = "{group: base, material: stone, min: [0, 0, -1], max: [1, 1, 0]}"
    write(tmp_path, f"blocks:\n  - box: {item}\n", "more.yaml")
    deck = read_deck(write(tmp_path, INCLUDING))
    assert [each.item.group for each in deck.content.blocks] == ["base", "block"]
    assert str(deck.fault_at(("blocks", 0, "box", "min", 2), Message("not-a-number", "no"))) == (
        f"{tmp_path}/more.yaml:2:53 blocks[0].box.min[2] = -1: no"
    )
    assert (
        deck.fault_at(("blocks", 1, "box", "group"), Message("not-a-number", "no")).place.file
        == f"{tmp_path}/deck.yaml"
    )


def test_faults_in_included_files_have_their_places(tmp_path: Path) -> None:
    write(
        tmp_path,
        "mbla: 1\nmaterials:\n  brick: {density: -1}\njoints: {wet: {friction: 1, friction: 2}}\n",
        "more.yaml",
    )
    assert faults(write(tmp_path, INCLUDING)) == [
        "more.yaml:3:20 materials.brick.density [out-of-bounds]",
        "more.yaml:4:29 joints.wet.friction [duplicate-key]",
    ]


def test_what_both_define_names_both_places(tmp_path: Path) -> None:
    write(tmp_path, "title: Another\nmaterials: {stone: {density: 1}}\nunits: {length: mm}\n", "more.yaml")
    found = refusal(write(tmp_path, INCLUDING)).faults
    assert [str(fault).replace(f"{tmp_path}/", "") for fault in found] == [
        "deck.yaml:2:1 title: is defined in more.yaml:1:1 too",
        "deck.yaml:4:9 units.length: is defined in more.yaml:3:9 too",
        "deck.yaml:7:3 materials.stone: is defined in more.yaml:2:13 too",
    ]


def test_version_may_stand_in_each_file_but_not_differ(tmp_path: Path) -> None:
    write(tmp_path, "mbla: 1\n", "more.yaml")
    path = write(tmp_path, INCLUDING)
    assert read_deck(path).content.mbla == 1
    write(tmp_path, "mbla: 2\n", "more.yaml")
    assert faults(path) == ["deck.yaml:1:1 mbla [duplicate-key]"]


def test_names_are_relative_to_the_including_file(tmp_path: Path) -> None:
    write(tmp_path, "include: [c.yaml]\n", "sub/b.yaml")
    write(tmp_path, "materials: {brick: {density: -1}}\n", "sub/c.yaml")
    assert faults(write(tmp_path, INCLUDING.replace("more.yaml", "sub/b.yaml"))) == [
        "sub/c.yaml:1:30 materials.brick.density [out-of-bounds]"
    ]


def test_file_reached_twice_is_merged_once(tmp_path: Path) -> None:
    write(tmp_path, "include: [common.yaml]\n", "a.yaml")
    write(tmp_path, "include: [common.yaml]\n", "b.yaml")
    write(tmp_path, "materials: {brick: {density: 1800}}\n", "common.yaml")
    deck = read_deck(write(tmp_path, INCLUDING.replace("more.yaml", "a.yaml, b.yaml")))
    assert list(deck.content.materials) == ["brick", "stone"]
    assert len(deck.sources) == 4


def test_included_file_cannot_leave_its_own_folder(tmp_path: Path) -> None:
    write(tmp_path, "include: [../other.yaml]\n", "sub/b.yaml")
    write(tmp_path, "materials: {brick: {density: 1}}\n", "other.yaml")
    assert faults(write(tmp_path, INCLUDING.replace("more.yaml", "sub/b.yaml"))) == [
        "sub/b.yaml:1:11 include[0] [file-outside-folder]"
    ]


def test_link_out_of_the_folder(tmp_path: Path) -> None:
    outside = write(tmp_path, "materials: {brick: {density: 1}}\n", "outside.yaml")
    path = write(tmp_path, INCLUDING, "inside/deck.yaml")
    (tmp_path / "inside" / "more.yaml").symlink_to(outside)
    assert faults(path) == ["deck.yaml:3:11 include[0] [file-outside-folder]"]


def test_cycles(tmp_path: Path) -> None:
    path = write(tmp_path, INCLUDING)
    write(tmp_path, "include: [deck.yaml]\n", "more.yaml")
    assert faults(path) == ["more.yaml:1:11 include[0] [include-refused]"]
    write(tmp_path, "include: [more.yaml]\n", "more.yaml")
    assert faults(path) == ["more.yaml:1:11 include[0] [include-refused]"]


def test_pipe(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "more.yaml")
    assert faults(write(tmp_path, INCLUDING)) == ["deck.yaml:3:11 include[0] [not-a-regular-file]"]


def test_number_of_files_is_limited(tmp_path: Path) -> None:
    for number in range(120):
        write(tmp_path, f"include: [f{number + 1}.yaml]\n", f"f{number}.yaml")
    (found,) = faults(write(tmp_path, INCLUDING.replace("more.yaml", "f0.yaml")))
    assert found == "f98.yaml:1:11 include[0] [include-refused]"


def test_what_an_included_file_supplies_is_not_missing(tmp_path: Path) -> None:
    write(tmp_path, BLOCK, "more.yaml")
    assert read_deck(write(tmp_path, "include: [more.yaml]\n")).content.title == "A block on the ground"


def test_an_included_library_of_vehicles_is_added_to_and_need_not_be_used(tmp_path: Path) -> None:
    write(tmp_path, 'vehicles: {cart: {force: [0, 0, "-2 kN"]}, van: {force: [0, 0, "-9 kN"]}}\n', "more.yaml")
    path = write(tmp_path, INCLUDING + "vehicles: {cart: {width: 2}, own: {force: [0, 0, -1]}}\n")
    deck = read_deck(path)
    assert deck.content.vehicles["cart"].force == (0.0, 0.0, -2000.0)
    assert deck.content.vehicles["cart"].width == 2.0
    told = [notice.message for notice in deck.notices if notice.identifier == "vehicle-unused"]
    assert [text.split()[1] for text in told] == ["vehicles.cart", "vehicles.own"]
