"""What soil of cells and water in it press with: a footing on flooded soil, by statics alone."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest

from mbla.process.run_options import RunOptions
from mbla.results.collapse.soil_pressure import soil_pressures, water_pressures
from mbla.results.listing.listing import listing
from mbla.results.record.json_record import results_json
from mbla.results.results import Results
from mbla.run import run

DECK = """mbla: 1
units: {force: kN}
materials: {stone: {unit_weight: 24}, sand: {unit_weight: 20}}
joints: {dry: {friction: 0.6}}
blocks:
  - box: {group: footing, material: stone, min: [0.5, 0, 1], max: [1.3, 1, 2]}
  - soil:
      group: bed
      material: sand
      outline: [[0, 0], [2, 0], [2, 1], [0, 1]]
      width: 1
      cells: {size: 0.5}
      friction_angle: 30
      cohesion: 2
      water: {level: 1.5, unit_weight: 10}
contacts: {joint: dry}
supports:
  - {ground: {z: 0}}
  - {ground: {point: [0, 0, 0], normal: [1, 0, 0]}, blocks: bed}
  - {ground: {point: [2, 0, 0], normal: [-1, 0, 0]}, blocks: bed}
load_cases: {push: {live: [{force: [1, 0, 0], on: footing, at: [0.5, 0.5, 1]}]}}
analysis: {flow_rule: associative}
output: {vtu: false}
"""
WEIGHT, UPLIFT = 24 * 0.8, 10 * 0.5 * 0.8
"""of the footing, and of the water under it"""


@pytest.fixture(scope="module")
def results() -> Iterator[Results]:
    with TemporaryDirectory() as name:
        path = Path(name) / "footing.yaml"
        path.write_text(DECK, encoding="utf-8")
        yield run(path, RunOptions(folder=Path(name) / "out"))


def test_water_presses_under_the_footing(results: Results) -> None:
    (water,) = water_pressures(results.model, results.cases[0].load_case)
    assert (water.soil, water.group, water.water) == (0, "footing", True)
    assert water.force == pytest.approx([0, 0, UPLIFT], abs=1e-12)
    assert water.point == pytest.approx([0.9, 0.5, 1.0], abs=1e-12)


def test_soil_carries_the_rest_at_rest_and_with_the_load(results: Results) -> None:
    (case,) = results.cases
    mechanics, standing = case.solution.mechanics, case.solution.standing
    assert mechanics is not None
    assert standing is not None
    assert standing.forces is not None
    assert mechanics.load_factor == pytest.approx((WEIGHT - UPLIFT) * np.tan(np.radians(20)), rel=1e-6)
    for forces, load in ((standing.forces, 0.0), (mechanics.contact_forces, mechanics.load_factor)):
        (soil,) = soil_pressures(results.model, results.contacts, forces)
        assert soil.force == pytest.approx([-load, 0, WEIGHT - UPLIFT], rel=1e-6, abs=1e-6)
        assert soil.point == pytest.approx([0.9, 0.5, 1.0], abs=1e-5)
        assert not soil.water


def test_the_listing_has_both_states(results: Results) -> None:
    text = " ".join(listing(results).split())
    collapse, rest = text.index("[kN] centre of pressure"), text.index("at rest soil presses Fx")
    assert collapse < rest
    assert "soil bed on footing 0 0 15.2 (0.9, 0.5, 1)" in text[rest:]
    assert text.count("water in soil bed on footing 0 0 4 (0.9, 0.5, 1)") == 2
    assert "no coefficient of earth pressure at rest is assumed" in text


def test_all_in_balance_with_the_water(results: Results) -> None:
    """Soil, saturated, and footing weigh on the ground what water in their place does not lift."""
    (case,) = results.cases
    total = case.load_case.dead_load.sum(axis=0)
    assert total[2] == pytest.approx(-(20 * 2 + WEIGHT - 10 * 2 - UPLIFT), rel=1e-12)
    assert np.abs(total[:2]).max() < 1e-12
    assert case.checks.equilibrium_residual < 1e-9


def test_the_record_has_both_states(results: Results) -> None:
    (case,) = results_json(results)["cases"]
    found = {(each["at_rest"], each["water"]): each for each in case["earth_pressure"]}
    assert len(found) == len(case["earth_pressure"]) == 4
    assert {(each["soil"], each["group"]) for each in found.values()} == {("bed", "footing")}
    assert found[True, False]["force"] == pytest.approx([0, 0, WEIGHT - UPLIFT], rel=1e-6, abs=1e-6)
    assert found[False, False]["force"][0] == pytest.approx(-case["load_factor"])
    assert found[False, True]["point"] == found[True, True]["point"] == pytest.approx([0.9, 0.5, 1.0])
