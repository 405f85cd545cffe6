"""Pictures of collapse mechanisms (only importer of pyvista and vtk; it comes with the extra ``mbla[pictures]``).

The deformed structure over the outline of the undeformed one, supports grey, blocks the bluer the more they move,
hinges orange, sliding interfaces green, corners that part joined by purple lines; colours after Okabe and Ito, which
the colour-blind can tell apart. Drawn off-screen; no display is needed.
"""

from __future__ import annotations

import ctypes
import os
import sys
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.errors import UsageError
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.pictures.geometry import (
    as_vtk_rows,
    block_colours,
    block_edges,
    box_of,
    edges_of_blocks,
    front_axis,
    hinge_axes,
    interface_sides,
)
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import quiet_matplotlib
from mbla.results.pictures.palette import GHOST, GROUND, HINGE, INK, OPEN, SLIDE
from mbla.results.pictures.scene import Scene
from mbla.solution.solution import ContactMode, Mechanics

KINDS = ("mechanism",)
"""kinds of pictures that are drawn here"""
FRAME = ((0.04, 0.86), (0.06, 0.86))
"""part of the picture, from left to right and from bottom to top, that the structure fills; the rest is for words"""


def render(scene: Scene, kind: str, options: PictureOptions) -> Any:
    """Image of a case, (height, width, 3) of 0 to 255, ``options.pixels`` large.

    kind : one of ``KINDS``

    Raises
    ------
    UsageError
        The extra for pictures is not installed, or the machine has no OpenGL.
    """
    plotter = _pyvista().Plotter(off_screen=True, window_size=options.pixels)
    try:
        _draw(plotter, scene)
        return plotter.screenshot(None, return_img=True)
    finally:
        plotter.close()


def legend(scene: Scene, kind: str) -> list[list[str]]:
    """Names and colours of what the image of that kind shows."""
    entries = []
    if scene.collapse is not None and scene.mechanics is not None:
        modes = scene.collapse.interfaces.modes
        entries += [["hinge", HINGE]] * bool((modes == InterfaceMode.HINGE).any())
        entries += [["sliding", SLIDE]] * bool(np.isin(modes, (InterfaceMode.SLIDE, InterfaceMode.TWIST)).any())
        entries += [["opening", OPEN]] * bool((scene.mechanics.modes == ContactMode.OPEN).any())
    entries += [["undeformed", GHOST]] * bool(scene.motion.any())
    if np.any(scene.arrow[0] != scene.arrow[1]):
        entries.append(["live load" if scene.case.load_case.settlement is None else "settlement", INK])
    return entries


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


def _draw(plotter: Any, scene: Scene) -> None:
    """Everything but words."""
    plotter.set_background("white")
    _add_grounds(plotter, scene)
    _add_blocks(plotter, scene)
    if scene.mechanics is not None:
        _add_modes(plotter, scene, scene.mechanics)
    _add_live_load(plotter, scene)
    _set_camera(plotter, scene)
    plotter.enable_anti_aliasing("ssaa")


# --- the structure ------------------------------------------------------------------------------------------------


def _add_blocks(plotter: Any, scene: Scene) -> None:
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


def _add_grounds(plotter: Any, scene: Scene) -> None:
    for corners in scene.slabs:
        slab = _pyvista().PolyData(corners).delaunay_3d().extract_surface(algorithm="dataset_surface")
        plotter.add_mesh(slab, color=GROUND, ambient=0.5)


# --- what the joints do -------------------------------------------------------------------------------------------


def _add_modes(plotter: Any, scene: Scene, mechanics: Mechanics) -> None:
    """Marks on hinges, sliding interfaces and corners that part."""
    contacts = scene.contacts
    assert scene.collapse is not None  # there are mechanics
    modes = scene.collapse.interfaces.modes
    sides = scene.contact_sides
    middle = (sides[0] + sides[1]) / 2
    opened = mechanics.modes == ContactMode.OPEN
    hinge = (modes == InterfaceMode.HINGE)[contacts.interface_of_point] & ~opened
    radius = 0.005 * scene.size
    if hinge.any():
        _add_balls(plotter, middle[hinge], radius)
        axes = hinge_axes(contacts, hinge)
        if len(axes):
            plotter.add_mesh(_lines(middle, axes).tube(radius=radius / 2), color=HINGE, ambient=0.4)
    sliding = interface_sides(contacts, (modes == InterfaceMode.SLIDE) | (modes == InterfaceMode.TWIST))
    if len(sliding):
        plotter.add_mesh(_lines(middle, sliding), color=SLIDE, line_width=6)
    if opened.any():
        pairs = np.arange(2 * int(opened.sum())).reshape(2, -1).T
        ends = np.vstack([sides[0][opened], sides[1][opened]])
        plotter.add_mesh(_lines(ends, pairs), color=OPEN, line_width=3)


def _add_balls(plotter: Any, points: FloatArray, radius: float) -> None:
    vista = _pyvista()
    balls = vista.PolyData(points).glyph(scale=False, orient=False, geom=vista.Sphere(radius=radius))
    plotter.add_mesh(balls, color=HINGE, ambient=0.4)


# --- load, camera, words ------------------------------------------------------------------------------------------


def _add_live_load(plotter: Any, scene: Scene) -> None:
    start, tip = scene.arrow
    length = float(np.linalg.norm(tip - start))
    if length == 0.0:
        return
    shape = {"shaft_radius": 0.02, "tip_radius": 0.06, "tip_length": 0.25}
    arrow = _pyvista().Arrow(start=start, direction=(tip - start) / length, scale=length, **shape)
    plotter.add_mesh(arrow, color=INK, ambient=0.5)


def _set_camera(plotter: Any, scene: Scene) -> None:
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
    shape = float(plotter.window_size[0]) / float(plotter.window_size[1])
    (left, end), (bottom, top) = FRAME
    height = max(np.ptp(along) / (top - bottom), np.ptp(across) / (end - left) / shape)
    width = height * shape
    centre = right * ((across.max() + across.min()) / 2 + (0.5 - (left + end) / 2) * width)
    centre += up * ((along.max() + along.min()) / 2 + (0.5 - (bottom + top) / 2) * height)
    centre += towards * (((low + high) / 2) @ towards)
    plotter.camera_position = [tuple(centre + 3 * scene.size * towards), tuple(centre), (0.0, 0.0, 1.0)]
    plotter.enable_parallel_projection()
    plotter.camera.parallel_scale = height / 2
    plotter.renderer.ResetCameraClippingRange()
