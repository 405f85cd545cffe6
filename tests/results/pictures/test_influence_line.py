"""Load factor of a travelling load over its position, above the section along its path."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.results.pictures.influence_line import draw_series
from mbla.results.pictures.options import PictureOptions
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
