"""What items ask for is counted before any of it is made.

Added masses weigh as the blocks do, each where it is.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.model import build_model, items
from mbla.model.blocks import ITEM_KINDS
from mbla.model.model import Model
from tests.deck.decks import BLOCK, write
from tests.model.shapes import write_deck

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
    unmade = replace(ITEM_KINDS["wall"], generate=lambda item, site: pytest.fail("a wall is made"))
    monkeypatch.setitem(ITEM_KINDS, "wall", unmade)
    wall = "  - wall: {material: stone, unit: [0.4, 0.2, 0.1], length: 360, courses: 1000}\n"
    assert faults(tmp_path, 3 * wall) == [
        "10:3 blocks: the items make about 3e+06 units; at most 2,000,000 can be handled"
    ]


def test_what_fits_is_made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(items, "MOST", 4)
    stack = (
        "  - stack: {group: GROUP, material: stone, block: [1, 1, 1], count: 2, transform: {translate: [X, 0, 0]}}\n"
    )
    two = stack.replace("X", "0").replace("GROUP", "block") + stack.replace("X", "5").replace("GROUP", "b")
    assert len(build_model(read_deck(write(tmp_path, BLOCK.replace(BOX, two)))).blocks) == 4
    assert len(faults(tmp_path, two + BOX.replace("group: block", "group: c"))) == 1


BLOCKS = [
    "box: {group: base, material: stone, min: [0, 0, 0], max: [1, 1, 1]}",
    "box: {group: top, material: stone, min: [0, 0, 1], max: [1, 1, 3]}",
    "box: {group: top, material: stone, min: [0, 0, 3], max: [1, 1, 4]}",
]


def model(folder: Path, masses: str, units: str = "", supports: str = "[{ground: {z: 0}}]") -> Model:
    path = write_deck(folder, BLOCKS, supports, "live: [{acceleration: [1, 0, 0]}]", units)
    path.write_text(path.read_text() + f"masses: {masses}\n")
    return build_model(read_deck(path))


def test_shared_in_proportion_to_volume_at_the_centroids(tmp_path: Path) -> None:
    found = model(tmp_path, "[{mass: 600, on: top}, {mass: 50, on: base}]")
    assert found.blocks.added_masses.tolist() == [50, 400, 200]
    assert found.blocks.masses.tolist() == [2050, 4400, 2200]
    assert found.total_weight == pytest.approx(9.81 * (8000 + 650), rel=1e-14)
    case = found.load_cases[0]
    assert case.dead_load[:, 2] == pytest.approx(-9.81 * found.blocks.masses, rel=1e-14)
    assert case.live_load[:, 0] == pytest.approx(9.81 * found.blocks.masses, rel=1e-14)
    assert not case.live_load[:, 3:].any()


def test_a_mass_at_a_point_brings_its_moment(tmp_path: Path) -> None:
    """Two masses on one block act like one at their common centroid."""
    masses = [f"{{mass: {m}, on: {{group: top, index: 1}}, at: [{x}, 0.5, 4]}}" for m, x in ((300, 1), (100, 0))]
    found = model(tmp_path, f"[{', '.join(masses)}]")
    assert found.blocks.added_mass_points[2] == pytest.approx([0.75, 0.5, 4])
    case, weight = found.load_cases[0], 9.81 * 400
    assert case.dead_load[2] == pytest.approx([0, 0, -9.81 * 2400, *np.cross([0.25, 0, 0.5], [0, 0, -weight])])
    assert case.live_load[2] == pytest.approx([9.81 * 2400, 0, 0, *np.cross([0.25, 0, 0.5], [weight, 0, 0])])
    assert case.live_words == ("acceleration (1, 0, 0) g",)


def test_units(tmp_path: Path) -> None:
    found = model(tmp_path, "[{mass: 600 kg, on: base}]", "length: m, force: kN, mass: t")
    assert found.blocks.added_masses.tolist() == [0.6, 0, 0]
    assert found.load_cases[0].dead_load[0, 2] == pytest.approx(-9.81 * (2000 + 0.6))


def test_one_point_for_several_blocks(tmp_path: Path) -> None:
    with pytest.raises(DeckError, match="applies to a mass on one block, 2 are selected"):
        model(tmp_path, "[{mass: 600, on: top, at: [0, 0, 3]}]")


@pytest.mark.parametrize(
    ("mass", "supports", "identifiers"),
    [
        ("{mass: 5, on: base}", "[{blocks: base}]", ["mass-on-support"]),
        ("{mass: 5, on: [base, top]}", "[{blocks: base}]", []),
        ("{mass: 5, on: base, at: [3, 0, 0]}", "[{ground: {z: 0}}]", ["mass-outside-block"]),
        ("{mass: 5, on: base, at: [1, 0, 0]}", "[{ground: {z: 0}}]", []),
    ],
)
def test_masses_that_look_wrong_are_remarked_on(
    tmp_path: Path, mass: str, supports: str, identifiers: list[str]
) -> None:
    found = model(tmp_path, f"[{mass}]", supports=supports)
    assert [notice.identifier for notice in found.notices] == identifiers


@pytest.mark.parametrize(
    ("at", "severity", "words"),
    [
        ("[500, 500, 2000]", "warning", "large; in mm it would be at (0.5, 0.5, 2) m; it moves with the block"),
        ("[0.5, 0.5, 9000]", "warning", "m outside that block, of a structure that is"),
        ("[3, 0, 0]", "notice", "the mass of 5 kg at (3, 0, 0) m on base[0] lies 2 m outside that block; it moves"),
    ],
)
def test_where_a_mass_far_from_its_block_may_be_meant(tmp_path: Path, at: str, severity: str, words: str) -> None:
    (notice,) = model(tmp_path, f"[{{mass: 5, on: base, at: {at}}}]").notices
    assert (notice.severity, notice.identifier) == (severity, "mass-outside-block")
    assert words in notice.message
