"""Pictures in space as pixels, off-screen (only importer of pyvista and vtk, the extra ``mbla[pictures]``).

Marks, such as hinges, lie between blocks, where blocks hide them. They are drawn twice: once among the blocks, once by
themselves, and the second image is laid over the first with a part of its strength. Where a mark is in front both
images agree and nothing changes; where it is hidden it shines through.
"""

from __future__ import annotations

import ctypes
import os
import sys
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from mbla.arrays import FloatArray, IntArray
from mbla.errors import UsageError
from mbla.results.pictures.camera import Camera
from mbla.results.pictures.geometry import Slab, block_edges
from mbla.results.pictures.marks.marks import Mark
from mbla.results.pictures.page import GHOST, INK, SLAB, rgb
from mbla.results.pictures.scene import PictureScene, bounding_edges

FINER, FINE = 2, 4_000_000
"""rendered pixels over those of the image, in each direction: smooths edges the same way on every machine; and pixels
from which an image is fine as it is"""
THICK = 0.005
"""radius of the thickest marks over the diagonal of what is seen"""
SHINE = 0.7
"""strength of marks that blocks hide"""
EARTH, PALE_LIGHT = 0.7, {"ambient": 0.7, "diffuse": 0.9}
"""strength of areas that are seen through, and how they take light: little, for they are seen from both sides"""
MANY = 400
"""blocks from which edges are drawn thinner"""
ByteArray = npt.NDArray[np.uint8]


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


def pyvista() -> Any:
    """The library; raises UsageError that says what to install."""
    try:
        import pyvista as vista
        from vtkmodules.vtkCommonCore import vtkLogger
    except ImportError as error:
        raise UsageError(
            "extra-missing", "pictures need an extra that is not installed: pip install 'mbla[pictures]'"
        ) from error
    if not can_draw():
        raise UsageError(
            "no-opengl",
            "pictures need OpenGL, with or without a display: install libEGL (Debian: apt install libegl1) or OSMesa",
        )
    # without a display vtk says so on standard error before it goes on without one
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)
    return vista


def image_of(
    scene: PictureScene,
    colours: Sequence[str],
    marks: Sequence[tuple[Mark, FloatArray]],
    slabs: Sequence[Slab],
    ghost: IntArray,
    camera: Camera,
    pixels: tuple[int, int],
) -> FloatArray:
    """What the camera sees of a structure as it has moved, (height, width, 3) from 0 to 1.

    colours : of each block; marks : with their points as moved, (n, 3) m; slabs : of ground
    ghost   : (n, 2) vertices, edges that are drawn where they were; pixels : width and height

    Raises UsageError where the extra is not installed or the machine has no OpenGL.
    """
    vista = pyvista()
    plotter = vista.Plotter(off_screen=True, window_size=(64, 64), lighting="none")
    try:
        plotter.set_background("white")
        # from above the left shoulder of the viewer, with a weak one from the right, whatever the view
        for position, strength in (((-0.35, 0.55, 1.0), 0.55), ((0.9, 0.0, 0.5), 0.22)):
            light = vista.Light(light_type="camera light", intensity=strength)
            light.position = position
            plotter.add_light(light)
        width, height = pixels
        finer = FINER if width * height < FINE else 1
        solid = _structure(vista, plotter, scene, colours, slabs, ghost, finer * height / 1000)
        drawn = [(mark, _actors(vista, plotter, mark, points, THICK * scene.size)) for mark, points in marks]
        image = _render(plotter, camera, finer * width, finer * height)
        if not all(mark.covered for mark, _ in drawn):
            for actor in [*solid, *(actor for mark, actors in drawn if mark.covered for actor in actors)]:
                actor.SetVisibility(False)
            alone = _render(plotter, camera, finer * width, finer * height)
            covered = (alone < 255).any(axis=2)
            image[covered] = np.round((1 - SHINE) * image[covered] + SHINE * alone[covered]).astype(np.uint8)
    finally:
        plotter.close()
    return np.asarray(image.reshape(height, finer, width, finer, 3).mean(axis=(1, 3), dtype=np.float32) / 255)


def _render(plotter: Any, camera: Camera, width: int, height: int) -> ByteArray:
    """Pixels, (height, width, 3)."""
    plotter.window_size = (width, height)
    eye = camera.centre + 3 * camera.depth * camera.towards
    plotter.camera_position = [tuple(eye), tuple(camera.centre), tuple(camera.up)]
    plotter.enable_parallel_projection()
    plotter.camera.parallel_scale = camera.height / 2
    plotter.renderer.ResetCameraClippingRange()
    plotter.render()  # a screenshot alone may be of the camera before
    return np.array(plotter.screenshot(None, return_img=True)[..., :3], dtype=np.uint8, order="C")


def _structure(
    vista: Any,
    plotter: Any,
    scene: PictureScene,
    colours: Sequence[str],
    slabs: Sequence[Slab],
    ghost: IntArray,
    thin: float,
) -> list[Any]:
    """Ground, blocks with their edges, and edges where they were; ``thin`` is the width of a thin line in pixels."""
    blocks = scene.model.blocks
    mesh = vista.PolyData(scene.moved, faces=_rows(blocks.loop_start, blocks.loops))
    tints = np.array([rgb(colour) for colour in colours])[blocks.block_of_face]
    mesh.cell_data["colour"] = np.round(255 * tints).astype(np.uint8)
    mesh = mesh.triangulate()  # vtk draws polygons that are not convex wrongly
    lit = {"ambient": 0.42, "diffuse": 0.85, "specular": 0.0}
    actors = [plotter.add_mesh(mesh, scalars="colour", rgb=True, **lit)]
    width = max(1.0, (1.5 if len(blocks) < MANY else 1.0) * thin)
    for points, edges, colour in (
        (scene.moved, bounding_edges(scene, block_edges(blocks)), INK),
        (blocks.vertices, ghost, GHOST),
    ):
        if len(edges):
            lines = vista.PolyData(points, lines=_rows(2 * np.arange(len(edges) + 1), edges))
            actors.append(plotter.add_mesh(lines, color=colour, line_width=width, lighting=False))
    for slab in slabs:
        box = vista.PolyData(slab.points, faces=_rows(3 * np.arange(len(slab.triangles) + 1), slab.triangles))
        actors.append(plotter.add_mesh(box, color=SLAB, **lit))
    return actors


def _actors(vista: Any, plotter: Any, mark: Mark, points: FloatArray, radius: float) -> list[Any]:
    """Areas, rods, arrows and balls of a mark; points (n, 3) m as moved; radius of the thickest, m."""
    meshes = []
    ends = points[mark.pairs]
    steps = ends[:, 1] - ends[:, 0]
    lengths = np.linalg.norm(steps, axis=1)
    long = lengths > 2 * radius * mark.widths
    if len(mark.faces):
        meshes.append(vista.PolyData(points, faces=_rows(4 * np.arange(len(mark.faces) + 1), mark.faces)).triangulate())
    if mark.arrows:
        for start, step, length in zip(ends[long, 0], steps[long], lengths[long], strict=True):
            looks = {"tip_length": 0.3, "tip_radius": 2.8 * radius / length, "shaft_radius": radius / length}
            meshes.append(vista.Arrow(start=start, direction=step, scale=length, **looks))
    elif mark.outlined or not len(mark.faces):
        for width in np.unique(np.round(mark.widths, 1)):
            own = np.round(mark.widths, 1) == width
            lines, dots = ends[own & long].reshape(-1, 3), ends[own & ~long].mean(axis=1)
            if len(lines):
                rows = _rows(np.arange(0, len(lines) + 1, 2), np.arange(len(lines)))
                tubes = vista.PolyData(lines, lines=rows).tube(
                    radius=max(width, 0.1) * radius, n_sides=12, capping=True
                )
                meshes.append(tubes)
            if len(dots):
                ball = vista.Sphere(radius=1.6 * max(width, 0.1) * radius)
                meshes.append(vista.PolyData(dots).glyph(geom=ball, orient=False, scale=False))
    plain = {"ambient": 0.42, "diffuse": 0.85}
    if len(mark.faces):
        plain = PALE_LIGHT if mark.pale else {"ambient": 1.0, "diffuse": 0.0}
    through = [{"opacity": EARTH} if mark.pale else {}] + [{}] * len(meshes)  # of the areas, which come first
    drawn = zip(meshes, through, strict=False)
    return [plotter.add_mesh(mesh, color=mark.colour, specular=0.0, **plain, **look) for mesh, look in drawn]


def _rows(start: Any, items: Any) -> Any:
    """Ragged rows in the form that vtk wants: each row preceded by its length."""
    return np.insert(np.ravel(items), start[:-1], np.diff(start))
