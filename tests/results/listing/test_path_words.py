from dataclasses import replace

from mbla.results.listing.solving import path_lines
from mbla.results.listing.text import MOST_ROWS
from mbla.solution.solution import PathPoint
from tests.results.synthetic import tower_model, tower_results

MODEL = tower_model()
CASE = tower_results().cases[0]


def lines_of(*path: PathPoint) -> list[str]:
    return path_lines(MODEL, replace(CASE, solution=replace(CASE.solution, path=path)))


def test_no_path_no_lines() -> None:
    assert lines_of() == []


def test_a_long_path_shows_where_modes_change_and_says_what_it_leaves_out() -> None:
    quiet = [PathPoint(i, 0.001 * i, 0, 0, 1e-9) for i in range(100)]
    quiet[60:] = [replace(point, open=2) for point in quiet[60:]]
    lines = lines_of(*quiet)
    rows = [line.split() for line in lines if line.split() and line.split()[0].isdigit()]
    assert [row[0] for row in rows] == ["0", "60", "99"]
    assert "and 97 steps more" in lines[-1]


def test_a_path_of_many_changes_is_thinned_but_keeps_peak_and_ends() -> None:
    factors = [0.001 * i for i in range(300)]
    factors[150] = 1.0
    lines = lines_of(*(PathPoint(i, factor, i, 0, 1e-9) for i, factor in enumerate(factors)))
    rows = [line.split()[0] for line in lines if line.split() and line.split()[0].isdigit()]
    assert len(rows) == MOST_ROWS
    assert {"0", "150", "299"} <= set(rows)
