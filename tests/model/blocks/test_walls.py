"""Walls along a plan: exact volume, whole contacts, interlocking corners and junctions."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.model.blocks.masonry.built import Built, build, is_sound, least_distance

ROOM: dict[str, Any] = {"plan": [[0, 0], [4, 0], [4, 3], [0, 3]], "closed": True}
PLANS: dict[str, tuple[dict[str, Any], float]] = {
    # area of the plan for walls of thickness t: by line length and corners
    "corner": ({"plan": [[0, 0], [4, 0], [4, 3]]}, 4 + 3 - 0.2),
    "corner right": ({"plan": [[0, 0], [4, 0], [4, 3]], "side": "right"}, 4 + 3 + 0.2),
    "corner centre": ({"plan": [[0, 0], [4, 0], [4, 3]], "side": "centre"}, 4 + 3),
    "z": ({"plan": [[0, 0], [4, 0], [4, 3], [7, 3]]}, 4 + 3 + 3),
    "u": ({"plan": [[0, 3], [0, 0], [4, 0], [4, 3]]}, 3 + 4 + 3 - 0.4),
    "t": ({"plan": [[0, 0], [4, 0]], "cross_walls": [{"from": [2, 0], "to": [2, 3]}]}, 4 + 3 - 0.2),
    "t off the bond": ({"plan": [[0, 0], [4, 0]], "cross_walls": [{"from": [1.93, 0.2], "to": [1.93, 3.1]}]}, 4 + 2.9),
    "cross": ({"plan": [[0, 0], [4, 0]], "cross_walls": [{"from": [2, -2], "to": [2, 3]}]}, 4 + 5 - 0.2),
    "room": (ROOM, 2 * (4 + 3) - 4 * 0.2),
    "room outside": ({**ROOM, "side": "right"}, 2 * (4 + 3) + 4 * 0.2),
    "room off the bond": (
        {"plan": [[0, 0], [4.07, 0], [4.07, 3.33], [0, 3.33]], "closed": True},
        2 * (4.07 + 3.33) - 4 * 0.2,
    ),
    "two rooms": ({**ROOM, "cross_walls": [{"from": [2, 0], "to": [2, 3]}]}, 2 * (4 + 3) - 4 * 0.2 + 3 - 0.4),
    "l-shaped room": (
        {"plan": [[0, 0], [4, 0], [4, 2], [2, 2], [2, 3], [0, 3]], "closed": True},
        2 * (4 + 3) - 5 * 0.2 + 0.2,
    ),
}


def walls(folder: Path, **keys: Any) -> Built:
    return build(folder, "walls", **{"courses": 6, **keys})


@pytest.mark.parametrize("name", PLANS)
def test_plans_are_prisms_in_one_piece(tmp_path: Path, name: str) -> None:
    keys, length = PLANS[name]
    built = walls(tmp_path, **keys)
    is_sound(built)
    assert built.volume == pytest.approx(length * 0.2 * 0.9, rel=1e-12)
    assert built.ground_area() == pytest.approx(length * 0.2, rel=1e-12)
    assert built.bed_area() == pytest.approx(5 * length * 0.2, rel=1e-12)


def joints_and_faces(built: Built, segment: int) -> dict[int, list[float]]:
    """Of one wall: perpends, and faces of walls that run through it, of each course; its outer ends left out."""
    boxes = built.boxes()[built.position("segment") == segment]
    courses = built.position("course")[built.position("segment") == segment]
    axis = int(np.argmax(np.ptp(boxes.reshape(-1, 3), axis=0)[:2]))
    least, greatest = boxes[..., axis].min(), boxes[..., axis].max()
    found = {}
    for course in range(int(courses.max()) + 1):
        ends = np.unique(boxes[courses == course][..., axis].round(9))
        found[course] = ends[(ends > least + 1e-9) & (ends < greatest - 1e-9)].tolist()
    return found


@pytest.mark.every(4)
@pytest.mark.parametrize("bond", ["running", "english", "flemish", "header"])
@pytest.mark.parametrize(
    "name", ["corner", "t", "t off the bond", "cross", "room", "room off the bond", "l-shaped room"]
)
def test_no_joint_stands_over_another_nor_over_the_face_of_another_wall(tmp_path: Path, name: str, bond: str) -> None:
    keys, _ = PLANS[name]
    leaves = 1 if bond == "running" else 2
    if leaves == 2 and name == "t off the bond":
        keys = {**keys, "cross_walls": [{"from": [1.93, 0.4], "to": [1.93, 3.1]}]}
    built = walls(tmp_path, **keys, bond=bond, leaves=leaves)
    is_sound(built)
    for segment in range(int(built.position("segment").max()) + 1):
        assert least_distance(joints_and_faces(built, segment)) >= 0.1 * (1 - 1e-6), segment


@pytest.mark.parametrize("unit", [[0.4, 0.4, 0.15], [0.5, 0.2, 0.15], [0.4, 0.3, 0.15], [0.3, 0.25, 0.15]])
def test_units_of_any_shape(tmp_path: Path, unit: list[float]) -> None:
    built = walls(tmp_path, **ROOM, unit=unit)
    is_sound(built)
    thickness = unit[1]
    assert built.volume == pytest.approx((14 - 4 * thickness) * thickness * 0.9, rel=1e-12)
    for segment in range(4):
        assert least_distance(joints_and_faces(built, segment)) >= 0.25 * unit[0] * (1 - 1e-6)
        boxes = built.boxes()[built.position("segment") == segment]
        assert np.ptp(boxes, axis=1)[:, :2].max() <= max(1.5 * unit[0], unit[1]) * (1 + 1e-9)


@pytest.mark.every(3)
@pytest.mark.parametrize("bond", ["running", "stack", "english", "flemish", "header"])
@pytest.mark.parametrize("side", ["front", "back"])
def test_bonds_that_begin_with_half_a_unit_and_run_through_buttresses(tmp_path: Path, bond: str, side: str) -> None:
    leaves = 1 if bond in ("running", "stack") else 2
    thickness, pier = 0.2 * leaves, {"width": 0.3, "depth": 0.5, "side": side, "slope": 0.15}
    for start in ("full", "half"):
        built = walls(
            tmp_path,
            **ROOM,
            bond=bond,
            leaves=leaves,
            start=start,
            buttresses=[{"segment": 0, "at": 1.9, **pier}, {"segment": 1, "at": 1.3, **pier}],
        )
        is_sound(built)
        expected = (14 - 4 * thickness) * thickness * 0.9 + 2 * 0.3 * 0.5 * (0.9 - 0.15 / 2)
        assert built.volume == pytest.approx(expected, rel=1e-12)
        plain = walls(tmp_path, **ROOM, bond=bond, leaves=leaves, start=start)
        assert plain.volume == pytest.approx((14 - 4 * thickness) * thickness * 0.9, rel=1e-12)
        is_sound(plain)


def test_corner_courses_alternate(tmp_path: Path) -> None:
    built = walls(tmp_path, **ROOM)
    corner = (built.boxes()[:, 0, :2] < 0.1).all(axis=1)
    order = np.argsort(built.position("course")[corner])
    assert built.position("segment")[corner][order].tolist() == [0, 3] * 3


def test_stack_bond_meets_too(tmp_path: Path) -> None:
    built = walls(tmp_path, **ROOM, bond="stack")
    is_sound(built)
    corner = (built.boxes()[:, 0, :2] < 0.1).all(axis=1)
    order = np.argsort(built.position("course")[corner])
    assert built.position("segment")[corner][order].tolist() == [0, 3] * 3


def test_through_stones_and_random_units(tmp_path: Path) -> None:
    for keys in ({"leaves": 2, "headers": {"every": 2, "spacing": 2}}, {"irregular": {"seed": 3, "variation": 0.3}}):
        built = walls(tmp_path, **ROOM, **keys)
        is_sound(built)
        thickness = 0.2 * int(str(keys.get("leaves", 1)))
        assert built.volume == pytest.approx((14 - 4 * thickness) * thickness * 0.9, rel=1e-12)
    for segment in range(4):
        assert least_distance(joints_and_faces(built, segment)) >= 0.2 * 0.4 * (1 - 1e-6)


def test_a_house(tmp_path: Path) -> None:
    built = walls(
        tmp_path,
        **ROOM,
        courses=8,
        openings=[
            {"segment": 0, "from": [1.0, 0.0], "to": [1.8, 0.75], "lintel": {"bearing": 0.2, "material": "oak"}},
            {"segment": 2, "from": [2.0, 0.3], "to": [2.8, 0.75], "arch": {"voussoirs": 5, "courses": 2}},
        ],
        gables=[{"segment": 1, "rise": 1.0}, {"segment": 3, "rise": 1.0}],
        cross_walls=[{"from": [3, 0], "to": [3, 3]}],
        buttresses=[{"segment": 3, "side": "front", "at": 1, "width": 0.4, "depth": 0.3, "courses": 5}],
    )
    is_sound(built)
    plan = 0.2 * (14 - 0.8 + 3 - 0.4)
    expected = plan * 1.2 - 0.2 * 0.8 * (0.75 + 0.45) + 2 * 0.2 * 3.0 * 1.0 / 2 + 0.4 * 0.3 * 0.75
    assert built.volume == pytest.approx(expected, rel=1e-12)
    segments = built.position("segment")
    assert segments[built.member("lintel")].tolist() == [0]
    assert set(segments[built.member("voussoir")].tolist()) == {2}
    assert set(segments[built.member("gable")].tolist()) == {1, 3}
    assert set(segments[built.member("buttress")].tolist()) == {3}
    assert built.position("course")[built.member("gable")].min() == 8


def test_distances_along_a_wall_are_from_the_first_point_of_its_line(tmp_path: Path) -> None:
    opening = {"segment": 1, "from": [1.0, 0.3], "to": [1.8, 0.75]}
    for side in ("left", "centre", "right"):
        built = walls(tmp_path, plan=[[0, 0], [4, 0], [4, 3]], side=side, openings=[opening])
        boxes = built.boxes()[(built.position("segment") == 1) & (built.position("course") == 3)]
        edges = np.sort(boxes[..., 1].ravel()).round(9).tolist()
        assert edges.count(1.0) == edges.count(1.8) == 1


def test_the_front_of_a_wall_is_to_the_right_of_its_line(tmp_path: Path) -> None:
    buttress = {"segment": 0, "side": "front", "at": 1, "width": 0.4, "depth": 0.3}
    assert walls(tmp_path, **ROOM, buttresses=[buttress]).boxes()[..., 1].min() == pytest.approx(-0.3)
    built = walls(tmp_path, **ROOM, buttresses=[{**buttress, "segment": 1}])
    assert built.boxes()[..., 0].max() == pytest.approx(4.3)
    is_sound(built)


def test_a_corner_drawn_backwards_on_the_other_side_covers_the_same_plan(tmp_path: Path) -> None:
    forwards = walls(tmp_path, plan=[[0, 0], [4, 0], [4, 4]])
    backwards = walls(tmp_path, plan=[[4, 4], [4, 0], [0, 0]], side="right")
    assert forwards.volume == pytest.approx(backwards.volume, rel=1e-12)
    assert forwards.boxes().min(axis=(0, 1)) == pytest.approx(backwards.boxes().min(axis=(0, 1)), abs=1e-12)
    assert forwards.boxes().max(axis=(0, 1)) == pytest.approx(backwards.boxes().max(axis=(0, 1)), abs=1e-12)
