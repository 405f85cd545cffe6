"""Pictures of collapse mechanisms (only importer of pyvista; it comes with the extra ``mbla[pictures]``).

The deformed structure over the outline of the undeformed one, supports grey, blocks the bluer the more they move,
hinges orange, sliding interfaces green, points that open as small dots; colours after Okabe and Ito, which the
colour-blind can tell apart. Drawn off-screen; no display is needed.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.errors import FileError, UsageError
from mbla.model.model import Model
from mbla.results.case_words import verdict
from mbla.results.mechanics import InterfaceMode, interface_modes
from mbla.results.motion import contact_displacements, drawn_motion, moved_vertices, vertex_displacements
from mbla.results.outlines import as_vtk_rows, block_edges, box_of, edges_of_blocks
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import ContactMode, Mechanics

STONE, MOVED = (0.93, 0.90, 0.83), (0.10, 0.37, 0.61)
FIXED, GROUND = (0.62, 0.62, 0.62), (0.35, 0.35, 0.35)
HINGE, SLIDE, OPEN = "#D55E00", "#009E73", "#CC79A7"
GHOST, INK = "#9A9A9A", "#222222"
THIN = 0.35
"""extent over the next larger one below which a structure is seen from the front"""
MOST_DOTS = 400
"""open points beyond this number are not marked one by one; they would hide the structure"""


@dataclass(frozen=True)
class _Scene:
    """What is drawn: the case, its motion as drawn, and vertices before and after."""

    results: Results
    case: CaseResult
    motion: FloatArray
    moved: FloatArray
    size: float

    @property
    def model(self) -> Model:
        return self.results.model

    @property
    def contacts(self) -> Contacts:
        return self.results.contacts


def plot_mechanism(results: Results, case: CaseResult, path: Path, width: int = 1600, height: int = 1000) -> None:
    """Draw the mechanism of one load case to a PNG file; the structure at rest where there is none.

    width, height : pixels

    Raises
    ------
    UsageError
        The extra for pictures is not installed, or the file is not to be a PNG.
    FileError
        The file cannot be written.
    """
    if path.suffix.lower() != ".png":
        raise UsageError(f"{path}: pictures are written as PNG")
    vista = _pyvista()
    scene = _scene(results, case)
    plotter = vista.Plotter(off_screen=True, window_size=(width, height))
    try:
        plotter.set_background("white")
        _add_grounds(plotter, scene)
        _add_blocks(plotter, scene)
        if case.solution.mechanics is not None:
            _add_modes(plotter, scene, case.solution.mechanics)
        _set_camera(plotter, scene)
        _add_live_load(plotter, scene)
        _add_words(plotter, scene)
        plotter.enable_anti_aliasing("ssaa")
        plotter.screenshot(path, return_img=False)
    except OSError as error:
        raise FileError(f"{path}: {error.strerror or error}") from error
    finally:
        plotter.close()


def plot_results(results: Results, target: Path, stem: str, case: str | None = None) -> list[Path]:
    """Pictures of every case, or of one; the paths written.

    target : a file with the suffix .png, for a single case; else a folder for ``STEM_CASE.png``, created if missing

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
        raise UsageError(f"no such load case in the result: {case}; it has {names}")
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


def _pyvista() -> Any:
    try:
        import pyvista
    except ImportError as error:
        raise UsageError("pictures need an extra that is not installed: pip install 'mbla[pictures]'") from error
    return pyvista


def _scene(results: Results, case: CaseResult) -> _Scene:
    motion = drawn_motion(results.model, case)
    blocks = results.model.blocks
    return _Scene(
        results=results,
        case=case,
        motion=motion,
        moved=moved_vertices(blocks, motion),
        size=float(np.linalg.norm(np.ptp(blocks.vertices, axis=0))),
    )


# --- the structure ------------------------------------------------------------------------------------------------


def _block_colours(scene: _Scene) -> FloatArray:
    """Colour of each block, (n_blocks, 3): stone at rest, bluer the farther it moves, grey if fixed."""
    blocks = scene.model.blocks
    distance = np.zeros(len(blocks))
    np.maximum.at(distance, blocks.block_of_vertex, np.linalg.norm(vertex_displacements(blocks, scene.motion), axis=1))
    share = np.sqrt(distance / (distance.max() or 1.0))[:, None]
    colours = (1 - share) * np.array(STONE) + share * np.array(MOVED)
    colours[scene.model.fixed] = FIXED
    return np.asarray(colours)


def _add_blocks(plotter: Any, scene: _Scene) -> None:
    blocks = scene.model.blocks
    vista = _pyvista()
    surface = vista.PolyData(scene.moved, faces=as_vtk_rows(blocks.loop_start, blocks.loops))
    surface.cell_data["colour"] = (255 * _block_colours(scene)[blocks.block_of_face]).astype(np.uint8)
    plotter.add_mesh(surface.triangulate(), scalars="colour", rgb=True, ambient=0.35, diffuse=0.7, specular=0.0)
    edges = block_edges(blocks)
    width = 1.6 if len(blocks) < 500 else 1.0
    plotter.add_mesh(_lines(scene.moved, edges), color=INK, line_width=width)
    moving = np.any(scene.motion != 0, axis=1)
    ghost = edges_of_blocks(blocks, edges, moving)
    if len(ghost):
        plotter.add_mesh(_lines(blocks.vertices, ghost), color=GHOST, line_width=1.0, opacity=0.45)


def _lines(points: FloatArray, pairs: IntArray) -> Any:
    start = 2 * np.arange(len(pairs) + 1)
    return _pyvista().PolyData(points, lines=as_vtk_rows(start, pairs.ravel()))


def _add_grounds(plotter: Any, scene: _Scene) -> None:
    """A slab behind each ground plane, as wide as what stands on it and a little more."""
    contacts, model = scene.contacts, scene.model
    for row, ground in enumerate(model.grounds):
        touching = (contacts.bodies == len(model.blocks) + row).any(axis=1)[contacts.interface_of_point]
        if not touching.any():
            continue
        frame = np.linalg.svd(ground.normal[None])[2]  # rows: normal, then two directions in the plane
        local = (contacts.points[touching] - ground.point) @ frame.T
        low, high = box_of(local)
        margin = 0.06 * scene.size
        low[1:] -= margin * (np.ptp(local[:, 1:], axis=0) > 0.1 * np.ptp(local[:, 1:]))
        high[1:] += margin * (np.ptp(local[:, 1:], axis=0) > 0.1 * np.ptp(local[:, 1:]))
        inwards = np.sign(frame[0] @ ground.normal)
        low[0], high[0] = sorted((0.0, -inwards * 0.02 * scene.size))
        slab = _pyvista().Box((low[0], high[0], low[1], high[1], low[2], high[2]))
        slab.points = slab.points @ frame + ground.point
        plotter.add_mesh(slab, color=GROUND, ambient=0.5)


# --- what the joints do -------------------------------------------------------------------------------------------


def _add_modes(plotter: Any, scene: _Scene, mechanics: Mechanics) -> None:
    contacts = scene.contacts
    vista = _pyvista()
    modes = interface_modes(contacts, mechanics)
    points = contacts.points + contact_displacements(scene.model, contacts, scene.motion)
    closed = mechanics.modes != ContactMode.OPEN
    hinge = modes[contacts.interface_of_point] == InterfaceMode.HINGE
    radius = 0.006 * scene.size
    if (hinge & closed).any():
        balls = vista.PolyData(points[hinge & closed]).glyph(
            scale=False, orient=False, geom=vista.Sphere(radius=radius)
        )
        plotter.add_mesh(balls, color=HINGE, ambient=0.4)
        axes = _hinge_axes(contacts, hinge & closed)
        if len(axes):
            plotter.add_mesh(_lines(points, axes).tube(radius=radius / 2), color=HINGE, ambient=0.4)
    sliding = np.flatnonzero((modes == InterfaceMode.SLIDE) | (modes == InterfaceMode.TWIST))
    if len(sliding):
        plotter.add_mesh(_lines(points, _outlines(contacts, sliding)), color=SLIDE, line_width=6)
    opening = points[~closed]
    if 0 < len(opening) <= MOST_DOTS:
        dots = vista.PolyData(opening).glyph(scale=False, orient=False, geom=vista.Sphere(radius=0.55 * radius))
        plotter.add_mesh(dots, color=OPEN, ambient=0.5)


def _hinge_axes(contacts: Contacts, chosen: np.typing.NDArray[np.bool_]) -> IntArray:
    """Chosen points that follow each other on one interface, as pairs of points."""
    rows = np.flatnonzero(chosen)
    owners = contacts.interface_of_point[rows]
    chained = owners[1:] == owners[:-1]
    return np.column_stack([rows[:-1][chained], rows[1:][chained]])


def _outlines(contacts: Contacts, interfaces: IntArray) -> IntArray:
    """Sides of the outer boundaries of interfaces, as pairs of points."""
    sides = []
    for interface in interfaces.tolist():
        corners = contacts.point_start[interface] + np.arange(contacts.outline[interface])
        sides.append(np.column_stack([corners, np.roll(corners, -1)]))
    return np.vstack(sides)


# --- load, camera, words ------------------------------------------------------------------------------------------


def _live_resultant(scene: _Scene) -> tuple[FloatArray, FloatArray]:
    """Resultant of the live load on free blocks and the mean of where it acts, (3,) each."""
    free = scene.model.free
    forces = scene.case.load_case.live_load[free, :3]
    sizes = np.linalg.norm(forces, axis=1)
    centre = np.average(scene.model.blocks.centroids[free], axis=0, weights=sizes if sizes.any() else None)
    return forces.sum(axis=0), centre


def _add_live_load(plotter: Any, scene: _Scene) -> None:
    """An arrow before the structure, pointing where the live load pushes."""
    resultant, centre = _live_resultant(scene)
    size = float(np.linalg.norm(resultant))
    total = float(np.linalg.norm(scene.case.load_case.live_load[scene.model.free, :3], axis=1).sum())
    if total == 0.0 or size < 0.05 * total:
        return
    direction = resultant / size
    low, high = box_of(scene.moved)
    reach = _distance_to_box(centre, -direction, low, high)
    length = 0.14 * scene.size
    tip = centre - direction * (reach + 0.03 * scene.size)
    arrow = _pyvista().Arrow(
        start=tip - length * direction,
        direction=direction,
        scale=length,
        shaft_radius=0.02,
        tip_radius=0.055,
        tip_length=0.22,
    )
    plotter.add_mesh(arrow, color=INK, ambient=0.5)


def _distance_to_box(point: FloatArray, direction: FloatArray, low: FloatArray, high: FloatArray) -> float:
    """How far a ray from inside a box goes until it leaves it."""
    with np.errstate(divide="ignore"):
        distances = np.where(direction > 0, (high - point) / direction, (low - point) / direction)
    return float(np.min(np.where(direction == 0, np.inf, distances)))


def front_axis(extents: FloatArray, travel: FloatArray) -> int | None:
    """Horizontal axis along which to look: the thin one, unless the mechanism moves along it; None for a slanted view.

    extents : (3,) of the structure
    travel  : (3,) largest displacement along each axis
    """
    axis = int(np.argmin(extents[:2]))
    across = np.sort(np.delete(extents, axis))[0]
    hidden = travel[axis] > 0.5 * float(np.max(travel)) > 0
    return None if hidden or extents[axis] > THIN * across else axis


def _set_camera(plotter: Any, scene: _Scene) -> None:
    low, high = box_of(np.vstack([scene.moved, scene.model.blocks.vertices]))
    travel = np.abs(scene.moved - scene.model.blocks.vertices).max(axis=0)
    axis = front_axis(np.ptp(scene.model.blocks.vertices, axis=0), travel)
    views = {0: (1.0, 0.0, 0.0), 1: (0.0, -1.0, 0.0), None: (0.9, -1.6, 0.85)}
    centre = (low + high) / 2
    plotter.camera_position = [tuple(centre + scene.size * np.array(views[axis])), tuple(centre), (0.0, 0.0, 1.0)]
    if axis is not None:
        plotter.enable_parallel_projection()
    plotter.reset_camera(bounds=np.column_stack([low, high]).ravel().tolist())
    plotter.camera.zoom(1.15 if axis is not None else 1.05)


def _add_words(plotter: Any, scene: _Scene) -> None:
    title = scene.model.title or scene.results.deck.name
    words = f"{title}\nload case {scene.case.load_case.name}: {verdict(scene.model, scene.case)}"
    plotter.add_text(words, position="upper_left", font_size=13, color=INK)
    legend = [["hinge", HINGE], ["sliding", SLIDE], ["opening", OPEN], ["undeformed", GHOST]]
    if scene.case.solution.mechanics is not None:
        plotter.add_legend(legend, bcolor=None, face="rectangle", size=(0.14, 0.13), loc="lower right")
