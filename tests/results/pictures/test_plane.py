"""Which cases are told in a plane figure, and from where."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.assembly.assembly import Assembly
from mbla.results.pictures.options import VIEWS, PictureOptions
from mbla.results.pictures.plane import Flat, face_polygons, flat_of, seen_edges
from mbla.results.pictures.scene import PictureScene, scene_of
from mbla.results.results import CaseResult, Results
from tests.results.synthetic import cuboids, tower_results


def scene(results: Results | None = None, case: CaseResult | None = None) -> PictureScene:
    results = results or tower_results()
    return scene_of(results, case or results.cases[0], PictureOptions(), "mechanism")


def flat(shown: PictureScene | None = None, view: tuple[float, float] | None = None) -> Flat:
    found = flat_of(shown or scene(), view)
    assert found is not None
    return found


def with_live_load(live: Any) -> PictureScene:
    """The tower under another load, nothing known of its mechanism."""
    results = tower_results()
    case = results.cases[0]
    solution = replace(case.solution, mechanics=None, associative=None)
    load_case = replace(case.load_case, live_load=np.asarray(live, float))
    return scene(results, replace(case, load_case=load_case, solution=solution))


def with_blocks(lower: Any, upper: Any) -> PictureScene:
    results = tower_results()
    return scene(
        replace(
            results,
            assembly=replace(results.assembly, model=replace(results.model, blocks=cuboids(lower, upper, "abc"))),
        )
    )


def test_tower_is_seen_from_the_front_or_from_behind() -> None:
    assert flat().towards == pytest.approx([0, -1, 0])
    assert flat().azimuth == pytest.approx(-90.0)
    assert len(flat().faces) == 3
    assert flat(view=VIEWS["back"]).towards == pytest.approx([0, 1, 0])


@pytest.mark.parametrize("view", ["left", "right", "top", "iso"])
def test_other_views_need_space(view: str) -> None:
    assert flat_of(scene(), VIEWS[view]) is None


@pytest.mark.parametrize(("block", "plane"), [([1.0, 0, 0, 0, 1, 0], True), ([1.0, 1, 0, 0, 0, 0], False)])
def test_load_across_needs_space_but_for_the_model(block: list[float], plane: bool) -> None:
    live = np.zeros((3, 6))
    live[1] = block
    shown = with_live_load(live)
    assert (flat_of(shown, None) is not None) == plane
    assert flat_of(shown, None, "model") is not None
    live[1, 5] = 1.0
    assert flat_of(with_live_load(live), None) is None


@pytest.mark.parametrize("left", [0.5, 0.0])
def test_blocks_behind_each_other_need_space(left: float) -> None:
    shown = with_blocks([[-1, -1, 0], [0, 0, 1], [left, 1, 1]], [[2, 2, 1], [1, 1, 3], [1 + left, 2, 3]])
    assert flat_of(shown, None) is None


def test_sloping_face_across_needs_space() -> None:
    results = tower_results()
    normals = results.model.blocks.face_normals.copy()
    normals[8] = [0, -0.8, 0.6]
    blocks = replace(results.model.blocks, face_normals=normals)
    assert (
        flat_of(
            scene(replace(results, assembly=replace(results.assembly, model=replace(results.model, blocks=blocks)))),
            None,
        )
        is None
    )


def test_a_turned_structure_is_seen_along_its_own_normal() -> None:
    """Turned by 30 degrees about the vertical with loads and mechanism."""
    turn = np.deg2rad(30)
    rotation = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]])

    def both(rows: Any) -> Any:
        return np.hstack([rows[:, :3] @ rotation.T, rows[:, 3:] @ rotation.T])

    results = tower_results()
    model, contacts, case = results.model, results.contacts, results.cases[0]
    blocks = replace(
        model.blocks,
        vertices=model.blocks.vertices @ rotation.T,
        face_normals=model.blocks.face_normals @ rotation.T,
        centroids=model.blocks.centroids @ rotation.T,
    )
    mechanics = case.solution.mechanics
    assert mechanics is not None
    turned = replace(
        results,
        assembly=Assembly(
            replace(model, blocks=blocks, grounds=model.grounds[:1]),
            replace(contacts, points=contacts.points @ rotation.T, centroids=contacts.centroids @ rotation.T),
        ),
    )
    loads = {"dead_load": both(case.load_case.dead_load), "live_load": both(case.load_case.live_load)}
    load_case = replace(case.load_case, **loads)
    solution = replace(case.solution, mechanics=replace(mechanics, mechanism=both(mechanics.mechanism)))
    assert flat(scene(turned, replace(case, load_case=load_case, solution=solution))).azimuth == pytest.approx(-60.0)


def test_outlines_and_edges() -> None:
    blocks = scene().model.blocks
    polygons = face_polygons(blocks, flat(), blocks.vertices[:, [0, 2]])
    assert sorted(polygons[1].tolist()) == [[0, 1], [0, 3], [1, 1], [1, 3]]
    assert len(seen_edges(blocks, flat())) == 3 * 4
