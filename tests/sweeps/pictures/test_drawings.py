"""What stands in the pictures is what stands in the table."""

from pathlib import Path
from typing import Any

import numpy as np

from mbla.sweeps.answers import Answer
from mbla.sweeps.pictures.plot import Fragility
from mbla.sweeps.pictures.sheet import MARKS
from tests.sweeps.pictures.drawing import draw, lines_with, words
from tests.sweeps.pictures.hand_made import FAILED, FALLEN, UNBOUNDED, Row, grid, sample


def arch(mu: float, thickness: float) -> Row | float:
    """Falls, has no collapse, or fails at a corner each."""
    corner = {(0.2, 0.1): FALLEN, (0.8, 0.3): UNBOUNDED, (0.4, 0.2): FAILED}
    return corner.get((mu, thickness), mu * thickness)


ARCH = {"mu": [0.2, 0.4, 0.6, 0.8], "thickness": [0.1, 0.2, 0.3]}


def test_curves_are_the_table_and_break_where_a_point_has_no_value(tmp_path: Path, figures: list[Any]) -> None:
    draw(grid(ARCH, arch), tmp_path, "curve")
    (axes,) = figures[0].axes
    curves = [line for line in axes.lines if line.get_linestyle() == "-" and len(line.get_xdata()) == 4]
    for line, thickness in zip(curves, ARCH["thickness"], strict=True):
        expected = [value if isinstance(value := arch(mu, thickness), float) else np.nan for mu in ARCH["mu"]]
        assert line.get_xdata().tolist() == ARCH["mu"]
        assert np.array_equal(line.get_ydata(), expected, equal_nan=True)
    assert "12 points: 9 with a verified value" in words(figures[0])


def test_marks_stand_where_points_have_no_value(tmp_path: Path, figures: list[Any]) -> None:
    draw(grid(ARCH, arch), tmp_path, "curve")
    (axes,) = figures[0].axes
    at = {
        kind: [tuple(np.ravel(line.get_data())) for line in lines_with(axes, MARKS[kind].marker)]
        for kind in (Answer.NO_EQUILIBRIUM, Answer.UNBOUNDED, Answer.FAILED)
    }
    assert at == {Answer.NO_EQUILIBRIUM: [(0.2, 0.0)], Answer.UNBOUNDED: [(0.8, 1.0)], Answer.FAILED: [(0.4, 0.0)]}
    fallen = lines_with(axes, "v")[0]
    assert fallen.get_transform() == axes.transData  # at zero of the load factor; the others at the edges
    named = [text.get_text() for text in figures[0].legends[0].get_texts()]
    assert named[-3:] == ["no equilibrium (does not stand)", "unbounded (no collapse)", "failed"]


def test_cells_of_a_map_are_the_table(tmp_path: Path, figures: list[Any]) -> None:
    draw(grid(ARCH, arch), tmp_path, "map")
    axes = figures[0].axes[0]
    cells = axes.collections[0].get_array()
    expected = [
        [arch(mu, t) if isinstance(arch(mu, t), float) else None for mu in ARCH["mu"]] for t in ARCH["thickness"]
    ]
    assert cells.reshape(3, 4).tolist() == expected
    at = {
        kind: [tuple(np.ravel(line.get_data())) for line in lines_with(axes, MARKS[kind].marker)]
        for kind in (Answer.NO_EQUILIBRIUM, Answer.UNBOUNDED, Answer.FAILED)
    }
    assert at == {Answer.NO_EQUILIBRIUM: [(0.2, 0.1)], Answer.UNBOUNDED: [(0.8, 0.3)], Answer.FAILED: [(0.4, 0.2)]}


def test_demands_stand_in_the_distribution(tmp_path: Path, figures: list[Any]) -> None:
    table = sample({"mu": list(np.linspace(0, 1, 30))}, lambda mu: mu)
    known = Fragility(({"result": "load_factor", "demands": [{"demand": 0.25}]},))
    draw(table, tmp_path, "distribution", known=known)
    for axes in figures[0].axes:
        assert [0.25, 0.25] in [list(line.get_xdata()) for line in axes.lines]


def test_a_curve_over_the_azimuth_is_broken_where_it_fails(tmp_path: Path, figures: list[Any]) -> None:
    turns = list(range(0, 360, 45))
    draw(grid({"azimuth": turns}, lambda azimuth: FAILED if azimuth == 90 else 1.0 + azimuth / 360), tmp_path, "curve")
    (axes,) = figures[0].axes
    (curve,) = [line for line in axes.lines if line.get_linestyle() == "-"]
    assert curve.get_xdata().tolist() == turns
    assert np.isnan(curve.get_ydata()).tolist() == [angle == 90 for angle in turns]
    assert lines_with(axes, "x")[0].get_xdata().tolist() == [90.0]
