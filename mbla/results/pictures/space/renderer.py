"""Shapes to pixels, off-screen (only importer of pyvista and vtk, the extra ``mbla[pictures]``).

Marks, such as hinges, lie between blocks, where blocks hide them. They are drawn twice: once among the blocks, once by
themselves, and the second image is laid over the first with a part of its strength. Where a mark is in front both
images agree and nothing changes; where it is hidden it shines through.
"""

from __future__ import annotations

import ctypes
import os
import sys
from collections.abc import Sequence
from types import TracebackType
from typing import Any, Self

import numpy as np
import numpy.typing as npt

from mbla.arrays import FloatArray
from mbla.errors import UsageError
from mbla.results.pictures.space.camera import Camera
from mbla.results.pictures.space.shapes import Lines, Shape

REFERENCE_HEIGHT = 1000
"""pixels of the picture for which line widths are given"""
FINER = 2
"""rendered pixels over those of the image, in each direction: smooths edges the same way on every machine"""
FINE = 4_000_000
"""pixels from which an image is fine as it is: its edges are smoothed by vtk alone, in a third of the memory"""

WHITE = 255
"""each component of the background"""
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


class Renderer:
    """A window off-screen that shapes are put into once and seen from several sides; a context manager.

    Raises UsageError where the extra is not installed or the machine has no OpenGL.
    """

    def __init__(self, solid: Sequence[Shape], marks: Sequence[Shape], loads: Sequence[Shape] = ()) -> None:
        self._vista = pyvista()
        self._plotter = self._vista.Plotter(off_screen=True, window_size=(64, 64), lighting="none")
        self._line_actors: list[tuple[Any, float]] = []
        self._light()
        self._plotter.set_background("white")
        self._solid = [self._add(shape) for shape in solid if _size(shape)]
        self._loads = [self._add(shape) for shape in loads if _size(shape)]
        self._marks = [self._add(shape) for shape in marks if _size(shape)] + self._loads

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self._plotter.close()

    def image(self, camera: Camera, width: int, height: int, shine: float, *, loads: bool = True) -> FloatArray:
        """What the camera sees, (height, width, 3) from 0 to 1.

        shine : strength of marks that blocks hide, 0 to 1
        loads : show them too
        """
        for actor in self._loads:
            actor.SetVisibility(loads)
        whole = self._render(camera, width, height)
        if not self._marks or shine == 0:
            return _coarser(whole, height)
        for actor in self._solid:
            actor.SetVisibility(False)
        marks = self._render(camera, width, height)
        for actor in self._solid:
            actor.SetVisibility(True)
        white = (marks[..., 0] == WHITE) & (marks[..., 1] == WHITE) & (marks[..., 2] == WHITE)
        covered = np.flatnonzero(~white)  # a few of millions of pixels
        flat = whole.reshape(-1, 3)
        flat[covered] = np.round((1 - shine) * flat[covered] + shine * marks.reshape(-1, 3)[covered]).astype(np.uint8)
        return _coarser(whole, height)

    def _render(self, camera: Camera, width: int, height: int) -> ByteArray:
        """Pixels of the image or of a finer one, (FINER height, FINER width, 3), to be written to."""
        plotter = self._plotter
        finer = FINER if width * height < FINE else 1
        plotter.window_size = (finer * width, finer * height)
        for actor, line_width in self._line_actors:
            actor.GetProperty().SetLineWidth(max(1.0, finer * line_width * height / REFERENCE_HEIGHT))
        eye = camera.centre + 3 * camera.depth * camera.towards
        plotter.camera_position = [tuple(eye), tuple(camera.centre), tuple(camera.up)]
        plotter.enable_parallel_projection()
        plotter.camera.parallel_scale = camera.height / 2
        plotter.renderer.ResetCameraClippingRange()
        plotter.render()  # a screenshot alone may be of the camera before
        pixels = plotter.screenshot(None, return_img=True)
        return np.array(pixels[..., :3], dtype=np.uint8, order="C")

    def _light(self) -> None:
        """From above the left shoulder of the viewer, with a weak one from the right, whatever the view."""
        for position, strength in (((-0.35, 0.55, 1.0), 0.55), ((0.9, 0.0, 0.5), 0.22)):
            light = self._vista.Light(light_type="camera light", intensity=strength)
            light.position = position
            self._plotter.add_light(light)

    def _add(self, shape: Shape) -> Any:
        if isinstance(shape, Lines):
            mesh = self._vista.PolyData(shape.points, lines=_rows(2 * np.arange(len(shape.pairs) + 1), shape.pairs))
            actor = self._plotter.add_mesh(
                mesh, color=shape.colour, line_width=shape.width, opacity=shape.opacity, lighting=False
            )
            self._line_actors.append((actor, shape.width))
            return actor
        mesh = self._vista.PolyData(shape.points, faces=_rows(shape.start, shape.loops))
        mesh.cell_data["colour"] = np.round(255 * shape.colours).astype(np.uint8)
        shading = {"ambient": 0.42, "diffuse": 0.85} if shape.lit else {"ambient": 1.0, "diffuse": 0.0}
        if np.diff(shape.start).max() > 4:
            mesh = mesh.triangulate()  # vtk draws polygons that are not convex wrongly
        return self._plotter.add_mesh(mesh, scalars="colour", rgb=True, opacity=shape.opacity, specular=0.0, **shading)


def _size(shape: Shape) -> int:
    return len(shape.pairs) if isinstance(shape, Lines) else len(shape.start) - 1


def _rows(start: Any, items: Any) -> Any:
    """Ragged rows in the form that vtk wants: each row preceded by its length."""
    return np.insert(np.ravel(items), start[:-1], np.diff(start))


def _coarser(pixels: ByteArray, height: int) -> FloatArray:
    """The image of so many rows, each pixel the mean of a square of the finer ones, from 0 to 1."""
    finer = pixels.shape[0] // height
    total = np.zeros((pixels.shape[0] // finer, pixels.shape[1] // finer, 3), dtype=np.uint16)
    for row in range(finer):
        for column in range(finer):
            total += pixels[row::finer, column::finer]
    return np.asarray(total * np.float32(1 / (WHITE * finer**2)))
