"""Random assemblies by the program, by linear programs assembled beside it, and by its other contact model."""

from __future__ import annotations

import logging
import math
from dataclasses import replace
from statistics import median

import pytest

from tests.trust.certificates.claims import NEAR_ZERO, WITHIN
from tests.trust.certificates.whole_line import each
from tests.trust.counts import record_counts
from tests.trust.second_opinion.friction_polyhedra import Bracket
from tests.trust.second_opinion.opinions import BesideConvex, BesidePolyhedra, beside_convex, beside_polyhedra

LOG = logging.getLogger(__name__)
FEW, MANY = (2, 12, 52), range(200)
FEW_BY_BOTH_MODELS = (4, 7)
"""a stack that does not twist, and cells that do"""
ROUNDING = 1e-6
"""share of the load factor to which the program and HiGHS are good"""


def broken_bracket(found: BesidePolyhedra) -> list[str]:
    """What the linear programs contradict; what either side leaves open contradicts nothing."""
    inner, outer = found.bracket.inner, found.bracket.outer
    fault = f"{found.name}: {found.status} {found.value}, linear programs {inner} and {outer}"
    below = math.isfinite(found.value) and found.value < inner - _room(inner)
    above = math.isfinite(found.value) and found.value > outer + _room(outer)
    wrongly_none = found.value == -math.inf and found.bracket.inner_stands
    wrongly_some = found.value > -math.inf and not found.bracket.outer_stands
    wrongly_locked = found.value == math.inf and outer < math.inf
    return [fault] if below or above or wrongly_none or wrongly_some or wrongly_locked else []


def broken_models(found: BesideConvex) -> list[str]:
    """The convex model adds conditions: it carries no more, and as much where no interface twists or crushes."""
    room = WITHIN * max(abs(found.concave), NEAR_ZERO) if math.isfinite(found.concave) else 0.0
    above = found.convex > found.concave + room
    unexplained = differ(found) and not (found.twists or found.crushes)
    return [f"{found}"] if above or unexplained else []


def differ(found: BesideConvex) -> bool:
    """Whether both models have a load factor, and not the same one."""
    both = math.isfinite(found.concave) and math.isfinite(found.convex)
    return both and abs(found.concave - found.convex) > 2 * WITHIN * max(abs(found.concave), NEAR_ZERO)


def decided(bracket: Bracket) -> bool:
    """Whether both linear programs have a load factor."""
    return math.isfinite(bracket.inner) and math.isfinite(bracket.outer)


def _room(value: float) -> float:
    return ROUNDING * max(abs(value), NEAR_ZERO) if math.isfinite(value) else 0.0


@pytest.mark.parametrize("seed", FEW)
def test_a_few_brackets(seed: int) -> None:
    found = beside_polyhedra(seed)
    assert broken_bracket(found) == []
    stands = found.value > -math.inf
    assert (found.bracket.inner_stands, found.bracket.outer_stands) == (stands, stands)


@pytest.mark.parametrize("seed", FEW_BY_BOTH_MODELS)
def test_a_few_by_both_contact_models(seed: int) -> None:
    assert broken_models(beside_convex(seed)) == []


def test_what_is_outside_is_found() -> None:
    found = BesidePolyhedra("wall", "solved", 0.5, Bracket(0.499, 0.501, True, True))
    assert broken_bracket(found) == []
    for value in (0.4989, 0.5011, math.inf, -math.inf):
        assert len(broken_bracket(replace(found, value=value))) == 1
    both = BesideConvex("wall", 0.5, 0.49, twists=True, crushes=False)
    assert broken_models(both) == []
    assert len(broken_models(replace(both, twists=False))) == 1
    assert len(broken_models(replace(both, convex=0.501))) == 1


@pytest.mark.trust
def test_200_brackets() -> None:
    opinions = []
    for found in each(beside_polyhedra, MANY):
        LOG.info("%s", found)
        opinions.append(found)
    assert [fault for found in opinions for fault in broken_bracket(found)] == []
    enclosed = [found for found in opinions if math.isfinite(found.value) and decided(found.bracket)]
    standing = sum(found.bracket.outer_stands for found in enclosed)
    widths = [(found.bracket.outer - found.bracket.inner) / max(abs(found.value), NEAR_ZERO) for found in enclosed]
    none = sum(found.value == -math.inf and not found.bracket.outer_stands for found in opinions)
    locked = sum(found.value == math.inf and found.bracket.outer == math.inf for found in opinions)
    claim = (
        "Linear programs with friction polygons inside and around the circle, assembled beside the program and solved "
        "by HiGHS, enclose the load factor"
    )
    counts = {
        "random assemblies": len(opinions),
        "load factors, all enclosed": len(enclosed),
        "bracket narrower than 1 % of the load factor": sum(width < 1e-2 for width in widths),
        "of these, dead load alone not excluded by HiGHS": standing,
        "dead load alone not carried, by both": none,
        "locked by friction, by both": locked,
        "left open by one of the two": len(opinions) - len(enclosed) - none - locked,
    }
    record_counts("second_opinion", 20, claim, counts)
    assert median(widths) < 0.05


@pytest.mark.trust
def test_200_by_both_contact_models() -> None:
    opinions = []
    for found in each(beside_convex, MANY):
        LOG.info("%s", found)
        opinions.append(found)
    assert [fault for found in opinions for fault in broken_models(found)] == []
    record_models(opinions)


def record_models(opinions: list[BesideConvex]) -> None:
    """The counts of both contact models."""
    apart = [found for found in opinions if differ(found)]
    both = [found for found in opinions if math.isfinite(found.concave) and math.isfinite(found.convex)]
    claim = (
        "Interface resultants carry no more than contact points at the corners; where they carry less, an interface "
        "twists or crushes in the mechanism, whose strength the corners overstate"
    )
    counts = {
        "random assemblies": len(opinions),
        "load factors by both contact models": len(both),
        "the same within 2e-5": len(both) - len(apart),
        "less, interfaces twist": sum(found.twists and not found.crushes for found in apart),
        "less, interfaces crush": sum(found.crushes and not found.twists for found in apart),
        "less, interfaces twist and crush": sum(found.crushes and found.twists for found in apart),
        "no load factor by either": sum(
            found.concave == found.convex and not math.isfinite(found.convex) for found in opinions
        ),
        "dead load not carried by interface resultants alone": sum(
            found.convex == -math.inf < found.concave for found in opinions
        ),
        "left open with interface resultants": sum(math.isnan(found.convex) for found in opinions),
    }
    record_counts("contact_models", 21, claim, counts)
