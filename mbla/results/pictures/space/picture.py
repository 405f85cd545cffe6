"""A picture in space: the views worth showing, and the file."""

from __future__ import annotations

import weakref
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.results.pictures.geometry import front_axis
from mbla.results.pictures.options import PictureOptions, format_of
from mbla.results.pictures.page import open_page
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.space.camera import Panel, add_images, fill_sheet, fitted, focus_of, panels_of
from mbla.results.pictures.space.drawings import forces_drawing, mechanism_drawing, model_drawing, moving_blocks
from mbla.results.pictures.space.joints import joint_marks
from mbla.results.pictures.space.renderer import Renderer
from mbla.results.pictures.space.shapes import Drawing, Faces, Shape, block_faces, grounds
from mbla.results.results import CaseResult

USUAL = (-60.0, 25.0)
"""azimuth and elevation where nothing speaks for another view"""
SIDES = (
    (-60.0, -30.0, -120.0, -150.0, 30.0, 60.0, 120.0, 150.0),
    (-68.0, -112.0, 68.0, 112.0),
    (-22.0, 22.0, 158.0, 202.0),
)
"""azimuths that are tried: of a structure about as wide as deep, of one long along x, of one long along y"""
LONG = 2.0
"""length over width in plan from which a structure is looked at across its length"""
ELEVATIONS = {25.0: 1.0, -25.0: 0.5}
"""from above, and from below, which takes twice as much to be seen: one does not stand there"""
BEHIND = 0.9
"""weight of views from +y, which is the back of most decks"""
LOOKING_ON = 0.25
"""weight of facing the side towards which the structure moves"""
PIXELS = (240, 150)
"""of the trial pictures"""
JOINTS = 4.0
"""weight of a pixel of a hinge or a gap over one of a block that moves"""


def best_view(scene: Scene) -> tuple[float, float]:
    """Azimuth and elevation in degrees.

    What is thin is seen from the front. For the rest trial pictures are drawn from several sides, with what moves in
    one colour and joints that hinge, slide or open in another, and the one that shows most of them is taken.
    """
    vertices = scene.model.blocks.vertices
    travel = np.abs(scene.moved - vertices).max(axis=0)
    axis = front_axis(np.ptp(vertices, axis=0), travel)
    if axis is not None:
        return (0.0, 0.0) if axis == 0 else (-90.0, 0.0)
    moving = moving_blocks(scene)
    if not moving.any():
        return USUAL
    heading = np.average((scene.moved - vertices)[:, :2], axis=0)
    heading /= float(np.linalg.norm(heading)) or 1.0
    best, most = USUAL, 0.0
    with Renderer(_trial(scene, moving), ()) as renderer:
        for elevation, weight in ELEVATIONS.items():
            for azimuth in _azimuths(vertices):
                seen = _seen(renderer, scene, azimuth, elevation)
                turn = np.deg2rad(azimuth)
                facing = float(np.cos(turn) * heading[0] + np.sin(turn) * heading[1])
                seen *= weight * (BEHIND if 0 < azimuth < 180 else 1.0) * (1 + LOOKING_ON * facing)
                if seen > 1.02 * most:
                    best, most = (azimuth, elevation), seen
    return best


def _azimuths(vertices: FloatArray) -> tuple[float, ...]:
    wide, deep = np.ptp(vertices[:, :2], axis=0)
    return SIDES[1 if wide > LONG * deep else 2 if deep > LONG * wide else 0]


def _trial(scene: Scene, moving: BoolArray) -> list[Shape]:
    colours = np.zeros((len(moving), 3))
    colours[moving, 2] = 1.0
    faces, marks, *_ = joint_marks(scene, scene, scene.moved)
    joints = [shape for shape in (*faces, *marks) if isinstance(shape, Faces)]
    green = [
        Faces(shape.points, shape.start, shape.loops, np.tile([0.0, 1.0, 0.0], (len(shape.colours), 1)), lit=False)
        for shape in joints
    ]
    black = [
        Faces(shape.points, shape.start, shape.loops, np.zeros_like(shape.colours), lit=False)
        for shape in grounds(scene)
        if isinstance(shape, Faces)
    ]
    return [*black, block_faces(scene, scene.moved, colours, lit=False), *green]


def _seen(renderer: Renderer, scene: Scene, azimuth: float, elevation: float) -> float:
    """Area of what moves and of joints that is seen, in squares of the size of the structure."""
    width, height = PIXELS
    camera = fitted(scene.moved, azimuth, elevation, width / height)
    image = renderer.image(camera, width, height, 0.0)
    dark = image[..., 0] < 0.5
    pixels = (dark & (image[..., 2] > 0.5)).sum() + JOINTS * (dark & (image[..., 1] > 0.5)).sum()
    return float(pixels) * (camera.height / height / scene.size) ** 2


# --- A spatial picture of a load case, from the scene to the file ---------------------------------------------------


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
    """What each panel of a page of these pixels shows; loads in that of the whole structure only.

    Each (n_rows, n_columns, 3), red, green and blue from 0 to 1.
    """
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
        view = best_view(scene.moved_to(1.0))
        _VIEWS[key] = weakref.ref(scene.case, lambda _: _VIEWS.pop(key, None)), view
    return view
