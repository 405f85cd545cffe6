from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.results.pictures.geometry import block_edges
from mbla.results.pictures.options import VIEWS, PictureOptions
from mbla.results.pictures.plane.flat import Flat, face_polygons, flat_of, joint_ends, seen_edges
from mbla.results.pictures.scene import Scene, scene_of
from mbla.results.results import CaseResult, Results
from tests.results.synthetic import cuboids, tower_results

USUAL = PictureOptions()


def scene(results: Results | None = None, case: CaseResult | None = None) -> Scene:
    results = results or tower_results()
    return scene_of(results, case or results.cases[0], USUAL, "mechanism")


def flat(shown: Scene | None = None, options: PictureOptions = USUAL) -> Flat:
    found = flat_of(shown or scene(), options)
    assert found is not None
    return found


def with_live_load(live: Any) -> Scene:
    """The tower under another load, nothing known of its mechanism."""
    results = tower_results()
    case = results.cases[0]
    solution = replace(case.solution, mechanics=None, associative=None)
    load_case = replace(case.load_case, live_load=np.asarray(live, float))
    return scene(results, replace(case, load_case=load_case, solution=solution))


def test_tower_is_seen_from_the_front() -> None:
    seen = flat()
    assert seen.towards == pytest.approx([0, -1, 0])
    assert seen.right == pytest.approx([1, 0, 0])
    assert len(seen.faces) == 3
    assert seen.project(np.array([[1.0, 2, 3]])) == pytest.approx(np.array([[1, 3]]))


def test_from_behind_left_is_right() -> None:
    seen = flat(options=replace(USUAL, view=VIEWS["back"]))
    assert seen.right == pytest.approx([-1, 0, 0])


@pytest.mark.parametrize("view", ["left", "right", "top", "iso"])
def test_other_views_need_space(view: str) -> None:
    assert flat_of(scene(), replace(USUAL, view=VIEWS[view])) is None


def test_load_across_needs_space_but_for_the_model() -> None:
    live = np.zeros((3, 6))
    live[1, :2] = 1.0
    shown = with_live_load(live)
    assert flat_of(shown, USUAL) is None
    assert flat_of(shown, USUAL, "model") is not None


def test_moment_in_the_plane() -> None:
    live = np.zeros((3, 6))
    live[1, 4] = 1.0
    assert flat_of(with_live_load(live), USUAL) is not None
    live[1, 5] = 1.0
    assert flat_of(with_live_load(live), USUAL) is None


def test_blocks_behind_each_other_need_space() -> None:
    results = tower_results()
    blocks = cuboids([[-1, -1, 0], [0, 0, 1], [0.5, 1, 1]], [[2, 2, 1], [1, 1, 3], [1.5, 2, 3]], "abc")
    behind = replace(results, model=replace(results.model, blocks=blocks))
    assert flat_of(scene(behind), USUAL) is None
    blocks = cuboids([[-1, -1, 0], [0, 0, 1], [0, 1, 1]], [[2, 2, 1], [1, 1, 3], [1, 2, 3]], "abc")
    assert flat_of(scene(replace(results, model=replace(results.model, blocks=blocks))), USUAL) is None


def test_sloping_face_across_needs_space() -> None:
    results = tower_results()
    normals = results.model.blocks.face_normals.copy()
    normals[8] = [0, -0.8, 0.6]
    blocks = replace(results.model.blocks, face_normals=normals)
    assert flat_of(scene(replace(results, model=replace(results.model, blocks=blocks))), USUAL) is None


def test_a_turned_structure_is_seen_along_its_own_normal() -> None:
    """Turned by 30 degrees about the vertical with loads and mechanism; the figure stays the same."""
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
        model=replace(model, blocks=blocks, grounds=model.grounds[:1]),
        contacts=replace(contacts, points=contacts.points @ rotation.T, centroids=contacts.centroids @ rotation.T),
    )
    load_case = replace(
        case.load_case, dead_load=both(case.load_case.dead_load), live_load=both(case.load_case.live_load)
    )
    solution = replace(case.solution, mechanics=replace(mechanics, mechanism=both(mechanics.mechanism)))
    shown = scene(turned, replace(case, load_case=load_case, solution=solution))
    polygons = face_polygons(blocks, flat(shown), blocks.vertices)
    straight = face_polygons(model.blocks, flat(), model.blocks.vertices)
    for mine, theirs in zip(polygons, straight, strict=True):
        assert sorted((mine.round(9) + 0.0).tolist()) == sorted((theirs.round(9) + 0.0).tolist())


def test_outlines_and_edges() -> None:
    blocks = scene().model.blocks
    polygons = face_polygons(blocks, flat(), blocks.vertices)
    assert sorted(polygons[1].tolist()) == [[0, 1], [0, 3], [1, 1], [1, 3]]
    assert len(seen_edges(blocks, flat(), block_edges(blocks))) == 3 * 4


def test_joints_end_at_their_farthest_points() -> None:
    shown = scene()
    ends = joint_ends(shown.contacts, flat())
    assert sorted(shown.contacts.points[ends[0], 0]) == [0, 1]
    assert sorted(shown.contacts.points[ends[1], 0]) == [4, 5]
