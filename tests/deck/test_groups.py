"""Section `groups`: a name stands for its selector wherever blocks are chosen; faults are told where they are."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from mbla.deck import read_deck
from mbla.deck.sections.selectors import SelectorTerm
from tests.deck.decks import BLOCK, changed, faults, write

GROUPS = "groups: {one: block, first: {group: block, index: 0}, both: [block, {group: block, index: 0}]}\ncontacts:"
NAMED = BLOCK.replace("contacts:", GROUPS)


def chosen(folder: Path, selector: str, *overrides: str) -> Any:
    text = NAMED.replace("{ground: {z: 0}}", f"{{blocks: {selector}}}")
    return read_deck(write(folder, text), overrides).content.supports[0].blocks


def test_a_name_stands_for_its_selector(tmp_path: Path) -> None:
    first = SelectorTerm(group="block", index=0)
    assert chosen(tmp_path, "one") == "block"
    assert chosen(tmp_path, "first") == first
    assert chosen(tmp_path, "both") == ["block", first]
    assert chosen(tmp_path, "[first, both, block]") == [first, "block", first, "block"]


@pytest.mark.parametrize(
    ("place", "old", "new"),
    [
        ("supports", "{ground: {z: 0}}", "{ground: {z: 0}, blocks: NAME}"),
        ("loads", "{acceleration: [1, 0, 0]}", "{acceleration: [1, 0, 0], on: NAME}"),
        ("contacts", "{joint: dry}", "{joint: dry, overrides: [{joint: dry, between: [NAME, [ground, NAME]]}]}"),
        ("masses", "supports:", "masses: [{mass: 1, on: NAME}]\nsupports:"),
        ("pushover", "live: [", "pushover: {step: 0.1, control: {on: NAME}}\n    live: ["),
        ("symmetry", "supports:", "symmetry: [{x: 0, halves: NAME}]\nsupports:"),
    ],
)
def test_it_does_in_every_place(tmp_path: Path, place: str, old: str, new: str) -> None:
    text = NAMED.replace(old, new)
    assert text != NAMED, place
    written = read_deck(write(tmp_path, text.replace("NAME", "{group: block, index: 0}"), "written.yaml")).content
    assert read_deck(write(tmp_path, text.replace("NAME", "first"))).content == written


def test_a_wrong_selector_is_reported_where_it_is_written(tmp_path: Path) -> None:
    text = NAMED.replace("index: 0}, both", "indx: 0}, both").replace("{ground: {z: 0}}", "{blocks: first}")
    places = {fault.split(" ")[0] for fault in faults(write(tmp_path, text))}
    assert places == {"deck.yaml:11:44"}


def test_names_of_two_files_are_one_section(tmp_path: Path) -> None:
    write(tmp_path, "mbla: 1\ngroups: {first: {group: block, index: 0}}\n", "names.yaml")
    text = changed("mbla: 1\n", "mbla: 1\ninclude: [names.yaml]\n").replace("{ground: {z: 0}}", "{blocks: first}")
    assert read_deck(write(tmp_path, text)).content.supports[0].blocks == SelectorTerm(group="block", index=0)
    twice = text.replace("contacts:", "groups: {first: block}\ncontacts:")
    assert any("[duplicate-key]" in fault for fault in faults(write(tmp_path, twice)))


def test_a_choice_can_be_set(tmp_path: Path) -> None:
    assert chosen(tmp_path, "both", "groups.both=block") == "block"
