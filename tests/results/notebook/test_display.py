"""What a notebook shows, through IPython's own display."""

import base64
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from mbla.errors import FileError, UsageError
from mbla.results.notebook.run import Run
from mbla.results.pictures.image import EncodedPicture
from mbla.solution.solution import Status
from tests.results.synthetic import tower_results

PNG = b"\x89PNG\r\n\x1a\n drawn"


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Names of the cases that were drawn; the drawing itself has its own tests."""
    names: list[str] = []

    def plot(results: Any, case: Any, path: Path, kind: str = "mechanism") -> None:
        names.append(f"{case.load_case.name}{'' if kind == 'mechanism' else '_' + kind}{path.suffix}")
        path.write_bytes(PNG if path.suffix == ".png" else b"<svg/>")

    monkeypatch.setattr("mbla.results.pictures.plot.plot_case", plot)
    return names


def shown(thing: object) -> dict[str, Any]:
    """What IPython sends to a notebook."""
    formatter = pytest.importorskip("IPython.core.formatters").DisplayFormatter()
    bundle, _ = formatter.format(thing)
    return dict(bundle)


def test_a_run_shows_its_table_and_one_picture(drawn: list[str]) -> None:
    bundle = shown(Run(tower_results()))
    html = bundle["text/html"]
    cells = re.findall(r"<td>(.*?)</td>", html)
    assert cells[:3] == ["push_x", "solved", "0.5"]
    assert "NO EQUILIBRIUM" in cells
    assert drawn == ["push_x.png"]
    assert base64.b64encode(PNG).decode() in html
    assert bundle["text/plain"].startswith("<mbla run of tower.yaml")


def test_what_is_not_verified_stands_out(drawn: list[str]) -> None:
    results = tower_results()
    html = shown(Run(replace(results, cases=(replace(results.cases[0], status=Status.NOT_VERIFIED),))))["text/html"]
    assert "NOT VERIFIED" in html
    assert re.search(r'<tr style="color: #B00020"><td>push_x</td><td>NOT VERIFIED</td><td>-</td>', html)


def test_without_pictures_the_table_is_there_with_the_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise UsageError("extra-missing", "pictures need an extra that is not installed")

    monkeypatch.setattr("mbla.results.pictures.plot.plot_case", refuse)
    html = shown(Run(tower_results()))["text/html"]
    assert "no picture: pictures need an extra" in html
    assert "<td>push_x</td>" in html


def test_pictures_as_notebooks_want_them(drawn: list[str], tmp_path: Path) -> None:
    case = Run(tower_results())["push_x"]
    assert shown(case.picture())["image/png"].strip() in (base64.b64encode(PNG).decode(), PNG)
    assert shown(case.picture(format="svg"))["image/svg+xml"] == "<svg/>"
    case.picture(kind="forces")
    assert drawn[-1] == "push_x_forces.png"
    assert case.picture(tmp_path / "a.svg").format == "svg"
    assert (tmp_path / "a.svg").read_bytes() == b"<svg/>"
    assert case.picture().save(tmp_path / "b.png").read_bytes() == PNG
    for wrong in ({"format": "gif"}, {"path": tmp_path / "a.svg", "format": "png"}, {"path": tmp_path / "a.bmp"}):
        with pytest.raises(UsageError):
            case.picture(**wrong)
    with pytest.raises(UsageError, match="png"):
        EncodedPicture("png", PNG).save(tmp_path / "c.svg")
    with pytest.raises(FileError):
        EncodedPicture("png", PNG).save(tmp_path / "a.svg" / "c.png")  # a file is no folder


def test_no_name_is_markup(drawn: list[str]) -> None:
    results = tower_results()
    model = replace(results.model, title="<script>alert(1)</script>")
    case = replace(results.cases[0], load_case=replace(results.cases[0].load_case, name="<b>"))
    html = shown(Run(replace(results, assembly=replace(results.assembly, model=model), cases=(case,))))["text/html"]
    assert "<script>" not in html
    assert "<b>" not in html
