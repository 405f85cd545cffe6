"""The library of vehicles: every file loads by itself, and what codes say of weights and lengths is met."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.deck.sections.vehicles import Vehicle
from mbla.model import build_model
from tests.decks.folder import DECKS

LIBRARY = DECKS / "bridges" / "vehicles"
TONNE = 9.81
"""kN"""
WEIGHTS = {
    "lm1_lane_1": 600, "lm1_lane_2": 400, "lm1_lane_3": 200,
    "lm71": 1000, "lm71_behind": 1000 + 80 * 12.8,
    "cs454_single": 11.5 * TONNE, "cs454_single_fire_engines_1": 10 * TONNE, "cs454_single_13_tonnes": 9 * TONNE,
    "cs454_single_10_tonnes": 7 * TONNE, "cs454_single_7_5_tonnes": 5.5 * TONNE,
    "cs454_single_fire_engines_2": 5 * TONNE, "cs454_single_3_tonnes": 2 * TONNE,
    "cs454_double_1_0": 16 * TONNE, "cs454_double_1_3": 19 * TONNE, "cs454_double_1_8": 20 * TONNE,
    "cs454_triple": 24 * TONNE,
}  # fmt: skip
"""total of each, kN; with lift-off the same"""
LENGTHS = {
    "lm1_lane_1": 1.2, "lm1_lane_2": 1.2, "lm1_lane_3": 1.2, "lm71": 4.8, "lm71_behind": 4.8 + 0.8 + 12.8 - 0.4,
    "cs454_double_1_0": 1.0, "cs454_double_1_3": 1.3, "cs454_double_1_8": 1.8, "cs454_triple": 2.6,
}  # fmt: skip
"""from the first axle to the last, m; the last of those that stand for an even load is in the middle of its part"""
DECK = """mbla: 1
units: {{force: {force}, length: {length}}}
include: [vehicles.yaml]
materials: {{stone: {{density: "2400 kg/m^3"}}}}
joints: {{dry: {{friction: 0.6}}}}
blocks: [{{box: {{material: stone, min: ["-30 m", "-2 m", "-1 m"], max: ["30 m", "2 m", 0]}}}}]
contacts: {{joint: dry}}
supports: [{{ground: {{z: "-1 m"}}}}]
load_cases:
{cases}
"""


def deck_of(folder: Path, library: Path, force: str = "kN", length: str = "m", *, cases: str) -> Path:
    """A slab with a library of vehicles."""
    (folder / "vehicles.yaml").write_text(library.read_text(encoding="utf-8"), encoding="utf-8")
    path = folder / "deck.yaml"
    path.write_text(DECK.format(force=force, length=length, cases=cases), encoding="utf-8")
    return path


PUSH = "  push: {live: [{acceleration: [1, 0, 0]}]}"


@cache
def names_of(library: Path) -> tuple[str, ...]:
    """Of its vehicles."""
    lines = library.read_text(encoding="utf-8").splitlines()
    return tuple(line.split(":")[0].strip() for line in lines if line.startswith("  ") and line[2].isalpha())


def vehicles_of(folder: Path, library: Path) -> Mapping[str, Vehicle]:
    """In kilonewtons and metres."""
    deck = read_deck(deck_of(folder, library, cases=PUSH))
    assert [notice for notice in deck.notices if notice.identifier == "vehicle-unused"] == []
    return deck.content.vehicles


@pytest.mark.parametrize("library", sorted(LIBRARY.iterdir()), ids=lambda path: path.stem)
def test_weights_and_lengths_are_those_of_the_code(library: Path, tmp_path: Path) -> None:
    found = vehicles_of(tmp_path, library)
    assert set(found) == set(names_of(library))
    for name, vehicle in found.items():
        plain = name.removesuffix("_lift_off")
        forces = np.array([vehicle.force, *(axle.force for axle in vehicle.axles)])
        assert forces[:, 2].sum() == pytest.approx(-WEIGHTS[plain], rel=1e-5), name
        assert not forces[:, :2].any()
        assert max([0.0, *(axle.behind for axle in vehicle.axles)]) == pytest.approx(LENGTHS.get(plain, 0.0)), name


def test_every_vehicle_of_the_codes_is_there() -> None:
    there = {name.removesuffix("_lift_off") for library in LIBRARY.iterdir() for name in names_of(library)}
    assert there == set(WEIGHTS)


def test_tandem_systems_stand_on_their_wheels(tmp_path: Path) -> None:
    for name, vehicle in vehicles_of(tmp_path, LIBRARY / "en_1991_2.yaml").items():
        wheels = vehicle.wheels
        assert (wheels is not None) == name.startswith("lm1_")
        assert wheels is None or (wheels.gauge, wheels.contact) == (2.0, (0.4, 0.4))


@pytest.mark.parametrize("library", sorted(LIBRARY.iterdir()), ids=lambda path: path.stem)
def test_they_stand_in_decks_of_any_units(library: Path, tmp_path: Path) -> None:
    cases = "\n".join(
        f"  {name}: {{live: [{{vehicle: {{name: {name}, at: [0, 0, 0]}}}}]}}" for name in names_of(library)
    )
    model = build_model(read_deck(deck_of(tmp_path, library, "N", "mm", cases=cases)))
    for case in model.load_cases:
        weight = 1000 * WEIGHTS[case.name.removesuffix("_lift_off")]
        assert case.live_load[:, 2].sum() == pytest.approx(-weight, rel=1e-5), case.name
