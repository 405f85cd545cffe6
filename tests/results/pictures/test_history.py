from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from mbla.results.pictures.history import MOST_NAMED, _keep_to_the_middle, draw_history, draw_series
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.scene import scene_of
from mbla.results.results import CaseResult, Results
from mbla.results.series import series_of
from mbla.solution.solution import IterationRecord, ProgramRecord, Status
from tests.results.synthetic import full_results, standing_at, tower_results


def texts(path: Path) -> list[str]:
    nodes = ElementTree.parse(path).iter("{http://www.w3.org/2000/svg}text")
    return [" ".join("".join(node.itertext()).split()) for node in nodes]


def history(tmp_path: Path, results: Results, case: CaseResult) -> list[str]:
    path = tmp_path / "history.svg"
    draw_history(path, scene_of(results, case, PictureOptions(), "history"), PictureOptions())
    return texts(path)


def test_iterations_are_named_by_their_program(tmp_path: Path) -> None:
    results = tower_results()
    shown = history(tmp_path, results, results.cases[0])
    assert {"1 associative", "gap", "primal residual", "dual residual", "iteration", "load factor 0.5"} <= set(shown)
    assert "step of the load path" not in shown


@pytest.mark.parametrize("answer", [0.5, 40.0])
def test_the_answer_is_in_sight_of_the_diagram(answer: float) -> None:
    """Iterates of later programs may be far from it: here all end at 0."""
    from matplotlib.figure import Figure

    axes = Figure().add_subplot()
    _keep_to_the_middle(axes, np.array([0.4, 0.5, 0.0, 0.0, 0.0]), answer)
    low, high = axes.get_ylim()
    assert low <= 0 < answer <= high


def test_load_path_where_there_is_one(tmp_path: Path) -> None:
    results = full_results()
    shown = history(tmp_path, results, results.cases[0])
    assert {"step of the load path", "open", "sliding", "contact points"} <= set(shown)


def test_case_without_iterations_says_so(tmp_path: Path) -> None:
    results = tower_results()
    shown = history(tmp_path, results, results.cases[1])
    assert "no iterations to draw: the case was decided without a cone program" in shown


def series_results() -> Results:
    """Four positions: solved, unbounded, not verified, solved."""
    results = tower_results()
    case = results.cases[0]
    mechanics = case.solution.mechanics
    assert mechanics is not None
    cases = []
    for i, (status, factor) in enumerate(
        [(Status.SOLVED, 0.5), (Status.UNBOUNDED, 0.0), (Status.NOT_VERIFIED, 9.0), (Status.SOLVED, 0.4)]
    ):
        travel = standing_at(i + 1, 4, np.array([float(i), 0, 0]), 1.5 * i)
        solution = replace(case.solution, mechanics=replace(mechanics, load_factor=factor), flow_rule="associative")
        load_case = replace(case.load_case, name=f"train@{i + 1}", travel=travel)
        cases.append(replace(case, load_case=load_case, solution=solution, status=status))
    return replace(results, cases=tuple(cases))


def test_series_shows_what_is_known_of_every_position(tmp_path: Path) -> None:
    results = series_results()
    path = tmp_path / "series.svg"
    scene = scene_of(results, results.cases[0], PictureOptions(), "history")
    draw_series(path, scene, series_of(results.cases)[0], PictureOptions())
    shown = texts(path)
    assert {"no result", "any multiple is carried", "position along the path [m]"} <= set(shown)
    assert "NOT VERIFIED: 1 of 4 positions without a result" in shown
    assert "worst" not in shown, "not known while one position has no result"


def test_worst_position(tmp_path: Path) -> None:
    results = series_results()
    results = replace(results, cases=tuple(case for case in results.cases if case.status is not Status.NOT_VERIFIED))
    path = tmp_path / "series.svg"
    scene = scene_of(results, results.cases[0], PictureOptions(), "history")
    draw_series(path, scene, series_of(results.cases)[0], PictureOptions())
    assert "worst at position 4, at (3, 0, 0) m: 0.4" in texts(path)


def test_a_case_without_a_load_factor_has_none_in_its_diagram(tmp_path: Path) -> None:
    """Its only program found no load factor either: residuals are drawn, no line of an answer."""
    results = tower_results()
    solution = results.cases[0].solution
    programs = (replace(solution.programs[0], load_factor=float("nan")),)
    case = replace(results.cases[0], solution=replace(solution, mechanics=None, programs=programs))
    shown = history(tmp_path, results, replace(case, status=Status.NOT_VERIFIED))
    assert {"gap", "primal residual", "dual residual", "iteration", "1 associative"} <= set(shown)
    assert not any(text.startswith(("load factor 0", "not a result")) for text in shown)


def test_of_many_programs_those_with_room_are_named(tmp_path: Path) -> None:
    """One iteration each: every second name is left out."""
    results, count = tower_results(), 2 * MOST_NAMED
    solution = results.cases[0].solution
    record = ProgramRecord(1, "published", Status.SOLVED, 0.5, 1e-6, 1, 0.01, "clarabel", "qdldl")
    programs = tuple(replace(record, program=i + 1) for i in range(count))
    iterations = tuple(IterationRecord(i + 1, 0, 0.5, 0.1, 1e-3, 1e-4, 0.9, 0.001) for i in range(count))
    case = replace(results.cases[0], solution=replace(solution, programs=programs, iterations=iterations))
    shown = history(tmp_path, results, case)
    assert [text for text in shown if text.endswith(" published")] == [
        f"{number} published" for number in range(1, count, 2)
    ]


def test_series_in_which_every_position_is_carried(tmp_path: Path) -> None:
    results = series_results()
    results = replace(results, cases=tuple(replace(case, status=Status.UNBOUNDED) for case in results.cases))
    path = tmp_path / "series.svg"
    scene = scene_of(results, results.cases[0], PictureOptions(), "history")
    draw_series(path, scene, series_of(results.cases)[0], PictureOptions())
    shown = texts(path)
    assert "any multiple is carried" in shown
    assert not {"no result", "worst", "approximate"} & set(shown)
    assert not any(text.startswith(("NOT VERIFIED", "worst at")) for text in shown)


def test_a_position_with_larger_residuals_is_told_apart(tmp_path: Path) -> None:
    results = series_results()
    statuses = (Status.SOLVED, Status.APPROXIMATE, Status.SOLVED, Status.SOLVED)
    cases = tuple(replace(case, status=status) for case, status in zip(results.cases, statuses, strict=True))
    path = tmp_path / "series.svg"
    scene = scene_of(results, cases[0], PictureOptions(), "history")
    draw_series(path, scene, series_of(cases)[0], PictureOptions())
    assert {"load factor", "approximate", "worst"} <= set(texts(path))
