"""Which pictures of a result go to which files, and what draws each of them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from mbla.errors import FileError, UsageError
from mbla.results.pictures import space
from mbla.results.pictures.options import PictureOptions, format_of
from mbla.results.pictures.page import write_page
from mbla.results.pictures.scene import scene_of
from mbla.results.results import CaseResult, Results

SHARPNESS = {"png": 1, "svg": 2, "pdf": 2}
"""pixels of an image over those of a PNG page"""


def plot_results(results: Results, target: Path, stem: str, options: PictureOptions | None = None) -> list[Path]:
    """Pictures of every case, or of one; the paths written.

    target : a file with the suffix .png, .svg or .pdf, for a single picture; else a folder for ``STEM_CASE.png`` and
    its like, created if missing

    Raises
    ------
    UsageError
        As ``plot_mechanism`` does; no such case; several cases for one file; another suffix.
    FileError
        A picture or the folder cannot be written.
    """
    options = options or PictureOptions(kinds=("mechanism",))
    chosen = _chosen_cases(results, options.case)
    if target.suffix and not target.is_dir():
        if len(chosen) > 1:
            raise UsageError(f"{target}: one file for {len(chosen)} load cases; name one with --case, or a folder")
        paths = [target]
    else:
        paths = [target / f"{stem}_{each.load_case.name}.{options.format}" for each in chosen]
    for each, path in zip(chosen, paths, strict=True):
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise FileError(f"{path.parent}: {error.strerror or error}") from error
        plot_mechanism(results, each, path, options)
    return paths


def _chosen_cases(results: Results, name: str | None) -> list[CaseResult]:
    chosen = [each for each in results.cases if name is None or each.load_case.name == name]
    if not chosen:
        names = ", ".join(each.load_case.name for each in results.cases) or "none"
        raise UsageError(f"no load case {name or ''} in the result; it has {names}")
    return chosen


def plot_mechanism(results: Results, case: CaseResult, path: Path, options: PictureOptions | None = None) -> None:
    """Draw the mechanism of one load case to a PNG, SVG or PDF file; the structure at rest where there is none.

    Raises
    ------
    UsageError
        The extra for pictures is not installed, the machine has no OpenGL, or the name asks for another format.
    FileError
        The file cannot be written.
    """
    options = options or PictureOptions()
    sharp = replace(options, dpi=options.dpi * SHARPNESS[format_of(path)])
    scene = scene_of(results, case, options, "mechanism")
    image = space.render(scene, "mechanism", sharp)
    write_page(path, image, scene.words, space.legend(scene, "mechanism"), options)
