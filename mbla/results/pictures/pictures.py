"""Pictures of collapse mechanisms (only importer of pyvista and vtk; it comes with the extra ``mbla[pictures]``).

The deformed structure over the outline of the undeformed one, supports grey, blocks the bluer the more they move,
hinges orange, sliding interfaces green, corners that part joined by purple lines; colours after Okabe and Ito, which
the colour-blind can tell apart. Drawn off-screen; no display is needed.
"""

from __future__ import annotations

import ctypes
import os
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.errors import FileError, UsageError
from mbla.model.model import Model
from mbla.results.collapse.collapse import collapse_of
from mbla.results.collapse.interface_modes import InterfaceMode, interface_motion
from mbla.results.collapse.motion import drawn_motion, moved_contact_points, moved_vertices
from mbla.results.pictures.geometry import (
    as_vtk_rows,
    block_colours,
    block_edges,
    box_of,
    edges_of_blocks,
    front_axis,
    ground_slab,
    hinge_axes,
    interface_sides,
    live_load_arrow,
)
from mbla.results.pictures.page import HEIGHT, INK, SHARPNESS, WIDTH, format_of, quiet_matplotlib, write_page
from mbla.results.results import CaseResult, Results
from mbla.results.words.mechanism_words import mechanism_summary
from mbla.results.words.verdict_words import verdict
from mbla.solution.solution import ContactMode, Mechanics

GROUND, GHOST = "#595959", "#8A8A8A"
HINGE, SLIDE, OPEN = "#D55E00", "#009E73", "#CC79A7"
FRAME = ((0.04, 0.86), (0.06, 0.86))
"""part of the picture, from left to right and from bottom to top, that the structure fills; the rest is for words"""


@dataclass(frozen=True)
class _Scene:
    """What is drawn: the case, its motion as drawn, vertices as moved, and the diagonal of the model."""

    results: Results
    case: CaseResult
    motion: FloatArray
    moved: FloatArray
    size: float

    @property
    def model(self) -> Model:
        return self.results.model.of_case(self.case.load_case)

    @property
    def contacts(self) -> Contacts:
        return self.results.contacts

    @property
    def slabs(self) -> list[FloatArray]:
        """Corners of the slab under each ground plane that something stands on, (8, 3) each."""
        rows = range(len(self.model.grounds))
        slabs = [ground_slab(self.model, self.contacts, row, self.size) for row in rows]
        return [corners for corners in slabs if corners is not None]

    @property
    def arrow(self) -> FloatArray:
        """Start and tip of the live load's arrow, (2, 3)."""
        low, high = box_of(np.vstack([self.moved, self.model.blocks.vertices]))
        return live_load_arrow(self.model, self.case.load_case, low, high, 0.13 * self.size)


def plot_results(results: Results, target: Path, stem: str, case: str | None = None) -> list[Path]:
    """Pictures of every case, or of one; the paths written.

    target : a file with the suffix .png, .svg or .pdf, for a single case; else a folder for ``STEM_CASE.png``, created
    if missing

    Raises
    ------
    UsageError
        As ``plot_mechanism`` does; no such case; several cases for one file; another suffix.
    FileError
        A picture or the folder cannot be written.
    """
    chosen = [each for each in results.cases if case is None or each.load_case.name == case]
    if not chosen:
        names = ", ".join(each.load_case.name for each in results.cases) or "none"
        raise UsageError(f"no load case {case or ''} in the result; it has {names}")
    if target.suffix and not target.is_dir():
        if len(chosen) > 1:
            raise UsageError(f"{target}: one file for {len(chosen)} load cases; name one with --case, or a folder")
        paths = [target]
    else:
        paths = [target / f"{stem}_{each.load_case.name}.png" for each in chosen]
    for each, path in zip(chosen, paths, strict=True):
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise FileError(f"{path.parent}: {error.strerror or error}") from error
        plot_mechanism(results, each, path)
    return paths


def plot_mechanism(results: Results, case: CaseResult, path: Path) -> None:
    """Draw the mechanism of one load case to a PNG, SVG or PDF file; the structure at rest where there is none.

    Raises
    ------
    UsageError
        The extra for pictures is not installed, the machine has no OpenGL, or the name asks for another format.
    FileError
        The file cannot be written.
    """
    kind = format_of(path)
    vista = _pyvista()
    scene = _scene(results, case)
    plotter = vista.Plotter(off_screen=True, window_size=(WIDTH, HEIGHT))
    try:
        legend = _draw(plotter, scene)
        image = plotter.screenshot(None, return_img=True, scale=SHARPNESS[kind])
    finally:
        plotter.close()
    write_page(path, image, _words(scene), legend)


def can_draw() -> bool:
    """Whether the machine has what vtk draws with; without it vtk crashes the process instead of saying so."""
    if not sys.platform.startswith("linux"):
        return True

    def loads(name: str) -> bool:
        try:
            ctypes.CDLL(name)
        except OSError:
            return False
        return True

    return any(loads(name) for name in ("libEGL.so.1", "libOSMesa.so.8", "libOSMesa.so.6")) or (
        bool(os.environ.get("DISPLAY")) and loads("libGL.so.1")
    )


def _pyvista() -> Any:
    quiet_matplotlib()
    try:
        import pyvista
        from vtkmodules.vtkCommonCore import vtkLogger
    except ImportError as error:
        raise UsageError("pictures need an extra that is not installed: pip install 'mbla[pictures]'") from error
    if not can_draw():
        raise UsageError(
            "pictures need OpenGL, with or without a display: install libEGL (Debian: apt install libegl1) or OSMesa"
        )
    # without a display vtk says so on standard error before it goes on without one
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)
    return pyvista


def _scene(results: Results, case: CaseResult) -> _Scene:
    blocks = results.model.blocks
    motion = drawn_motion(results.model.of_case(case.load_case), case)
    size = float(np.linalg.norm(np.ptp(blocks.vertices, axis=0)))
    return _Scene(results, case, motion, moved_vertices(blocks, motion), size)


def _draw(plotter: Any, scene: _Scene) -> list[list[str]]:
    """Everything but words; the entries of the legend, name and colour."""
    plotter.set_background("white")
    _add_grounds(plotter, scene)
    _add_blocks(plotter, scene)
    legend = [["undeformed", GHOST]] if scene.motion.any() else []
    if scene.case.solution.mechanics is not None:
        legend = _add_modes(plotter, scene, scene.case.solution.mechanics) + legend
    legend += _add_live_load(plotter, scene)
    _set_camera(plotter, scene)
    plotter.enable_anti_aliasing("ssaa")
    return legend


# --- the structure ------------------------------------------------------------------------------------------------


def _add_blocks(plotter: Any, scene: _Scene) -> None:
    blocks = scene.model.blocks
    surface = _pyvista().PolyData(scene.moved, faces=as_vtk_rows(blocks.loop_start, blocks.loops))
    colours = block_colours(scene.model, scene.motion)[blocks.block_of_face]
    surface.cell_data["colour"] = (255 * colours).astype(np.uint8)
    plotter.add_mesh(surface.triangulate(), scalars="colour", rgb=True, ambient=0.35, diffuse=0.7, specular=0.0)
    edges = block_edges(blocks)
    plotter.add_mesh(_lines(scene.moved, edges), color=INK, line_width=1.6 if len(blocks) < 500 else 1.0)
    ghost = edges_of_blocks(blocks, edges, np.any(scene.motion != 0, axis=1))
    if len(ghost):
        plotter.add_mesh(_lines(blocks.vertices, ghost), color=GHOST, line_width=1.0, opacity=0.45)


def _lines(points: FloatArray, pairs: IntArray) -> Any:
    return _pyvista().PolyData(points, lines=as_vtk_rows(2 * np.arange(len(pairs) + 1), pairs.ravel()))


def _add_grounds(plotter: Any, scene: _Scene) -> None:
    for corners in scene.slabs:
        slab = _pyvista().PolyData(corners).delaunay_3d().extract_surface(algorithm="dataset_surface")
        plotter.add_mesh(slab, color=GROUND, ambient=0.5)


# --- what the joints do -------------------------------------------------------------------------------------------


def _add_modes(plotter: Any, scene: _Scene, mechanics: Mechanics) -> list[list[str]]:
    """Marks on hinges, sliding interfaces and corners that part; what the legend says of them."""
    contacts = scene.contacts
    modes = interface_motion(scene.model, contacts, mechanics).modes
    sides = [moved_contact_points(scene.model, contacts, scene.motion, side) for side in (0, 1)]
    middle = (sides[0] + sides[1]) / 2
    opened = mechanics.modes == ContactMode.OPEN
    hinge = (modes == InterfaceMode.HINGE)[contacts.interface_of_point] & ~opened
    radius = 0.005 * scene.size
    legend = []
    if hinge.any():
        _add_balls(plotter, middle[hinge], radius)
        axes = hinge_axes(contacts, hinge)
        if len(axes):
            plotter.add_mesh(_lines(middle, axes).tube(radius=radius / 2), color=HINGE, ambient=0.4)
        legend.append(["hinge", HINGE])
    sliding = interface_sides(contacts, (modes == InterfaceMode.SLIDE) | (modes == InterfaceMode.TWIST))
    if len(sliding):
        plotter.add_mesh(_lines(middle, sliding), color=SLIDE, line_width=6)
        legend.append(["sliding", SLIDE])
    if opened.any():
        pairs = np.arange(2 * int(opened.sum())).reshape(2, -1).T
        ends = np.vstack([sides[0][opened], sides[1][opened]])
        plotter.add_mesh(_lines(ends, pairs), color=OPEN, line_width=3)
        legend.append(["opening", OPEN])
    return legend


def _add_balls(plotter: Any, points: FloatArray, radius: float) -> None:
    vista = _pyvista()
    balls = vista.PolyData(points).glyph(scale=False, orient=False, geom=vista.Sphere(radius=radius))
    plotter.add_mesh(balls, color=HINGE, ambient=0.4)


# --- load, camera, words ------------------------------------------------------------------------------------------


def _add_live_load(plotter: Any, scene: _Scene) -> list[list[str]]:
    start, tip = scene.arrow
    length = float(np.linalg.norm(tip - start))
    if length == 0.0:
        return []
    shape = {"shaft_radius": 0.02, "tip_radius": 0.06, "tip_length": 0.25}
    arrow = _pyvista().Arrow(start=start, direction=(tip - start) / length, scale=length, **shape)
    plotter.add_mesh(arrow, color=INK, ambient=0.5)
    return [["live load" if scene.case.load_case.settlement is None else "settlement", INK]]


def _set_camera(plotter: Any, scene: _Scene) -> None:
    """A front view of what is thin, a slanted one of the rest; parallel lines stay parallel in both."""
    vertices = scene.model.blocks.vertices
    seen = np.vstack([scene.moved, vertices, scene.arrow, *scene.slabs])
    low, high = box_of(seen)
    axis = front_axis(np.ptp(vertices, axis=0), np.abs(scene.moved - vertices).max(axis=0))
    towards = np.array({0: (1.0, 0.0, 0.0), 1: (0.0, -1.0, 0.0), None: (0.9, -1.6, 0.85)}[axis])
    towards /= np.linalg.norm(towards)
    right = np.cross([0.0, 0.0, 1.0], towards)
    right /= np.linalg.norm(right)
    up = np.cross(towards, right)
    across, along = seen @ right, seen @ up
    (left, end), (bottom, top) = FRAME
    height = max(np.ptp(along) / (top - bottom), np.ptp(across) / (end - left) * HEIGHT / WIDTH)
    width = height * WIDTH / HEIGHT
    centre = right * ((across.max() + across.min()) / 2 + (0.5 - (left + end) / 2) * width)
    centre += up * ((along.max() + along.min()) / 2 + (0.5 - (bottom + top) / 2) * height)
    centre += towards * (((low + high) / 2) @ towards)
    plotter.camera_position = [tuple(centre + 3 * scene.size * towards), tuple(centre), (0.0, 0.0, 1.0)]
    plotter.enable_parallel_projection()
    plotter.camera.parallel_scale = height / 2
    plotter.renderer.ResetCameraClippingRange()


def _words(scene: _Scene) -> list[str]:
    case, model = scene.case, scene.model
    lines = [model.title or scene.results.deck.name, f"load case {case.load_case.name}: {verdict(model, case)}"]
    if case.solution.mechanics is not None:
        collapse = collapse_of(model, scene.contacts, case.load_case, case.solution.mechanics)
        lines.append(mechanism_summary(model, collapse))
    return lines
