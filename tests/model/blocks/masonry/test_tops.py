"""Gables and buttresses: exact outlines, bonded or not."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.model.blocks.masonry.built import build, is_sound, least_distance, perpends


@pytest.mark.parametrize("rise", [1.5, 0.4, 1.43, 0.1])
@pytest.mark.parametrize("apex", [None, 1.0, 0.0])
def test_a_gable_is_an_exact_triangle(tmp_path: Path, rise: float, apex: float | None) -> None:
    gable = {"rise": rise} if apex is None else {"rise": rise, "apex": apex}
    built = build(tmp_path, length=4.0, courses=4, gable=gable)
    is_sound(built)
    assert built.volume == pytest.approx(0.2 * (4.0 * 0.6 + 4.0 * rise / 2), rel=1e-12)
    top = built.member("gable")
    assert built.blocks.volumes[top].sum() == pytest.approx(0.2 * 4.0 * rise / 2, rel=1e-12)
    corners = built.blocks.vertices
    peak = 2.0 if apex is None else apex
    slopes = np.interp(
        corners[:, 0], [0.0, peak, 4.0] if peak > 0 else [0.0, 4.0], [0, rise, 0] if peak > 0 else [rise, 0]
    )
    assert (corners[:, 2] <= 0.6 + slopes + 1e-12).all()
    assert corners[:, 2].max() == pytest.approx(0.6 + rise, rel=1e-12)
    courses = built.position("course")[top]
    assert courses.min() == 4
    # bed joints are as long as the triangle is wide there; the last course may be lower or up to a quarter higher
    heights = 0.15 * np.arange(courses.max() - 3)
    assert built.bed_area() == pytest.approx(0.2 * (3 * 4.0 + (4.0 * (1 - heights / rise)).sum()), rel=1e-12)
    # a wedge under a slope is half a unit long; under the flattest slope here it is thin
    assert built.blocks.volumes.min() > 0.02 * 0.4 * 0.2 * 0.15


@pytest.mark.parametrize("side", ["front", "back"])
@pytest.mark.parametrize("bonded", [True, False])
@pytest.mark.parametrize("slope", [0.0, 0.3])
def test_a_buttress(tmp_path: Path, side: str, bonded: bool, slope: float) -> None:
    buttress = {"at": 1.1, "width": 0.3, "depth": 0.5, "side": side, "bonded": bonded, "slope": slope}
    built = build(tmp_path, length=4.0, courses=8, buttresses=[buttress])
    is_sound(built)
    pier = 0.3 * 0.5 * (1.2 - slope / 2)
    assert built.volume == pytest.approx(4.0 * 0.2 * 1.2 + pier, rel=1e-12)
    member = built.member("buttress")
    # odd courses of its level part run through the wall
    inside = 0.3 * 0.2 * 0.15 * ((8 - slope / 0.15) // 2) if bonded else 0.0
    assert built.blocks.volumes[member].sum() == pytest.approx(pier + inside, rel=1e-9)
    reach = built.boxes()[member]
    assert (reach[:, 0, 1].min() if side == "front" else reach[:, 1, 1].max()) == pytest.approx(
        -0.5 if side == "front" else 0.7
    )
    face = 0.0 if side == "front" else 0.2
    on_face = (np.abs(built.contacts.normals[:, 1]) > 0.99) & (np.abs(built.contacts.centroids[:, 1] - face) < 1e-9)
    tied = (8 - round(slope / 0.15)) // 2 * 0.15 if bonded else 0.0
    assert built.contacts.areas[on_face].sum() == pytest.approx(0.3 * (1.2 - tied), rel=1e-9)
    assert built.ground_area() == pytest.approx(4.0 * 0.2 + 0.3 * 0.5, rel=1e-12)


def test_the_joints_of_a_wall_keep_off_the_faces_of_its_buttresses(tmp_path: Path) -> None:
    built = build(tmp_path, length=4.0, courses=4, buttresses=[{"at": 1.15, "width": 0.3, "depth": 0.5}])
    places = perpends(built)
    inside = [place for course in (0, 2) for place in places[course] if 1.0 < place < 1.6]
    assert all(abs(place - face) >= 0.1 - 1e-9 for place in inside for face in (1.15, 1.45))
    assert math.isfinite(least_distance(places))


@pytest.mark.parametrize(
    "keys",
    [{"bond": "english", "leaves": 2}, {"irregular": {"seed": 2, "variation": 0.3, "heights": 0.2}}],
    ids=["english", "random"],
)
def test_gables_of_other_walls(tmp_path: Path, keys: dict[str, Any]) -> None:
    built = build(tmp_path, length=4.0, courses=4, gable={"rise": 1.5}, **keys)
    is_sound(built)
    assert built.volume == pytest.approx(0.2 * keys.get("leaves", 1) * (4.0 * 0.6 + 4.0 * 1.5 / 2), rel=1e-12)
    assert built.member("gable").sum() > 40
