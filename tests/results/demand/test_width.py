"""The width of planar problems, and that no unit bends along it."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.results.demand.actions import Acting
from mbla.results.demand.demand import Demand, demand_under
from mbla.results.demand.width import width_of
from tests.line import line_of

LENGTH, DEPTH, WIDTH, FORCE = 0.2, 0.1, 3.0, 100.0
"""m of a slab on a block as wide, and N that presses on its middle"""
DOWN = [0.0, 0.0, -1.0]


def deck(live: list[float], turn: float = 0.0, force: list[float] = DOWN) -> dict[str, Any]:
    """The slab, pushed sideways, all of it turned about z by an angle in degrees."""
    boxes = [("base", [0, 0, 0], [1, WIDTH, 0.5]), ("slab", [0.4, 0, 0.5], [0.4 + LENGTH, WIDTH, 0.5 + DEPTH])]
    rotated = [{"rotate": {"axis": [0, 0, 1], "angle": turn}}]
    press = {"force": [FORCE * each for each in force], "on": "slab"}
    return {
        "mbla": 1,
        "materials": {"stone": {"unit_weight": 1e-6}},
        "joints": {"dry": {"friction": 0.6}},
        "contacts": {"joint": "dry"},
        "blocks": [
            {"box": {"group": group, "material": "stone", "min": low, "max": high, "transform": rotated}}
            for group, low, high in boxes
        ],
        "supports": [{"blocks": "base"}],
        "load_cases": {"push": {"dead": [{"gravity": [0, 0, -9.81]}, press], "live": [{"acceleration": live}]}},
    }


def width(text: dict[str, Any]) -> FloatArray | None:
    found = line_of("\n" + json.dumps(text))
    return width_of(found.assembly.model, found.contacts, found.load_case)


def pressed(text: dict[str, Any]) -> Demand:
    """The slab under the force, on an even pressure."""
    found = line_of("\n" + json.dumps(text))
    forces = np.zeros((len(found.contacts.points), 3))
    forces[:, 0] = FORCE / len(forces)
    return demand_under(found.assembly, Acting(found.load_case, 0.0, forces))


@pytest.mark.parametrize("turn", [0.0, 33.0])
def test_across_the_plane_of_loads(turn: float) -> None:
    along, across = (np.array([np.cos(a), np.sin(a), 0.0]) for a in np.radians([turn, turn + 90.0]))
    found = width(deck(along.tolist(), turn))
    assert found is not None
    assert abs(found @ across) == pytest.approx(1.0)


def test_none_where_several_planes_have_everything_in_them() -> None:
    assert width(deck(DOWN)) is None


def test_none_where_a_force_turns_out_of_the_plane() -> None:
    aside = deck([1, 0, 0])
    aside["load_cases"]["push"]["dead"][1]["at"] = [0.5, 1.0, 0.5]
    assert width(aside) is None


@pytest.mark.parametrize("turn", [0.0, 33.0])
def test_a_planar_slab_bends_in_its_plane_and_a_spatial_one_along_its_length(turn: float) -> None:
    """An even pressure below and a force in the middle: P L / 8."""
    way = np.array([np.cos(np.radians(turn)), np.sin(np.radians(turn)), 0.0])
    planar, spatial = (
        pressed(deck((way + skew).tolist(), turn)) for skew in (np.zeros(3), np.array([0.01, 0.01, 0.0]))
    )
    assert planar.bending[1] == pytest.approx(FORCE * LENGTH / 8 / (WIDTH * DEPTH**2 / 6), rel=1e-4)
    assert spatial.bending[1] == pytest.approx(FORCE * WIDTH / 8 / (LENGTH * DEPTH**2 / 6), rel=1e-4)
