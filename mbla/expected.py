"""The deck's ``expected`` section against what was found."""

from __future__ import annotations

import math

from mbla.deck.types import Expectation
from mbla.results.outcome import associative_of, result_of
from mbla.results.results import CaseResult
from mbla.results.settlement_words import reaction_of
from mbla.solution.solution import Mechanics


def compare_with_expected(case: CaseResult, expected: Expectation) -> list[str]:
    """What differs, one sentence each; nothing where the case is as expected."""
    name = case.load_case.name
    differences = []
    if expected.status is not None and case.status.value != expected.status:
        differences.append(f"{name}: status {case.status.value}, expected {expected.status} ({expected.source})")
    found = {
        "load_factor": _factor(result_of(case)),
        "associative_load_factor": _factor(associative_of(case)),
        "reaction": reaction_of(case),
        "lower": None if math.isnan(case.checks.lower) else case.checks.lower,
    }
    for key, value in found.items():
        wanted = getattr(expected, key)
        if wanted is None:
            continue
        if value is None:
            differences.append(f"{name}: no {key}, expected {wanted:g} ({expected.source})")
        elif abs(value - wanted) > expected.tolerance * max(abs(wanted), _least(key, case)):
            differences.append(
                f"{name}: {key} {value:.10g}, expected {wanted:.10g} within {expected.tolerance:g} ({expected.source})"
            )
    return differences


def _factor(mechanics: Mechanics | None) -> float | None:
    return None if mechanics is None else mechanics.load_factor


ZERO_REACTION = 1e-3
"""share of the weight of the free blocks below which a reaction is compared as if it were that share"""


def _least(key: str, case: CaseResult) -> float:
    """Size below which a figure counts as zero in the comparison."""
    settlement = case.load_case.settlement
    return ZERO_REACTION * settlement.unit if key == "reaction" and settlement is not None else 1e-12
