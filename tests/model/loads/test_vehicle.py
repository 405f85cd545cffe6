"""Vehicles that stand; how their axles land is tested with the loads that spread in fill."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.deck import read_deck
from mbla.errors import DeckError
from mbla.model import build_model
from mbla.model.model import Model
from tests.model.fill.test_dispersal import DECK, POINT, ROW, law_up_to, model, shares


def test_a_vehicle_stands_or_travels(tmp_path: Path) -> None:
    """Standing where it travels it is the same load; each axle is a line of its width."""
    stands = model(tmp_path, "vehicle: {name: lorry, at: [6.3, 1, 9]}", *ROW, width=", width: 1.8")
    travels = model(
        tmp_path, "travel: {vehicle: lorry, path: [[3.3, 1, 9], [6.3, 1, 9]], positions: 3}", *ROW, width=", width: 1.8"
    )
    assert travels.load_cases[1].live_load == pytest.approx(stands.load_cases[0].live_load)
    each = [np.diff(law_up_to("boussinesq", np.arange(11) - x, 1.2)) for x in (6.3, 3.3)]
    assert shares(stands) == pytest.approx(60 * each[0] + 40 * each[1], rel=1e-8, abs=1e-6)
    assert "through fill soil" in travels.load_cases[1].live_words[0]


FIELD = tuple(
    f"box: {{group: row, material: stone, min: [{x}, {y}, 0], max: [{x + 1}, {y + 1}, 1]}}"
    for x in range(6)
    for y in range(3)
)
"""blocks of 1 m x 1 m, three across"""
EACH = 0.5 / np.sqrt(3)
"""of the side of a contact, the two places that stand for it"""


def field(folder: Path, wheels: str, middle: float, through: bool, dispersal: str = "", path: str = "") -> Model:
    """A vehicle of 60 kN and, 3 m behind, 40 kN on the field, the first axle at x = 4.9, or along a path."""
    load = f"vehicle: {{name: lorry, at: [4.9, {middle}, 1]}}"
    load = f"travel: {{vehicle: lorry, {path}}}" if path else load
    text = DECK.format(
        blocks="\n".join(f"  - {block}" for block in FIELD),
        load=load + (", through: soil" if through else ""),
        top="level: 2.2",
        dispersal=dispersal,
        supports="[{ground: {z: 0}}]",
        units="",
        width=f", wheels: {{{wheels}}}",
    )
    (folder / "deck.yaml").write_text(text)
    return build_model(read_deck(folder / "deck.yaml"))


def on_field(found: Model, case: int = 0) -> FloatArray:
    """Load on the blocks, (6, 3) along and across."""
    return shares(found, case).reshape(6, 3)


def test_wheels_on_blocks(tmp_path: Path) -> None:
    """Two wheels on the joints y = 1 and 2 of blocks, three quarters of each before the joint x = 5 and 2."""
    found = on_field(field(tmp_path, "gauge: 1, contact: [0.4, 0.6]", 1.5, through=False))
    across = np.array([1, 2, 1]) / 4
    assert found[4] == pytest.approx(60 * 0.75 * across)
    assert found[5] == pytest.approx(60 * 0.25 * across)
    assert found[1] == pytest.approx(40 * 0.75 * across)
    assert found[2] == pytest.approx(40 * 0.25 * across)


def test_wheels_on_points(tmp_path: Path) -> None:
    """Without a contact each wheel stands on one block."""
    found = field(tmp_path, "gauge: 2", 1.3, through=False)
    assert on_field(found)[4] == pytest.approx([30, 0, 30])
    assert on_field(found)[1] == pytest.approx([20, 0, 20])
    moments = found.load_cases[0].live_load[:, 3] + found.blocks.centroids[:, 1] * found.load_cases[0].live_load[:, 2]
    assert moments.sum() == pytest.approx(-100 * 1.3)


@pytest.mark.parametrize("contact", ["", ", contact: [0.4, 0.6]"])
def test_wheels_on_fill(tmp_path: Path, contact: str) -> None:
    """1:2 over 1.2 m of soil from each place of the contact, along and across."""
    law = "law: uniform, angle: 26.565051177077986"
    found = on_field(field(tmp_path, f"gauge: 1{contact}", 1.4, through=True, dispersal=law))
    ways = EACH * np.array([-0.4, 0.4]) if contact else np.zeros(2)
    asides = EACH * np.array([-0.6, 0.6]) if contact else np.zeros(2)
    expected = np.zeros((6, 3))
    for force, x in ((60, 4.9), (40, 1.9)):
        along = np.mean([np.diff(law_up_to("uniform", np.arange(7) - x - way, 1.2)) for way in ways], axis=0)
        wheels = [y + aside for y in (0.9, 1.9) for aside in asides]
        across = np.mean([np.diff(law_up_to("uniform", np.arange(4) - y, 1.2)) for y in wheels], axis=0)
        expected += force * np.outer(along, across)
    assert found == pytest.approx(expected, abs=1e-6)
    assert found.sum() == pytest.approx(100)
    travels = field(
        tmp_path, f"gauge: 1{contact}", 1.4, True, law, "path: [[1.9, 1.4, 1], [4.9, 1.4, 1]], positions: 3"
    )
    assert on_field(travels, 1) == pytest.approx(found)
    assert " m on wheels 1 m apart through fill soil on " in travels.load_cases[1].live_words[0]


def test_contact_of_wheels_takes_the_place_of_that_of_the_spread(tmp_path: Path) -> None:
    law = "law: uniform, angle: 26.565051177077986"
    own = on_field(field(tmp_path, "gauge: 1, contact: [0.4, 0.6]", 1.4, through=True, dispersal=law))
    both = on_field(field(tmp_path, "gauge: 1, contact: [0.4, 0.6]", 1.4, True, f"{law}, contact: 0.3"))
    assert both == pytest.approx(own)


def test_a_wheel_beside_the_blocks_is_refused(tmp_path: Path) -> None:
    with pytest.raises(DeckError, match="lies over no block"):
        field(tmp_path, "gauge: 2", 0.9, through=False)
    with pytest.raises(DeckError, match="beside the fill"):
        field(tmp_path, "gauge: 2, contact: [0.2, 0.2]", 0.9, through=True)


def test_a_vehicle_has_width_or_wheels(tmp_path: Path) -> None:
    with pytest.raises(DeckError, match="give width or wheels"):
        model(tmp_path, POINT, *ROW, width=", width: 2, wheels: {gauge: 2}")
