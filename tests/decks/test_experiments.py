"""The page on experiments says what their decks expect, and what was measured."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest

import mbla
from mbla.deck import read_deck
from mbla.results.demand.cracking import cracking_of
from tests.decks.experiments import MEASURED, cut_walls, mean_of, words_of
from tests.decks.folder import DECKS

FOLDER = DECKS / "benchmarks" / "experiments"
PAGE = (FOLDER / "README.md").read_text(encoding="utf-8")


def test_every_deck_has_its_measurements() -> None:
    assert {path.stem for path in FOLDER.glob("*.yaml")} == set(MEASURED)


@pytest.mark.parametrize("name", MEASURED)
def test_the_table_has_the_figures_of_the_deck(name: str) -> None:
    expected = read_deck(FOLDER / f"{name}.yaml").content.expected
    assert set(expected) == set(MEASURED[name])
    for case, expectation in expected.items():
        found = re.search(rf"\| {name} \| {words_of(case)} \| ([\d.]+)[^|]* \| ([\d.]+) \| ([-−+][\d.]+) % \|", PAGE)
        assert found is not None, case
        measured, computed = mean_of(name, case), expectation.load_factor
        assert computed is not None
        assert float(found[1]) == pytest.approx(measured, abs=0.051)
        assert float(found[2]) == pytest.approx(computed, abs=0.0051)
        off = 100 * (computed / measured - 1)
        assert float(found[3].replace("−", "-")) == pytest.approx(off, abs=0.11)


@pytest.mark.long
@pytest.mark.parametrize("name", ["walls_ws", "walls_sw"])
def test_the_table_has_the_load_from_which_units_may_crack(name: str) -> None:
    run = mbla.run(str(FOLDER / f"{name}.yaml"))
    for case in run.records.cases:
        found = cracking_of(run.records.assembly, case)
        row = rf"\| {name} \| {case.load_case.name[1:]} \|(?:[^|]*\|){{3}} (–|[\d.]+) \|"
        told = re.search(row, PAGE)
        assert told is not None
        assert told[1] == ("–" if found is None else f"{found.factor:.0f}")


@pytest.mark.long
@pytest.mark.parametrize(
    ("tensile_strength", "vertical_load", "computed"),
    [(3353, 200, 99.2), (3353, 250, 123.2), (1000, 200, 81.5), (1000, 250, 93.5), (0, 200, 23.0)],
)
def test_walls_with_units_that_are_cut(tensile_strength: float, vertical_load: float, computed: float) -> None:
    results = mbla.run("\n" + json.dumps(cut_walls(tensile_strength, vertical_load)))
    assert results.case("push").load_factor == pytest.approx(computed, rel=5e-3)
    assert f"{computed:.4g}" in PAGE


MASS_ALONE = {
    "on": "ring",
    "material": "earth",
    "level": 1.813,
    "dispersal": {"law": "uniform", "angle": 26.565, "contact": 0.3},
}
STRIPS: dict[int, dict[str, object]] = {
    102: {"fill.soil": MASS_ALONE},
    139: {"parameters.fc": 1e6},
    158: {"parameters.mobilisation": 1},
    185: {"parameters.mobilisation": 1, "fill.soil.passive.cohesion_mobilisation": 1},
}
"""load factor that the page has, of Prestwood with strips and these values"""


@pytest.mark.long
@pytest.mark.parametrize("computed", STRIPS)
def test_prestwood_with_other_strips(computed: int) -> None:
    results = mbla.run(FOLDER / "prestwood_strips.yaml", set=STRIPS[computed])
    assert results.case("strip").load_factor == pytest.approx(computed, abs=0.51)
    page = PAGE[PAGE.index("**Prestwood in strips") :].split("\n\n")[0]
    assert re.search(rf"\b{computed}\b", page)


IN_SOIL: dict[int, dict[str, object]] = {
    183: {"parameters.delta": 10},
    226: {"parameters.delta": 27},
    239: {"parameters.delta": 30},
    265: {"parameters.pad": 0.6},
    307: {"parameters.pad": 0.6, "parameters.fc": 1e6},
    230: {"parameters.fc": 1e6},
    188: {"parameters.cover": 0.115},
    238: {"parameters.cover": 0.215},
    187: {"supports": []},
}
"""load factor that the page has, of Prestwood in soil of cells with these values"""
SOME = (183, 307, 187)
"""less friction on the ring, a longer load on a ring that does not crush, and the load left to itself; a quarter of a
minute each"""


@pytest.mark.parametrize(
    "computed", [pytest.param(each, marks=pytest.mark.long if each in SOME else pytest.mark.trust) for each in IN_SOIL]
)
def test_prestwood_in_other_soil(computed: int) -> None:
    case = mbla.run(FOLDER / "prestwood.yaml", set=IN_SOIL[computed]).case("strip")
    assert case.verified
    assert case.load_factor == pytest.approx(computed, rel=0.01)
    page = PAGE[PAGE.index("**Prestwood in soil") :].split("**Prestwood in strips")[0]
    assert re.search(rf"\b{computed}\b", page)


@pytest.mark.long
def test_the_ring_of_prestwood_turns_about_four_hinges() -> None:
    mechanism = mbla.run(FOLDER / "prestwood.yaml").case("strip").mechanism
    assert mechanism is not None
    turns = mechanism[:41, 4]  # of the voussoirs, about the axis across the bridge
    turning = np.sign(turns[abs(turns) > 0.1 * abs(turns).max()])
    assert np.count_nonzero(np.diff(turning)) == 2  # three pieces, between two springings
