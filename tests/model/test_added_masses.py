"""Added masses weigh as the blocks do, each where it is."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.model import build_model
from mbla.model.model import Model
from tests.model.shapes import write_deck

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
