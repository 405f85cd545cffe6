"""Lintels and arches over openings: exact volumes, units cut around them."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.model.blocks.masonry.built import Built, build, is_sound

GROSS = 4.0 * 0.2 * 1.5
HOLE = 1.0 * 0.2 * 0.6


def with_opening(folder: Path, **over: Any) -> Built:
    return build(folder, length=4.0, courses=10, openings=[{"from": [1.5, 0.3], "to": [2.5, 0.9], **over}])


@pytest.mark.parametrize("courses", [1, 2])
def test_a_lintel_is_one_block_that_rests_on_both_sides(tmp_path: Path, courses: int) -> None:
    built = with_opening(tmp_path, lintel={"bearing": 0.25, "courses": courses})
    is_sound(built)
    assert built.volume == pytest.approx(GROSS - HOLE, rel=1e-12)
    (lintel,) = np.flatnonzero(built.member("lintel"))
    expected = [[1.25, 0.0, 0.9], [2.75, 0.2, 0.9 + 0.15 * courses]]
    assert built.boxes()[lintel].tolist() == [pytest.approx(corner, rel=1e-12) for corner in expected]
    below = (built.contacts.bodies == lintel).any(axis=1) & (np.abs(built.contacts.normals[:, 2]) > 0.5)
    below &= built.contacts.centroids[:, 2] < 0.91
    assert built.contacts.areas[below].sum() == pytest.approx(2 * 0.25 * 0.2, rel=1e-12)
    # bed joints: nine, less the opening, which takes away those inside it, above its sill and below its head; less
    # those inside the lintel
    beds = 9 * 4.0 - (4 + 1) * 1.0 - (courses - 1) * 1.5
    assert built.bed_area() == pytest.approx(0.2 * beds, rel=1e-12)


@pytest.mark.parametrize(("embrace", "courses"), [(None, 1), (40, 2)])
def test_a_flat_arch(tmp_path: Path, embrace: float | None, courses: int) -> None:
    keys = {} if embrace is None else {"embrace": embrace}
    built = with_opening(tmp_path, arch={"voussoirs": 7, "courses": courses, **keys})
    is_sound(built)
    assert built.volume == pytest.approx(GROSS - HOLE, rel=1e-12)
    voussoirs = built.member("voussoir")
    height, lean = 0.15 * courses, math.tan(math.radians(embrace or 60) / 2)
    assert built.blocks.volumes[voussoirs].sum() == pytest.approx(0.2 * height * (1.0 + height * lean), rel=1e-12)
    assert built.position("voussoir")[voussoirs].tolist() == list(range(7))
    assert np.diff(built.blocks.centroids[voussoirs][:, 0]).min() > 0


def test_all_joints_of_a_flat_arch_are_skewed_towards_one_centre(tmp_path: Path) -> None:
    built = with_opening(tmp_path, arch={"voussoirs": 6, "courses": 2})
    voussoirs = np.flatnonzero(built.member("voussoir"))
    joints = np.isin(built.contacts.bodies, voussoirs).any(axis=1) & (np.abs(built.contacts.normals[:, 2]) < 0.99)
    # six voussoirs have five joints and, over two courses, two skewbacks on each side
    assert joints.sum() == 5 + 4
    depth = 0.5 / math.tan(math.radians(30))
    arms = built.contacts.centroids[joints] - [2.0, 0.1, 0.9 - depth]
    normals = built.contacts.normals[joints]
    assert np.einsum("ij,ij->i", arms, normals) == pytest.approx(0, abs=1e-12)
    lengths = built.contacts.areas[joints].sum() / 0.2
    slopes = np.linspace(-1, 1, 7) * math.tan(math.radians(30))
    assert lengths == pytest.approx((0.3 * np.hypot(1, slopes)).sum(), rel=1e-12)


@pytest.mark.parametrize("voussoirs", [5, 6])
def test_a_segmental_arch_with_a_level_top(tmp_path: Path, voussoirs: int) -> None:
    rise = 0.1
    built = with_opening(tmp_path, arch={"voussoirs": voussoirs, "courses": 2, "rise": rise})
    is_sound(built)
    radius = (0.25 + rise**2) / (2 * rise)
    half = math.asin(0.5 / radius)
    chords = radius**2 * (voussoirs * math.sin(2 * half / voussoirs) - math.sin(2 * half)) / 2
    assert built.volume == pytest.approx(GROSS - HOLE - 0.2 * chords, rel=1e-12)
    found = built.blocks.volumes[built.member("voussoir")].sum()
    assert found == pytest.approx(0.2 * (0.3 * (1.0 + 0.3 * math.tan(half)) - chords), rel=1e-12)
    top = built.boxes()[built.member("voussoir")][:, 1, 2]
    assert top == pytest.approx(1.2)


def test_several_openings_each_with_its_own(tmp_path: Path) -> None:
    built = build(
        tmp_path,
        length=6.0,
        courses=10,
        openings=[
            {"from": [0.5, 0.0], "to": [1.3, 0.9], "lintel": {"bearing": 0.2}},
            {"from": [2.5, 0.3], "to": [3.3, 0.9], "arch": {"voussoirs": 5}},
            {"from": [4.5, 0.3], "to": [5.3, 0.9]},
        ],
    )
    assert built.volume == pytest.approx(0.2 * (6.0 * 1.5 - 0.8 * (0.9 + 0.6 + 0.6)), rel=1e-12)
    assert built.member("lintel").sum() == 1
    assert built.member("voussoir").sum() == 5
    # the units over the last opening have nothing under them, and lie loose between their neighbours
    is_sound(built)


def test_lintels_go_through_all_leaves(tmp_path: Path) -> None:
    opening = {"from": [1.5, 0.3], "to": [2.5, 0.9], "lintel": {"bearing": 0.25}}
    built = build(tmp_path, length=4.0, courses=10, bond="english", leaves=2, openings=[opening])
    is_sound(built)
    assert built.volume == pytest.approx(2 * (GROSS - HOLE), rel=1e-12)
    assert np.ptp(built.boxes()[built.member("lintel")][0], axis=0) == pytest.approx([1.5, 0.4, 0.15])
