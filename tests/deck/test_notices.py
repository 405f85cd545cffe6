from __future__ import annotations

from pathlib import Path

import pytest

from mbla.deck import read_deck
from tests.deck.decks import BLOCK, changed, write

LIVE = "    live: [{acceleration: [1, 0, 0]}]\n"


def notices(folder: Path, text: str) -> list[str]:
    path = write(folder, text)
    return [str(notice).replace(f"{folder}/", "") for notice in read_deck(path).notices]


def test_none_for_the_working_deck(tmp_path: Path) -> None:
    assert notices(tmp_path, BLOCK) == []


def test_gravity_in_metres_in_a_deck_in_millimetres(tmp_path: Path) -> None:
    text = changed(LIVE, "    dead: [{gravity: [0, 0, -9.81]}]\n" + LIVE).replace("length: m", "length: mm")
    assert notices(tmp_path, text) == [
        "warning [gravity-unusual]: deck.yaml:16:22 load_cases.push.dead[0].gravity = [0, 0, -9.81]: "
        "is 0.00981 m/s^2, not 9.81: its numbers are in mm/s^2"
    ]


@pytest.mark.parametrize(
    ("length", "gravity"),
    [
        ("m", "[0, 0, -9.80665]"),
        ("m", "[0, -9.8, 0]"),
        ("mm", "[0, 0, -9810]"),
        ("ft", "[0, 0, -32.174]"),
        ("mm", '[0, 0, "-9.81 m/s^2"]'),
        ("m", "[6.94, 0, -6.94]"),
        ("m", "[0, 0, 0]"),
    ],
)
def test_usual_gravity(tmp_path: Path, length: str, gravity: str) -> None:
    text = changed(LIVE, f"    dead: [{{gravity: {gravity}}}]\n" + LIVE).replace("length: m", f"length: {length}")
    assert notices(tmp_path, text) == []


def test_gravity_three_per_cent_off_as_live_load(tmp_path: Path) -> None:
    (notice,) = notices(tmp_path, changed(LIVE, "    live: [{gravity: [0, 0, -9.5]}]\n"))
    assert notice.startswith(
        "warning [gravity-unusual]: deck.yaml:16:22 load_cases.push.live[0].gravity = [0, 0, -9.5]"
    )


def test_names_that_nothing_uses(tmp_path: Path) -> None:
    text = changed("{mu: 0.6}", "{mu: 0.6, nu: 1, xi: '=nu'}").replace(
        "joints:\n", "  brick: {density: 1}\njoints:\n  wet: {friction: 1}\n"
    )
    assert notices(tmp_path, text) == [
        "notice [parameter-unused]: deck.yaml:4:34 parameters.xi is not used",
        "notice [material-unused]: deck.yaml:7:3 materials.brick is not used",
        "notice [joint-unused]: deck.yaml:9:3 joints.wet is not used",
    ]
