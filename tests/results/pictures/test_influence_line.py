"""Load factor of a travelling load over its position, above the section along its path."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import mbla
from mbla.results.pictures.influence_line import draw_series
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import SLIDE, SOIL
from mbla.results.pictures.scene import scene_of
from mbla.results.series import series_of
from mbla.solution.solution import Status
from tests.results.pictures.test_history import texts
from tests.results.synthetic import standing_at, tower_results

V, U, N, A = Status.SOLVED, Status.UNBOUNDED, Status.NOT_VERIFIED, Status.APPROXIMATE


@pytest.mark.parametrize(
    ("statuses", "shown", "hidden"),
    [
        ((V, U, N, V), {"no result", "any multiple is carried", "position along the path [m]",
                        "NOT VERIFIED: 1 of 4 positions without a result"}, {"worst"}),
        ((V, U, V), {"worst at position 3, at (2, 0, 0) m: 0.4", "worst"}, {"no result"}),
        ((U, U, U, U), {"any multiple is carried"}, {"no result", "worst", "approximate"}),
        ((V, A, V, V), {"load factor", "approximate", "worst"}, {"no result"}),
    ],
)  # fmt: skip
def test_series_shows_what_is_known_of_every_position(
    tmp_path: Path, statuses: tuple[Status, ...], shown: set[str], hidden: set[str]
) -> None:
    """The worst is not known while one position has no result."""
    results = tower_results()
    case = results.cases[0]
    mechanics = case.solution.mechanics
    assert mechanics is not None
    cases = []
    for i, status in enumerate(statuses):
        travel = standing_at(i + 1, len(statuses), np.array([float(i), 0, 0]), 1.5 * i)
        found = replace(mechanics, load_factor=0.4 if i + 1 == len(statuses) else 0.5)
        solution = replace(case.solution, mechanics=found, flow_rule="associative")
        load_case = replace(case.load_case, name=f"train@{i + 1}", question=travel)
        cases.append(replace(case, load_case=load_case, solution=solution, status=status))
    results = replace(results, cases=tuple(cases))
    scene = scene_of(results, cases[0], PictureOptions(), "history")
    draw_series(tmp_path / "series.svg", scene, series_of(results.cases)[0], PictureOptions())
    found_texts = set(texts(tmp_path / "series.svg"))
    assert shown <= found_texts
    assert not hidden & found_texts


@pytest.mark.parametrize(
    ("points", "section"),
    [
        ([[0.0, 0.3, 3.0], [0.8, 0.3, 3.0]], True),
        ([[0.0, 9.0, 3.0], [0.8, 9.0, 3.0]], False),  # beside the tower
        ([[0.0, 0.3, 3.0], [0.2, 0.9, 3.0]], False),  # distances that are not those of a straight path
    ],
)
def test_beneath_is_the_section_along_a_straight_path(tmp_path: Path, points: list[list[float]], section: bool) -> None:
    results = tower_results()
    case = results.cases[0]
    cases = []
    for i, point in enumerate(points):
        travel = standing_at(i + 1, len(points), np.array(point), 0.8 * i)
        cases.append(replace(case, load_case=replace(case.load_case, name=f"train@{i + 1}", question=travel), status=V))
    results = replace(results, cases=tuple(cases))
    scene = scene_of(results, cases[0], PictureOptions(), "history")
    draw_series(tmp_path / "series.svg", scene, series_of(results.cases)[0], PictureOptions())
    found = set(texts(tmp_path / "series.svg"))
    assert {"position along the path [m]", "worst"} <= found
    assert ("section along the path, with the position where it is worst" in found) is section


def drawn(folder: Path, factors: list[float]) -> list[str]:
    """Texts of the picture of positions with these load factors; that of infinity is unbounded."""
    results = tower_results()
    case = results.cases[0]
    assert case.solution.mechanics is not None
    cases = []
    for i, factor in enumerate(factors):
        travel = standing_at(i + 1, len(factors), np.array([float(i), 0, 0]), 1.5 * i)
        found = replace(case.solution.mechanics, load_factor=factor)
        load_case = replace(case.load_case, name=f"train@{i + 1}", question=travel)
        solution = replace(case.solution, mechanics=found, flow_rule="associative")
        status = V if np.isfinite(factor) else U
        cases.append(replace(case, load_case=load_case, solution=solution, status=status))
    results = replace(results, cases=tuple(cases))
    scene = scene_of(results, cases[0], PictureOptions(), "history")
    draw_series(folder / "series.svg", scene, series_of(results.cases)[0], PictureOptions())
    return texts(folder / "series.svg")


def test_positions_with_hardly_any_load_do_not_flatten_the_rest(tmp_path: Path) -> None:
    """The axis ends at a multiple of the least, and says how far the rest goes."""
    assert "above the axis, up to 113.7" in drawn(tmp_path, [2.06, 113.7, 2.21])
    assert not {text for text in drawn(tmp_path, [2.0, 19.0, 3.0]) if text.startswith("above")}


def test_without_any_load_factor_the_axis_has_no_figures(tmp_path: Path) -> None:
    found = drawn(tmp_path, [np.inf, np.inf])
    assert "any multiple is carried" in found
    assert found.count("0.2") == 1, "of the position"


SOIL_DECK = """mbla: 1
materials: {stone: {density: 2000}, earth: {density: 1800}}
joints: {dry: {friction: 0.6}}
blocks:
  - box: {group: base, material: stone, min: [0, 0, 0], max: [3, 1, 1]}
contacts: {joint: dry}
supports: [{blocks: base}]
fill: {soil: {on: base, material: earth, level: 2, cells: {size: 0.4}, friction_angle: 10}}
load_cases:
  lorry:
    live: [{travel: {force: [0, 0, -1], contact: 0.3, width: 0.8, path: [[0.6, 0.5, 2], [2.4, 0.5, 2]], positions: 3}}]
analysis: {flow_rule: associative}
"""


def test_soil_of_cells_in_one_tone_with_slip_lines_of_the_worst(tmp_path: Path) -> None:
    results = mbla.run(SOIL_DECK).records
    scene = scene_of(results, results.cases[0], PictureOptions(), "history")
    draw_series(tmp_path / "series.svg", scene, series_of(results.cases)[0], PictureOptions())
    assert {"soil", "slip line where it is worst"} <= set(texts(tmp_path / "series.svg"))
    svg = (tmp_path / "series.svg").read_text().lower()
    assert svg.count(f"fill: {SOIL.lower()}") >= 1
    assert svg.count(f"stroke: {SLIDE.lower()}") > 1  # besides the one of the legend
