"""A sweep in words: how far it is; then least and greatest verified values, each point told once, failures."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mbla.sweeps.tables.sweep_table import sweep_table
from mbla.sweeps.words import SweepProgress, duration_words, failure_lines, result_lines
from tests.sweeps.pictures.hand_made import FALLEN, Row, grid
from tests.sweeps.tables import synthetic


def test_a_line_has_counts_rate_and_time_left() -> None:
    progress = SweepProgress(total=100, done=10, failed=1, seconds=4.5)
    assert progress.words() == "10 of 100 points, 1 failed, 45 s left"


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (0.2, "1 s"),
        (59.4, "59 s"),
        (61, "1 min 1 s"),
        (3599, "59 min 59 s"),
        (3600, "1 h 0 min"),
        (90061, "25 h 1 min"),
    ],
)
def test_durations_have_two_units_at_most(seconds: float, words: str) -> None:
    assert duration_words(seconds) == words


UNSURE = {"status": "not_verified", "load_factor": None, "static_bound": 9.0, "mechanism.class": None}


def two_bounds(mu: float) -> Row:
    """Bounds a little apart; at the last but one friction nothing stands, at the last the answer is not verified."""
    if mu == 0.8:
        return {"status": FALLEN["status"], "load_factor": None, "static_bound": None, "mechanism.class": None}
    if mu == 0.9:
        return UNSURE
    return {"status": "solved", "load_factor": mu, "static_bound": mu - 0.01, "mechanism.class": "sliding"}


def test_a_line_for_each_result_and_each_point_told_once() -> None:
    table = grid({"mu": [0.4, 0.3, 0.5, 0.8, 0.9]}, lambda mu: two_bounds(mu))
    lines = [" ".join(line.split()) for line in result_lines(table)]
    assert lines == [
        "status solved 3, no_equilibrium 1, not_verified 1",
        "mechanism.class sliding 3",
        "",
        "result least point greatest point without",
        "load_factor 0.3 2 0.5 3 2",
        "static_bound 0.29 2 0.49 3 2",  # and not the 9 of a point without a verified answer
        "point 2: mu 0.3",
        "point 3: mu 0.5",
        "",
    ]


def test_values_that_are_shown_alike_have_no_least_and_no_greatest_point() -> None:
    """The last digits of the solver do not make one point the weakest."""
    table = grid({"mu": [0.2, 0.3, 0.4]}, lambda mu: {"status": "solved", "load_factor": 0.25 + 1e-10 * mu})
    lines = [" ".join(line.split()) for line in result_lines(table)]
    assert "load_factor 0.25 all 0.25 all 0" in lines
    assert not any(line.startswith("point ") for line in lines)


def test_of_many_failures_the_first_are_told_and_the_others_counted() -> None:
    """The first five of seven, of which no reason is known."""
    found = synthetic.outcomes()
    failed = replace(found["key4"], reason="")
    design = synthetic.design()
    points = tuple(replace(point, number=i) for i, point in enumerate((*design.points, *design.points[:2]), 1))
    table = sweep_table("", replace(design, points=points), (), {"key": failed}, ["key"] * 7)
    lines = [" ".join(line.split()) for line in failure_lines(table)]
    assert len(lines) == 6
    assert lines[0] == "failed: point 1: mu 0.5, t 0.1 m, seed 4: no reason known"
    assert lines[-1] == "and 2 other failed points; column reason of sweep.csv has why"
