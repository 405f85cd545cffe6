"""Bonds of several leaves: full prisms, joints that keep apart, headers where they belong."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.model.blocks.masonry.built import Built, build, is_sound, least_distance, perpends

LENGTHS = [2.0, 2.2, 2.13, 0.7]


def is_a_prism(built: Built, length: float, thickness: float, courses: int, height: float = 0.15) -> None:
    is_sound(built)
    assert built.volume == pytest.approx(length * thickness * courses * height, rel=1e-12)
    assert built.ground_area() == pytest.approx(length * thickness, rel=1e-12)
    assert built.bed_area() == pytest.approx((courses - 1) * length * thickness, rel=1e-12)


@pytest.mark.parametrize("length", LENGTHS)
@pytest.mark.parametrize("start", ["full", "half"])
@pytest.mark.parametrize("bond", ["english", "flemish", "header"])
def test_bonded_walls_are_prisms_whose_perpends_keep_half_a_header_apart(
    tmp_path: Path, bond: str, start: str, length: float
) -> None:
    built = build(tmp_path, length=length, courses=4, bond=bond, leaves=2, start=start)
    is_a_prism(built, length, 0.4, 4)
    assert least_distance(perpends(built)) >= 0.1 * (1 - 1e-6)


@pytest.mark.parametrize("bond", ["english", "flemish"])
def test_three_leaves(tmp_path: Path, bond: str) -> None:
    built = build(tmp_path, length=2.4, courses=4, bond=bond, leaves=3, unit=[0.6, 0.2, 0.15])
    is_a_prism(built, 2.4, 0.6, 4)
    assert least_distance(perpends(built)) >= 0.1 * (1 - 1e-6)


def widths(built: Built, course: int, leaf: int | None) -> list[float]:
    """Along the wall: of units of one leaf, or of headers, from left to right."""
    chosen = (built.position("course") == course) & (built.position("leaf") == (-1 if leaf is None else leaf))
    boxes = built.boxes()[chosen]
    found: list[float] = np.ptp(boxes[np.argsort(boxes[:, 0, 0])], axis=1)[:, 0].round(9).tolist()
    return found


def test_english_bond_has_courses_of_stretchers_and_of_headers_with_closers(tmp_path: Path) -> None:
    built = build(tmp_path, length=1.6, courses=3, bond="english", leaves=2)
    assert widths(built, 0, 0) == widths(built, 0, 1) == [0.4] * 4
    assert widths(built, 0, None) == []
    assert widths(built, 1, None) == [0.2, 0.1, 0.2, 0.2, 0.2, 0.2, 0.2, 0.1, 0.2]
    assert widths(built, 1, 0) == []
    assert widths(built, 2, 0) == [0.4] * 4


def test_flemish_bond_centres_headers_on_stretchers(tmp_path: Path) -> None:
    built = build(tmp_path, length=2.2, courses=2, bond="flemish", leaves=2)
    assert widths(built, 0, 0) == widths(built, 0, 1) == [0.4] * 4
    assert widths(built, 0, None) == [0.2] * 3
    # a header and a closer at both ends
    assert widths(built, 1, None) == [0.2, 0.1, 0.2, 0.2, 0.1, 0.2]
    assert widths(built, 1, 0) == [0.4] * 3
    boxes, headers = built.boxes(), built.position("leaf") == -1
    below = boxes[~headers & (built.position("course") == 0)].mean(axis=1)[:, 0]
    inner = boxes[headers & (built.position("course") == 1)].mean(axis=1)[2:4, 0]
    assert np.abs(np.subtract.outer(inner, below)).min(axis=1) == pytest.approx(0, abs=1e-12)


def test_header_bond(tmp_path: Path) -> None:
    built = build(tmp_path, length=1.0, courses=2, bond="header", leaves=2)
    assert widths(built, 0, None) == [0.2] * 5
    assert widths(built, 1, None) == [0.1, 0.2, 0.2, 0.2, 0.2, 0.1]


def test_leaves_without_headers_are_not_bonded(tmp_path: Path) -> None:
    built = build(tmp_path, length=2.0, courses=4, leaves=3)
    is_a_prism(built, 2.0, 0.6, 4)
    assert built.area_along(1) == pytest.approx(2 * 2.0 * 0.6, rel=1e-12)
    assert not built.member("header").any()
    leaf, boxes = built.position("leaf"), built.boxes()
    assert np.bincount(leaf).tolist() == [22, 22, 22]
    assert boxes[:, 0, 1] == pytest.approx(0.2 * leaf)


def test_through_stones_at_a_regular_spacing(tmp_path: Path) -> None:
    built = build(tmp_path, length=2.4, courses=8, leaves=2, headers={"every": 2, "spacing": 3})
    is_a_prism(built, 2.4, 0.4, 8)
    header, unit, course = built.member("header"), built.position("unit"), built.position("course")
    assert unit[header & (course == 1)].tolist() == [0, 3, 6]
    assert unit[header & (course == 3)].tolist() == [2, 5]
    assert unit[header & (course == 5)].tolist() == [0, 3, 6]
    assert not header[course % 2 == 0].any()
    assert built.position("leaf")[header].tolist() == [-1] * int(header.sum())
    # where a header lies there is no joint between the leaves
    lengths = built.boxes()[header].max(axis=1)[:, 0] - built.boxes()[header].min(axis=1)[:, 0]
    assert built.area_along(1) == pytest.approx(0.15 * (2.4 * 8 - lengths.sum()), rel=1e-12)


@pytest.mark.parametrize(("units", "scale"), [("mm", 1000.0), ("ft", 1 / 0.3048)])
def test_in_any_unit_of_length(tmp_path: Path, units: str, scale: float) -> None:
    keys: dict[str, Any] = {"courses": 4, "bond": "flemish", "leaves": 2}
    metres = build(tmp_path, length=2.13, **keys)
    other = build(
        tmp_path, units=units, length=2.13 * scale, **{**keys, "unit": [0.4 * scale, 0.2 * scale, 0.15 * scale]}
    )
    assert len(other.blocks) == len(metres.blocks)
    assert other.blocks.vertices / scale == pytest.approx(metres.blocks.vertices, rel=1e-12, abs=1e-12)
    assert len(other.contacts) == len(metres.contacts)


def test_far_from_the_origin(tmp_path: Path) -> None:
    moved = build(
        tmp_path,
        length=2.0,
        courses=4,
        bond="english",
        leaves=2,
        transform=[{"rotate": {"axis": [0, 0, 1], "angle": 30}}, {"translate": [4e5, 5e6, 0]}],
    )
    is_sound(moved)
    assert moved.volume == pytest.approx(2.0 * 0.4 * 0.6, rel=1e-7)  # digits of the coordinates: 1e-9 of 0.4
    assert moved.bed_area() == pytest.approx(3 * 2.0 * 0.4, rel=1e-7)
