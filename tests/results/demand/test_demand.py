"""What forces ask of units, against closed forms of beams, discs and columns."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.assembly.assembly import Assembly
from mbla.results.demand.actions import Acting
from mbla.results.demand.bearings import HINGE, Bearings
from mbla.results.demand.demand import Demand, demand_under
from mbla.results.demand.splitting import MOST, struts_of
from tests.line import line_of
from tests.results.no_contacts import without_contacts
from tests.results.synthetic import tower_results

PAD = 0.01
"""width of what beams and blocks lie on"""
DEPTH, THICKNESS, LENGTH, WEIGHT = 0.2, 0.3, 2.0, 1.2
"""m of the beam, and N of its weight"""


def deck(blocks: list[dict[str, Any]], weight: float, **more: Any) -> dict[str, Any]:
    """Stones of a weight per volume, those of the group `pad` fixed, pushed sideways."""
    return {
        "mbla": 1,
        "materials": {"stone": {"unit_weight": weight}},
        "joints": {"dry": {"friction": 0.6}},
        "contacts": {"joint": "dry"},
        "blocks": [{"box": {"material": "stone", **block}} for block in blocks],
        "supports": [{"blocks": "pad"}],
        "load_cases": {"push": {"live": [{"acceleration": [1, 0, 0]}]}},
        **more,
    }


def pad(x: float, z: float = 0.0, width: float = PAD, thickness: float = THICKNESS) -> dict[str, Any]:
    return {"group": "pad", "min": [x - width / 2, 0, z - 0.1], "max": [x + width / 2, thickness, z]}


def carried(text: dict[str, Any], shares: dict[int, FloatArray]) -> Demand:
    """Demand of forces on contact points, (N, T1, T2), by interface; without a live load."""
    found = line_of("\n" + json.dumps(text))
    forces = np.zeros((len(found.contacts.points), 3))
    for interface, force in shares.items():
        forces[found.contacts.point_start[interface] : found.contacts.point_start[interface + 1]] = force
    return demand_under(found.assembly, Acting(found.load_case, 0.0, forces))


BEAM = {"group": "beam", "min": [-LENGTH / 2, 0, 0], "max": [LENGTH / 2, THICKNESS, DEPTH]}
SPAN = 1.6
"""m between its supports"""
MODULUS = THICKNESS * DEPTH**2 / 6


def on_two_supports(force: float) -> Demand:
    """A beam with a force in its middle, each support taking half."""
    beam = deck([BEAM, pad(-SPAN / 2), pad(SPAN / 2)], WEIGHT / (LENGTH * THICKNESS * DEPTH))
    load = {"force": [0, 0, -force], "on": {"group": "beam", "index": 0}, "at": [0, THICKNESS / 2, DEPTH]}
    beam["load_cases"]["push"]["dead"] = [{"gravity": [0, 0, -9.81]}, load]
    each = np.array([(WEIGHT + force) / 8, 0.0, 0.0])
    return carried(beam, {0: each, 1: each})


@pytest.mark.parametrize("force", [0.0, 10.0])
def test_a_beam_on_two_supports_bends_by_moment_over_section_modulus(force: float) -> None:
    moment = force * SPAN / 4 + WEIGHT * SPAN / 4 - WEIGHT * LENGTH / 8
    assert on_two_supports(force).bending[0] == pytest.approx(moment / MODULUS, rel=1e-5)


def test_what_is_fixed_is_not_judged() -> None:
    demand = on_two_supports(10.0)
    assert np.isnan(demand.bending[1:]).all()
    assert np.isnan(demand.splitting[1:]).all()
    assert np.isnan(demand.pressure[1:]).all()


def test_supports_are_pressed_evenly() -> None:
    assert on_two_supports(10.0).pressure[0] == pytest.approx((WEIGHT + 10.0) / 2 / (PAD * THICKNESS))


CUBE = 0.2


def test_two_opposite_line_loads_split_as_in_the_brazilian_test() -> None:
    """2P/(π t D), but for the width of the lines."""
    cube = {"group": "cube", "min": [-CUBE / 2, 0, 0], "max": [CUBE / 2, CUBE, CUBE]}
    above = {"group": "above", "min": [-PAD / 2, 0, CUBE], "max": [PAD / 2, CUBE, CUBE + 0.1]}
    both = np.array([5.0, 0.0, 0.0])
    demand = carried(deck([cube, above, pad(0.0, thickness=CUBE)], 1e-6), {0: both, 1: both})
    full = 2 * 20.0 / (np.pi * CUBE * CUBE)
    assert demand.splitting[0] == pytest.approx(full, rel=5e-3)
    assert demand.splitting[0] == pytest.approx(full * (1 - (PAD / CUBE) ** 2) ** 1.5, rel=1e-9)


def on_a_cube(lower: FloatArray, upper: FloatArray) -> Demand:
    """A cube between another one and the ground under forces on the four points of each face."""
    boxes = [
        {"group": name, "min": [0, 0, z], "max": [CUBE, CUBE, z + CUBE]}
        for name, z in (("pad", -CUBE), ("cube", 0.0), ("above", CUBE))
    ]
    found = line_of("\n" + json.dumps(deck(boxes, 1e-6)))
    forces = np.zeros((8, 3))
    for interface, side in ((0, lower), (1, upper)):
        rows = slice(4 * interface, 4 * interface + 4)
        order = np.lexsort(found.contacts.points[rows, :2].T)  # by y, then by x
        frames = found.contacts.frames[rows][order]
        forces[rows][...] = 0.0
        forces[4 * interface + order] = np.einsum("pjx,px->pj", frames, side)
    return demand_under(found.assembly, Acting(found.load_case, 0.0, forces))


def test_a_diagonal_strut_splits_a_unit() -> None:
    """From edge to edge: D is the diagonal."""
    push = 3.0 * np.array([1.0, 0.0, 1.0]) / np.sqrt(2)  # on the upper of the two bodies
    left, right = np.array([push, 0 * push, push, 0 * push]), np.array([0 * push, push, 0 * push, push])
    demand = on_a_cube(left, right)
    assert demand.splitting[1] == pytest.approx(2 * 6.0 / (np.pi * CUBE * CUBE * np.sqrt(2)), rel=1e-6)
    assert demand.pressure[1] == pytest.approx(6.0 / np.sqrt(2) / (HINGE * CUBE**2))


def test_an_even_pressure_brings_no_tension() -> None:
    even = np.tile([0.0, 0.0, 2.5], (4, 1))
    demand = on_a_cube(even, even)
    assert demand.bending[1] == 0.0
    assert demand.splitting[1] == 0.0
    assert demand.pressure[1] == pytest.approx(10.0 / CUBE**2)


def test_two_forces_along_one_edge_split_nothing() -> None:
    edge = np.array([[0.0, 0.0, 5.0], [0.0] * 3, [0.0, 0.0, 5.0], [0.0] * 3])
    assert on_a_cube(edge, edge).splitting[1] == 0.0


def test_without_contacts_nothing_is_asked() -> None:
    results = tower_results()
    none = Assembly(results.model, without_contacts(results.contacts))
    demand = demand_under(none, Acting(results.cases[0].load_case, 1.0, np.zeros((0, 3))))
    assert np.nanmax(demand.bending) == np.nanmax(demand.splitting) == np.nanmax(demand.pressure) == 0.0


def test_struts_of_a_block_on_many_others_are_those_of_its_greatest_forces() -> None:
    count = MOST + 10
    places, forces = np.zeros((count, 3)), np.zeros((count, 3))
    places[:, 0] = np.arange(count)
    forces[:, 2] = 1e-3
    places[[3, 7]], forces[[3, 7]] = [[0.5, 0, 0], [0.5, 0, 1]], [[0, 0, 5.0], [0, 0, -5.0]]
    bearings = Bearings(np.array([0, count]), np.arange(count), places, forces, forces[:, 2])
    struts = struts_of(bearings, np.array([True]))
    assert struts.ends.tolist() == [[3, 7]]
    assert struts.forces == pytest.approx([5.0])
