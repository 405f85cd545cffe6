"""Arrows and rings of loads: where they are, which way they lead, and what is one arrow for all blocks."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.model.applied_load import AppliedLoad, Patches, without_forces, wrenches_of
from mbla.questions.reaction import Reaction, Settlement
from mbla.questions.travel_position import NOWHERE, TravelPosition
from mbla.results.pictures.marks.loads import MANY, arrow_steps, live_marks, marks_of_load, shown_loads
from mbla.results.pictures.marks.marks import Mark
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import CASES, DEAD_LOAD, LIVE_LOAD
from mbla.results.pictures.scene import PictureScene, scene_of
from mbla.results.results import Results
from tests.results.pictures.rows_and_columns import row_of_blocks
from tests.results.synthetic import G, standing_at, tower_model, tower_results

GRAVITY = replace(without_forces("gravity (0, 0, -9.81) m/s2"), on_masses=True)
FORCE = without_forces("force")


def scene(results: Results | None = None, kind: str = "model") -> PictureScene:
    results = results or tower_results()
    return scene_of(results, results.cases[0], PictureOptions(), kind)


def wrench(force: list[float], point: list[float], block: int) -> np.ndarray:
    """A force at a point of one block of the tower model, about its centroid, (3, 6)."""
    loads = np.zeros((3, 6))
    loads[block, :3] = force
    loads[block, 3:] = np.cross(np.array(point) - tower_model().blocks.centroids[block], force)
    return loads


def marks(loads: np.ndarray, *applied: AppliedLoad, travel: TravelPosition = NOWHERE) -> list[Mark]:
    return marks_of_load(scene(), "load", LIVE_LOAD, loads, applied, travel)


def tips(mark: Mark) -> list[list[float]]:
    return [point.tolist() for point in mark.points[mark.pairs[:, 1]]]


def ways(mark: Mark) -> np.ndarray:
    steps = mark.points[mark.pairs[:, 1]] - mark.points[mark.pairs[:, 0]]
    return np.asarray(steps / np.linalg.norm(steps, axis=1, keepdims=True))


@pytest.mark.parametrize(
    ("force", "point", "tip"),
    [
        ([5, 0, 0], [0.0, 0.5, 2.7], [0.0, 0.5, 2.7]),
        ([5, 0, 0], [0.8, 0.5, 2.7], [0.0, 0.5, 2.7]),
        ([0, 0, -3], [0.2, 0.1, 3.0], [0.2, 0.1, 3.0]),
        ([-1, 0, -1], [1.0, 0.5, 2.0], [1.0, 0.5, 2.0]),
    ],
    ids=["on its face", "inside", "on top", "slanted"],
)
def test_arrow_ends_where_the_force_enters_the_block(force: list[float], point: list[float], tip: list[float]) -> None:
    (mark,) = marks(wrench(force, point, 1), FORCE)
    assert mark.arrows
    assert mark.bodies.tolist() == [[1, 1], [1, 1]]
    assert tips(mark) == [pytest.approx(tip)]
    assert ways(mark) == pytest.approx(np.array([force]) / np.linalg.norm(force))


def test_loads_on_supports_are_not_drawn() -> None:
    assert not marks(wrench([5, 0, 0], [0, 0, 0], 0), FORCE)


def test_acceleration_is_one_arrow_above_and_forces_beside_it_are_drawn_by_themselves() -> None:
    shown = scene(row_of_blocks(3))
    loads = np.zeros((3, 6))
    loads[:, 2] = -G * shown.model.blocks.masses
    loads[1, 0] = 3.0
    above, force = marks_of_load(shown, "", LIVE_LOAD, loads, (GRAVITY, FORCE))
    assert ways(above) == pytest.approx(np.array([[0, 0, -1]]))
    assert tips(above)[0][2] > 2.0
    assert above.bodies.tolist() == [[-1, -1], [-1, -1]]
    assert force.bodies.tolist() == [[1, 1], [1, 1]]


def test_masses_that_blocks_carry_along_make_no_moment() -> None:
    results = tower_results()
    blocks = results.model.blocks
    blocks = replace(blocks, added_masses=np.array([0, 0.5, 0]), added_mass_points=blocks.centroids + 0.3)
    loads = np.zeros((3, 6))
    loads[:, 2] = -G * blocks.masses
    loads[:, 3:] = np.cross(np.full((3, 3), 0.3), np.outer(blocks.added_masses, [0, 0, -G]))
    heavy = scene(replace(results, assembly=replace(results.assembly, model=replace(results.model, blocks=blocks))))
    assert len(marks_of_load(heavy, "", LIVE_LOAD, loads, (GRAVITY,))) == 1


def test_accelerations_that_differ_from_block_to_block_are_forces() -> None:
    """As of a tilt about different points: no two blocks have the same force for their mass."""
    loads = np.zeros((3, 6))
    loads[1:, 0] = tower_model().blocks.masses[1:] * [1.0, 2.0]
    (mark,) = marks(loads, replace(without_forces("acceleration by height"), on_masses=True))
    assert mark.bodies[::2, 0].tolist() == [1, 2]


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_moment_is_a_ring_about_the_centroid_that_turns_its_way(sense: float) -> None:
    loads = np.zeros((3, 6))
    loads[2, 4] = 7.0 * sense
    ring, tip = marks(loads, FORCE)
    arms = ring.points - tower_model().blocks.centroids[2]
    assert np.ptp(np.linalg.norm(arms, axis=1)) < 1e-9
    turns = np.cross(arms[ring.pairs[:, 0]], arms[ring.pairs[:, 1]])
    assert (sense * turns[:, 1] > 0).all()
    assert tip.arrows


def test_a_vehicle_has_an_arrow_for_each_axle_on_its_path() -> None:
    """Two on one block are two arrows, and what else acts on it has its own."""
    points = np.array([[9.0, 0.5, 4.0], [0.8, 0.5, 4.0], [0.2, 0.5, 4.0]])
    forces = np.array([[0, 0, -7.0], [0, 0, -5.0], [0, 0, -3.0]])
    vehicle = TravelPosition("train", 1, 1, points, np.array([9.0, 0.8, 0.2]), forces, np.array([-1, 1, 1]))
    loads = wrench([0, 0, -5], points[1], 1) + wrench([0, 0, -3], points[2], 1) + wrench([2, 0, 0], [0, 0.5, 2], 1)
    (mark,) = marks(loads, FORCE, without_forces("position 1"), travel=vehicle)
    assert np.array(tips(mark))[:, 0].tolist() == pytest.approx([0, 0.8, 0.2])


def test_positions_of_a_travelling_load_are_one_way_and_the_arrows_of_the_worst() -> None:
    results = tower_results()
    own = results.cases[0].solution.mechanics
    assert own is not None
    cases = []
    for number, factor in ((1, 0.7), (2, 0.5), (3, 0.6)):
        case = results.cases[0]
        travel = standing_at(number, 3, np.array([0.2 * number, 0.5, 4.0]), 0.2 * number)
        loads = wrench([0, 0, -1], travel.place.points[0].tolist(), 1)
        named = replace(case.load_case, name=f"train@{number}", question=travel)
        load_case = replace(named, live_load=loads, live=(without_forces("f"),))
        solution = replace(case.solution, mechanics=replace(own, load_factor=factor))
        cases.append(replace(case, load_case=load_case, solution=solution))
    shown = scene(replace(results, cases=tuple(cases)))
    line, places, arrow = (mark for mark in shown_loads(shown, "model") if mark.colour == CASES[0])
    assert line.name == places.name == "live load, 3 positions"
    assert len(line.pairs) == 2
    assert places.points[:, 0].tolist() == pytest.approx([0.2, 0.4, 0.6])
    assert np.array(tips(arrow))[:, 0].tolist() == pytest.approx([0.4])


def test_many_forces_have_short_arrows() -> None:
    few, many = (arrow_steps(np.tile([0, 0, -1.0], (count, 1)), 10.0) for count in (MANY, MANY + 1))
    assert np.abs(many).max() < 0.5 * np.abs(few).max()


def test_every_case_has_its_colour_and_its_words() -> None:
    """Of the model; a picture of one case has its live load, and the dead load where it is what falls."""
    found = {mark.name: mark.colour for mark in shown_loads(scene(), "model")}
    assert found == {
        "dead load: gravity (0, 0, -9.81) m/s2": DEAD_LOAD,
        "live load push_x: acceleration (1, 0, 0) g on all blocks": CASES[0],
        "live load fall: acceleration (1, 0, 0) g on all blocks": CASES[1],
    }
    results = tower_results()
    fallen = scene_of(results, results.cases[1], PictureOptions(), "mechanism")
    assert [mark.colour for mark in shown_loads(fallen, "mechanism")] == [DEAD_LOAD, LIVE_LOAD]
    assert [mark.colour for mark in shown_loads(fallen, "forces")] == [LIVE_LOAD]


@pytest.mark.parametrize(
    ("motion", "kinds"), [([0, 0, -1, 0, 0, 0], [True]), ([0, 0, 0, 0, 1, 0], [False, True]), ([0] * 6, [])]
)
def test_a_support_that_gives_way_has_an_arrow_along_its_motion_or_a_ring(
    motion: list[float], kinds: list[bool]
) -> None:
    given = Settlement(np.array([2]), np.array([motion], float), False, "settlement of brick[0]", 1.0, 1.0)
    case = replace(tower_model().load_cases[0], question=Reaction(given))
    found = live_marks(scene(), case, "live load", LIVE_LOAD)
    assert [mark.arrows for mark in found] == kinds
    assert all(mark.name == "settlement of brick[0]" for mark in found)
    if kinds == [True]:
        assert found[0].points[:, 2].max() <= 0.0, "below the brick that sinks"


def on_patches(spreads: bool) -> tuple[np.ndarray, AppliedLoad]:
    """An axle of 8 N on two wheels of 0.2 m x 0.1 m on block 2, as if part of it landed on block 1."""
    corners = np.array([[-0.1, -0.05, 0], [0.1, -0.05, 0], [0.1, 0.05, 0], [-0.1, 0.05, 0]])
    middles = np.array([[0.5, 0.2, 4.0], [0.5, 0.8, 4.0]])
    forces, under = np.tile([0, 0, -4.0], (2, 1)), np.array([2, 2])
    wrenches = wrenches_of(forces, middles, tower_model().blocks.centroids[[1, 2]])
    patches = Patches(corners + middles[:, None], forces, under, spreads)
    loads = np.zeros((3, 6))
    loads[[1, 2]] = wrenches[:, :6]
    return loads, AppliedLoad(np.array([1, 2]), wrenches, "lorry", patches=patches)


def test_axles_on_contacts_have_an_arrow_on_each_and_its_area() -> None:
    """In a plane figure a line as long as the area seems there; what lands of them on fill has arrows below."""
    loads, lorry = on_patches(spreads=False)
    arrow, area = marks(loads, lorry)
    assert tips(arrow) == pytest.approx(np.array([[0.5, 0.2, 4.0], [0.5, 0.8, 4.0]]))
    assert len(area.faces) == 2
    assert np.allclose(area.points[area.faces[0], :2].mean(axis=0), [0.5, 0.2])
    for towards, length in (([0, -1.0, 0], 0.2), ([1.0, 0, 0], 0.1)):
        *_, line = marks_of_load(scene(), "load", LIVE_LOAD, loads, (lorry,), towards=np.array(towards))
        assert np.linalg.norm(np.diff(line.points[line.pairs], axis=1)[:, 0], axis=1) == pytest.approx([length] * 2)
    below, area = marks(*on_patches(spreads=True))
    assert below.bodies[::2, 0].tolist() == [1, 2]
    assert len(area.faces) == 2
