"""Which pictures a report has, how they are called, and what stands in the place of those that cannot be drawn."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.errors import UsageError
from mbla.results.pictures.options import PictureOptions
from mbla.results.report.figures import case_figures, model_figures, series_figures
from mbla.results.results import CaseResult, Results
from mbla.results.series import series_of
from mbla.solution.solution import Status
from tests.results.rocking import rocking_case
from tests.results.synthetic import full_results, standing_at, tower_results


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, PictureOptions]]:
    """Pictures that were asked for, by kind and options; they are empty files."""
    found: list[tuple[str, PictureOptions]] = []

    def draw(path: Path, scene: object, kind: str, options: PictureOptions) -> None:
        found.append((f"{kind}{path.suffix}", options))
        path.write_bytes(b"")

    monkeypatch.setattr("mbla.results.pictures.plot.draw_picture", draw)
    return found


def changed(status: Status, **changes: Any) -> tuple[Results, CaseResult]:
    """The first case with another status and something else of its solution."""
    results = tower_results()
    case = results.cases[0]
    return results, replace(case, status=status, solution=replace(case.solution, status=status, **changes))


@pytest.mark.parametrize(
    ("status", "changes", "captions"),
    [
        (Status.SOLVED, {}, ["Motion of", "Contact forces of"]),
        (Status.NOT_VERIFIED, {}, ["Motion of", "Contact forces of"]),
        (Status.NO_EQUILIBRIUM, {"mechanics": None, "certificate": np.ones((3, 6))}, ["Motion of"]),
    ],
)
@pytest.mark.usefixtures("asked")
def test_captions_say_what_the_pictures_are(status: Status, changes: dict[str, Any], captions: list[str]) -> None:
    found = case_figures(*changed(status, **changes))
    assert [picture.caption.partition(" load case push_x")[0] for picture in found.pictures] == captions
    assert found.pictures[0].caption.endswith(", best iterate, no result") == (status is Status.NOT_VERIFIED)
    assert found.missing == ""


def test_pictures_in_space_have_one_view_that_is_looked_for_once(
    monkeypatch: pytest.MonkeyPatch, asked: list[tuple[str, PictureOptions]]
) -> None:
    views: list[object] = []

    def view_of(scene: object) -> tuple[float, float]:
        views.append(scene)
        return 12.0, 34.0

    monkeypatch.setattr("mbla.results.report.figures.flat_of", lambda scene, view, kind: None)
    monkeypatch.setattr("mbla.results.report.figures.view_of_case", view_of)
    results = tower_results()
    assert case_figures(results, results.cases[0]).view == (12.0, 34.0)
    assert [(kind, options.view) for kind, options in asked] == [
        ("mechanism.png", (12.0, 34.0)),
        ("forces.png", (12.0, 34.0)),
    ]
    assert len(views) == 1
    model_figures(results, (56.0, 7.0))
    assert asked[-1] == ("model.png", replace(PictureOptions(), view=(56.0, 7.0)))
    assert len(views) == 1


def test_what_the_machine_cannot_draw_is_said_in_its_place(monkeypatch: pytest.MonkeyPatch) -> None:
    """The others are there."""

    def draw(path: Path, scene: object, kind: str, options: object) -> None:
        if kind == "mechanism":
            raise UsageError("no-opengl", "pictures need OpenGL")
        path.write_bytes(b"")

    monkeypatch.setattr("mbla.results.pictures.plot.draw_picture", draw)
    results = tower_results()
    found = case_figures(results, results.cases[0])
    assert [picture.caption.split()[0] for picture in found.pictures] == ["Contact"]
    assert found.missing.startswith("pictures need OpenGL")


@pytest.mark.parametrize("positions", [1, 3])
def test_several_positions_of_a_travelling_load_have_a_diagram(positions: int) -> None:
    results = tower_results()
    cases = []
    for i in range(positions):
        travel = standing_at(i + 1, positions, np.array([1.0 * i, 0, 0]), 1.5 * i)
        load_case = replace(results.cases[0].load_case, name=f"train@{i}", question=travel)
        cases.append(replace(results.cases[0], load_case=load_case))
    results = replace(results, cases=tuple(cases))
    found = series_figures(results, series_of(cases)[0])
    assert [picture.caption for picture in found.pictures] == ["Travelling load train"] * (positions > 1)
    for picture in found.pictures:
        assert picture.words == "Load factor at each position"
        assert picture.source.startswith("data:image/svg+xml;base64,")
    assert [picture.caption for picture in case_figures(results, cases[0]).pictures] == [
        f"{what} of load case train@0" for what in ("Motion", "Contact forces")
    ]


@pytest.mark.usefixtures("asked")
def test_a_pushover_has_its_curve() -> None:
    results = full_results()
    pushed = next(case for case in results.cases if case.solution.further.pushover.curve)
    captions = [picture.caption.partition(" of load case")[0] for picture in case_figures(results, pushed).pictures]
    assert captions == ["Motion", "Capacity curve", "Contact forces"]


@pytest.mark.usefixtures("asked")
def test_a_structure_in_time_has_its_diagrams() -> None:
    results = tower_results()
    case = rocking_case(results.cases[0])
    found = case_figures(replace(results, cases=(case,)), case)
    captions = [picture.caption for picture in found.pictures]
    assert captions[1] == "Load case shaken in time: displacements, base, energies, response spectra"
    assert found.pictures[1].words.startswith("Displacements, motion of the base, energies over time")
