"""Small random assemblies: the bounds of the program hold in exact rational arithmetic."""

from __future__ import annotations

import logging
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import islice

import pytest

from mbla.solution.solution import Mechanics
from tests.trust.certificates.assemblies import assembly, without_crushing
from tests.trust.certificates.exact_bounds import ExactBounds, bound_of, exact_bounds, within_limits
from tests.trust.certificates.rational import ExactCase, exact_case, rationals
from tests.trust.certificates.whole_line import NEAR_ZERO, WITHIN, each, with_results
from tests.trust.counts import record_counts

LOG = logging.getLogger(__name__)
FEW, SEEDS, WANTED = (9,), range(75), 50
ROUNDING = 1e-9
"""share of the load factor by which bounds in floats may miss those that are exact"""


@dataclass(frozen=True)
class Enclosed:
    """Bounds of a solved case in floats, by the program, and exact ones."""

    name: str
    static: float
    kinematic: float
    exact: ExactBounds


def small_case(seed: int) -> tuple[ExactCase, Mechanics, Enclosed] | None:
    """A small assembly; None where it has no load factor."""
    outcome, results = with_results(without_crushing(assembly(seed, small=True)))
    assert results is not None, outcome.told
    case = results.cases[0]
    if outcome.status != "solved":
        return None
    assert case.solution.mechanics is not None
    exact = exact_case(results.model, results.contacts, case.load_case)
    bounds = exact_bounds(exact, case.solution.mechanics)
    static, kinematic = outcome.recomputed["static_bound"], outcome.recomputed["kinematic_bound"]
    return exact, case.solution.mechanics, Enclosed(outcome.name, static, kinematic, bounds)


def enclosed(seed: int) -> Enclosed | None:
    """Its bounds alone."""
    found = small_case(seed)
    return None if found is None else found[2]


def broken_bounds(found: Enclosed) -> list[str]:
    """What the exact bounds refute or leave unproved."""
    static, kinematic = found.exact.static, found.exact.kinematic
    if static is None or kinematic is None:
        return [f"{found.name}: no exact bound {'below' if static is None else 'above'}"]
    size, faults = max(abs(kinematic), Fraction(NEAR_ZERO)), []
    if not 0 <= kinematic - static <= Fraction(WITHIN) * size:
        faults.append(f"exact bounds {float(static)} and {float(kinematic)} lie apart")
    room = Fraction(ROUNDING) * size
    if Fraction(found.static) > kinematic + room:
        faults.append(f"static bound {found.static} above the exact kinematic one {float(kinematic)}")
    if Fraction(found.kinematic) < static - room:
        faults.append(f"kinematic bound {found.kinematic} below the exact static one {float(static)}")
    return [f"{found.name}: {fault}" for fault in faults]


@pytest.mark.parametrize("seed", FEW)
def test_a_few_bounds_are_exact(seed: int) -> None:
    found = enclosed(seed)
    assert found is not None
    assert broken_bounds(found) == []


def test_wrong_bounds_are_refuted() -> None:
    small = small_case(0)
    assert small is not None
    exact, mechanics, found = small
    assert broken_bounds(found) == []
    assert len(broken_bounds(replace(found, static=found.static * (1 + 1e-6)))) == 1
    assert len(broken_bounds(replace(found, kinematic=found.kinematic * (1 - 1e-6)))) == 1
    heavier = replace(mechanics, load_factor=mechanics.load_factor * (1 + 1e-3))
    assert broken_bounds(replace(found, exact=exact_bounds(exact, heavier))) == [f"{found.name}: no exact bound below"]
    closing = rationals(-mechanics.mechanism[list(exact.free)].ravel())
    assert bound_of(exact, closing) is None
    forces = rationals(mechanics.contact_forces)
    assert not within_limits(exact, [-force for force in forces])


@pytest.mark.trust
def test_bounds_of_50_are_exact() -> None:
    solved = list(islice((found for found in each(enclosed, SEEDS) if found is not None), WANTED))
    for found in solved:
        LOG.info("%s: %s", found.name, found.exact)
    assert [fault for found in solved for fault in broken_bounds(found)] == []
    claim = (
        "The load factor of a small assembly lies between bounds proved in exact rational arithmetic from the floats "
        "of the result file, within 1e-5 of each other, and the bounds told by the program agree with them"
    )
    counts = {"small random assemblies that are solved, all enclosed": len(solved)}
    record_counts("exact_bounds", 12, claim, counts)
    assert len(solved) == WANTED
