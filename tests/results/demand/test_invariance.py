"""What forces ask of units is the same elsewhere, in other units, and with bodies the other way round."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.assembly.assembly import Assembly
from mbla.model.model import LoadCase
from mbla.results.demand.demand import Demand, demand_of
from tests.results.collapse.solved_state import State, moved, renumbered, scaled, states_of_deck, swapped

DECK = {
    "mbla": 1,
    "materials": {"stone": {"density": 2000}},
    "joints": {"dry": {"friction": 0.6}},
    "contacts": {"joint": "dry"},
    "blocks": [
        {"wall": {"group": "wall", "material": "stone", "unit": [0.4, 0.2, 0.15], "length": 1.2, "courses": 4}},
        {"arch": {"group": "arch", "material": "stone", "shape": "semicircular", "span": 2, "thickness": 0.2,
                  "width": 0.5, "voussoirs": 11, "transform": {"translate": [5, 0, 0]}}},
    ],
    "supports": [{"ground": {"z": 0}}],
    "load_cases": {"push": {"live": [{"acceleration": [1, 0.2, 0]}]}},
    "analysis": {"flow_rule": "associative"},
}  # fmt: skip


@pytest.fixture(scope="module")
def state() -> State:
    (found,) = states_of_deck(DECK)
    return replace(found, load_case=_without_words(found.load_case))


def _without_words(load_case: LoadCase) -> LoadCase:
    return replace(load_case, dead=(), live=())


def demand(state: State) -> Demand:
    return demand_of(Assembly(state.model, state.contacts), state.load_case, state.mechanics)


def same(one: Demand, other: Demand, factor: float = 1.0) -> None:
    for name in ("bending", "splitting", "pressure"):
        found, expected = getattr(one, name), factor * getattr(other, name)
        size = np.abs(expected[np.isfinite(expected)]).max(initial=0.0)
        assert found == pytest.approx(expected, rel=1e-5, abs=1e-6 * size, nan_ok=True), name


def test_elsewhere(state: State) -> None:
    turn, _ = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    same(demand(moved(state, turn, np.array([3.0, -2.0, 7.0]))), demand(state))


def test_in_other_units(state: State) -> None:
    same(demand(scaled(state, 1000.0, 0.001)), demand(state), 0.001 / 1000.0**2)


def test_with_bodies_the_other_way_round(state: State) -> None:
    chosen = np.arange(0, len(state.contacts), 2)
    same(demand(swapped(state, chosen)), demand(state))


def test_with_blocks_in_another_order(state: State) -> None:
    order = np.random.default_rng(2).permutation(len(state.model.blocks))
    found, before = demand(renumbered(state, order)), demand(state)
    same(found, Demand(*(getattr(before, name)[order] for name in ("bending", "splitting", "pressure", "crushing"))))
