"""What is run on each structure of the standard set, so that the page takes three quarters of an hour.

Times of an idle machine with two cores, one thread: small members take a tenth of a second to some seconds a setting
and get every setting that tells something; vaults take up to a minute, walls of 40 x 40 as long, walls of 60 x 60 in
space and the house minutes. Large members get the presets, from rough to sharp, and those after one that was stopped
are not tried.
"""

from __future__ import annotations

from dataclasses import dataclass

from mbla.deck import read_deck
from mbla.sweeps.tradeoff.ladder import usual_ladder
from mbla.sweeps.tradeoff.rung import Rung
from tests.performance.standard_set import Structure

PRESETS = ("accuracy: draft", "accuracy: standard", "accuracy: reference")
"""from rough to sharp"""
LEFT_OUT = (
    "the deck's own settings",
    "tolerance: 1e-4",
    "tolerance: 1e-10",
    "polyhedron: 32 sides",
    "points per edge: 3",
)
"""rungs of the usual ladder that tell nothing more here"""


@dataclass(frozen=True)
class Plan:
    """What is run.

    settings : beginnings of the names of rungs of the usual ladder
    limit    : seconds after which each of them is stopped
    in_turn  : the presets alone, from rough to sharp, none after one that was stopped
    """

    settings: tuple[str, ...]
    limit: float
    in_turn: bool = False


SMALL = Plan(("",), 20.0)
VAULTS = Plan(("accuracy: ", "form: ", "solver: ", "polyhedron: 8 ", "contact_model: "), 60.0)
MIDDLE = Plan(("accuracy: ", "form: ", "solver: "), 100.0)
PRESETS_ALONE = Plan(("accuracy: ",), 100.0, in_turn=True)
LARGE = Plan(("accuracy: ",), 150.0, in_turn=True)
LARGEST = Plan(("accuracy: ",), 400.0, in_turn=True)
PLANS = {
    "60 x 60": (LARGE, LARGEST),
    "house": (LARGE, LARGE),
    "40 x 40": (MIDDLE, PRESETS_ALONE),
    "500 voussoirs": (MIDDLE, PRESETS_ALONE),
    "200 voussoirs": (MIDDLE, PRESETS_ALONE),
    "dome": (VAULTS, PRESETS_ALONE),
    "cross vault": (VAULTS, PRESETS_ALONE),
}
"""by what the name of the structure has in it: with associative flow, and without dilatancy"""


def plan_of(structure: Structure, rule: str) -> Plan:
    """The plan of one structure under one flow rule."""
    for part, plans in PLANS.items():
        if part in structure.name:
            return plans[rule != "associative"]
    return SMALL


def rungs_for(structure: Structure, rule: str) -> list[Rung]:
    """The rungs of the usual ladder that the plan names; the presets from rough to sharp where they go in turn."""
    fixed, plan = overrides_of(structure, rule), plan_of(structure, rule)
    ladder = usual_ladder(read_deck(structure.deck, fixed), fixed)
    rungs = [rung for rung in ladder if rung.name.startswith(plan.settings) and rung.name not in LEFT_OUT]
    rungs = [rung for rung in rungs if not rung.unfit and rung.name != f"flow_rule: {rule}"]
    return sorted(rungs, key=lambda rung: PRESETS.index(rung.name)) if plan.in_turn else rungs


def overrides_of(structure: Structure, rule: str) -> tuple[str, ...]:
    """What makes the deck the structure of the set."""
    return (*structure.overrides, f"analysis.flow_rule={rule}")
