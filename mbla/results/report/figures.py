"""The pictures of a report, embedded as data, and why there are not more of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TypeAlias

from mbla.errors import UsageError
from mbla.results.listing.places import counted_soils
from mbla.results.listing.text import counted
from mbla.results.listing.verdict_words import verdict
from mbla.results.outcome import best_iterate
from mbla.results.pictures import influence_line, plot
from mbla.results.pictures.camera import view_of_case
from mbla.results.pictures.image import drawn_image
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.plane import flat_of
from mbla.results.pictures.scene import scene_of
from mbla.results.results import CaseResult, Results
from mbla.results.series import Series

View: TypeAlias = tuple[float, float]
"""azimuth and elevation of an eye, degrees"""
OPTIONS = PictureOptions()


@dataclass(frozen=True)
class ReportFigure:
    """A picture with its caption and what it shows in words; ``source`` is a data URI."""

    source: str
    caption: str
    words: str


@dataclass(frozen=True)
class ReportFigures:
    """Pictures, and why there are not more of them; empty where nothing is missing.

    view : azimuth and elevation of the eye of pictures in space, degrees; None where all are plane
    """

    pictures: tuple[ReportFigure, ...]
    missing: str = ""
    view: View | None = None


def case_figures(results: Results, case: CaseResult) -> ReportFigures:
    """Mechanism, capacity curve of a pushover, diagrams of a structure in time, and forces where there are any."""
    name, solution = case.load_case.name, case.solution
    no_result = ", best iterate, no result" if best_iterate(case) is not None else ""
    captions = {"mechanism": f"Motion of load case {name}{no_result}"}
    if solution.further.time_history.rows is not None:
        captions["curve"] = f"Load case {name} in time: displacements, base, energies, response spectra"
    if solution.further.pushover.curve:
        captions["curve"] = f"Capacity curve of load case {name}: load over displacement"
    if solution.mechanics is not None or solution.lock is not None:
        captions["forces"] = f"Contact forces of load case {name}{no_result}"
    return _drawn(results, case, captions, None)


def model_figures(results: Results, view: View | None = None) -> ReportFigures:
    """The model with its groups, supports and the loads of the first load case; nothing where there is none.

    view : that of the figures of the first load case, where it is known
    """
    if not results.cases:
        return ReportFigures(())
    first = results.cases[0]
    return _drawn(results, first, {"model": f"Groups, supports, and loads of load case {first.load_case.name}"}, view)


def series_figures(results: Results, series: Series) -> ReportFigures:
    """Load factor over the positions of a travelling load."""
    if len(series.cases) < 2:
        return ReportFigures(())
    scene = scene_of(results, series.cases[0], OPTIONS, "history")
    caption, words = f"Travelling load {series.name}", "Load factor at each position"
    write = partial(influence_line.draw_series, scene=scene, series=series, options=OPTIONS)
    return _added(ReportFigures(()), caption, words, "svg", write)


def _drawn(results: Results, case: CaseResult, captions: dict[str, str], view: View | None) -> ReportFigures:
    """Plane figures and diagrams as SVG; pictures in space, which are images, as PNG, all of a case from one side."""
    found = ReportFigures((), view=view)
    for kind, caption in captions.items():
        scene, options, format = scene_of(results, case, OPTIONS, kind), OPTIONS, "svg"
        if kind != "curve" and flat_of(scene, options.view, kind) is None:
            found = replace(found, view=found.view or view_of_case(scene))
            options, format = replace(OPTIONS, view=found.view), "png"
        words = _in_words(results, case, kind)
        write = partial(plot.draw_picture, scene=scene, kind=kind, options=options)
        found = _added(found, caption, words, format, write)
    return found


def _added(found: ReportFigures, caption: str, words: str, format: str, write: Callable[[Path], None]) -> ReportFigures:
    """With one more picture, or the reason why the machine cannot draw it, to be shown in its place."""
    try:
        source = drawn_image(format, write).data_uri
    except UsageError as error:
        return replace(found, missing=str(error))
    return replace(found, pictures=(*found.pictures, ReportFigure(source, caption, words)))


def _in_words(results: Results, case: CaseResult, kind: str) -> str:
    """Description for a reader who does not see the picture."""
    model = results.model.of_case(case.load_case)
    if kind == "model":
        cells = model.soil_of_block >= 0
        free = int((~cells[results.model.free]).sum())
        soils = "".join(f", {words}" for words in counted_soils(model))
        blocks = counted(int((~cells).sum()), "block")
        return f"The model of {blocks}, {free} of them free{soils}, with its supports and loads"
    in_time = case.load_case.time_history is not None
    shown = {
        "mechanism": "The structure as it moves",
        "forces": "Resultants at the interfaces and lines of thrust",
        "curve": "Displacements, motion of the base, energies over time, and response spectra"
        if in_time
        else "Load over the displacement of the control point in a pushover",
    }
    return f"{shown[kind]}; load case {case.load_case.name}: {verdict(model, case)}"
