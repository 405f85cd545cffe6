"""The script with the standard views: against a stand-in for ParaView that looks into the files, and in ParaView."""

import os
import runpy
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import meshio
import numpy as np
import pytest
from matplotlib import image

from mbla.deck.content import OutputSection
from mbla.results.record.scene import FIGURES
from mbla.results.results import Results
from mbla.solution.solution import Status
from tests.results.outputs import write_outputs
from tests.results.synthetic import tower_results


@pytest.fixture(scope="module")
def results() -> Results:
    return tower_results()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory, results: Results) -> Path:
    path = tmp_path_factory.mktemp("views")
    write_outputs(results, path, "tower", False, OutputSection(vtu=True, frames=3, plots=False))
    return path


class Source:
    """A reader or filter; what it asks of its data must be in the file at its beginning."""

    seen: set[str]

    def __init__(self, seen: set[str], **properties: Any) -> None:
        self.__dict__["seen"] = seen
        self.__dict__["GlyphTransform"] = SimpleNamespace()
        for name, value in properties.items():
            setattr(self, name, value)

    def __setattr__(self, name: str, value: Any) -> None:
        self.__dict__[name] = value
        if name in ("Vectors", "Scalars", "OrientationArray", "ScaleArray"):
            self.must_have(*value)

    def file(self) -> Path | None:
        source: Any = self
        while "Input" in source.__dict__:
            source = source.Input
        name = source.__dict__.get("FileName")
        return None if name is None else Path(name[0] if isinstance(name, list) else name)

    def must_have(self, where: str, name: str) -> None:
        path = self.file()
        assert path is not None
        if path.suffix == ".pvd":
            path = path.with_name(f"{path.stem}_frame_000.vtu")
        mesh = meshio.read(path)
        assert name in (mesh.point_data if where == "POINTS" else mesh.cell_data), (path.name, where, name)
        self.seen.add(f"{path.stem}:{name}")

    def UpdatePipeline(self) -> None:
        path = self.file()
        assert path is None or path.is_file(), path

    @property
    def PointData(self) -> Any:
        path = self.file()
        assert path is not None
        data = meshio.read(path).point_data
        sizes = {name: np.linalg.norm(np.atleast_2d(values.T), axis=0) for name, values in data.items()}
        return {name: SimpleNamespace(GetRange=lambda _, v=v: (v.min(), v.max())) for name, v in sizes.items()}


class Anything:
    """Takes every property and call."""

    def __getattr__(self, name: str) -> Any:
        return lambda *_, **__: Anything()


def stand_in(seen: set[str]) -> dict[str, ModuleType]:
    """Modules ``paraview`` and ``paraview.simple``."""
    paraview, simple = ModuleType("paraview"), ModuleType("paraview.simple")
    paraview.fromGUI, paraview.simple = False, simple  # type: ignore[attr-defined]
    for name in (
        "XMLUnstructuredGridReader",
        "PVDReader",
        "Threshold",
        "WarpByVector",
        "ExtractSurface",
        "Tube",
        "Glyph",
        "Text",
    ):
        setattr(simple, name, lambda **properties: Source(seen, **properties))

    def show(source: Source, view: Any) -> Any:
        shown = Anything()
        shown.source = source  # type: ignore[attr-defined]
        return shown

    def colour(shown: Any, by: tuple[str, str]) -> None:
        shown.source.must_have(*by)

    simple.Show, simple.ColorBy = show, colour  # type: ignore[attr-defined]
    for name in (
        "CreateView",
        "GetColorTransferFunction",
        "GetScalarBar",
        "GetAnimationScene",
        "Render",
        "ResetCamera",
        "Delete",
        "SaveScreenshot",
        "SaveAnimation",
        "Interact",
    ):
        setattr(simple, name, lambda *_, **__: Anything())
    saved = seen

    def save(name: str, *_: Any, **__: Any) -> None:
        saved.add(Path(name).name)

    simple.SaveScreenshot = simple.SaveAnimation = save  # type: ignore[attr-defined]
    return {"paraview": paraview, "paraview.simple": simple}


def run_script(script: Path, monkeypatch: pytest.MonkeyPatch, *words: str) -> set[str]:
    """What it looks at and saves."""
    seen: set[str] = set()
    for name, module in stand_in(seen).items():
        monkeypatch.setitem(sys.modules, name, module)
    monkeypatch.setattr(sys, "argv", [str(script), *words])
    runpy.run_path(str(script), run_name="__main__")
    return seen


def test_every_file_and_array_that_it_names_exists(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = run_script(folder / "tower_paraview.py", monkeypatch, "--save", str(tmp_path))
    views = ("structure", "mechanism", "thrust", "utilisation", "loads", "animation")
    assert {name for name in seen if name.startswith("tower_push_x") and name.endswith(".png")} == {
        f"tower_push_x_{view}.png" for view in views
    }
    # what falls has a motion and loads, but no forces
    assert {name for name in seen if name.startswith("tower_fall") and name.endswith(".png")} == {
        f"tower_fall_{view}.png" for view in ("structure", "mechanism", "loads", "animation")
    }
    assert {"tower_push_x_thrust:resultant_forces", "tower_push_x_interfaces:torsion_use"} <= seen
    assert {"tower_push_x_hinges:displacement", "tower_push_x_blocks:parts", "tower_supports:kind"} <= seen
    assert "tower_push_x_frame_000:parts" in seen


def test_one_case_and_one_view(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    words = ("--case", "fall", "--view", "structure", "--save", str(tmp_path))
    seen = run_script(folder / "tower_paraview.py", monkeypatch, *words)
    assert {name for name in seen if name.endswith(".png")} == {"tower_fall_structure.png"}


def test_view_that_a_case_has_not_is_refused_by_name(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(SystemExit, match="load case fall has no view thrust; it has structure, mechanism"):
        run_script(folder / "tower_paraview.py", monkeypatch, "--case", "fall", "--view", "thrust")


def test_missing_file_is_named(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copy(folder / "tower_paraview.py", tmp_path)
    with pytest.raises(SystemExit, match=r"tower_push_x_blocks\.vtu is not there"):
        run_script(tmp_path / "tower_paraview.py", monkeypatch)


def test_forces_that_are_no_result_say_so(tmp_path: Path, results: Results) -> None:
    case = replace(results.cases[0], status=Status.NOT_VERIFIED)
    write_outputs(
        replace(results, cases=(case,)), tmp_path, "tower", False, OutputSection(vtu=True, frames=2, plots=False)
    )
    text = (tmp_path / "tower_paraview.py").read_text(encoding="utf-8")
    assert "NOT VERIFIED: no load factor" in text
    assert "Forces and motion are NO RESULT" in text
    told = np.concatenate(meshio.read(tmp_path / "tower_push_x_interfaces.vtu").cell_data["figures"])
    assert [FIGURES[number] for number in told] == ["best_iterate"] * 2


def test_titles_cannot_break_the_script(tmp_path: Path, results: Results, monkeypatch: pytest.MonkeyPatch) -> None:
    model = replace(results.model, title="\"\"\"\n''' \\ {} RESULT: dict[str, Any] = {}")
    write_outputs(
        replace(results, assembly=replace(results.assembly, model=model)),
        tmp_path,
        "tower",
        False,
        OutputSection(vtu=True, frames=2, plots=False),
    )
    assert run_script(tmp_path / "tower_paraview.py", monkeypatch, "--save", str(tmp_path / "png"))


@pytest.mark.long
def test_views_in_paraview_itself(folder: Path, tmp_path: Path) -> None:
    """Where pvbatch and a display, or Xvfb for one, are there."""
    if not shutil.which("pvbatch") or not (shutil.which("xvfb-run") or os.environ.get("DISPLAY")):
        pytest.skip("no pvbatch, or no display for it")
    display = [] if os.environ.get("DISPLAY") else ["xvfb-run", "-a"]
    script = [str(folder / "tower_paraview.py"), "--case", "push_x", "--save", str(tmp_path)]
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    subprocess.run([*display, "pvbatch", *script], check=True, capture_output=True, timeout=300, env=environment)
    for view in ("structure", "mechanism", "thrust", "utilisation", "loads", "animation.0000", "animation.0002"):
        pixels = image.imread(tmp_path / f"tower_push_x_{view}.png")[..., :3]
        drawn = (np.abs(pixels - 1.0).max(axis=2) > 0.05).mean()
        assert 0.01 < drawn < 0.9, view
