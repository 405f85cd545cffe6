from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from mbla.results.pictures.history import _keep_to_the_middle, draw_curve, draw_history
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.scene import scene_of
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import Status
from tests.results.changed_files import with_curve
from tests.results.synthetic import full_results, tower_results


def texts(path: Path) -> list[str]:
    nodes = ElementTree.parse(path).iter("{http://www.w3.org/2000/svg}text")
    return [" ".join("".join(node.itertext()).split()) for node in nodes]


def history(tmp_path: Path, results: Results, case: CaseResult) -> list[str]:
    path = tmp_path / "history.svg"
    draw_history(path, scene_of(results, case, PictureOptions(), "history"), PictureOptions())
    return texts(path)


def test_iterations_have_their_residuals(tmp_path: Path) -> None:
    results = tower_results()
    shown = history(tmp_path, results, results.cases[0])
    assert {"gap", "primal residual", "dual residual", "iteration", "load factor 0.5"} <= set(shown)
    assert "displacement of the path over the elastic one" not in shown


@pytest.mark.parametrize("answer", [0.5, 40.0])
def test_the_answer_is_in_sight_of_the_diagram(answer: float) -> None:
    """Iterates of later programs may be far from it: here all end at 0."""
    from matplotlib.figure import Figure

    axes = Figure().add_subplot()
    _keep_to_the_middle(axes, np.array([0.4, 0.5, 0.0, 0.0, 0.0]), answer)
    low, high = axes.get_ylim()
    assert low <= 0 < answer <= high


def test_path_of_elastic_joints_where_there_is_one(tmp_path: Path) -> None:
    results = full_results()
    shown = history(tmp_path, results, results.cases[0])
    assert {"displacement of the path over the elastic one", "open", "sliding", "contact points"} <= set(shown)
    assert "joints begin to slip: 0.6" in shown


def test_case_without_iterations_says_so(tmp_path: Path) -> None:
    results = tower_results()
    shown = history(tmp_path, results, results.cases[1])
    assert "no iterations to draw: the case was decided without a cone program" in shown


@pytest.mark.long
def test_a_case_without_a_load_factor_has_none_in_its_diagram(tmp_path: Path) -> None:
    """Its only program found no load factor either: residuals are drawn, no line of an answer."""
    results = tower_results()
    solution = results.cases[0].solution
    programs = (replace(solution.programs[0], load_factor=float("nan")),)
    case = replace(results.cases[0], solution=replace(solution, mechanics=None, programs=programs))
    shown = history(tmp_path, results, replace(case, status=Status.NOT_VERIFIED))
    assert {"gap", "primal residual", "dual residual", "iteration"} <= set(shown)
    assert not any(text.startswith(("load factor 0", "not a result")) for text in shown)


@pytest.mark.parametrize("pushed", [True, False])
def test_a_curve_says_which_steps_are_not_verified(tmp_path: Path, pushed: bool) -> None:
    results = full_results()
    case = results.cases[0 if pushed else 1]
    if pushed:
        first, last = case.solution.further.pushover.curve
        case = with_curve(case, (first, replace(last, residual=0.1)))
    path = tmp_path / "curve.svg"
    draw_curve(path, scene_of(results, case, PictureOptions(), "curve"), PictureOptions())
    shown = " ".join(texts(path))
    assert ("NOT VERIFIED: 1 of 2 steps, hollow" in shown) is pushed
    assert ("the load case has no pushover" in shown) is not pushed
    assert ("displacement of the support [m]" in shown) is pushed
