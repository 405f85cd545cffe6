"""What a run must keep of what it claims, judged by what ``mbla verify`` found in the result file alone."""

from __future__ import annotations

import math

from tests.properties.random_items import Tree
from tests.trust.certificates.whole_line import Outcome

WITHIN = 1e-5
"""distance of static and kinematic bound, over the load factor, of what may be called solved"""
NEAR_ZERO = 1e-3
"""load factors below this are compared with it: next to zero nothing is relative"""
SETTLED = ("solved", "no_equilibrium", "unbounded")
RESIDUALS = ("equilibrium", "yield", "tension", "penetration", "complementarity", "slip")
SOLVED_RESIDUAL = 1e-4


def broken_claims(outcome: Outcome) -> list[str]:
    """What is claimed and not kept, a sentence each; nothing where all is."""
    if not outcome.claimed:
        return [f"{outcome.name}: refused: {outcome.told}"]
    claimed, recomputed = outcome.claimed, outcome.recomputed
    faults = []
    if outcome.code != outcome.verify_code or claimed["status"] != recomputed["status"]:
        faults.append(f"run says {claimed['status']}, verify {recomputed['status']}")
    if claimed["status"] in SETTLED and not recomputed["verified"]:
        faults.append(f"{claimed['status']} without verification: {recomputed['failures']}")
    if claimed["status"] not in ("solved", "approximate") and claimed["load_factor"] is not None:
        faults.append(f"a load factor with status {claimed['status']}")
    if claimed["status"] == "solved":
        if claimed["load_factor"] is None and claimed["standing"]["verdict"] == "yes":
            faults.append("solved without a load factor")
        faults_of = _associative_faults if claimed["flow_rule"] == "associative" else _other_faults
        faults += faults_of(recomputed)
    return [f"{outcome.name}: {fault}" for fault in faults]


def _associative_faults(case: Tree) -> list[str]:
    """The bounds enclose the load factor and lie within 1e-5 of each other."""
    static, kinematic, factor = case["static_bound"], case["kinematic_bound"], case["load_factor"]
    if None in (static, kinematic, factor):
        return [f"load factor {factor} with bounds {static}, {kinematic}"]
    room = WITHIN * max(abs(kinematic), NEAR_ZERO)
    if not abs(kinematic - static) <= room:
        return [f"bounds {static} and {kinematic} lie apart"]
    if not static - room <= factor <= kinematic + room:
        return [f"load factor {factor} is not between {static} and {kinematic}"]
    return []


def _other_faults(case: Tree) -> list[str]:
    """Residuals are there and small, and the load factor is at or below the associative one.

    Where the associative load factor has no bound, nothing can be above it.
    """
    faults = []
    residuals = [case["residuals"][name] for name in RESIDUALS]
    if any(value is None or not math.isfinite(value) or value > SOLVED_RESIDUAL for value in residuals):
        faults.append(f"residuals {case['residuals']}")
    factor, bound = case["load_factor"], case["kinematic_bound"]
    if factor is not None and bound is not None:
        allowed = SOLVED_RESIDUAL * max(abs(bound), NEAR_ZERO)
        if factor > bound + allowed:
            faults.append(f"load factor {factor} above the bound {bound} of associative flow")
    return faults
