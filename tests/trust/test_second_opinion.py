"""Random assemblies by the program, and by linear programs assembled beside it."""

from __future__ import annotations

import json
import logging
import math
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

import pytest

from mbla.deck import read_deck
from mbla.model import build_model
from tests.properties.random_items import Tree
from tests.properties.scenes import Scene, solve_scene, value_of
from tests.trust.certificates.assemblies import assembly, crushes, without_crushing
from tests.trust.certificates.rational import exact_case
from tests.trust.certificates.whole_line import NEAR_ZERO, each
from tests.trust.counts import record_counts
from tests.trust.friction_polyhedra import Bracket, bracket_of

LOG = logging.getLogger(__name__)
FEW, CRUSHING, MANY = (2, 12, 52), (2, 12), range(200)
"""the second: with joints that crush"""
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


def beside_polyhedra(seed: int) -> BesidePolyhedra:
    """An assembly by the program and by HiGHS, with joints that do not crush."""
    return _opinion(without_crushing(assembly(seed)))


def above_stress_blocks(seed: int) -> BesidePolyhedra | None:
    """The same where joints crush, in the program as stress blocks, by HiGHS at points, which contain them; else None.

    Forces at points prove nothing for stress blocks.
    """
    deck = assembly(seed)
    if not crushes(deck):
        return None
    found = _opinion(deck)
    return replace(found, bracket=replace(found.bracket, inner=-math.inf, inner_stands=False))


def _opinion(deck_tree: Tree) -> BesidePolyhedra:
    scene = _scene(deck_tree)
    solved = solve_scene(scene)
    case = solved.cases[0]
    bracket = bracket_of(exact_case(solved.model, solved.contacts, case.load_case))
    return BesidePolyhedra(scene.name, str(case.status), value_of(case), bracket)


def _scene(deck_tree: Tree) -> Scene:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "deck.yaml"
        path.write_text(json.dumps(deck_tree), encoding="utf-8")
        deck = read_deck(path)
        return Scene(str(deck_tree["title"]), deck, build_model(deck))


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


@pytest.mark.parametrize("seed", CRUSHING)
def test_stress_blocks_bear_no_more_than_points(seed: int) -> None:
    found = above_stress_blocks(seed)
    assert found is not None
    assert broken_bracket(found) == []


def test_what_is_outside_is_found() -> None:
    found = BesidePolyhedra("wall", "solved", 0.5, Bracket(0.499, 0.501, True, True))
    assert broken_bracket(found) == []
    for value in (0.4989, 0.5011, math.inf, -math.inf):
        assert len(broken_bracket(replace(found, value=value))) == 1


@pytest.mark.trust
def test_200_brackets() -> None:
    opinions = []
    for found in each(beside_polyhedra, MANY):
        LOG.info("%s", found)
        opinions.append(found)
    crushing = [found for found in each(above_stress_blocks, MANY) if found is not None]
    assert [fault for found in (*opinions, *crushing) for fault in broken_bracket(found)] == []
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
