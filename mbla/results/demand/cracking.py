"""Whether units would crack under the forces that are shown, and at which load factor the first of them does.

Between the forces of the standing structure under its dead load and those that are shown, in proportion to the load
factor, all are in balance, and within the joint laws, which are convex. Where both are known, units crack at the first
load factor at which forces between them ask for more than their strength.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.assembly.assembly import Assembly
from mbla.errors import Notice
from mbla.model.wording import named
from mbla.questions.figures import significant
from mbla.questions.load_factor import LoadFactor
from mbla.results.collapse.collapse import kept
from mbla.results.demand.actions import Acting
from mbla.results.demand.demand import Demand, demand_of, demand_under, strength_use
from mbla.results.results import CaseResult
from mbla.solution.solution import Standing, StandingResult

ROUNDING = 1e-3
"""excess over a strength that is none: joints that crush at it press by it"""
HALVINGS = 14
"""of the stretch between both states"""


@dataclass(frozen=True)
class Cracking:
    """Units whose strength is exceeded.

    blocks : (n,) the most exceeded first
    uses   : (n,) stress over strength
    factor : load factor at which the first would crack; nan where forces between both states are not known
    """

    blocks: IntArray
    uses: FloatArray
    factor: float


@kept
def cracking_of(assembly: Assembly, case: CaseResult) -> Cracking | None:
    """Of a case with forces; None where no unit cracks or no strength is given."""
    mechanics = case.solution.mechanics
    if mechanics is None or assembly.model.blocks.strengths is None:
        return None
    use = np.nan_to_num(strength_use(assembly, demand_of(assembly, case.load_case, mechanics)))
    over = np.flatnonzero(use > 1.0 + ROUNDING)
    over = over[np.argsort(-use[over], kind="stable")]
    return Cracking(over, use[over], _first_factor(assembly, case)) if len(over) else None


def _first_factor(assembly: Assembly, case: CaseResult) -> float:
    """By halving: demands between both states grow, or what is found is one of the factors at which a unit cracks."""
    mechanics, standing, load_case = case.solution.mechanics, case.solution.standing, case.load_case
    assert mechanics is not None  # the caller has forces
    dead = _dead_forces(assembly, standing)
    if dead is None or not isinstance(load_case.question, LoadFactor):
        return math.nan

    def cracks(share: float) -> bool:
        forces = dead + share * (mechanics.contact_forces - dead)
        found = demand_under(assembly, Acting(load_case, share * mechanics.load_factor, forces))
        return bool((np.nan_to_num(strength_use(assembly, found)) > 1.0 + ROUNDING).any())

    low, high = 0.0, 1.0
    if cracks(low):
        return 0.0
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (low, middle) if cracks(middle) else (middle, high)
    return high * mechanics.load_factor


def _dead_forces(assembly: Assembly, standing: StandingResult | None) -> FloatArray | None:
    """Contact forces under the dead load alone, (n_points, 3); None where they are not known, or ties act."""
    if standing is None or standing.verdict is not Standing.YES or standing.forces is None or len(assembly.model.ties):
        return None
    return standing.forces if len(standing.forces) == len(assembly.contacts.points) else None


def cracking_notices(assembly: Assembly, case: CaseResult) -> tuple[Notice, ...]:
    """A warning on units that may crack before the load factor is reached."""
    cracking = cracking_of(assembly, case)
    if cracking is None or case.solution.mechanics is None:
        return ()
    name, count = case.load_case.name, len(cracking.blocks)
    demand = demand_of(assembly, case.load_case, case.solution.mechanics)
    worst = int(cracking.blocks[0])
    which = named(cracking.blocks, assembly.model.blocks.name)
    units = "1 unit" if count == 1 else f"{count} units ({which})"
    text = f"{name}: {units} may crack before the structure moves: {_worst_words(assembly, demand, worst)}"
    text = f"{text}; {first_words(cracking)}"
    return (Notice("warning", "units-would-crack", text, name),)


def first_words(cracking: Cracking) -> str:
    """At which load factor the first unit would crack."""
    if math.isnan(cracking.factor):
        return "the load factor at which the first does is not known"
    if cracking.factor == 0.0:
        return "the first does under the dead load alone"
    return f"with forces in proportion to the load the first does at load factor {significant(cracking.factor, 4)}"


def _worst_words(assembly: Assembly, demand: Demand, block: int) -> str:
    """The stress of a block that is most beyond its strength."""
    blocks, unit = assembly.model.blocks, assembly.model.units.unit("stress")
    assert blocks.strengths is not None  # a strength is exceeded
    name, (tensile, compressive) = blocks.name(block), blocks.strengths[block]
    crushed = demand.crushing[block] / compressive if np.isfinite(compressive) else 0.0
    bent, split = demand.bending[block] / tensile, demand.splitting[block] / tensile
    if crushed > max(bent, split):
        pressed = f"joints press {name} by {stress_words(demand.crushing[block])} {unit}"
        return f"{pressed}, {stress_words(crushed)} times its compressive strength"
    use, stress, what = max((bent, demand.bending[block], "bending"), (split, demand.splitting[block], "splitting"))
    tension = f"{name} has a tension of {stress_words(stress)} {unit} by {what}"
    return f"{tension}, {stress_words(use)} times its tensile strength"


def stress_words(stress: float) -> str:
    """Three digits: what forces ask of units is known no better.

    >>> stress_words(15380.4), stress_words(0.012345)
    ('15400', '0.0123')
    """
    return f"{float(f'{stress:.3g}'):.12g}"
