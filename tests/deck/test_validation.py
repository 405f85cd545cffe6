"""How complaints are merged and placed; their words are in tests/invalid_decks.

An interruption while the types of the deck are built is an interruption, not a fault of the types.
"""

from __future__ import annotations

import signal
from pathlib import Path
from typing import Any

import pytest

from mbla.deck.section import MOST_WRONG, Section, validator
from mbla.errors import MOST_FAULTS
from tests.deck.decks import BLOCK, changed, faults, write

BOX = "box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 1]}"


def test_type_faults_rules_and_names_come_together(tmp_path: Path) -> None:
    text = (
        changed("density: 2000", "density: true")
        .replace("max: [1, 1, 1]", "max: [1, 1, 0]")
        .replace("{z: 0}", "{z: 0, x: 0}")
    )
    assert [
        message.split(" ")[1] for message in faults(write(tmp_path, text.replace("{joint: dry}", "{joint: wet}")))
    ] == [
        "materials.stone.density",
        "blocks[0].box.max[2]",
        "contacts.joint",
        "supports[0].ground.z",
    ]


@pytest.mark.parametrize(
    "value", ["[1, 1", "true", "heavy", '"3"', "[]", "{}", "-1", "0", ".nan", '"1 s"', '"=1/0"', "~"]
)
def test_one_fault_for_one_value(tmp_path: Path, value: str) -> None:
    assert len(faults(write(tmp_path, changed("density: 2000", f"density: {value}")))) == 1


@pytest.mark.parametrize(
    "value", ["true", "5", "[]", "[5]", "[{group: 5}]", "{group: 5}", '"a b"', "~", "{}", "nobody"]
)
def test_one_fault_for_one_selector(tmp_path: Path, value: str) -> None:
    assert len(faults(write(tmp_path, changed("{ground: {z: 0}}", f"{{blocks: {value}}}")))) == 1


@pytest.mark.parametrize("value", ["5", "[5]", "[{scale: 0}]", "{scale: 0}", "{turn: 1}", "{}", "[{}]", "left"])
def test_one_fault_for_one_transform(tmp_path: Path, value: str) -> None:
    assert len(faults(write(tmp_path, changed("group: block,", f"group: block, transform: {value},")))) == 1


@pytest.mark.parametrize("key", ["float", "chain", "name", "mapping", "list", "SelectorTerm"])
def test_names_like_branches_of_a_union_are_kept_in_the_path(tmp_path: Path, key: str) -> None:
    text = BLOCK.replace("stone", key).replace("density: 2000", "density: 0")
    assert faults(write(tmp_path, text)) == [f"deck.yaml:6:{15 + len(key)} materials.{key}.density [out-of-bounds]"]


def test_unreadable_value_does_not_break_rules_around_it(tmp_path: Path) -> None:
    assert faults(write(tmp_path, changed('{friction: "=mu"}', "{friction: .inf}"))) == [
        "deck.yaml:8:19 joints.dry.friction [not-a-number]"
    ]


def test_fault_beside_an_unreadable_value_is_still_reported(tmp_path: Path) -> None:
    assert faults(write(tmp_path, changed('{friction: "=mu"}', "{friction: .inf, cohesion: -1}"))) == [
        "deck.yaml:8:19 joints.dry.friction [not-a-number]",
        "deck.yaml:8:35 joints.dry.cohesion [out-of-bounds]",
    ]


def test_root_that_is_no_mapping_and_faulty_itself(tmp_path: Path) -> None:
    assert faults(write(tmp_path, "- .nan\n")) == [
        "deck.yaml:1:1  [not-a-mapping]",
        "deck.yaml:1:3 [0] [not-a-number]",
    ]


def test_users_of_a_faulty_parameter_are_not_reported(tmp_path: Path) -> None:
    for value in ("true", '"=nu"', '"0.6"', "[1]", "~"):
        (found,) = faults(write(tmp_path, changed("{mu: 0.6}", f"{{mu: {value}}}")))
        assert "parameters.mu" in found


@pytest.mark.parametrize("item", ["{mas: 1}", "x"])
@pytest.mark.parametrize("count", [MOST_WRONG // 4, MOST_WRONG + 1])
def test_the_first_of_very_many_wrong_items_are_told(tmp_path: Path, count: int, item: str) -> None:
    told = faults(write(tmp_path, BLOCK + "masses:\n" + f"  - {item}\n" * count))
    assert told[0].startswith(f"deck.yaml:{BLOCK.count(chr(10)) + 2}:5 masses[0]")
    assert len(told) == MOST_FAULTS + 1
    assert told[-1].endswith("[more-faults]")


def test_of_very_many_wrong_names_none_is_told(tmp_path: Path) -> None:
    names = ", ".join(f"n{number}: {{a: 1, b: 1}}" for number in range(MOST_WRONG // 2 - 1))
    told = faults(write(tmp_path, f"{BLOCK}expected: {{{names}}}\n"))
    assert told[0] == "deck.yaml:1:1  [more-faults]"


def test_a_signal_waits_until_the_validator_is_there() -> None:
    arriving = [signal.SIGINT]

    class Struck(str):
        @classmethod
        def __get_pydantic_core_schema__(cls, source: Any, handler: Any) -> Any:
            while arriving:
                signal.raise_signal(arriving.pop())
            return handler(str)

    class Stone(Section):
        name: Struck

    with pytest.raises(KeyboardInterrupt):
        validator(Stone)
    assert validator(Stone).validate_python({"name": "ashlar"}).name == "ashlar"
