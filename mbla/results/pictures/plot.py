"""Which pictures of a result go to which files, and what draws each of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from mbla.errors import UsageError
from mbla.results.pictures import drawing
from mbla.results.pictures.animation import format_of_film, write_animation
from mbla.results.pictures.history import draw_curve, draw_history
from mbla.results.pictures.influence_line import draw_series
from mbla.results.pictures.options import KINDS, USUAL_KINDS, PictureOptions, format_of, is_single
from mbla.results.pictures.page import PictureFile, write_pictures
from mbla.results.pictures.scene import PictureScene, scene_of
from mbla.results.pictures.time_history import draw_time_history
from mbla.results.results import CaseResult, Results
from mbla.results.series import chosen_cases, detailed_cases, no_such_case, series_of


def plot_results(results: Results, target: Path, stem: str, options: PictureOptions | None = None) -> list[Path]:
    """Pictures of a result; the paths written.

    ``STEM_model.png``, and for each load case ``STEM_CASE.png`` (mechanism), ``STEM_CASE_forces.png`` and
    ``STEM_CASE_history.png``, of a pushover or a structure in time ``STEM_CASE_curve.png``;
    ``STEM_SERIES_history.png`` for the positions of a travelling load, which is among the usual kinds. With
    ``options.animate`` ``STEM_CASE.gif`` or ``.mp4`` for each load case that has a motion.

    target : a file with the suffix .png, .svg or .pdf, for a single picture; else a folder, created if missing
    options.case : one load case, or of a travelling load by its name in the deck those of its positions that are
        reported in full, and as history the load factor over all of them

    Raises
    ------
    UsageError
        As ``plot_case`` does; no such case; several pictures for one file; another suffix.
    FileError
        A picture or the folder cannot be written.
    """
    options = options or PictureOptions()
    cases = _chosen_cases(results, options.case)
    pictures = _films(results, cases, options) if options.animate else pictures_of(results, cases, options)
    if is_single(target):
        _check_name(target, options)
    return write_pictures(pictures, target, stem, options.animate or options.format, "--case and --kind")


def _chosen_cases(results: Results, name: str | None) -> Sequence[CaseResult]:
    """Those of that name that are reported in full, as the worst of the positions of a travelling load is."""
    if not results.cases:
        raise no_such_case(results, name)
    chosen = chosen_cases(results, None if name is None else [name])
    return chosen if name in {case.load_case.name for case in chosen} else detailed_cases(chosen)


def pictures_of(results: Results, cases: Sequence[CaseResult], options: PictureOptions) -> list[PictureFile]:
    """Every picture of some cases, kind by kind of each case; the model first."""

    def of(case: CaseResult, kind: str) -> Callable[[Path], None]:
        return lambda path: draw_picture(path, scene_of(results, case, options, kind), kind, options)

    if not cases:
        return []
    pictures = [PictureFile("_model", of(cases[0], "model"))] if "model" in options.kinds else []
    names = _mechanism_names([case.load_case.name for case in cases])
    for case in cases:
        curve = _has_curve(case) or len(options.kinds) == 1
        drawn = {"model"} if curve else {"model", "curve"}
        if case.load_case.name != case.load_case.deck_name == options.case:
            drawn.add("history")  # of all positions, below
        if case.load_case.time_history is not None and "curve" in options.kinds:
            drawn.add("history")  # its curves, drawn once
        for kind in (kind for kind in options.kinds if kind not in drawn):
            name = names[case.load_case.name] if kind == "mechanism" else f"_{case.load_case.name}_{kind}"
            pictures.append(PictureFile(name, of(case, kind)))
    if "history" in options.kinds or options.kinds == USUAL_KINDS:
        for series in series_of(results.cases):
            if len(series.cases) > 1 and options.case in (None, series.name):
                scene = scene_of(results, series.cases[0], options, "history")
                write = partial(draw_series, scene=scene, series=series, options=options)
                pictures.append(PictureFile(f"_{series.name}_history", write))
    return pictures


def _has_curve(case: CaseResult) -> bool:
    """Whether there is a pushover, or a structure that was followed in time."""
    further = case.solution.further
    return bool(further.pushover.curve) or further.time_history.rows is not None


def _mechanism_names(cases: Sequence[str]) -> dict[str, str]:
    """``_CASE`` for each; ``_CASE_mechanism`` where that is another picture's, as of load cases named model."""
    taken = {"_model"} | {f"_{case}_{kind}" for case in cases for kind in KINDS if kind != "mechanism"}
    names = {}
    for case in cases:
        name = f"_{case}"
        while name in taken:
            name += "_mechanism"
        taken.add(name)
        names[case] = name
    return names


def _films(results: Results, cases: Sequence[CaseResult], options: PictureOptions) -> list[PictureFile]:
    """A film of every case that moves; UsageError where none does."""

    def of(case: CaseResult) -> Callable[[Path], None]:
        return lambda path: write_animation(results, case, path, options)

    moving = [each for each in cases if scene_of(results, each, options, "mechanism").motion.any()]
    if not moving:
        names = ", ".join(each.load_case.name for each in cases)
        raise UsageError(
            "no-mechanism", f"--animate {options.animate}: there is no mechanism in {names}, so nothing moves"
        )
    pushed = ["_curve" if "curve" in options.kinds and each.solution.further.pushover.curve else "" for each in moving]
    return [PictureFile(f"_{each.load_case.name}{kind}", of(each)) for each, kind in zip(moving, pushed, strict=True)]


def _check_name(target: Path, options: PictureOptions) -> None:
    """The name of a single file asks for what is written to it."""
    if not options.animate:
        format_of(target)
    elif format_of_film(target) != options.animate:
        raise UsageError(
            "output-format", f"{target}: --animate {options.animate} writes a file that ends in .{options.animate}"
        )


def draw_picture(path: Path, scene: PictureScene, kind: str, options: PictureOptions) -> None:
    """Write one picture: a diagram of the history, a plane figure where that can show the case, else an image.

    The history of a structure in time is its curves: no cone program has iterations there.

    Raises as ``plot_case`` does.
    """
    if kind in ("history", "curve"):
        in_time = scene.case.load_case.time_history is not None
        draw = draw_time_history if in_time else draw_history if kind == "history" else draw_curve
        draw(path, scene, options)
        return
    drawing.draw_picture(path, scene, kind, options)


def plot_case(
    results: Results, case: CaseResult, path: Path, kind: str = "mechanism", options: PictureOptions | None = None
) -> None:
    """Draw one load case to a PNG, SVG or PDF file, its mechanism unless another kind is asked for.

    kind : of ``KINDS``; a picture of the mechanism is one of the structure at rest where there is none

    Raises
    ------
    UsageError
        The extra for pictures is not installed, the name asks for another format, there is no such kind, or a picture
        in space is needed and the machine has no OpenGL.
    FileError
        The file cannot be written.
    """
    if kind not in KINDS:
        raise UsageError("picture-option", f"kind {kind}: there are {', '.join(KINDS)}")
    options = options or PictureOptions()
    if kind == "model":  # the loads of this case alone
        options = replace(options, case=case.load_case.name)
    draw_picture(path, scene_of(results, case, options, kind), kind, options)
