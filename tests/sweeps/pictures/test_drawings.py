"""What stands in the pictures is what stands in the table."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.sweeps.answers import Answer
from mbla.sweeps.pictures.sheet import MARKS
from tests.sweeps.pictures.drawing import draw, lines_with, words
from tests.sweeps.pictures.hand_made import FAILED, FALLEN, UNBOUNDED, Row, grid, sample, table_of


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


def test_scatter_shows_each_point_once_in_each_diagram(tmp_path: Path, figures: list[Any]) -> None:
    mu, t = np.linspace(0.2, 1.0, 21), np.linspace(3.0, 4.0, 21)[::-1]
    table = sample({"mu": list(mu), "thickness": list(t)}, lambda mu, thickness: FALLEN if mu == 0.2 else mu)
    draw(table, tmp_path, "scatter")
    for axes, x, told in zip(figures[0].axes, (mu, t), ("+1.00", "-1.00"), strict=True):
        (points,) = [line for line in axes.lines if len(line.get_xdata()) == 20]
        assert points.get_xdata().tolist() == x[1:].tolist()
        assert points.get_ydata().tolist() == mu[1:].tolist()
        assert axes.get_title() == f"rank correlation {told}"
        assert lines_with(axes, "v")[0].get_data()[1].tolist() == [0.0]


def test_a_tornado_is_sorted(tmp_path: Path, figures: list[Any]) -> None:
    table = grid({"weak": [0.0, 1.0], "strong": [0.0, 1.0]}, lambda weak, strong: weak - 5 * strong)
    draw(table, tmp_path, "tornado")
    axes = figures[0].axes[0]
    bars = [bar.get_width() for bar in axes.patches]
    assert [text.get_text().split(",")[0] for text in axes.get_yticklabels()] == ["strong", "weak"]
    assert bars == [-5.0, 1.0]


def test_demands_stand_in_the_distribution(tmp_path: Path, figures: list[Any]) -> None:
    table = sample({"mu": list(np.linspace(0, 1, 30))}, lambda mu: mu)
    draw(table, tmp_path, "distribution", demands={"load_factor": (0.25,)})
    for axes in figures[0].axes:
        assert [0.25, 0.25] in [list(line.get_xdata()) for line in axes.lines]


def test_a_polar_curve_is_closed_and_broken_where_it_fails(tmp_path: Path, figures: list[Any]) -> None:
    turns = list(range(0, 360, 45))
    draw(grid({"azimuth": turns}, lambda azimuth: FAILED if azimuth == 90 else 1.0 + azimuth / 360), tmp_path, "polar")
    (axes,) = figures[0].axes
    (curve,) = [line for line in axes.lines if line.get_linestyle() == "-"]
    angle, radius = curve.get_data()
    assert np.degrees(angle).tolist() == pytest.approx([*turns, 360])
    assert radius[0] == radius[-1] == 1.0
    assert np.isnan(radius[2])
    assert np.degrees(lines_with(axes, "x")[0].get_xdata()).tolist() == pytest.approx([90.0])


def test_directions_of_a_sphere_have_the_colours_of_their_values(tmp_path: Path, figures: list[Any]) -> None:
    turns = [(0.0, 0.0), (120.0, 0.0), (240.0, 0.0), (0.0, 89.0), (0.0, -89.0)]
    rows = [{"azimuth": azimuth, "elevation": elevation} for azimuth, elevation in turns]
    table = table_of(rows, lambda azimuth, elevation: FALLEN if elevation < 0 else azimuth, [("to", 5)],
                     [(i,) for i in range(5)], {"azimuth": "to", "elevation": "to"})  # fmt: skip
    draw(table, tmp_path, "polar")
    axes = figures[0].axes[0]
    (dots,) = [each for each in axes.collections if each.get_array() is not None]
    assert dots.get_array().tolist() == [0.0, 120.0, 240.0, 0.0]
    assert dots.get_offsets().tolist() == [list(turn) for turn in turns[:4]]
    assert lines_with(axes, "v")[0].get_data()[1].tolist() == [-89.0]  # towards the nadir nothing stands
