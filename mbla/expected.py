"""The deck's ``expected`` section against what was found."""

from __future__ import annotations

from mbla.deck.types import Expectation
from mbla.results.results import CaseResult


def compare_with_expected(case: CaseResult, expected: Expectation) -> list[str]:
    """What differs, one sentence each; nothing where the case is as expected."""
    name = case.load_case.name
    differences = []
    if expected.status is not None and case.status.value != expected.status:
        differences.append(f"{name}: status {case.status.value}, expected {expected.status} ({expected.source})")
    found = {
        "load_factor": case.solution.mechanics,
        "associative_load_factor": case.solution.associative,
    }
    for key, mechanics in found.items():
        wanted = getattr(expected, key)
        if wanted is None:
            continue
        if mechanics is None:
            differences.append(f"{name}: no {key}, expected {wanted:g} ({expected.source})")
        elif abs(mechanics.load_factor - wanted) > expected.tolerance * max(abs(wanted), 1e-12):
            differences.append(
                f"{name}: {key} {mechanics.load_factor:.10g}, expected {wanted:.10g} "
                f"within {expected.tolerance:g} ({expected.source})"
            )
    return differences
