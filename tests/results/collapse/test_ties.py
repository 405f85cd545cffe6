"""What ties do at collapse, and what is said of those that are brittle."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.assembly.assembly import Assembly
from mbla.contacts import find_contacts
from mbla.results.collapse.collapse import collapse_of
from mbla.results.collapse.mechanics import reactions_of
from mbla.results.collapse.ties import TieState, tie_rows
from mbla.results.findings import found_notices
from mbla.results.listing.sections.tie_words import tie_force_blocks
from mbla.results.listing.text import lines_of
from tests.analytic.test_ties import SLENDER, WEIGHT
from tests.line import case_of, line_of
from tests.model.fill.test_restraint import DECK as WEDGE

SECOND = "  - {through: [[0, 0.5, 0.8], [-3, 0.5, 0.8]], capacity: 100, on: [block, ground]}\n"
TWO = SLENDER.replace('capacity: "=T"', 'capacity: "=T", breaks_at: 0') + SECOND


def test_a_tie_that_yields_has_all_of_its_force_and_supports_take_it() -> None:
    model, case = case_of(SLENDER)
    mechanics = case.solution.mechanics
    assert mechanics is not None
    (row,) = tie_rows(model, mechanics)
    assert (row.state, row.from_body, row.to_body, row.length) == (TieState.YIELDS, "block[0]", "outside", 3.0)
    assert (row.force, row.use) == pytest.approx((3000.0, 1.0))
    # the power of the loads goes into the tie: (lambda W 1 - W b/2) per unit rotation, live power 1
    assert row.power == pytest.approx(3000 * 1.6 / (WEIGHT * 1.0), rel=1e-6)


def test_brittle_ties_that_yield_with_others_are_told() -> None:
    _, case = case_of(TWO)
    assert "brittle-ties" in {notice.identifier for notice in found_notices(case)}
    _, alone = case_of(SLENDER.replace('capacity: "=T"', 'capacity: "=T", breaks_at: 0'))
    assert "brittle-ties" not in {notice.identifier for notice in found_notices(alone)}


@pytest.mark.parametrize(("case", "state", "count"), [(0, TieState.PASSIVE, (1, 0)), (1, TieState.ACTIVE, (0, 1))])
def test_fill_is_at_a_limit_and_no_tie(case: int, state: TieState, count: tuple[int, int]) -> None:
    """The wedge into the soil and away from it; what holds it is not among the ties that yield or are slack."""
    model, result = case_of(WEDGE.format(cohesion=0.0), "analysis.accuracy=standard", case=case)
    mechanics = result.solution.mechanics
    assert mechanics is not None
    (row,) = tie_rows(model, mechanics)
    assert row.state is state
    contacts = find_contacts(model, line_of(WEDGE.format(cohesion=0.0)).deck.contacts)
    collapse = collapse_of(Assembly(model, contacts), result.load_case, mechanics)
    assert (collapse.yielding, collapse.soil) == (0, count)
    (soil,) = (
        each for each in reactions_of(model, contacts, result.load_case, mechanics) if each.support == "fill on faces"
    )
    assert soil.wrench[0] == pytest.approx(row.force, rel=1e-9)
    words = " ".join(" ".join(lines_of(tie_force_blocks(model, mechanics))).split())
    assert f"passive limit on {count[0]} of 1 face, at its active limit on {count[1]}" in words
    assert " tie" not in words


def test_reactions_with_those_of_ties_balance_the_loads() -> None:
    line = line_of(SLENDER)
    model, case = case_of(SLENDER)
    assert case.solution.mechanics is not None
    contacts = find_contacts(model, line.deck.contacts)
    found = {
        each.support: each.wrench for each in reactions_of(model, contacts, case.load_case, case.solution.mechanics)
    }
    assert found["ties to supports"][:3] == pytest.approx([-3000.0, 0, 0])
    total = np.sum(list(found.values()), axis=0)[:3]
    loads = case.load_case.dead_load[0, :3] + case.solution.mechanics.load_factor * case.load_case.live_load[0, :3]
    assert total == pytest.approx(-loads, abs=1e-6 * WEIGHT)
