"""The pictures of a report (its one door to the pictures): drawn to files in a passing folder, embedded as data."""

from __future__ import annotations

import base64
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from mbla.errors import UsageError
from mbla.results.listing.text import counted
from mbla.results.listing.verdict_words import verdict
from mbla.results.outcome import result_of
from mbla.results.results import CaseResult, Results
from mbla.results.series import Series

if TYPE_CHECKING:
    from mbla.results.pictures.scene import Scene

View: TypeAlias = tuple[float, float]
"""azimuth and elevation of an eye, degrees"""


@dataclass(frozen=True)
class Figure:
    """A picture with its caption and what it shows in words; ``source`` is a data URI."""

    source: str
    caption: str
    words: str


@dataclass(frozen=True)
class Figures:
    """Pictures, and why there are not more of them; empty where nothing is missing.

    view : azimuth and elevation of the eye of pictures in space, degrees; None where all are plane
    """

    pictures: tuple[Figure, ...]
    missing: str = ""
    view: View | None = None


def case_figures(results: Results, case: CaseResult) -> Figures:
    """Mechanism, forces where there are any, and history of a case; of a travelling load that of all its positions."""
    name, solution = case.load_case.name, case.solution
    eye = _Eye(results, case)
    captions = {"mechanism": f"{_subject(case)} of load case {name}"}
    if solution.mechanics is not None or solution.lock is not None:
        captions["forces"] = f"{_forces(case)} of load case {name}"
    if case.load_case.travel is None and (solution.iterations or solution.path):
        captions["history"] = f"Iteration history of load case {name}: load factor and residuals"
    drawn = _drawn([_picture(results, case, kind, caption, eye) for kind, caption in captions.items()])
    return replace(drawn, view=eye.found)


def model_figures(results: Results, view: View | None = None) -> Figures:
    """The model with its groups, supports and the loads of the first load case; nothing where there is none.

    view : that of the figures of the first load case, where it is known
    """
    if not results.cases:
        return Figures(())
    first = results.cases[0]
    caption = f"Groups, supports, and loads of load case {first.load_case.name}"
    return _drawn([_picture(results, first, "model", caption, _Eye(results, first, view))])


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


@dataclass
class _Eye:
    """From where the pictures in space of a case are seen; looked for once, as that takes many trial pictures."""

    results: Results
    case: CaseResult
    found: View | None = None

    def of(self, scene: Scene) -> View:
        """Azimuth and elevation."""
        if self.found is None:
            from mbla.results.pictures.space.picture import view_of_case

            self.found = view_of_case(scene)
        return self.found


def _picture(results: Results, case: CaseResult, kind: str, caption: str, eye: _Eye) -> _Drawing:
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
        draw_picture(path, scene, kind, options if lines else replace(options, view=eye.of(scene)))
        return path

    return _Drawing(caption, _in_words(results, case, kind), write)


def _in_words(results: Results, case: CaseResult, kind: str) -> str:
    """What a reader is told who does not see the picture."""
    model = results.model.of_case(case.load_case)
    if kind == "model":
        free = len(results.model.free)
        return f"The model of {counted(len(model.blocks), 'block')}, {free} of them free, with its supports and loads"
    shown = {
        "mechanism": "The structure as it moves" if _moves(case) else "The structure at rest",
        "forces": "Resultants at the interfaces and lines of thrust",
        "history": "Load factor and residuals over the iterations of the solvers",
    }
    return f"{shown[kind]}; load case {case.load_case.name}: {verdict(model, case)}"


def _moves(case: CaseResult) -> bool:
    return case.solution.mechanics is not None or case.solution.certificate is not None


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
