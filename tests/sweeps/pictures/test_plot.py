"""Which pictures are made, refused, and where they go."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.cli import main
from mbla.errors import UsageError
from mbla.results.pictures.options import PictureOptions
from mbla.sweeps.fragility import Asked, fragility_of
from mbla.sweeps.pictures.plot import SweepPictures, pictures_of
from mbla.sweeps.tables.sweep_table import SweepTable
from mbla.sweeps.tables.write_tables import StudyResult, write_tables
from tests.sweeps.pictures.hand_made import FAILED, grid, sample, sphere
from tests.sweeps.tables.synthetic import record, table

pytest.importorskip("matplotlib")
SMALL = PictureOptions(size=(400, 300))


def names(swept: SweepTable, **changes: Any) -> list[str]:
    return [picture.name for picture in pictures_of(swept, SweepPictures(**changes))]


def plane(points: int = 4) -> SweepTable:
    levels = list(np.linspace(0.2, 0.8, points))
    return grid({"mu": levels, "thickness": levels}, lambda mu, thickness: mu * thickness)


def drawn(points: int = 20) -> SweepTable:
    rng = np.random.default_rng(1)
    return sample({"mu": list(rng.uniform(size=points)), "thickness": list(rng.uniform(size=points))},
                  lambda mu, thickness: mu + thickness)  # fmt: skip


def test_kinds_suit_the_table() -> None:
    assert names(plane()) == ["curve_load_factor", "map_load_factor", "map_mechanism.class"]
    assert names(drawn()) == ["distribution_load_factor"]
    over = [(0.0, 0.0), (120.0, 0.0), (240.0, 0.0), (0.0, 89.0)]
    assert names(sphere(over, {}, lambda to_azimuth, to_elevation: to_azimuth)) == ["distribution_load_factor"]
    turned = grid({"azimuth": [0.0, 90.0, 180.0, 270.0]}, lambda azimuth: 1.0)
    assert names(turned) == ["curve_load_factor"]
    assert names(grid({"mu": [0.1, 0.2, 0.3]}, lambda mu: FAILED)) == ["curve_load_factor"]  # seen to have failed


@pytest.mark.parametrize(
    ("swept", "changes", "told"),
    [
        (drawn(), {"kinds": ("curve",)}, "--kind curve of load_factor: no parameter has two values of a grid"),
        (drawn(), {"kinds": ("map",)}, "needs two parameters of a grid"),
        (plane(), {"kinds": ("curve",), "result": "mechanism.class"}, "the result is text; map shows it"),
        (plane(), {"result": "load_facter"}, "did you mean load_factor"),
        (plane(), {"by": "thicknes"}, "did you mean thickness"),
        (grid({"mu": [0.5]}, lambda mu: mu), {"kinds": ("curve",)}, "no parameter has two values"),
        (grid({"mu": [0.5]}, lambda mu: FAILED), {}, "no kind of picture suits load_factor"),
        (grid({"mu": [0.5, 0.6]}, lambda mu: FAILED), {"kinds": ("distribution",)}, "no point has a verified value"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_refused_with_the_reason(swept: SweepTable, changes: Any, told: str) -> None:
    with pytest.raises(UsageError, match=told):
        pictures_of(swept, SweepPictures(**changes))


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    found = fragility_of(table(), Asked("load_factor", (0.2,), (), table().samples, table().sampling))
    write_tables(tmp_path / "wall.out", record(fragility=found), table(), (), StudyResult())
    return tmp_path / "wall.out"


def test_the_command_writes_into_the_folder_of_the_sweep_and_replaces(
    folder: Path, capsys: pytest.CaptureFixture[str], figures: list[Any]
) -> None:
    wanted = folder / "sweep_distribution_load_factor.png"
    wanted.write_bytes(b"earlier")
    command = ["sweep-plot", "--kind", "distribution", "--size", "800x500"]
    for given in (folder, folder / "sweep.csv"):
        assert main([*command, str(given)]) == 0
        assert capsys.readouterr().out.splitlines() == [str(wanted)]
    assert wanted.read_bytes().startswith(b"\x89PNG")
    assert [0.2, 0.2] in [list(line.get_xdata()) for line in figures[0].axes[0].lines]  # the demand of the record


@pytest.mark.parametrize(
    ("options", "status", "told"),
    [
        (["--kind", "bars"], 2, "--kind bars: there are curve, map, distribution"),
        (["--kind", "polar"], 2, "--kind polar: there are curve, map, distribution"),
        (["--kind", "map"], 2, "needs two parameters"),
        (["--dpi", "5"], 2, "20 to 1200"),
        (["--size", "big"], 2, "width x height"),
        (["-o", "picture.jpg"], 2, "PNG, SVG or PDF"),
        (["--size", "300x200"], 2, "--size 300x200: words and legend leave no room"),
    ],
)
def test_refusals_of_the_command(
    folder: Path, capsys: pytest.CaptureFixture[str], options: list[str], status: int, told: str
) -> None:
    assert main(["sweep-plot", str(folder), *options]) == status
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1
    assert told in lines[0]
