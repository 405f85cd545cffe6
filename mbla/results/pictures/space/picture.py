"""A spatial picture of a load case, from the scene to the file."""

from __future__ import annotations

import weakref
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from mbla.arrays import FloatArray
from mbla.results.pictures.options import PictureOptions, format_of
from mbla.results.pictures.page import open_page
from mbla.results.pictures.scene import Scene, motion_as_drawn
from mbla.results.pictures.space.drawing import Drawing
from mbla.results.pictures.space.forces import forces_drawing
from mbla.results.pictures.space.mechanism import mechanism_drawing
from mbla.results.pictures.space.model import model_drawing
from mbla.results.pictures.space.panels import Panel, focus_of, panels_of
from mbla.results.pictures.space.renderer import Renderer
from mbla.results.pictures.space.sheet import add_images, fill_sheet
from mbla.results.pictures.space.views import best_view
from mbla.results.results import CaseResult

DRAWINGS: dict[str, Callable[[Scene], Drawing]] = {
    "model": model_drawing,
    "mechanism": mechanism_drawing,
    "forces": forces_drawing,
}
"""what makes the drawing of each kind of picture"""
KINDS = tuple(DRAWINGS)
MARGIN = 0.03
"""of the page beside the structure, share of the width"""
SCALE = 0.1
"""share of the height that a scale of colours takes above the legend"""
AXES = 0.09
"""share of the height that axes and scale bar take at least"""
_VIEWS: dict[tuple[int, int], tuple[weakref.ref[CaseResult], tuple[float, float]]] = {}
"""of the cases in use, by identity of model and case"""
SHARPNESS = {"png": 1, "svg": 2, "pdf": 2}
"""pixels of the image over those of a PNG page"""


def draw_in_space(path: Path, scene: Scene, kind: str, options: PictureOptions) -> None:
    """Draw a picture of one of ``KINDS`` to a PNG, SVG or PDF file.

    Raises
    ------
    UsageError
        The extra for pictures is not installed, the machine has no OpenGL, or the name asks for another format.
    FileError
        The file cannot be written.
    """
    width, height = replace(options, dpi=options.dpi * SHARPNESS[format_of(path)]).pixels
    focus = focus_of(scene) if kind == "mechanism" and options.zoom else None
    view = options.view or view_of_case(scene)
    with open_page(path, options) as page:
        drawing = DRAWINGS[kind](scene)
        bottom, top = fill_sheet(page, scene, kind, drawing)
        room = frame_between(bottom + SCALE * (drawing.scale is not None), top)
        panels = panels_of(drawing.extent, focus, view, width / height, room)
        if len(panels) > 1:
            drawing = mechanism_drawing(scene, seen=focus)
        with Renderer(drawing.solid_from(view[1]), drawing.marks, drawing.loads) as renderer:
            images = images_of(renderer, panels, drawing, (width, height))
        add_images(page, images, panels, scene, drawing, (bottom, top))


def images_of(
    renderer: Renderer, panels: Sequence[Panel], drawing: Drawing, pixels: tuple[int, int]
) -> list[FloatArray]:
    """What each panel of a page of these pixels shows; loads in that of the whole structure only."""
    width, height = pixels
    return [
        renderer.image(each.camera, round(each.share * width), height, drawing.shine, loads=each.gain == 1.0)
        for each in panels
    ]


def frame_between(bottom: float, top: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """The part of a page that the structure fills, from left to right and from bottom to top, between words."""
    return (MARGIN, 1 - MARGIN), (max(bottom, AXES) + 0.01, max(top - 0.01, bottom + 0.2))


def view_of_case(scene: Scene) -> tuple[float, float]:
    """Azimuth and elevation in degrees, the same for every kind of picture of a case: from where it is seen to move.

    It is found once for a case as long as that is in use, as trial pictures take longer than the picture itself.
    """
    key = (id(scene.results.model), id(scene.case))
    held, view = _VIEWS.get(key, (None, (0.0, 0.0)))
    if held is None or held() is not scene.case:
        view = best_view(replace(scene, motion=motion_as_drawn(scene.results, scene.case, 1.0)))
        _VIEWS[key] = weakref.ref(scene.case, lambda _: _VIEWS.pop(key, None)), view
    return view
