"""A finished sweep in words: least and greatest verified values, each point told once, failures with their reasons."""

from __future__ import annotations

from mbla.results.words.text import WIDTH
from mbla.studies.sweep.words import NAMED, result_lines
from tests.studies.sweep.pictures.hand_made import FALLEN, Row, grid

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
    assert "load_factor 0.25 all 0.25 all" in lines
    assert not any(line.startswith("point ") for line in lines)


def test_the_first_of_points_that_cannot_be_told_apart_is_named() -> None:
    """So that two results that have their least value at the same point name the same one."""
    table = grid({"mu": [0.2, 0.3, 0.4]}, lambda mu: {"status": "solved", "load_factor": max(0.3, mu) - 1e-9 * mu})
    assert "load_factor 0.3 1 0.4 3" in [" ".join(line.split()) for line in result_lines(table)]


def test_no_verified_value_at_all() -> None:
    table = grid({"mu": [0.8, 0.9]}, lambda mu: two_bounds(mu))
    lines = [" ".join(line.split()) for line in result_lines(table)]
    assert "load_factor - - - - 2" in lines
    assert not any(line.startswith("point ") for line in lines)


def test_many_extreme_points_are_counted_and_every_line_has_room() -> None:
    """Each of ten results is least and greatest at points of its own."""

    def solve(n: int) -> Row:
        results = {f"result_{i}": float(abs(n - 2 * i) if n // 2 == i else 0.5) for i in range(10)}
        return {"status": "solved", "load_factor": 1.0, "mechanism.class": "sliding", **results}

    lines = result_lines(grid({"n": list(range(20)), "name": ["a" * 40]}, lambda n, name: solve(n)))
    assert sum(line.startswith("  point ") for line in lines) == NAMED
    assert "  14 further points: see sweep.csv" in lines
    assert max(map(len, lines)) <= WIDTH
