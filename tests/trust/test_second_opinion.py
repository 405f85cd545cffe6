"""Random assemblies by the program, by linear programs assembled beside it, and by its other contact model."""

from __future__ import annotations

import json
import logging
import math
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.model import build_model
from mbla.results.results import CaseResult
from tests.properties.random_items import Tree
from tests.properties.scenes import Scene, Solved, solve_scene, value_of, with_analysis
from tests.trust.certificates.assemblies import assembly, at_points
from tests.trust.certificates.rational import exact_case
from tests.trust.certificates.whole_line import NEAR_ZERO, WITHIN, each
from tests.trust.counts import record_counts
from tests.trust.friction_polyhedra import Bracket, bracket_of

LOG = logging.getLogger(__name__)
FEW, MANY = (2, 12, 52), range(200)
FEW_BY_BOTH_MODELS = (4, 7)
"""a stack that does not twist, and cells that do"""
ROUNDING = 1e-6
"""share of the load factor to which the program and HiGHS are good"""


@dataclass(frozen=True)
class BesidePolyhedra:
    """Load factor by the program and the bracket of both linear programs.

    value : -inf without equilibrium, inf locked by friction, nan left open
    """

    name: str
    status: str
    value: float
    bracket: Bracket


@dataclass(frozen=True)
class BesideConvex:
    """Load factors of both contact models, as ``value``.

    twists, crushes : whether an interface of the convex model moves by torsion, or by crushing, in its mechanism
    """

    name: str
    concave: float
    convex: float
    twists: bool
    crushes: bool


def beside_polyhedra(seed: int) -> BesidePolyhedra:
    """An assembly by the program and by HiGHS, with joints that crush at points alone."""
    scene = _scene(at_points(assembly(seed)))
    solved = solve_scene(scene)
    case = solved.cases[0]
    bracket = bracket_of(exact_case(solved.model, solved.contacts, case.load_case))
    return BesidePolyhedra(scene.name, str(case.status), value_of(case), bracket)


def beside_convex(seed: int) -> BesideConvex:
    """An assembly by both contact models."""
    scene = _scene(assembly(seed))
    concave = solve_scene(scene)
    convex = solve_scene(with_analysis(scene, contact_model="convex"))
    twists, crushes = _interface_motions(convex)
    return BesideConvex(scene.name, value_of(concave.cases[0]), value_of(convex.cases[0]), twists, crushes)


def _scene(deck_tree: Tree) -> Scene:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "deck.yaml"
        path.write_text(json.dumps(deck_tree), encoding="utf-8")
        deck = read_deck(path)
        return Scene(str(deck_tree["title"]), deck, build_model(deck))


MOVES = 1e-6
"""motion of an interface, over the fastest contact, that is more than rounding"""


def _interface_motions(solved: Solved) -> tuple[bool, bool]:
    case: CaseResult = solved.cases[0]
    mechanics = case.solution.mechanics
    if mechanics is None or mechanics.interface_motions is None:
        return False, False
    lengths = np.sqrt(solved.contacts.areas)[:, None, None]
    motions = np.abs(mechanics.interface_motions) * np.concatenate(
        [np.ones((len(lengths), 1, 3)), lengths.repeat(3, axis=2)], axis=2
    )
    speed = float(np.linalg.norm(mechanics.contact_velocities, axis=1).max(initial=0.0))
    largest = motions.max(axis=(0, 2), initial=0.0) > MOVES * speed
    return bool(largest[0]), bool(largest[1])


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
