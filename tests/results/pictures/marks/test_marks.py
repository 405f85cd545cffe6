"""Marks of joints that move and of forces, and where bodies carry them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.results.pictures.marks import forces
from mbla.results.pictures.marks.forces import force_marks
from mbla.results.pictures.marks.joints import THIN, interface_sides, joint_marks
from mbla.results.pictures.marks.marks import Mark, arrows, moved, rings, segments
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.scene import PictureScene, scene_of
from mbla.results.results import Results
from mbla.solution.solution import ContactMode
from tests.results.pictures.rows_and_columns import column_of_blocks, row_of_blocks, two_on_one
from tests.results.synthetic import tower_results

FRICTION = 0.65


def scene(results: Results | None = None, case: int = 0, kind: str = "mechanism") -> PictureScene:
    results = results or tower_results()
    return scene_of(results, results.cases[case], PictureOptions(), kind)


def with_mechanics(results: Results, **changes: Any) -> Results:
    case = results.cases[0]
    assert case.solution.mechanics is not None
    solution = replace(case.solution, mechanics=replace(case.solution.mechanics, **changes))
    return replace(results, cases=(replace(case, solution=solution), *results.cases[1:]))


def named(found: list[Mark]) -> dict[str, Mark]:
    return {mark.name.split(",")[0]: mark for mark in found}


def test_the_tower_turns_about_its_hinge_and_opens_behind_it() -> None:
    """About the edge x = 1, z = 1; the area between base and tower reaches from there to x = 0 and up."""
    shown = scene()
    found = named(joint_marks(shown))
    assert list(found) == ["opening", "hinge"]
    assert sorted(found["hinge"].points.tolist()) == [[1, 0, 1], [1, 1, 1]]
    assert found["hinge"].texts[0] == "hinge: base[0] | tower[0]"
    gap = moved(found["opening"], shown.model, shown.motion)
    np.testing.assert_allclose(gap[found["opening"].points[:, 0] == 1, 2], 1.0, atol=1e-9)
    up = gap[found["opening"].points[:, 0] == 0]
    assert sorted(set((up[:, 2] > 1 + 1e-9).tolist())) == [False, True]


def test_a_structure_at_rest_has_no_joints_that_move() -> None:
    assert not joint_marks(scene(kind="forces"))


def test_hinges_that_the_listing_does_not_tell_are_thin() -> None:
    shown = scene()
    assert shown.failure is not None
    assert named(joint_marks(shown))["hinge"].widths.tolist() == [1.0]
    shown.__dict__["failure"] = replace(shown.failure, hinge_lines=())
    assert named(joint_marks(shown))["hinge"].widths.tolist() == [THIN]


def test_in_space_the_crack_between_parts_is_drawn_once_around() -> None:
    """Two blocks side by side turn as one: the side between their joints lies within the crack."""
    shown = scene(two_on_one())
    assert shown.failure is not None
    shown.__dict__["failure"] = replace(shown.failure, clusters=np.array([0, 1, 1]))  # as if they touched
    found = named(joint_marks(shown, flat=False))
    assert list(found) == ["opening", "crack", "hinge"]
    crack = found["crack"]
    assert crack.covered
    assert found["opening"].covered
    assert not found["hinge"].covered
    assert len(crack.pairs) == 2 * 6
    middles = crack.points[crack.pairs].mean(axis=1)
    assert not (np.abs(middles[:, 0] - 1.0) < 1e-9).any()
    below, above = crack.bodies[crack.pairs[:, 0], 0], crack.bodies[crack.pairs[:, 0], 1]
    assert below.tolist() == above.tolist()
    assert sorted(set(below.tolist())) == [0, 1, 2]


def test_in_space_joints_within_a_part_are_not_drawn() -> None:
    shown = scene()
    shown.__dict__["apart"] = np.zeros(len(shown.contacts), dtype=bool)
    assert joint_marks(shown, flat=False) == []


def sliding(*motion: float, mode: int = 1) -> PictureScene:
    """The tower moves on its base as its four corners there do: by a mode of contact points, 1 for sliding."""
    results = tower_results()
    mechanism, modes, velocities = np.zeros((3, 6)), np.zeros(8, dtype=np.int64), np.zeros((8, 3))
    mechanism[1], modes[:4] = motion, mode
    arms = results.contacts.points[:4] - results.model.blocks.centroids[1]
    velocities[:4] = (mechanism[1, :3] + np.cross(mechanism[1, 3:], arms))[:, [2, 0, 1]]
    return scene(with_mechanics(results, mechanism=mechanism, modes=modes, contact_velocities=velocities))


@pytest.mark.parametrize("push", [1.0, -1.0])
def test_the_arrow_of_a_block_that_slides_points_where_it_goes(push: float) -> None:
    outline, arrow = (mark for mark in joint_marks(sliding(push, 0, 0, 0, 0, 0)) if mark.name == "sliding")
    assert len(outline.pairs) == 4
    (step,) = arrow.points[arrow.pairs[:, 1]] - arrow.points[arrow.pairs[:, 0]]
    assert step / np.linalg.norm(step) == pytest.approx([push, 0, 0])
    assert arrow.points.mean(axis=0) == pytest.approx([0.5, 0.5, 1.0])


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_block_that_twists_has_a_ring_about_the_normal_its_way(sense: float) -> None:
    found = [mark for mark in joint_marks(sliding(0, 0, 0, 0, 0, sense)) if mark.name == "sliding"]
    ring = max(found, key=lambda mark: len(mark.pairs))
    arms = ring.points - [0.5, 0.5, 1.0]
    turns = np.cross(arms[ring.pairs[:, 0]], arms[ring.pairs[:, 1]])
    assert (sense * turns[:, 2] > 0).all()


def test_what_crushes_is_no_opening() -> None:
    """The tower sinks straight into its base."""
    assert list(named(joint_marks(sliding(0, 0, -1, 0, 0, 0, mode=ContactMode.CRUSH)))) == ["crushing"]


def test_sides_of_an_interface_close() -> None:
    shown = scene()
    sides = interface_sides(shown.contacts, np.arange(len(shown.contacts)) == 1)
    assert sides.tolist() == [[4, 5], [5, 6], [6, 7], [7, 4]]


def test_arrows_move_with_their_tip_and_keep_their_direction() -> None:
    """The others are carried by both bodies; grounds and nothing do not move."""
    results = tower_results()
    motion = np.zeros((3, 6))
    motion[1] = [0, 0, 2.0, 0, 0, 0.3]
    ends = np.array([[[0.5, 0.5, 2.0], [0.5, 0.5, 3.0]]])
    still = segments("", "", ends, np.array([[-1, 3]]), [""])
    assert moved(still, results.model, motion) == pytest.approx(ends[0])
    half = segments("", "", ends[:, ::-1], np.array([[1, 0]]), [""])
    assert moved(half, results.model, motion)[1] == pytest.approx([0.5, 0.5, 3.0])
    arrow = arrows("", "", ends[:, 1], ends[:, 1] - ends[:, 0], np.array([[1, 1]]), [""])
    start, tip = moved(arrow, results.model, motion)
    assert tip - start == pytest.approx([0, 0, 1])
    assert tip == pytest.approx([0.5, 0.5, 5.0])


def test_rings_turn_by_the_right_hand() -> None:
    ring, _ = rings("", "", np.zeros((1, 3)), np.array([[0, 0, 5.0]]), np.ones(1), np.zeros((1, 2), dtype=int), "")
    assert (np.cross(ring.points[ring.pairs[:, 0]], ring.points[ring.pairs[:, 1]])[:, 2] > 0).all()


# --- Forces ---------------------------------------------------------------------------------------------------------


def pressed(right: float, shear: float = 0.0) -> PictureScene:
    """One block of which the right edge carries a share of 4 N; shear along x, as a share of what friction gives."""
    normal = 2.0 * np.array([1 - right, right, right, 1 - right])
    forces = np.column_stack([normal, shear * FRICTION * normal, 0 * normal])
    return scene(with_mechanics(row_of_blocks(1), contact_forces=forces), kind="forces")


@pytest.mark.parametrize(
    ("right", "mark", "place"),
    [
        (0.5, "", 0.5),
        (0.6, "", 0.6),
        (0.8, "outside the middle third", 0.8),
        (1.0, "at the edge of the joint", 1.0),
        (3.0, "outside the joint (tension)", 1.0),
    ],
)
def test_eccentric_forces_are_marked_where_they_act(right: float, mark: str, place: float) -> None:
    """The joint reaches from x = 0 to 1; a force outside is drawn at its edge."""
    found = named(force_marks(pressed(right)))
    assert list(found)[1:] == [mark] * bool(mark)
    assert found["resultant"].points.mean(axis=0)[0] == pytest.approx(place)
    for dot in list(found.values())[1:]:
        assert dot.points[0, 0] == pytest.approx(place)


@pytest.mark.parametrize(("shear", "used"), [(0.99, False), (1.0, True)])
def test_a_joint_at_the_limit_of_friction_is_marked(shear: float, used: bool) -> None:
    assert ("all friction used" in named(force_marks(pressed(0.5, shear)))) == used


def test_a_chain_of_blocks_has_a_line_of_thrust_and_sections_in_proportion_to_forces() -> None:
    """Three joints with their forces at x = 0.5, 0.6 and 0.8, of 4, 8 and 12 N from the lowest up."""
    shown = scene(column_of_blocks(0.5, 0.6, 0.8), kind="forces")
    found = named(force_marks(shown))
    line = found["line of thrust"]
    assert sorted(line.points[:, 0].tolist()) == pytest.approx([0.5, 0.6, 0.8])
    assert len(line.pairs) == 2
    squares = found["resultant"].widths ** 2
    assert squares / squares[2] == pytest.approx([1 / 3, 2 / 3, 1])
    rods = named(force_marks(shown, proportional=True))["resultant"].points.reshape(-1, 2, 3)
    lengths = np.linalg.norm(rods[:, 1] - rods[:, 0], axis=1)
    assert lengths / lengths[2] == pytest.approx([1 / 3, 2 / 3, 1])


def test_only_the_largest_resultants_are_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(forces, "MOST", 2)
    assert forces.drawn_resultants(scene(column_of_blocks(0.5, 0.6, 0.8), kind="forces")).tolist() == [1, 2]


def test_without_forces_there_are_none_to_draw() -> None:
    assert not force_marks(scene(case=1, kind="forces"))
