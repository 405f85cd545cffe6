"""Lines, bands, scales and notes of curves."""

from pathlib import Path
from typing import Any

from tests.sweeps.drawn import names_in_legend
from tests.sweeps.pictures.drawing import draw, words
from tests.sweeps.pictures.hand_made import Row, grid, sphere


def curves(axes: Any) -> list[Any]:
    return [line for line in axes.lines if line.get_linestyle() == "-" and len(line.get_xdata()) > 2]


def test_each_value_of_a_third_parameter_has_its_diagram(tmp_path: Path, figures: list[Any]) -> None:
    levels = {"mu": [1.0, 2.0, 3.0, 4.0, 5.0], "height": [1.0, 2.0, 3.0, 4.0], "thickness": [0.1, 0.2, 0.3]}
    draw(grid(levels, lambda mu, height, thickness: mu + 10 * height + 100 * thickness), tmp_path, "curve")
    first, *_, bare = figures[0].axes
    titles = [axes.get_title() for axes in figures[0].axes]
    assert titles == ["thickness 0.1 m", "thickness 0.2 m", "thickness 0.3 m", ""]
    assert not bare.axison
    assert [line.get_ydata().tolist() for line in curves(first)] == [
        [mu + 10 * height + 100 * 0.1 for mu in levels["mu"]] for height in levels["height"]
    ]
    assert names_in_legend(figures[0]) == ["height 1", "height 2", "height 3", "height 4"]


def test_of_several_points_a_line_is_the_median_and_the_band_their_range(tmp_path: Path, figures: list[Any]) -> None:
    """Over a sphere of directions."""

    def solve(mu: float, to_azimuth: float, to_elevation: float) -> Row:
        return {"status": "solved", "load_factor": mu + to_azimuth}

    draw(sphere([(0.0, 0.0), (100.0, 30.0), (150.0, 60.0)], {"mu": [1.0, 2.0]}, solve), tmp_path, "curve")
    (axes,) = figures[0].axes
    (line,) = [line for line in axes.lines if len(line.get_xdata()) == 2]
    assert line.get_ydata().tolist() == [101.0, 102.0]
    band = axes.collections[0].get_paths()[0].vertices
    assert {tuple(each) for each in band} == {(1.0, 1.0), (1.0, 151.0), (2.0, 2.0), (2.0, 152.0)}
    assert "line: median of up to 3 points of the other parameters band: least to greatest" in words(figures[0])


def test_values_far_apart_have_a_log_axis(tmp_path: Path, figures: list[Any]) -> None:
    draw(grid({"k": [1e6, 1e7, 1e8]}, lambda k: k), tmp_path, "curve")
    (axes,) = figures[0].axes
    assert axes.get_xscale() == "log"
