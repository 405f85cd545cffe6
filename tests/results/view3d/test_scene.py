import base64
import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.assembly.assembly import Assembly
from mbla.model.solids.blocks import Blocks
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import HINGE
from mbla.results.pictures.scene import scene_of as picture_of
from mbla.results.results import Results
from mbla.results.view3d.scene import (
    MOST_NAMES,
    by_part,
    packed,
    scene_of,
)
from mbla.solution.solution import Status
from tests.results.no_contacts import without_contacts
from tests.results.pictures.rows_and_columns import row_of_blocks
from tests.results.synthetic import full_results, tower_results

KINDS = {"f4": "<f4", "i4": "<i4", "u1": "u1"}


def read(array: dict[str, str], columns: int = 1) -> Any:
    values = np.frombuffer(base64.b64decode(array["bdata"]), KINDS[array["dtype"]])
    return values.reshape(-1, columns) if columns > 1 else values


def scene(results: Results, case: int = 0) -> dict[str, Any]:
    found = scene_of(results, results.cases[case])
    json.dumps(found, allow_nan=False)
    return found


def marks(found: dict[str, Any]) -> dict[str, Any]:
    return {mark["name"]: mark for mark in found["marks"]}


def test_arrays_come_back_as_they_were() -> None:
    values = np.arange(6.0).reshape(2, 3)
    assert read(packed(values), 3).tolist() == values.tolist()
    assert read(packed(np.array([70000, -1]))).tolist() == [70000, -1]


def test_an_arrow_has_barbs_at_its_tip_and_its_text_stands_once() -> None:
    mark = marks(scene(tower_results()))["live load"]
    assert len(mark["texts"]) == 1
    assert read(mark["textRows"]).tolist() == 6 * [0]
    assert read(mark["pairs"], 2).tolist() == [[0, 1], [1, 2], [1, 3], [1, 4], [1, 5]]
    points = read(mark["points"], 3)
    np.testing.assert_allclose(points[2:].mean(axis=0), points[1] - 0.22 * (points[1] - points[0]), atol=1e-6)


def test_blocks_of_the_tower() -> None:
    found = scene(tower_results())
    assert read(found["vertices"], 3).shape == (24, 3)
    assert read(found["triangles"], 3).shape == (36, 3)
    assert np.bincount(read(found["blockOfTriangle"])).tolist() == [12, 12, 12]
    blocks = tower_results().model.blocks
    a, b, c = blocks.vertices[read(found["triangles"], 3)].transpose(1, 0, 2)
    outwards = np.cross(b - a, c - a) / np.linalg.norm(np.cross(b - a, c - a), axis=1, keepdims=True)
    assert {tuple(row) for row in outwards.round(9)} == {tuple(row) for row in blocks.face_normals.round(9)}
    assert read(found["edges"], 2).shape == (36, 2)
    assert found["texts"][1] == "tower[0]<br>weight 10 N<br>part 1"
    assert found["texts"][0].endswith("<br>fixed")
    assert found["texts"][2].endswith("<br>at rest")


def test_marks_of_the_tower() -> None:
    """What they are and where :mod:`tests.results.pictures.marks.test_marks` shows."""
    found = marks(scene(tower_results()))
    assert list(found) == ["opening", "crack", "hinge", "resultant", "at the edge of the joint", "live load"]
    assert found["hinge"]["colour"] == HINGE
    assert read(found["hinge"]["points"], 3)[:, [0, 2]].tolist() == [[1, 1], [1, 1]]
    assert found["hinge"]["texts"] == ["hinge: base[0] | tower[0]"]
    assert found["hinge"]["width"] > found["opening"]["width"]
    assert set(map(tuple, read(found["opening"]["bodies"], 2).tolist())) == {(0, 0), (1, 1)}
    assert found["resultant"]["inside"]
    assert "normal force 10 N, shear 5 N, eccentricity 1" in found["resultant"]["texts"][0]


def test_case_without_equilibrium_shows_what_falls() -> None:
    found = scene(tower_results(), 1)
    assert found["motionWords"] == "motion in which the dead load falls"
    assert list(marks(found)) == ["crack", "live load"]
    assert found["forceWords"] == ""
    assert [each["name"] for each in found["colourings"]] == ["part", "displacement", "group"]


def test_case_that_was_not_solved_is_at_rest() -> None:
    results = tower_results()
    nothing = replace(results.cases[1].solution, certificate=None, status=Status.NUMERICAL_ERROR)
    case = replace(results.cases[1], solution=nothing, status=Status.NUMERICAL_ERROR)
    found = scene(replace(results, cases=(case,)))
    assert found["motion"] is None
    assert [each["name"] for each in found["colourings"]] == ["group"]


@pytest.mark.parametrize(
    ("status", "words"),
    [(Status.APPROXIMATE, "APPROXIMATE"), (Status.NOT_VERIFIED, "NOT VERIFIED: no result"), (Status.SOLVED, "")],
)
def test_what_is_no_verified_result_says_so(status: Status, words: str) -> None:
    results = tower_results()
    found = scene(replace(results, cases=(replace(results.cases[0], status=status),)))
    for text in (found["motionWords"], found["forceWords"]):
        assert words in text
        assert words or "(" not in text


def test_locked_structure_shows_the_forces_that_lock_it() -> None:
    results = full_results()
    solution = replace(results.cases[0].solution, mechanics=None, certificate=None, status=Status.UNBOUNDED)
    case = replace(results.cases[0], solution=solution, status=Status.UNBOUNDED)
    found = scene(replace(results, cases=(case,)))
    assert found["forceWords"].startswith("contact forces that balance the live load alone")
    assert "resultant" in marks(found)


def moved(blocks: Blocks, shift: float) -> Blocks:
    return replace(
        blocks,
        vertices=blocks.vertices + shift,
        centroids=blocks.centroids + shift,
        added_mass_points=blocks.added_mass_points + shift,
    )


def test_far_from_the_origin_coordinates_keep_their_digits() -> None:
    """5,000 km away single precision would leave steps of half a metre."""
    results, shift = tower_results(), 5e6
    model = replace(results.model, blocks=moved(results.model.blocks, shift), grounds=())
    contacts = replace(
        results.contacts,
        points=results.contacts.points + shift,
        centroids=results.contacts.centroids + shift,
        bodies=np.array([[0, 1], [0, 2]]),
    )
    found = scene(replace(results, assembly=Assembly(model, contacts)))
    assert np.abs(np.array(found["offset"]) - shift).max() < 10
    vertices = read(found["vertices"], 3) + np.array(found["offset"])
    np.testing.assert_allclose(vertices, model.blocks.vertices, atol=1e-5)
    hinges = read(marks(found)["hinge"]["points"], 3) + np.array(found["offset"])
    np.testing.assert_allclose(hinges[:, 0], shift + 1, atol=1e-5)
    assert scene(results)["offset"] == [0, 0, 0]


def test_names_are_no_markup() -> None:
    results = tower_results()
    blocks = replace(results.model.blocks, groups=("base", "<b>&", "brick"))
    found = scene(replace(results, assembly=replace(results.assembly, model=replace(results.model, blocks=blocks))))
    assert found["texts"][1].startswith("&lt;b&gt;&amp;[0]<br>")
    assert "&lt;b&gt;&amp;[0]" in marks(found)["hinge"]["texts"][0]


def test_of_many_parts_the_first_are_named_and_the_others_counted() -> None:
    """Each of the blocks is a part; together with what rests there are more names than room."""
    results = row_of_blocks(MOST_NAMES + 4)
    shown = picture_of(results, results.cases[0], PictureOptions(), "mechanism")
    legend = by_part(shown, np.arange(1, MOST_NAMES + 5))["legend"]
    assert len(legend) == MOST_NAMES
    assert legend[-1][0].startswith("and ")
    assert legend[-1][0].endswith(" more")


def test_blocks_that_touch_nothing_have_no_marks() -> None:
    """What falls is shown all the same."""
    results = tower_results()
    apart = replace(results, assembly=replace(results.assembly, contacts=without_contacts(results.contacts)))
    found = scene_of(apart, apart.cases[1])
    assert list(marks(found)) == ["live load"]
    assert found["motion"] is not None
