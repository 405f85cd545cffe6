"""The pictures of a report (its one door to the pictures): drawn to files in a passing folder, embedded as data."""

from __future__ import annotations

import base64
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from mbla.errors import UsageError
from mbla.results.outcome import result_of
from mbla.results.results import CaseResult, Results
from mbla.results.series import Series
from mbla.results.words.text import counted
from mbla.results.words.verdict_words import verdict


@dataclass(frozen=True)
class Figure:
    """A picture with its caption and what it shows in words; ``source`` is a data URI."""

    source: str
    caption: str
    words: str


@dataclass(frozen=True)
class Figures:
    """Pictures, and why there are not more of them; empty where nothing is missing."""

    pictures: tuple[Figure, ...]
    missing: str = ""


def case_figures(results: Results, case: CaseResult) -> Figures:
    """Mechanism, forces where there are any, and history of a case; of a travelling load that of all its positions."""
    name, solution = case.load_case.name, case.solution
    model = results.model.of_case(case.load_case)
    kinds = {"mechanism": (f"{_subject(case)} of load case {name}", verdict(model, case))}
    if solution.mechanics is not None or solution.lock is not None:
        kinds["forces"] = (f"{_forces(case)} of load case {name}", "Contact forces, resultants and lines of thrust")
    if case.load_case.travel is None and (solution.iterations or solution.path):
        kinds["history"] = (f"How the solvers came to it, load case {name}", "Load factor and residuals by iteration")
    return _drawn([_picture(results, case, kind, *words) for kind, words in kinds.items()])


def model_figures(results: Results) -> Figures:
    """The model with its groups, supports and the loads of the first load case; nothing where there is none."""
    if not results.cases:
        return Figures(())
    first = results.cases[0]
    caption = f"Groups, supports, and loads of load case {first.load_case.name}"
    words = f"The model of {counted(len(results.model.blocks), 'block')}"
    return _drawn([_picture(results, first, "model", caption, words)])


def series_figures(results: Results, series: Series) -> Figures:
    """Load factor over the positions of a travelling load."""
    if len(series.cases) < 2:
        return Figures(())

    def write(folder: Path) -> Path:
        from mbla.results.pictures.history import draw_series
        from mbla.results.pictures.options import PictureOptions
        from mbla.results.pictures.scene import scene_of

        options, path = PictureOptions(), folder / "series.svg"
        draw_series(path, scene_of(results, series.cases[0], options, "history"), series, options)
        return path

    return _drawn([_Drawing(f"Travelling load {series.name}", "Load factor at each position", write)])


@dataclass(frozen=True)
class _Drawing:
    """A picture to come: caption, words, and what draws it into a folder."""

    caption: str
    words: str
    write: Callable[[Path], Path]


def _picture(results: Results, case: CaseResult, kind: str, caption: str, words: str) -> _Drawing:
    """Plane figures and diagrams as SVG; pictures in space, which are images, as PNG."""

    def write(folder: Path) -> Path:
        from mbla.results.pictures.options import PictureOptions
        from mbla.results.pictures.plane.flat import flat_of
        from mbla.results.pictures.plot import draw_picture
        from mbla.results.pictures.scene import scene_of

        options = PictureOptions()
        scene = scene_of(results, case, options, kind)
        lines = kind == "history" or flat_of(scene, options, kind) is not None
        path = folder / f"{kind}.{'svg' if lines else 'png'}"
        draw_picture(path, scene, kind, options)
        return path

    return _Drawing(caption, words, write)


def _drawn(drawings: Sequence[_Drawing]) -> Figures:
    """All that the machine can draw, and what it says of the others, to be shown in their place."""
    pictures, missing = [], ""
    with tempfile.TemporaryDirectory(prefix="mbla-report-") as folder:
        for drawing in drawings:
            try:
                path = drawing.write(Path(folder))
            except UsageError as error:
                missing = str(error)
            else:
                pictures.append(Figure(_data_uri(path), drawing.caption, drawing.words))
    return Figures(tuple(pictures), missing)


def _subject(case: CaseResult) -> str:
    """What a picture of a case shows: a mechanism only where it is one of a known load."""
    if result_of(case) is not None:
        return "Mechanism"
    if case.solution.mechanics is not None:
        return "Best iterate, no result,"
    return "Motion that shows the lack of equilibrium" if case.solution.certificate is not None else "Structure at rest"


def _forces(case: CaseResult) -> str:
    """What forces are drawn: those of a result, or what they are instead."""
    if result_of(case) is not None:
        return "Contact forces and lines of thrust"
    return "Forces that lock" if case.solution.mechanics is None else "Contact forces of the best iterate, no result,"


def _data_uri(path: Path) -> str:
    kinds = {".png": "image/png", ".svg": "image/svg+xml"}
    return f"data:{kinds[path.suffix]};base64,{base64.b64encode(path.read_bytes()).decode('ascii')}"
