import base64
import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.model.model import LoadCase, Settlement
from mbla.model.solids.blocks import Blocks
from mbla.results.results import Results
from mbla.results.view3d.marks import BESIDE, HINGE, load_arrow
from mbla.results.view3d.scene import eye_of, light_from, packed, scene_of, shades
from mbla.results.view3d.surface import MOST_NAMES, by_part
from mbla.solution.solution import Status
from tests.results.no_contacts import without_contacts
from tests.results.pictures.rows_and_columns import row_of_blocks
from tests.results.synthetic import cuboids, full_results, tower_model, tower_results

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


def test_texts_of_marks_stand_once() -> None:
    """Start, tip and barbs of a resultant say the same."""
    mark = marks(scene(tower_results()))["resultants"]
    assert len(mark["texts"]) == 2
    assert read(mark["textRows"]).tolist() == 6 * [0] + 6 * [1]


def test_blocks_of_the_tower() -> None:
    found = scene(tower_results())
    assert read(found["vertices"], 3).shape == (24, 3)
    assert read(found["triangles"], 3).shape == (36, 3)
    assert np.bincount(read(found["blockOfTriangle"])).tolist() == [12, 12, 12]
    assert read(found["edges"], 2).shape == (36, 2)
    assert found["texts"][1] == "tower[0]<br>weight 10 N<br>part 1"
    assert found["texts"][0].endswith("<br>fixed")
    assert found["texts"][2].endswith("<br>at rest")


def test_tower_turns_about_its_hinge() -> None:
    """About the edge x = 1, z = 1: opens at x = 0; the brick's interface stays shut."""
    found = marks(scene(tower_results()))
    assert list(found) == ["hinge lines", "hinges", "opening", "resultants"]
    assert found["hinges"]["colour"] == HINGE
    assert sorted(read(found["hinges"]["points"], 3).tolist()) == [[1, 0, 1], [1, 1, 1]]
    assert read(found["hinges"]["pairs"], 2).shape == (1, 2)
    assert found["hinges"]["texts"][0] == "hinges: base[0] | tower[0]"
    line = found["hinge lines"]
    assert read(line["points"], 3).tolist() in ([[1, 0, 1], [1, 1, 1]], [[1, 1, 1], [1, 0, 1]])
    assert line["width"] > found["hinges"]["width"]
    assert line["texts"] == ["hinge line of part 1 on the stationary blocks: 1 interface, 1 m"]
    opened = read(found["opening"]["points"], 3)
    assert opened[:, 0].tolist() == [0, 0, 0, 0]
    assert read(found["opening"]["bodies"], 2).tolist() == [[0, 0], [1, 1]] * 2  # as part of the base, of the tower


def test_resultants_pass_through_their_points_in_proportion() -> None:
    """10 N and a push of half of that at both: the tower's through its edge."""
    results = tower_results()
    mark = marks(scene(results))["resultants"]
    ends = read(mark["points"], 3).reshape(2, 6, 3)[:, :2]
    np.testing.assert_allclose(ends.mean(axis=1)[0], [1, 0.5, 1], atol=1e-6)
    lines = ends[:, 1] - ends[:, 0]
    np.testing.assert_allclose(np.linalg.norm(lines, axis=1), np.linalg.norm(lines[0]), rtol=1e-6)
    np.testing.assert_allclose(lines[:, 0] / lines[:, 2], -0.5, rtol=1e-6)
    assert "normal force 10 N, shear 5 N, eccentricity 1; force on base[0]" in mark["texts"][0]
    assert (lines[:, 2] < 0).all()  # the tower presses down on its base, the brick on its own


def test_case_without_equilibrium_shows_what_falls() -> None:
    found = scene(tower_results(), 1)
    assert found["motionWords"] == "motion in which the dead load falls"
    assert found["marks"] == []
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
    ("status", "words"), [(Status.APPROXIMATE, "APPROXIMATE"), (Status.NOT_VERIFIED, "NO RESULT"), (Status.SOLVED, "")]
)
def test_what_is_no_verified_result_says_so(status: Status, words: str) -> None:
    results = tower_results()
    found = scene(replace(results, cases=(replace(results.cases[0], status=status),)))
    for text in (found["motionWords"], found["forceWords"]):
        assert text.endswith(words)
        assert words or "," not in text


def test_locked_structure_shows_the_forces_that_lock_it() -> None:
    results = full_results()
    solution = replace(results.cases[0].solution, mechanics=None, certificate=None, status=Status.UNBOUNDED)
    case = replace(results.cases[0], solution=solution, status=Status.UNBOUNDED)
    found = scene(replace(results, cases=(case,)))
    assert found["forceWords"] == "forces that balance the live load alone"
    assert list(marks(found)) == ["resultants"]


def test_every_field_filled_and_still_json() -> None:
    assert scene(full_results())["arrow"]["name"] == "settlement"


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
    found = scene(replace(results, model=model, contacts=contacts))
    assert np.abs(np.array(found["offset"]) - shift).max() < 10
    vertices = read(found["vertices"], 3) + np.array(found["offset"])
    np.testing.assert_allclose(vertices, model.blocks.vertices, atol=1e-5)
    hinges = read(marks(found)["hinges"]["points"], 3) + np.array(found["offset"])
    np.testing.assert_allclose(hinges[:, 0], shift + 1, atol=1e-5)
    assert scene(results)["offset"] == [0, 0, 0]


def test_names_are_no_markup() -> None:
    results = tower_results()
    blocks = replace(results.model.blocks, groups=("base", "<b>&", "brick"))
    found = scene(replace(results, model=replace(results.model, blocks=blocks)))
    assert found["texts"][1].startswith("&lt;b&gt;&amp;[0]<br>")
    assert "&lt;b&gt;&amp;[0]" in marks(found)["hinges"]["texts"][0]


@pytest.mark.parametrize("azimuth", [-60.0, 30.0, 120.0])
def test_the_first_view_is_the_one_asked_for_and_bright(azimuth: float) -> None:
    """The face that looks at the eye is brighter than the opposite one, from whatever side it is seen."""
    cube = cuboids([[0, 0, 0]], [[1, 1, 1]], ("cube",))
    eye = eye_of(cube.vertices, cube.vertices, (azimuth, 25.0))
    np.testing.assert_allclose(np.rad2deg([np.arctan2(eye[1], eye[0]), np.arcsin(eye[2])]), [azimuth, 25.0])
    level = np.array([eye[0], eye[1], 0.0])
    seen, hidden = shades(np.array([level, -level]), light_from(eye))
    assert seen > hidden + 10


def test_what_is_thin_is_seen_from_its_front_whatever_is_asked_for() -> None:
    wall = cuboids([[0, 0, 0]], [[5, 0.2, 2]], ("wall",))
    assert eye_of(wall.vertices, wall.vertices, (120.0, 25.0)) == eye_of(wall.vertices, wall.vertices)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_arrow_of_a_settlement_stands_beside_its_support_and_moves_with_it(scale: float) -> None:
    """Of two blocks side by side the right one sinks: the arrow is to the right of it and points down."""
    results = full_results()
    settlement = results.cases[0].load_case.settlement
    assert settlement is not None
    blocks = cuboids(scale * np.array([[0, 0, 0], [2, 0, 0]]), scale * np.array([[2, 1, 1], [4, 1, 1]]), ("a", "b"))
    motions = np.array([[0.0, 0, -1, 0, 0, 0]])
    load_case = replace(
        results.cases[0].load_case, settlement=replace(settlement, blocks=np.array([1]), motions=motions, turns=False)
    )
    low, high = np.zeros(3), scale * np.array([4.0, 1, 1])
    arrow = load_arrow(replace(results.model, blocks=blocks), load_case, low, high, 0.5 * scale)
    assert (arrow.name, arrow.block) == ("settlement", 1)
    start, tip = arrow.points[:2] / scale
    np.testing.assert_allclose(tip - start, [0, 0, -0.5], atol=1e-12)
    assert start[0] > 4
    np.testing.assert_allclose((start + tip)[1:] / 2, [0.5, 0.5])


def settling(motion: list[float], block: int = 1) -> LoadCase:
    """A load case in which one block gives way."""
    settlement = Settlement(np.array([block]), np.array([motion], float), False, "settlement", 1.0, 1.0)
    return replace(tower_model().load_cases[0], settlement=settlement)


def test_the_arrow_of_a_settlement_stands_at_the_outer_side_of_its_support() -> None:
    """The brick is at the right end of the structure: the arrow is right of it and points down; it moves with it."""
    model = tower_model()
    arrow = load_arrow(model, settling([0, 0, -2, 0, 0, 0], 2), np.zeros(3), np.ones(3), 0.5)
    assert (arrow.name, arrow.block) == ("settlement", 2)
    assert len(arrow.pairs)
    assert arrow.points[:, 0].mean() > 5.0
    assert np.ptp(arrow.points[:, 2]) == pytest.approx(0.5)


def test_the_arrow_of_a_support_in_the_middle_stands_before_it() -> None:
    """A block in the middle of three: on the side of -y."""
    model = row_of_blocks(3).model
    arrow = load_arrow(model, settling([0, 0, -1, 0, 0, 0]), np.zeros(3), np.ones(3), 0.4)
    assert arrow.points[:, 1].mean() == pytest.approx(-BESIDE * 0.4, abs=0.02)
    assert arrow.points[:, 0].mean() == pytest.approx(2.5, abs=0.1)


def test_a_support_that_only_turns_and_a_load_that_cancels_have_no_arrow() -> None:
    model = tower_model()
    turning = load_arrow(model, settling([0, 0, 0, 0, 1, 0]), np.zeros(3), np.ones(3), 0.5)
    live = np.zeros((3, 6))
    live[1:, 0] = [1.0, -1.0]
    cancelling = load_arrow(model, replace(model.load_cases[0], live_load=live), np.zeros(3), np.ones(3), 0.5)
    for arrow in (turning, cancelling):
        assert not len(arrow.pairs)
        assert arrow.block == -1


def test_the_view_of_a_load_without_direction_has_no_arrow() -> None:
    results = tower_results()
    assert scene_of(results, results.cases[0])["arrow"] is not None
    live = np.zeros((3, 6))
    live[1:, 0] = [1.0, -1.0]
    load_case = replace(results.cases[0].load_case, live_load=live)
    assert scene_of(results, replace(results.cases[0], load_case=load_case))["arrow"] is None


def test_of_many_parts_the_first_are_named_and_the_others_counted() -> None:
    """Each of the blocks is a part; together with what rests there are more names than room."""
    model = row_of_blocks(MOST_NAMES + 4).model
    legend = by_part(model, np.arange(1, MOST_NAMES + 5)).legend
    assert len(legend) == MOST_NAMES
    assert legend[-1][0].startswith("and ")
    assert legend[-1][0].endswith(" more")


def test_blocks_that_touch_nothing_have_no_marks() -> None:
    """What falls is shown all the same."""
    results = tower_results()
    apart = replace(results, contacts=without_contacts(results.contacts))
    found = scene_of(apart, apart.cases[1])
    assert found["marks"] == []
    assert found["motion"] is not None
