import builtins
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.errors import FileError, UsageError
from mbla.results.pictures.options import VIEWS, PictureOptions
from mbla.results.pictures.palette import HINGE
from mbla.results.pictures.plot import plot_mechanism, plot_results
from mbla.results.pictures.space import can_draw
from mbla.results.results import Results
from tests.results.synthetic import tower_results

IN_SPACE = PictureOptions(kinds=("mechanism",), view=VIEWS["iso"])


@pytest.fixture(scope="module")
def results() -> Results:
    return tower_results()


def pixels(path: Path) -> Any:
    from PIL import Image

    with Image.open(path) as image:
        return np.asarray(image)[..., :3].astype(int)


def near(picture: Any, colour: str, distance: int = 40) -> int:
    """How many pixels are about of this colour."""
    target = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)])
    return int((np.abs(picture - target).max(axis=2) < distance).sum())


def test_without_opengl_the_machine_is_told_what_it_lacks(
    tmp_path: Path, results: Results, monkeypatch: pytest.MonkeyPatch
) -> None:
    """vtk would end the process with a segmentation fault."""
    monkeypatch.setattr("mbla.results.pictures.space.renderer.can_draw", lambda: False)
    with pytest.raises(UsageError, match="libegl1"):
        plot_results(results, tmp_path, "tower", IN_SPACE)
    assert not list(tmp_path.glob("*.png"))


@pytest.mark.skipif(not can_draw(), reason="this machine has no OpenGL")
def test_pictures_show_the_structure_and_its_hinge(tmp_path: Path, results: Results) -> None:
    paths = plot_results(results, tmp_path / "pictures", "tower", IN_SPACE)
    assert [path.name for path in paths] == ["tower_push_x.png", "tower_fall.png"]
    rocking, falling = map(pixels, paths)
    assert rocking.shape == (1000, 1600, 3)
    blue = (rocking[..., 2] - rocking[..., 0] > 60).sum()
    assert blue > 10_000
    assert near(rocking, HINGE) > 200
    assert near(falling, HINGE) < 20


@pytest.mark.skipif(not can_draw(), reason="this machine has no OpenGL")
def test_one_file_for_one_case(tmp_path: Path, results: Results) -> None:
    target = tmp_path / "mine.png"
    assert plot_results(results, target, "tower", replace(IN_SPACE, case="push_x")) == [target]
    assert target.stat().st_size > 5000


def test_usual_pictures_by_name(tmp_path: Path, results: Results) -> None:
    paths = plot_results(results, tmp_path, "tower", PictureOptions(format="svg"))
    assert [path.name for path in paths] == [
        "tower_model.svg",
        "tower_push_x.svg",
        "tower_push_x_forces.svg",
        "tower_fall.svg",
        "tower_fall_forces.svg",
    ]
    assert sorted(tmp_path.iterdir()) == sorted(paths)


def test_plane_figures_need_no_opengl(tmp_path: Path, results: Results, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mbla.results.pictures.space.can_draw", lambda: False)
    options = PictureOptions(kinds=("mechanism",), size=(800, 500), dpi=200)
    (path,) = plot_results(results, tmp_path / "one.png", "tower", replace(options, case="push_x"))
    assert pixels(path).shape == (1000, 1600, 3)


def test_two_kinds_for_one_file_are_refused(tmp_path: Path, results: Results) -> None:
    with pytest.raises(UsageError, match="--kind"):
        plot_results(results, tmp_path / "mine.png", "tower", PictureOptions(case="push_x"))


def test_one_file_for_two_cases_is_refused(tmp_path: Path, results: Results) -> None:
    with pytest.raises(UsageError, match="--case"):
        plot_results(results, tmp_path / "mine.png", "tower")


def test_unknown_case_is_refused(tmp_path: Path, results: Results) -> None:
    with pytest.raises(UsageError, match="push_x, fall"):
        plot_results(results, tmp_path, "tower", PictureOptions(case="push_y"))


def test_other_formats_are_refused(tmp_path: Path, results: Results) -> None:
    with pytest.raises(UsageError, match="PNG, SVG or PDF"):
        plot_results(results, tmp_path / "mine.gif", "tower", PictureOptions(case="push_x"))
    assert not list(tmp_path.iterdir())


def test_place_that_cannot_be_written(tmp_path: Path, results: Results) -> None:
    (tmp_path / "file").write_text("mine")
    with pytest.raises(FileError, match="file"):
        plot_results(results, tmp_path / "file" / "deeper", "tower")


def test_missing_extra_is_named(tmp_path: Path, results: Results, monkeypatch: pytest.MonkeyPatch) -> None:
    importing = builtins.__import__

    def without(name: str, *rest: Any) -> Any:
        if name.startswith("pyvista"):
            raise ImportError(name)
        return importing(name, *rest)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(UsageError, match=r"pip install 'mbla\[pictures\]'"):
        plot_mechanism(results, results.cases[0], tmp_path / "mine.png", IN_SPACE)


def test_module_imports_nothing_heavy() -> None:
    code = (
        "import sys, mbla.results.pictures.plot, mbla.results.write; "
        "print([name for name in ('pyvista', 'vtk', 'h5py', 'meshio') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
