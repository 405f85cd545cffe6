"""What a picture of a sweep is made from: results, axes, points of equal values, answers of points."""

from typing import Any

import numpy as np
import pytest

from mbla.sweeps.answers import Answer, answers_of
from mbla.sweeps.pictures.plot import SweepPictures, pictures_of
from mbla.sweeps.pictures.sheet import count_words
from mbla.sweeps.pictures.view import (
    NO_POINT,
    axis_of,
    chosen_results,
    column_by_name,
    grid_axes,
    is_sampled,
    pooled,
    several,
    view_of,
)
from tests.sweeps.pictures.hand_made import FAILED, FALLEN, UNBOUNDED, Row, grid, sample, table_of


def test_the_map_of_classes_is_made_of_itself_alone_where_no_result_is_named() -> None:
    table = grid({"mu": [1.0, 2.0, 3.0], "thickness": [1.0, 2.0, 3.0]}, lambda mu, thickness: mu)
    named = pictures_of(table, SweepPictures(result="load_factor"))
    assert [picture.name for picture in named] == ["curve_load_factor", "map_load_factor"]
    usual = pictures_of(table, SweepPictures())
    assert [picture.name for picture in usual] == [*(picture.name for picture in named), "map_mechanism.class"]


@pytest.mark.parametrize(
    ("levels", "log"),
    [
        ([1e6, 1e7, 1e8], True),
        ([1.0, 2.0, 4.0], False),
        (list(np.linspace(0.1, 0.9, 7)), False),
        ([-1.0, -10.0, -100.0], False),
    ],
)
def test_values_far_apart_are_a_log_axis(levels: list[float], log: bool) -> None:
    table = grid({"k": levels}, lambda k: k)
    assert axis_of(table, column_by_name(table, "k")).log is log


def test_numbers_ascend_and_texts_keep_the_order_of_the_design() -> None:
    table = grid({"mu": [0.7, 0.5], "bond": ["stack", "running"]}, lambda mu, bond: mu)
    mu, bond = grid_axes(table)
    assert mu.levels == (0.5, 0.7)
    assert mu.place.tolist() == [1, 1, 0, 0]
    assert bond.levels == ("stack", "running")
    assert bond.categorical


def test_parameters_that_change_together_are_one_axis() -> None:
    rows = [{"mu": 0.1 * i, "thickness": 0.2 * i} for i in range(1, 4)]
    table = table_of(rows, lambda mu, thickness: mu, [("zip", 3)], [(i,) for i in range(3)],
                     {"mu": "zip", "thickness": "zip"})  # fmt: skip
    (axis,) = grid_axes(table)
    assert axis.label == "mu, with thickness"


def test_samples_are_no_axis() -> None:
    drawn = {"mu": [0.1, 0.5, 0.3]}
    assert grid_axes(sample(drawn, lambda mu: mu)) == ()
    table = sample(drawn, lambda mu: mu, "sobol", samples="")
    assert is_sampled(table, "sobol")  # of a range without a distribution
    assert not is_sampled(grid({"sobol": [1.0, 2.0]}, lambda sobol: sobol), "sobol")  # a parameter of that name


def cell_of(*rows: Row | float) -> Any:
    """Several points of one value of ``mu``."""
    table = grid({"mu": [0.5, 0.6], "case": [float(i) for i in range(len(rows))]}, lambda mu, case: rows[int(case)])
    view = view_of(table, chosen_results(table, None)[0])
    return pooled(view.answers, [axis for axis in view.axes if axis.column.name == "mu"])[0]


def test_one_point_of_each_cell_is_itself() -> None:
    table = grid({"mu": [0.2, 0.4], "thickness": [1.0, 2.0, 3.0]}, lambda mu, thickness: mu * thickness)
    view = view_of(table, chosen_results(table, None)[0], by="mu")
    cells = pooled(view.answers, view.axes)
    assert np.allclose(cells.value, np.outer([0.2, 0.4], [1.0, 2.0, 3.0]), rtol=1e-15)
    assert not several(cells)


def test_a_point_left_out_is_no_point() -> None:
    rows = [{"mu": 0.2, "thickness": 1.0}, {"mu": 0.4, "thickness": 1.0}, {"mu": 0.4, "thickness": 2.0}]
    table = table_of(rows, lambda mu, thickness: mu, [("mu", 2), ("thickness", 2)], [(0, 0), (1, 0), (1, 1)],
                     {"mu": "mu", "thickness": "thickness"})  # fmt: skip
    view = view_of(table, chosen_results(table, None)[0], by="mu")
    cells = pooled(view.answers, view.axes)
    assert cells.answer.tolist() == [[Answer.VALUE, NO_POINT], [Answer.VALUE, Answer.VALUE]]
    assert np.isnan(cells.value[0, 1])


@pytest.mark.parametrize(
    ("rows", "answer", "median"),
    [
        ((0.1, 0.3, 0.2), Answer.VALUE, 0.2),
        ((0.1, FALLEN, 0.2), Answer.VALUE, 0.1),
        ((0.1, FALLEN, FALLEN), Answer.NO_EQUILIBRIUM, np.nan),
        ((0.1, UNBOUNDED, UNBOUNDED), Answer.UNBOUNDED, np.nan),
        ((0.1, FAILED, 0.2, 0.3), Answer.PARTLY, 0.2),
        ((0.1, FAILED, FAILED), Answer.PARTLY, 0.1),
        ((FAILED, FAILED, FAILED), Answer.FAILED, np.nan),
    ],
)
def test_medians_in_rank(rows: tuple[Row | float, ...], answer: Answer, median: float) -> None:
    cell = cell_of(*rows)
    assert cell.answer == answer
    assert cell.value == pytest.approx(median, rel=1e-15, nan_ok=True)


SLIDES, HINGES = ({"status": "solved", "load_factor": 0.5, "mechanism.class": name} for name in ("sliding", "hinging"))


@pytest.mark.parametrize(
    ("rows", "answer", "place"),
    [
        ((SLIDES, SLIDES), Answer.VALUE, 1.0),
        ((SLIDES, HINGES), Answer.MIXED, np.nan),
        ((SLIDES, FALLEN), Answer.MIXED, np.nan),
        ((FALLEN, FALLEN), Answer.NO_EQUILIBRIUM, np.nan),
        ((FALLEN, FAILED), Answer.MIXED, np.nan),
    ],
)
def test_texts_of_several_points_are_a_text_where_all_have_it(
    rows: tuple[Row, ...], answer: Answer, place: float
) -> None:
    """Beside them are points that hinge, which comes before sliding in the alphabet."""
    table = grid({"mu": [0.5, 0.6], "case": [0.0, 1.0]}, lambda mu, case: rows[int(case)] if mu == 0.5 else HINGES)
    view = view_of(table, chosen_results(table, "mechanism.class")[0], by="mu")
    cell = pooled(view.answers, view.axes[:1])[0]
    assert cell.answer == answer
    assert [cell.value, cell.low, cell.high] == pytest.approx([place] * 3, nan_ok=True)


STATES: dict[str, dict[str, Any]] = {
    "solved": {"status": "solved", "load_factor": 0.5, "static_bound": 0.49},
    "fallen": {**FALLEN, "static_bound": None},
    "unbounded": {**UNBOUNDED, "static_bound": None},
    "failed": {**FAILED, "static_bound": None},
    "unsure": {"status": "not_verified", "load_factor": None, "static_bound": 0.3},
    "none": {"status": "solved", "load_factor": None, "static_bound": None},
    "not run": {"status": None, "load_factor": None, "static_bound": None},
}


def states(state: str) -> Row:
    row = {"status": None, "load_factor": None, "static_bound": None, "mechanism.class": None} | STATES[state]
    return {name: row[name] for name in ("status", "load_factor", "static_bound", "mechanism.class")}


def test_each_point_has_its_answer() -> None:
    table = grid({"state_of": list(STATES)}, lambda state_of: states(state_of))
    found = answers_of(table, chosen_results(table, None)[0])
    assert found.answer.tolist() == [
        Answer.VALUE, Answer.NO_EQUILIBRIUM, Answer.UNBOUNDED, Answer.FAILED, Answer.FAILED, Answer.NONE,
        Answer.NOT_RUN,
    ]  # fmt: skip


def test_a_bound_of_a_point_that_is_not_verified_is_not_verified() -> None:
    table = grid({"state_of": list(STATES)}, lambda state_of: states(state_of))
    found = answers_of(table, chosen_results(table, "static_bound")[0])
    assert found.answer[4] == Answer.UNVERIFIED
    assert found.values[4] == 0.3
    assert found.good.tolist() == [True, False, False, False, False, False, False]


def test_counts_name_every_answer() -> None:
    table = grid({"state_of": list(STATES)}, lambda state_of: states(state_of))
    words = count_words(answers_of(table, chosen_results(table, None)[0]))
    assert words == (
        "7 points: 1 with a verified value, 1 no equilibrium (does not stand), 1 unbounded (no collapse), "
        "1 has no such value, 2 failed, 1 not solved yet"
    )


def test_texts_are_places_among_categories() -> None:
    table = grid({"state_of": ["solved", "fallen", "solved"]}, lambda state_of: states(state_of))
    found = answers_of(table, chosen_results(table, "status")[0])
    assert found.categories == ("no_equilibrium", "solved")
    assert found.values.tolist() == [1.0, 0.0, 1.0]
    assert found.good.all()  # that nothing stands is what the column says, not a value that it lacks
