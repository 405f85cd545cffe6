"""What points made by hand prove together and how the study ends; a point without a verified answer must look so."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from shapely import Polygon

from mbla.sweeps.interaction.domain import clipped, domain_of
from mbla.sweeps.interaction.question import DIRECTION, TWO_LOADS
from mbla.sweeps.interaction.study import INTERACT_RECORD
from tests.sweeps.interaction.hand_made import FIGURES, area_of_circle, both_bounds, made

SQUARE = np.array([[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]])
NONE: dict[str, Any] = dict.fromkeys((*FIGURES, "mechanism.class"))
LATE = {"state": "failed", "exit_code": 7, "status": None, "reason": "stopped after 3 s", **NONE}
DOUBTFUL = {"state": "failed", "exit_code": 4, "status": "not_verified", "reason": "bounds apart", "load_factor": None}
FREE = {"exit_code": 5, "status": "unbounded", "reason": "locked by friction", **NONE}


def test_clipping() -> None:
    assert Polygon(clipped(SQUARE, np.array([1.0, 1.0, 0.0]))).area == pytest.approx(2.0)
    assert Polygon(clipped(SQUARE, np.array([1.0, 0.0, 5.0]))).area == 4.0
    assert len(clipped(SQUARE, np.array([1.0, 0.0, -5.0]))) == 0


def test_tangents_and_chords_of_a_circle(tmp_path: Path) -> None:
    domain = made(tmp_path, DIRECTION, [0.5] * 6).domain
    assert (domain.inner.area, domain.outer.area) == pytest.approx(area_of_circle(6, 0.5))
    assert not domain.crossed
    assert not domain.cut_off
    assert domain.everywhere == pytest.approx(0.5 * np.sqrt(3) / 2)


def test_a_safe_point_beyond_a_half_plane_of_another_is_an_error_of_verification(tmp_path: Path) -> None:
    """Its own bound is far enough, that of its neighbour at 60 degrees allows 0.5 / cos 60 = 1 there."""
    found = made(tmp_path, DIRECTION, [0.5] * 6, {0: both_bounds(1.01)})
    assert found.domain.crossed == pytest.approx(0.01 / 1.01, rel=0.02)
    assert found.domain.everywhere is None
    assert "ERROR OF VERIFICATION: the safe domain of associative flow is convex" in found.words
    assert found.study.exit_code == 4


def test_the_origin_is_safe_only_where_the_structure_stands(tmp_path: Path) -> None:
    """Over 90 degrees of rays the hull of the points alone is a chord's worth away from it."""
    standing = made(tmp_path, TWO_LOADS, [0.5] * 3)
    doubtful = made(tmp_path, TWO_LOADS, [0.5] * 3, {number: {"standing.verdict": "doubtful"} for number in range(3)})
    assert standing.domain.inner.area - doubtful.domain.inner.area == pytest.approx(0.125)


def test_without_bounds_there_is_no_domain(tmp_path: Path) -> None:
    found = made(tmp_path, DIRECTION, [0.5] * 4, dict.fromkeys(range(4), dict.fromkeys(FIGURES[2:])))
    assert domain_of(found.points, found.question) is None
    assert found.study.record["interaction"]["domain"] is None


def test_points_that_do_not_go_around_leave_sides_without_a_mechanism(tmp_path: Path) -> None:
    found = made(tmp_path, DIRECTION, [0.5] * 4, {1: LATE, 2: LATE})
    assert "the mechanisms found do not bound it on all sides" in found.words
    assert "% of its area" not in found.words


@pytest.mark.parametrize(
    ("changes", "mark", "status"),
    [
        ({1: DOUBTFUL}, "NOT VERIFIED", 4),
        ({1: LATE}, "FAILED", 7),
        ({1: FREE}, "unbounded", 0),
        ({1: FREE | {"status": "no_equilibrium", "standing.verdict": "no"}}, "no equilibrium", 0),
        ({1: LATE, 2: DOUBTFUL}, "FAILED", 7),
        ({1: LATE, 2: LATE | {"exit_code": 1}}, "FAILED", 1),
        (dict.fromkeys(range(4), FREE), "unbounded", 5),
    ],
)
def test_what_is_not_plain_is_told(tmp_path: Path, changes: dict[int, Any], mark: str, status: int) -> None:
    """And the gravest point ends the study."""
    found = made(tmp_path, DIRECTION, [0.5] * 4, changes)
    (row,) = [line for line in found.study.lines if line.split()[:1] == ["90"]]
    assert row.endswith(f"  {mark}")
    assert f": {changes[1]['reason']}" in found.words
    assert found.study.exit_code == status


def test_extremes_name_their_angles(tmp_path: Path) -> None:
    found = made(tmp_path, DIRECTION, [0.5, 0.5, 0.25, 0.5, 0.5, 0.5, 0.25 * (1 + 1e-7), 0.5], {0: both_bounds(0.5)})
    assert "least load factor: 0.25 at 90, 270 degrees" in found.words
    assert "greatest load factor: 0.5 at 0, 45, 135, 180 and 2 more degrees" in found.words


def test_every_key_of_the_record_is_described(tmp_path: Path) -> None:
    record = made(tmp_path, DIRECTION, [0.5] * 4).study.record["interaction"]
    described = {key.path.removeprefix("interaction.") for key in INTERACT_RECORD}
    assert described == set(record) | {f"domain.{key}" for key in record["domain"]}
