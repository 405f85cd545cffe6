"""Whether greater capacities help without dilatancy: the structure with every candidate at its greatest capacity.

By associative flow the program proves it; by another flow rule joints may give way whatever ties bear. There a load
factor need not rise with the capacities, so that the greatest ones settle nothing where they give less than smaller
ones do, nor where the path of joints was not followed to its end with them.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.collapse.ties import TieState, tie_rows
from mbla.results.listing.sections.mechanism_words import description_of
from mbla.results.listing.text import number
from mbla.results.outcome import least_known, result_of
from mbla.results.results import CaseResult, Results
from mbla.solution.further.strengthening.strengthening import Strengthening
from mbla.solution.solution import Status

UNLIMITED = 10.0
"""over all loads that have to be carried: capacity of a candidate that has no greatest one"""
CLEARLY = 0.01
"""share of a required load factor by which the greatest capacities fall short where no others are tried"""
MOST_TIES = 6
"""ties that are named"""


def greatest_capacities(question: Strengthening) -> FloatArray:
    """The greatest capacity of each candidate, (k,) N; where it has none, more than all loads together."""
    loads = 0.0
    for each in question.requirements:
        case, free = each.load_case, question.model.free
        whole = np.abs(case.dead_load[free, :3]) + abs(each.load_factor) * np.abs(case.live_load[free, :3])
        loads = max(loads, float(whole.sum()))
    return np.where(np.isfinite(question.most), question.most, UNLIMITED * loads)


GREATEST = (
    "greater capacities are not tried, as with all candidates at their greatest capacity, or at more than all loads "
    "where they have none"
)
RAISED = "capacities were raised as far as is tried: with those written"
"""first words of why they do not suffice"""


def settled_factors(results: Results, before: Mapping[str, float]) -> dict[str, float]:
    """Load factors with the greatest capacities, of the load cases in which these settle that greater ones do not help.

    before : by load case, with smaller capacities
    """
    found = {case.load_case.name: least_known(case) for case in results.cases if case.status is Status.SOLVED}
    return {name: factor for name, factor in found.items() if factor >= before[name] * (1.0 - CLEARLY)}


def shortfall(
    results: Results, required: Mapping[str, float], factors: Mapping[str, float], names: Sequence[str], why: str
) -> str:
    """Why capacities do not suffice, from an analysis with them; empty where they do, or that is not known.

    factors : found by load case; names : of the candidates, which are the last of the ties; why : first words
    """
    for case in results.cases:
        name = case.load_case.name
        found, wanted = factors.get(name, math.nan), required.get(name, 0.0)
        if found < wanted * (1.0 - CLEARLY):
            return _words(results, case, found, wanted, names, why)
    return ""


def _words(results: Results, case: CaseResult, found: float, wanted: float, names: Sequence[str], why: str) -> str:
    """Load factor, moving part, and ties that bear less than they could."""
    model = results.model.of_case(case.load_case)
    says = f"{why}, {case.load_case.name} carries {number(found)}, required {number(wanted)}"
    how = description_of(results.assembly, case)
    if how is not None and len(how.sentences) > 1:
        says += f". It fails so: {how.sentences[1].rstrip('.')}"
    rows = zip(names, tie_rows(model, result_of(case))[-len(names) :] if names else (), strict=True)
    below = [(name, row.force) for name, row in rows if row.state is not TieState.YIELDS]
    named = ", ".join(f"{name} ({number(force)} {model.units.force})" for name, force in below[:MOST_TIES])
    if below:
        more = f" and {len(below) - MOST_TIES} more" if len(below) > MOST_TIES else ""
        says += f". Below their capacity are {named}{more}: joints give way there: tie what moves"
    return says
