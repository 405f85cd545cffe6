"""Load factors of a sample of the scenes under every transformation of the table, which has all of them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.properties.additions import split_in_two
from tests.properties.comparisons import Verdict, compare, relative
from tests.properties.metamorphic import README, checked, names, page, scene_named, unexplained
from tests.properties.relations import Relation, Transformation
from tests.properties.restatements import live_load_times, rotation
from tests.properties.rigid_motions import moved_scene
from tests.properties.scenes import Solved, solve_scene, value_of
from tests.properties.transformations import TABLE

pytestmark = pytest.mark.long

FEW = ("benchmarks/closed_forms/groove", "benchmarks/closed_forms/eccentric_compression", "random/302")
"""a wedge between two planes, a joint that crushes, and friction that locks resultants of interfaces"""
EVERY = 6
"""of the other scenes one of so many is taken"""


@pytest.mark.parametrize("name", FEW)
def test_a_few_scenes(name: str) -> None:
    _, found, _ = checked(name)
    assert len(found) > len(TABLE) / 2
    assert unexplained(found) == []


@pytest.mark.parametrize("name", [name for name in names() if name not in FEW][::EVERY])
def test_more_scenes(name: str) -> None:
    _, found, _ = checked(name)
    assert unexplained(found) == []


def groove() -> Solved:
    """Solved once for each test that asks."""
    return solve_scene(scene_named("benchmarks/closed_forms/groove"))


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


def test_reactions_that_do_not_turn_are_seen() -> None:
    scene, solved = scene_named("benchmarks/closed_forms/groove"), groove()
    rotate = next(row for row in TABLE if row.name == "rotate with gravity")
    wrong = replace(rotate, turn=lambda _: np.eye(3))
    assert compare(scene, solved, rotate)[0].verdict is Verdict.EQUAL
    assert "reactions differ" in compare(scene, solved, wrong)[0].words


def test_halves_make_the_whole_and_lean_on_glue() -> None:
    scene, solved = scene_named("benchmarks/closed_forms/groove"), groove()
    halved = split_in_two(scene, 0.35)
    assert halved is not None
    other = solve_scene(halved)
    assert len(other.model.blocks) == len(solved.model.blocks) + 1
    assert other.model.blocks.volumes.sum() == pytest.approx(solved.model.blocks.volumes.sum(), rel=1e-12)
    assert other.model.total_weight == pytest.approx(solved.model.total_weight, rel=1e-12)
    assert other.contacts.solid_of_block is not None
    assert len(np.unique(other.contacts.solid_of_block)) == len(solved.model.blocks)
    loose = solve_scene(replace(halved, deck=scene.deck))
    assert loose.contacts.solid_of_block is None


def test_a_structure_turned_without_its_loads_has_another_factor() -> None:
    scene, solved = scene_named("benchmarks/closed_forms/groove"), groove()
    turned = moved_scene(scene, rotation((0, 0, 1), 30.0), np.zeros(3))
    left = replace(turned, model=replace(turned.model, load_cases=scene.model.load_cases))
    assert value_of(solve_scene(left).cases[0]) != pytest.approx(value_of(solved.cases[0]), rel=1e-3)


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        (1.0, 1.0 + 1e-9, 1e-9),
        (0.0, 1e-12, 0.0),
        (math.inf, math.inf, 0.0),
        (1.0, math.inf, math.inf),
        (1.0, -math.inf, -math.inf),
    ],
)
def test_relative_differences(before: float, after: float, expected: float) -> None:
    assert relative(before, after) == pytest.approx(expected, rel=1e-6)


def test_the_page_has_every_transformation_and_no_exception_without_reason() -> None:
    text = README.read_text(encoding="utf-8")
    for row in TABLE:
        assert f"| {row.name} |" in text
        assert f"- **{row.name}**: {row.relation}; {row.reason}." in text
    assert text.startswith(page([]).splitlines()[0])
