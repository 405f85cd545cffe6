"""Units that may crack: what is warned of, with the factor at which the first does, and what the listing says."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

import mbla
from mbla.assembly.assembly import Assembly
from mbla.results.demand.actions import Acting
from mbla.results.demand.bearings import HINGE
from mbla.results.demand.cracking import cracking_notices, cracking_of
from mbla.results.demand.demand import Demand, demand_of, demand_under, strength_use
from mbla.results.listing.listing import case_section
from mbla.results.listing.text import section_lines
from mbla.results.outcome import notices_of
from mbla.results.results import CaseResult, Results
from tests.results.demand.test_demand import BEAM, DEPTH, MODULUS, SPAN, THICKNESS, deck, pad

OVERHANG: dict[str, Any] = deck(
    [{"group": "beam", "min": [-1, 0, 0], "max": [2, THICKNESS, DEPTH]}, pad(0.0, width=2.0)],
    10.0,
    load_cases={"push": {"live": [{"force": [0, 0, -1], "on": {"group": "beam"}, "at": [1.9, 0.15, DEPTH]}]}},
)
"""a beam over the edge of a wide support that a force near its end tips"""


def solved(**strengths: float) -> Results:
    return mbla.run("\n" + json.dumps(OVERHANG | {"materials": {"stone": {"unit_weight": 10.0, **strengths}}})).records


def listed(results: Results) -> str:
    lines = section_lines([case_section(results.assembly, results.cases[0])])
    return " ".join(" ".join(lines).split())


def test_a_beam_that_tips_bends_over_the_edge_of_its_support() -> None:
    results = solved()
    (case,) = results.cases
    mechanics = case.solution.mechanics
    assert mechanics is not None
    line = 10.0 * THICKNESS * DEPTH
    moment = 0.9 * mechanics.load_factor + line / 2
    demand = demand_of(results.assembly, case.load_case, mechanics)
    assert demand.bending[0] == pytest.approx(moment / MODULUS, rel=1e-5)
    assert cracking_notices(results.assembly, case) == ()
    assert "units-would-crack" not in {notice.identifier for notice in notices_of(results)}
    assert f"bending {moment / MODULUS:.3g} N/m^2 (beam[0])" in listed(results)
    assert "Not checked: no material has a tensile_strength" in listed(results)
    assert np.isnan(strength_use(results.assembly, demand)).all()


def test_a_unit_that_may_crack_is_warned_of_with_the_factor_at_which_it_does() -> None:
    greatest = float(demand_shown(solved()).bending[0])
    results = solved(tensile_strength=0.8 * greatest)
    (case,) = results.cases
    mechanics, standing = case.solution.mechanics, case.solution.standing
    cracking = cracking_of(results.assembly, case)
    assert mechanics is not None
    assert standing is not None
    assert standing.forces is not None
    assert cracking is not None
    assert cracking.blocks.tolist() == [0]
    assert cracking.uses[0] == pytest.approx(1.25, rel=1e-6)
    assert 0.0 < cracking.factor < mechanics.load_factor
    share = cracking.factor / mechanics.load_factor
    forces = standing.forces + share * (mechanics.contact_forces - standing.forces)
    there = demand_under(results.assembly, Acting(case.load_case, cracking.factor, forces))
    assert strength_use(results.assembly, there)[0] == pytest.approx(1.0, abs=2e-3)
    (notice,) = [each for each in notices_of(results) if each.identifier == "units-would-crack"]
    assert notice.severity == "warning"
    assert "1 unit may crack" in notice.message
    assert f"{cracking.factor:.4g}" in notice.message
    assert "1 unit may crack" in listed(results)
    assert "Their forces are unique in this mechanism" in listed(results)


def test_a_position_of_a_travelling_load_has_the_factor_of_a_force_there() -> None:
    strength = {"tensile_strength": 0.5 * float(demand_shown(solved()).bending[0])}
    travel = {"force": [0, 0, -1], "path": [[-0.5, 0.15, DEPTH], [1.9, 0.15, DEPTH]], "positions": 3}
    text = OVERHANG | {"materials": {"stone": {"unit_weight": 10.0, **strength}}}
    text["load_cases"] = {"crane": {"live": [{"travel": travel}]}}
    results = mbla.run("\n" + json.dumps(text)).records
    found, expected = cracking_of(results.assembly, results.cases[-1]), cracking_of(*shown(solved(**strength)))
    assert found is not None
    assert expected is not None
    assert found.factor == pytest.approx(expected.factor, rel=1e-3)


def beside_soil(text: dict[str, Any], earth: dict[str, float]) -> Results:
    """The same with soil of cells apart from it."""
    outline = [[-6, -1], [-3, -1], [-3, -0.5], [-5, -0.5]]
    soil = {"group": "clay", "material": "earth", "outline": outline, "width": 1, "cells": {"size": 0.5}}
    law = {"friction_angle": 35, "cohesion": 5}
    materials = text["materials"] | {"earth": {"unit_weight": 18.0} | earth}
    blocks = [*text["blocks"], {"soil": soil | law}]
    return mbla.run("\n" + json.dumps(text | {"materials": materials, "blocks": blocks, "supports": BESIDE})).records


BESIDE = [{"blocks": "pad"}, {"ground": {"z": -1}}]


@pytest.mark.parametrize("earth", [{}, {"tensile_strength": 1e-3, "compressive_strength": 1e-3}])
def test_units_are_judged_beside_soil_and_cells_of_soil_are_not(earth: dict[str, float]) -> None:
    strength = {"tensile_strength": 0.8 * float(demand_shown(solved()).bending[0])}
    alone = solved(**strength)
    results = beside_soil(OVERHANG | {"materials": {"stone": {"unit_weight": 10.0, **strength}}}, earth)
    found, expected = (cracking_of(each.assembly, each.cases[0]) for each in (results, alone))
    assert found is not None
    assert expected is not None
    assert found.blocks.tolist() == expected.blocks.tolist() == [0]
    assert found.uses == pytest.approx(expected.uses, rel=1e-6)
    assert found.factor == pytest.approx(expected.factor, rel=1e-3)
    cells = results.model.soil_of_block >= 0
    assert cells.sum() > 3
    assert np.isnan(demand_shown(results).bending[cells]).all()


def test_forces_that_are_not_unique_are_told() -> None:
    """A beam that slides on three supports."""
    stone = {"stone": {"unit_weight": 10.0, "tensile_strength": 1e-6}}
    text = deck([BEAM, pad(-SPAN / 2), pad(0.0), pad(SPAN / 2)], 10.0, materials=stone)
    listing = listed(mbla.run("\n" + json.dumps(text)).records)
    assert "1 unit may crack" in listing
    assert "Other forces in balance may ask for less." in listing


def test_a_unit_within_its_strength_is_not_warned_of() -> None:
    results = solved(tensile_strength=1.1 * float(demand_shown(solved()).bending[0]))
    assert cracking_of(results.assembly, results.cases[0]) is None
    assert "Within the strengths that are given" in listed(results)


def test_a_joint_without_a_compressive_strength_presses_on_a_tenth_of_it_at_least() -> None:
    """The beam tips over the edge of a support whose joint is 2 m long."""
    (case,) = solved().cases
    assert case.solution.mechanics is not None
    weight = 3.0 * 10.0 * THICKNESS * DEPTH + case.solution.mechanics.load_factor
    pressure = weight / (HINGE * 2.0 * THICKNESS)
    assert demand_shown(solved()).pressure[0] == pytest.approx(pressure, rel=1e-6)
    assert cracking_of(*shown(solved(compressive_strength=1.1 * pressure))) is None
    results = solved(compressive_strength=0.8 * pressure)
    cracking = cracking_of(*shown(results))
    assert cracking is not None
    assert cracking.uses[0] == pytest.approx(1.25, rel=1e-6)
    assert 0.5 * case.solution.mechanics.load_factor < cracking.factor < case.solution.mechanics.load_factor
    (notice,) = [each for each in notices_of(results) if each.identifier == "units-would-crack"]
    assert f"joints press beam[0] by {pressure:.3g} N/m^2, 1.25 times its compressive strength" in notice.message


def test_a_joint_that_crushes_presses_by_no_more_than_its_strength() -> None:
    both = OVERHANG | {"joints": {"dry": {"friction": 0.6, "compressive_strength": 1000.0}}}
    results = mbla.run("\n" + json.dumps(both)).records
    assert demand_shown(results).pressure[0] == pytest.approx(1000.0, rel=1e-3)
    both["materials"] = {"stone": {"unit_weight": 10.0, "compressive_strength": 1000.0}}
    assert cracking_of(*shown(mbla.run("\n" + json.dumps(both)).records)) is None


def shown(results: Results) -> tuple[Assembly, CaseResult]:
    return results.assembly, results.cases[0]


def demand_shown(results: Results) -> Demand:
    (case,) = results.cases
    assert case.solution.mechanics is not None
    return demand_of(results.assembly, case.load_case, case.solution.mechanics)
