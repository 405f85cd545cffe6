"""Metamorphic checks: what is stated in another way has the same load factor, more forces never lower it.

Every transformation of the table on small decks under ``decks/`` and on random ones: a sample of them are long tests,
``pytest -m trust tests/properties`` tries the rest. An exception that theory explains stands in ``EXPLAINED``.
"""

from __future__ import annotations

from collections.abc import Iterable

import pytest

from mbla.errors import DeckError
from tests.decks.folder import LONG, PATHS, name_of
from tests.properties.comparisons import (
    Comparison,
    Relation,
    Transformation,
    Verdict,
    compare,
    without_normality,
)
from tests.properties.restatements import live_load_times
from tests.properties.scenes import Scene, Solved, random_scene, scene_of, solve_scene
from tests.properties.transformations import TABLE

FEW = ("benchmarks/closed_forms/groove", "benchmarks/closed_forms/eccentric_compression", "random/302")
"""a wedge between two planes, a joint that crushes, and friction that locks resultants of interfaces"""
EVERY = 10
"""of the other scenes one of so many is taken"""
SURFACE = "benchmarks/formats/arch_on_faces_of_another_file"
"""stands on surfaces that end, which move with it"""
MOST_POINTS = 700
"""contact points of a deck that is tried: some twenty analyses of each take seconds"""
MOST_POINTS_WITHOUT_NORMALITY = 260
SEEDS = range(300, 320)

ALIKE = ("benchmarks/formats/arch_from_", "benchmarks/published/cocchetti_rizzi_mu_3")
"""beginnings of names of decks that are one structure many times: the last of each stands for all"""

EXPLAINED: dict[tuple[str, str], str] = {
    ("random/312", "rotate with gravity"): "without normality: no scheme is sure to find a state, and this one says so",
    (
        "regressions/light_block_pushed",
        "refine contact points, no strengths",
    ): "without normality: forces of many times the weights balance to 1.2e-5 of one, not to 1e-5, and the run says so",
}
"""Exceptions by (scene, transformation) and why theory admits them."""


def names() -> list[str]:
    """Every scene that could be tried: decks by name, random ones as ``random/SEED``."""
    decks = [name_of(path) for path in PATHS if name_of(path) not in LONG]
    for beginning in ALIKE:
        same = [name for name in decks if name.startswith(beginning)]
        decks = [name for name in decks if name not in same[:-1]]
    return [*decks, *(f"random/{seed}" for seed in SEEDS)]


def scene_named(name: str) -> Scene:
    """The scene of that name."""
    folder, _, stem = name.partition("/")
    if folder == "random":
        return random_scene(int(stem))
    return scene_of(next(path for path in PATHS if name_of(path) == name))


def checked(name: str) -> list[Comparison]:
    """All comparisons of a scene, by associative flow and without normality."""
    try:
        scene = scene_named(name)
        points = len(scene.assembly().contacts.points)
    except DeckError:  # of random decks some say what is refused
        return []
    found: list[Comparison] = []
    if points <= MOST_POINTS:
        solved = solve_scene(scene)
        found += [one for row in TABLE for one in compare(scene, solved, row)]
    if points <= MOST_POINTS_WITHOUT_NORMALITY and scene.deck.analysis.contact_model == "concave":
        other = without_normality(scene)
        solved = solve_scene(other)
        found += [one for row in TABLE if row.any_flow for one in compare(other, solved, row)]
    return found


def unexplained(found: Iterable[Comparison]) -> list[Comparison]:
    """Exceptions without a reason."""
    return [
        one for one in found if one.verdict is Verdict.EXCEPTION and (one.scene, one.transformation) not in EXPLAINED
    ]


OTHERS = [name for name in names() if name not in FEW]


@pytest.mark.long
@pytest.mark.parametrize("name", [*FEW, SURFACE])
def test_a_few_scenes(name: str) -> None:
    found = checked(name)
    assert len(found) > len(TABLE) / 2
    assert unexplained(found) == []


@pytest.mark.parametrize(
    "name",
    [
        *(pytest.param(name, marks=pytest.mark.long) for name in OTHERS[::EVERY]),
        *(pytest.param(name, marks=pytest.mark.trust) for name in OTHERS if name not in OTHERS[::EVERY]),
    ],
)
def test_more_scenes(name: str) -> None:
    assert unexplained(checked(name)) == []


def groove() -> Solved:
    """Solved once for each test that asks."""
    return solve_scene(scene_named("benchmarks/closed_forms/groove"))


@pytest.mark.long
def test_what_moves_against_its_relation_is_an_exception() -> None:
    scene, solved = scene_named("benchmarks/closed_forms/groove"), groove()
    stronger = live_load_times(8.0)  # lowers the factor
    verdicts = {
        relation: compare(scene, solved, Transformation("stronger live load", relation, "", stronger))[0].verdict
        for relation in (Relation.EQUAL, Relation.RISES, Relation.FALLS)
    }
    assert verdicts == {
        Relation.EQUAL: Verdict.EXCEPTION,
        Relation.RISES: Verdict.EXCEPTION,
        Relation.FALLS: Verdict.MOVED,
    }
