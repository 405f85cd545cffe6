"""What items ask for is counted before any of it is made."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.model import build_model
from mbla.model.generators import amounts
from mbla.model.generators.generator import ItemRefused
from tests.deck.decks import BLOCK, write

BOX = "  - box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 1]}\n"


def faults(folder: Path, items: str) -> list[str]:
    assert BOX in BLOCK
    with pytest.raises(DeckError) as caught:
        build_model(read_deck(write(folder, BLOCK.replace(BOX, items))))
    return [str(fault).split("deck.yaml:")[1] for fault in caught.value.faults]


@pytest.mark.parametrize(
    ("item", "key"),
    [
        ("stack: {block: [1, 1, 1], count: 1000000, repeat: {count: 3, translate: [2, 0, 0]}", "stack.count = 1000000"),
        (
            "arch: {shape: semicircular, span: 4, thickness: 0.3, width: 1, voussoirs: 1000, rings: 3000",
            "arch.voussoirs = 1000",
        ),
        (
            "bridge: {spans: [5], shape: semicircular, thickness: 0.4, width: 3, voussoirs: 1000, rings: 3000, "
            "abutments: {width: 2}, spandrels: none",
            "bridge.voussoirs = 1000",
        ),
        ("wall: {unit: [0.4, 0.2, 0.1], length: 400000, courses: 3", "wall.length = 400000"),
        (
            "cross_vault: {shape: semicircular, bay: [4, 4], thickness: 0.2, courses: 15, unit: 4.8e-5, edge: 0.4",
            "cross_vault.unit = 4.8e-5",
        ),
    ],
)
def test_an_item_of_too_many_units(tmp_path: Path, item: str, key: str) -> None:
    (told,) = faults(tmp_path, f"  - {item}, material: stone}}\n")
    assert f" blocks[0].{key}: makes about 3e+06 units" in told


def test_items_are_counted_together_before_any_is_made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mbla.model.items.generator_of", lambda kind: pytest.fail(f"a {kind} is made"))
    wall = "  - wall: {material: stone, unit: [0.4, 0.2, 0.1], length: 360, courses: 1000}\n"
    assert faults(tmp_path, 3 * wall) == [
        "10:3 blocks: the items make about 3e+06 units together; at most 2,000,000 can be handled"
    ]


def test_what_fits_is_made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(amounts, "MOST", 4)
    stack = (
        "  - stack: {group: GROUP, material: stone, block: [1, 1, 1], count: 2, transform: {translate: [X, 0, 0]}}\n"
    )
    two = stack.replace("X", "0").replace("GROUP", "block") + stack.replace("X", "5").replace("GROUP", "b")
    assert len(build_model(read_deck(write(tmp_path, BLOCK.replace(BOX, two)))).blocks) == 4
    assert len(faults(tmp_path, two + BOX.replace("group: block", "group: c"))) == 1


@pytest.mark.parametrize("apart", [(0.0, 0.0, 0.0), (1e-4, 0.0, 0.0), (0.0, -1e-4, 1e-4)])
def test_copies_in_one_place(apart: tuple[float, float, float]) -> None:
    lower = np.arange(1000)[:, None] * np.array(apart) + 0.3
    with pytest.raises(ItemRefused, match="lays copies in one place: more than 300,000 pairs of them come near"):
        amounts.refuse_crowd(lower, lower + 1.0, 1000)


def test_copies_beside_each_other_and_flat_ones_are_not_in_one_place() -> None:
    lower = np.arange(100_000)[:, None] * np.array([1.0, 0.0, 0.0])
    amounts.refuse_crowd(lower, lower + np.array([1.0, 1.0, 1.0]), 100_000)
    amounts.refuse_crowd(lower, lower + np.array([1.0, 0.0, 1.0]), 100_000)
    with np.errstate(invalid="ignore"):
        amounts.refuse_crowd(np.full((1000, 3), np.inf), np.full((1000, 3), np.inf), 1000)
