import builtins
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.cli import main
from mbla.deck.content import OutputSection
from mbla.errors import UsageError
from mbla.results.hdf5.result_file import write_results_hdf5
from mbla.results.pictures.animation import displacements
from mbla.results.pictures.options import VIEWS, PictureOptions
from mbla.results.pictures.page import CASES
from mbla.results.pictures.plot import pictures_of, plot_case, plot_results
from mbla.results.results import Results
from tests.results.opengl import needs_opengl
from tests.results.outputs import write_outputs
from tests.results.synthetic import standing_at, tower_results

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
    monkeypatch.setattr("mbla.results.pictures.renderer.can_draw", lambda: False)
    with pytest.raises(UsageError, match="libegl1"):
        plot_results(results, tmp_path, "tower", IN_SPACE)
    assert not list(tmp_path.glob("*.png"))


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
    monkeypatch.setattr("mbla.results.pictures.renderer.can_draw", lambda: False)
    options = PictureOptions(kinds=("mechanism",), size=(800, 500), dpi=200)
    (path,) = plot_results(results, tmp_path / "one.png", "tower", replace(options, case="push_x"))
    assert pixels(path).shape == (1000, 1600, 3)


def test_two_kinds_for_one_file_are_refused(tmp_path: Path, results: Results) -> None:
    with pytest.raises(UsageError, match="--kind"):
        plot_results(results, tmp_path / "mine.png", "tower", PictureOptions(case="push_x"))


def test_other_formats_are_refused(tmp_path: Path, results: Results) -> None:
    with pytest.raises(UsageError, match="PNG, SVG or PDF"):
        plot_results(results, tmp_path / "mine.gif", "tower", PictureOptions(case="push_x"))
    assert not list(tmp_path.iterdir())


def test_missing_extra_is_named(tmp_path: Path, results: Results, monkeypatch: pytest.MonkeyPatch) -> None:
    importing = builtins.__import__

    def without(name: str, *rest: Any) -> Any:
        if name.startswith("pyvista"):
            raise ImportError(name)
        return importing(name, *rest)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(UsageError, match=r"pip install 'mbla\[pictures\]'"):
        plot_case(results, results.cases[0], tmp_path / "mine.png", options=IN_SPACE)


def test_module_imports_nothing_heavy() -> None:
    code = (
        "import sys, mbla.results.pictures.plot, mbla.results.write; "
        "print([name for name in ('pyvista', 'vtk', 'h5py', 'meshio') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_command_line_makes_what_it_is_asked_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    result = tmp_path / "tower.h5"
    result.write_bytes(write_results_hdf5(tower_results()))
    target = tmp_path / "one.pdf"
    command = ["plot", str(result), "--case", "push_x", "-o", str(target)]
    assert main([*command, "--kind", "forces", "--size", "800x500", "--scale", "0.5", "--view", "back"]) == 0
    assert capsys.readouterr().out.split() == [str(target)]
    assert target.read_bytes().startswith(b"%PDF-")
    for wrong in (["--kind", "forcs"], ["--view", "bottom"], ["--scale", "x"], ["--size", "8"], ["--dpi", "1"]):
        assert main([*command, *wrong]) == 2
        told = capsys.readouterr().err
        assert told.startswith(f"mbla: {wrong[0]} {wrong[1]}")
        assert told.count("\n") == 1


def test_no_two_pictures_have_one_name(results: Results) -> None:
    names = ("model", "push_forces", "push")
    cases = [replace(results.cases[0], load_case=replace(results.cases[0].load_case, name=name)) for name in names]
    made = [picture.name for picture in pictures_of(results, cases, PictureOptions())]
    assert made[:2] == ["_model", "_model_mechanism"]
    assert "_push_forces_mechanism" in made
    assert len(set(made)) == len(made) == 1 + 2 * 3


def test_a_run_with_plots_writes_what_the_command_draws(tmp_path: Path, results: Results) -> None:
    written = write_outputs(results, tmp_path, "tower", False, OutputSection(vtu=False, frames=2, plots=True))
    assert {name for name in written if name.endswith(".png")} == {
        "tower_model.png",
        *(f"tower_{case.load_case.name}{kind}.png" for case in results.cases for kind in ("", "_forces")),
    }


def test_a_result_without_cases_has_no_pictures(tmp_path: Path, results: Results) -> None:
    """A run that was stopped before its first case writes the rest of its files."""
    written = write_outputs(
        replace(results, cases=()), tmp_path, "tower", False, OutputSection(vtu=False, frames=2, plots=True)
    )
    assert not [name for name in written if name.endswith(".png")]
    assert pictures_of(results, (), PictureOptions()) == []
    with pytest.raises(UsageError, match=r"^the result has no load case"):
        plot_results(replace(results, cases=()), tmp_path, "tower")


def test_positions_of_a_travelling_load_have_a_history_of_their_own(tmp_path: Path, results: Results) -> None:
    """Chosen by the name in the deck, with the worst position alone; one position alone is no series."""
    cases = []
    for position in (1, 2):
        travel = standing_at(position, 2, np.array([1.0 * position, 0, 0]), 1.5 * position)
        load_case = replace(results.cases[0].load_case, name=f"train@{position}", question=travel)
        cases.append(replace(results.cases[0], load_case=load_case))
    travelled = replace(results, cases=tuple(cases))
    options = PictureOptions(kinds=("history",), format="svg", case="train")
    names = [path.name for path in plot_results(travelled, tmp_path, "tower", options)]
    assert names == ["tower_train_history.svg"]
    assert "load case train: load factor over 2 positions" in (tmp_path / names[-1]).read_text()
    usual = [path.name for path in plot_results(travelled, tmp_path, "tower", replace(options, kinds=("forces",)))]
    assert usual == ["tower_train@1_forces.svg"]
    alone = pictures_of(travelled, cases[:1], replace(options, case="train@1"))
    assert [picture.name for picture in alone] == ["_train@1_history"]


def test_a_picture_of_the_model_of_one_case_shows_its_loads_alone(tmp_path: Path, results: Results) -> None:
    plot_case(results, results.cases[0], tmp_path / "one.svg", "model")
    svg = (tmp_path / "one.svg").read_text()
    assert "live load: acceleration (1, 0, 0) g on all blocks" in svg
    assert "fall" not in svg
    assert CASES[1].lower() not in svg.lower()


@needs_opengl
def test_a_film_goes_to_a_file_of_its_own(tmp_path: Path, results: Results, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mbla.results.pictures.animation.displacements", lambda: displacements(2))
    target = tmp_path / "film.gif"
    options = replace(IN_SPACE, animate="gif", case="push_x", size=(200, 200))
    assert plot_results(results, target, "tower", options) == [target]
    assert target.read_bytes().startswith(b"GIF8")
