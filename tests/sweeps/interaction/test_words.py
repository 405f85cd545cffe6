"""What is told of points, and how the study ends; a point without a verified answer must look so."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mbla.sweeps.interaction.domain import Point
from mbla.sweeps.interaction.picture import joined_runs
from mbla.sweeps.interaction.study import INTERACT_RECORD, study_json
from mbla.sweeps.interaction.words import conclusions, mark_words, study_lines
from tests.sweeps.interaction.hand_made import around, point, study

NAN = float("nan")
NONE = {"load_factor": NAN, "associative": NAN, "static_bound": NAN, "kinematic_bound": NAN, "powers": {}}
DOUBTFUL = replace(
    point(90.0), answered=False, exit_code=4, status="not_verified", load_factor=NAN, reason="bounds apart"
)
ROUGH = replace(point(90.0), answered=False, exit_code=4, status="approximate", reason="gap 0.01")
LATE = replace(point(90.0), answered=False, exit_code=7, status="", reason="stopped after 3 s", **NONE)  # type: ignore[arg-type]
FREE = replace(point(90.0), exit_code=5, status="unbounded", **NONE)  # type: ignore[arg-type]
FALLEN = replace(point(90.0), exit_code=5, status="no_equilibrium", standing="no", **NONE)  # type: ignore[arg-type]
LOCKED = replace(point(90.0), load_factor=NAN, standing="only by self-stress")


def with_one(other: Point) -> list[Point]:
    """Four points around, that at 90 degrees another."""
    points = around(4)
    points[1] = other
    return points


@pytest.mark.parametrize(
    ("other", "mark", "status", "words"),
    [
        (DOUBTFUL, "NOT VERIFIED", 4, "no verified answer at 90 degrees: bounds apart"),
        (ROUGH, "APPROXIMATE", 4, "no verified answer at 90 degrees: gap 0.01"),
        (LATE, "FAILED", 7, "no verified answer at 90 degrees: stopped after 3 s"),
        (FREE, "unbounded", 0, "unbounded at 90 degrees"),
        (FALLEN, "no equilibrium", 0, "no equilibrium at 90 degrees"),
        (LOCKED, "stands only by self-stress", 0, "stands only by self-stress at 90 degrees"),
    ],
)
def test_what_is_not_plain_is_told(other: Point, mark: str, status: int, words: str) -> None:
    made = study(with_one(other))
    assert mark_words(other) == mark
    lines = study_lines(made)
    (row,) = [line for line in lines if line.split()[:1] == ["90"]]
    assert row.endswith(mark)
    assert words in conclusions(made)
    assert made.exit_code == status
    assert conclusions(made)[0] == "load factor 0.5 at every point of 3 verified points"


def test_the_gravest_point_ends_the_study() -> None:
    points = with_one(DOUBTFUL)
    points[2] = replace(LATE, angle=180.0)
    assert study(points).exit_code == 7
    points[3] = replace(LATE, angle=270.0, exit_code=1)
    assert study(points).exit_code == 1


def test_extremes_name_their_angles() -> None:
    points = around(8)
    points[2] = replace(points[2], load_factor=0.25)
    points[6] = replace(points[6], load_factor=0.25 * (1 + 1e-7))
    words = conclusions(study(points))
    assert words[0] == "least load factor: 0.25 at azimuth 90 and 270 degrees"
    assert words[1] == "greatest: 0.5 at azimuth 0, 45, 135, 180 and 2 more degrees"


def test_contradicting_bounds_are_an_error_of_verification() -> None:
    points = around(6)
    points[0] = replace(points[0], static_bound=1.5, kinematic_bound=1.5)
    made = study(points)
    (words,) = [text for text in conclusions(made) if "ERROR" in text]
    assert words.startswith("ERROR OF VERIFICATION: the safe domain of associative flow is convex")
    assert not [text for text in conclusions(made) if "carries at least" in text]
    record = study_json(made)
    assert record["domain"]["convex"] is False
    assert record["domain"]["least_everywhere"] is None


def test_every_key_of_the_record_is_described() -> None:
    record = study_json(study(around(4)))
    described = {key.path for key in INTERACT_RECORD}
    assert described == set(record) | {f"domain.{key}" for key in record["domain"]}


def test_no_line_leads_to_a_point_without_a_verified_factor() -> None:
    points = around(6)
    points[2] = replace(DOUBTFUL, angle=120.0)
    assert [[one.angle for one in run] for run in joined_runs(points, closed=True)] == [
        [180.0, 240.0, 300.0, 0.0, 60.0]
    ]
    assert [[one.angle for one in run] for run in joined_runs(points, closed=False)] == [
        [0.0, 60.0],
        [180.0, 240.0, 300.0],
    ]
    (whole,) = joined_runs(around(4), closed=True)
    assert [one.angle for one in whole] == [0.0, 90.0, 180.0, 270.0, 0.0]
