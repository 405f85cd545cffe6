"""Random assemblies through run, result file and verify: what is called solved is proved by the file alone."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Callable
from dataclasses import replace

import pytest

from tests.trust.certificates.assemblies import assembly
from tests.trust.certificates.whole_line import SETTLED, Outcome, broken_claims, each, outcome_of
from tests.trust.counts import record_counts

LOG = logging.getLogger(__name__)
OF_ASSOCIATIVE = (
    "An associative load factor that is called solved lies between bounds within 1e-5 of each other, which mbla verify "
    "recomputes from the result file alone"
)
OTHERS = (
    "A load factor without dilatancy that is called solved carries its residuals, all below 1e-4, and lies at or below "
    "the kinematic bound of the associative one"
)
STACK = 4
FEW = (5, 12, 52)
"""cells of a box, some that do not stand, and a wall that friction locks"""
MANY, WITHOUT_DILATANCY = range(1000), range(100)
NON_ASSOCIATIVE = ("--flow-rule", "non_associative")


def associative(seed: int) -> Outcome:
    return outcome_of(assembly(seed))


def without_dilatancy(seed: int) -> Outcome:
    return outcome_of(assembly(seed), *NON_ASSOCIATIVE)


@pytest.fixture(scope="module")
def stack() -> tuple[Outcome, Outcome]:
    """A stack with and without dilatancy."""
    return associative(STACK), without_dilatancy(STACK)


@pytest.mark.long
@pytest.mark.parametrize("seed", FEW)
def test_what_is_settled_is_proved(seed: int) -> None:
    outcome = associative(seed)
    assert broken_claims(outcome) == []
    assert outcome.status in SETTLED


def test_without_dilatancy_it_is_no_more_than_with_it(stack: tuple[Outcome, Outcome]) -> None:
    assert [outcome.status for outcome in stack] == ["solved", "solved"]
    assert [fault for outcome in stack for fault in broken_claims(outcome)] == []


def test_what_is_not_kept_is_found(stack: tuple[Outcome, Outcome]) -> None:
    outcome, other = stack
    apart = outcome.recomputed["kinematic_bound"] * (1.0 + 3e-5)
    for key, value in (("kinematic_bound", apart), ("verified", False), ("status", "approximate")):
        worse = replace(outcome, recomputed=outcome.recomputed | {key: value})
        assert len(broken_claims(worse)) == 1, key
    too_high = other.recomputed | {"load_factor": 1.001 * other.recomputed["kinematic_bound"]}
    assert len(broken_claims(replace(other, recomputed=too_high))) == 1


@pytest.mark.trust
def test_all_certificates() -> None:
    outcomes, statuses = _all(associative, MANY)
    counts = {
        "random assemblies": len(outcomes),
        "solved, all with both bounds": statuses["solved"],
        "without equilibrium, proved by a motion": statuses["no_equilibrium"],
        "locked by friction, proved by forces": statuses["unbounded"],
        "said to be left open": len(outcomes) - sum(statuses[status] for status in SETTLED),
    }
    record_counts("certificates", 10, OF_ASSOCIATIVE, counts)


@pytest.mark.trust
def test_all_without_dilatancy() -> None:
    outcomes, statuses = _all(without_dilatancy, WITHOUT_DILATANCY)
    counts = {
        "random assemblies": len(outcomes),
        "solved": statuses["solved"],
        "without equilibrium, or locked by friction, proved": statuses["no_equilibrium"] + statuses["unbounded"],
        "said to be left open": len(outcomes) - sum(statuses[status] for status in SETTLED),
    }
    record_counts("without_dilatancy", 11, OTHERS, counts)


def _all(solve: Callable[[int], Outcome], seeds: range) -> tuple[list[Outcome], Counter[str]]:
    """What became of all seeds, none of which breaks a claim, and how many there are of each status."""
    outcomes = []
    for outcome in each(solve, seeds):
        LOG.info("%s: %s %s", outcome.name, outcome.status, outcome.claimed.get("reason") or "")
        outcomes.append(outcome)
    assert [fault for outcome in outcomes for fault in broken_claims(outcome)] == []
    return outcomes, Counter(outcome.status for outcome in outcomes)
