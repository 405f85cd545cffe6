"""The verification of a case as rows: every residual, what it may be at most, and whether it is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.results.listing.figure_words import residual_figures
from mbla.results.listing.text import number, small
from mbla.results.results import CaseResult
from mbla.solution.verification.verify_points import tolerances

PARTS = {"tension_violation": "part of the yield violation", "slip_residual": "part of the complementarity residual"}
"""figures that are judged with another one"""
PASSED, FAILED, NOT_JUDGED = "passed", "NOT PASSED", "not judged"


@dataclass(frozen=True)
class Check:
    """One residual with its tolerance; ``verdict`` is PASSED, FAILED or NOT_JUDGED."""

    name: str
    value: str
    measure: str
    tolerance: str
    verdict: str


def checks_of(case: CaseResult) -> list[Check]:
    """Rows of the residuals that there are; none where there are neither forces nor mechanism to check."""
    checks = case.checks
    allowed = tolerances(case.solution.flow_rule)
    rows = [
        _row(name, value, measure, name.replace(" ", "_"), allowed)
        for name, value, measure in residual_figures(checks)
        if not np.isnan(value)
    ]
    if not np.isnan(checks.live_power):
        deviation = abs(checks.live_power - 1.0)
        rows.append(_row("deviation of the live power", deviation, "from 1", "live_power", allowed))
    if not np.isnan(checks.gap):
        rows.append(_gap_row(case, allowed))
    return rows


def _row(name: str, value: float, measure: str, key: str, allowed: dict[str, float]) -> Check:
    if key not in allowed:
        return Check(name, small(value), measure, PARTS.get(key, "none"), NOT_JUDGED)
    verdict = PASSED if value <= allowed[key] else FAILED
    return Check(name, small(value), measure, number(allowed[key]), verdict)


def _gap_row(case: CaseResult, allowed: dict[str, float]) -> Check:
    """Distance of the bounds; of other flow rules it says how well the associative factor is known, nothing more."""
    name, measure = "gap of the bounds", "of the associative load factor"
    if case.solution.outer is not None:
        return Check(name, small(case.checks.gap), measure, "distance of the polyhedra, no error", NOT_JUDGED)
    if "gap" not in allowed:
        return Check(name, small(case.checks.gap), measure, "none by this flow rule", NOT_JUDGED)
    return _row(name, case.checks.gap, measure, "gap", allowed)
