import numpy as np
import pytest

from mbla.sweeps.answers import Answer
from mbla.sweeps.pictures.view import NO_POINT, Cells, chosen_results, pooled, several, view_of
from tests.sweeps.pictures.hand_made import FAILED, FALLEN, UNBOUNDED, Row, grid, table_of


def cell_of(*rows: Row | float) -> Cells:
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
        ((0.1, FAILED, FAILED), Answer.FAILED, np.nan),  # either of them may be the median
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
