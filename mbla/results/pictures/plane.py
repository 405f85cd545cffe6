"""Plane figures: whether a case can be shown in one, from where the plane is viewed, and the drawing itself.

It can where every block is a prism across one horizontal direction, no block lies behind another, and whatever moves,
loads and is loaded stays in the plane.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.model.solids.blocks import Blocks
from mbla.results.collapse.motion import drawn_motion
from mbla.results.pictures.camera import Camera, axes_of
from mbla.results.pictures.geometry import block_edges
from mbla.results.pictures.marks.marks import Mark, moved
from mbla.results.pictures.page import GHOST, GROUND, INK, SLAB, Page
from mbla.results.pictures.scene import PictureScene, bounding_edges

if TYPE_CHECKING:
    from mbla.results.pictures.drawing import Drawing

ALONG = 1e-3
"""sine of the angle up to which a face or a motion lies in the plane: geometry from files has coordinates of three
decimals"""
BEHIND = 1e-2
"""share of a block's outline that may be covered by another: blocks may overlap by the tolerance of contacts"""
MANY = 300
"""blocks from which outlines are thinner"""
THICK, FINEST, DOT = 3.0, 0.7, 9.0
"""width of lines, of the finest, and diameter of dots, points"""
HATCH, DASHES = "xxxx", (0, (4, 3))
"""of areas where joints open, and of the outlines of blocks before they move"""
SEAM = 0.8
"""width of the edges of cells of soil in their own colour, points"""
PALE = 0.3
"""strength of areas that are seen through"""
END_ON = 2e-3
"""length of a segment on the page, heights of it, below which it is a dot"""


@dataclass(frozen=True)
class Flat:
    """The plane of a figure.

    towards : (3,) unit, horizontal, from the structure to the eye
    faces   : (n,) faces of blocks that are seen
    """

    towards: FloatArray
    faces: IntArray

    @property
    def azimuth(self) -> float:
        """Of the eye, degrees."""
        return float(np.degrees(np.arctan2(self.towards[1], self.towards[0])))


def flat_of(scene: PictureScene, view: tuple[float, float] | None, kind: str = "mechanism") -> Flat | None:
    """The plane in which a case can be drawn; None where it needs a picture in space or the view asks for one.

    A model is drawn in the plane of its loads where there is one, and else in any.
    """
    model, blocks = scene.model, scene.model.blocks
    normals = _directions(blocks)
    in_plane = [normal for normal in normals if _in_plane(scene, normal)]
    for normal in (*in_plane, *(normals if kind == "model" else [])):
        eye = _eye(normal, view)
        if eye is not None and _prisms(model, scene.contacts, normal):
            flat = Flat(eye, np.flatnonzero(blocks.face_normals @ eye > 1 - ALONG))
            if not _one_behind_another(blocks, flat):
                return flat
    return None


def _directions(blocks: Blocks) -> list[FloatArray]:
    """Horizontal normals of the faces of the first block, each once; the direction of the least extent first."""
    kept: list[FloatArray] = []
    for normal in blocks.face_normals[blocks.block_of_face == 0]:
        if abs(normal[2]) <= ALONG and all(abs(other @ normal) < 1 - ALONG for other in kept):
            kept.append(normal)
    return sorted(kept, key=lambda normal: float(np.ptp(blocks.vertices @ normal)))


def _eye(normal: FloatArray, view: tuple[float, float] | None) -> FloatArray | None:
    """Unit vector to the eye along a normal; from -y or from +x unless the view says the other side."""
    level = np.array([normal[0], normal[1], 0.0]) / np.hypot(normal[0], normal[1])
    if view is None:
        usual = -level[1] if abs(level[1]) >= abs(level[0]) else level[0]
        return np.asarray(level if usual > 0 else -level)
    along = float(axes_of(*view)[0] @ level)
    return None if abs(along) < 1 - ALONG**2 else level * np.sign(along)


def _prisms(model: Model, contacts: Contacts, normal: FloatArray) -> bool:
    """Every face of blocks along or across the direction; joints and grounds seen edge-on."""
    across = np.abs(model.blocks.face_normals @ normal)
    edge_on = np.abs(np.vstack([contacts.normals, *(ground.normal for ground in model.grounds)]) @ normal)
    return bool(np.all((across <= ALONG) | (across >= 1 - ALONG)) and np.all(edge_on <= ALONG))


def _in_plane(scene: PictureScene, normal: FloatArray) -> bool:
    """Loads and motion leave nothing across the plane."""
    case, free = scene.case.load_case, scene.model.free
    motion = scene.mechanics.mechanism if scene.mechanics is not None else scene.case.solution.certificate
    if motion is None and scene.case.load_case.time_history is not None:
        motion = drawn_motion(scene.model, scene.case)
    size = float(scene.model.blocks.sizes.max())
    # moments are forces times length, rotations velocities over length
    rows = [(case.live_load[free], 1 / size), (case.dead_load[free], 1 / size)]
    rows += [] if motion is None else [(motion, size)]
    for each, arm in rows:
        linear, turning = each[:, :3], arm * each[:, 3:]
        out_of_plane = turning - (turning @ normal)[:, None] * normal
        most = max(np.abs(linear).max(initial=0.0), np.abs(turning).max(initial=0.0))
        if max(np.abs(linear @ normal).max(initial=0.0), np.abs(out_of_plane).max(initial=0.0)) > ALONG * most:
            return False
    return True


def _one_behind_another(blocks: Blocks, flat: Flat) -> bool:
    import shapely

    page = blocks.vertices @ np.column_stack([np.cross([0.0, 0.0, 1.0], flat.towards), [0.0, 0.0, 1.0]])
    outlines = np.array([shapely.Polygon(polygon) for polygon in face_polygons(blocks, flat, page)], dtype=object)
    first, second = shapely.STRtree(outlines).query(outlines, predicate="intersects")
    owner = blocks.block_of_face[flat.faces]
    first, second = (each[owner[first] != owner[second]] for each in (first, second))
    common = shapely.area(shapely.intersection(outlines[first], outlines[second]))
    return bool(np.any(common > BEHIND * shapely.area(outlines[first])))


def face_polygons(blocks: Blocks, flat: Flat, page: FloatArray) -> list[FloatArray]:
    """Outlines of the faces that are seen, (n, 2) each; ``page`` (n_vertices, 2) is where vertices are on it."""
    return [page[blocks.loops[blocks.loop_start[face] : blocks.loop_start[face + 1]]] for face in flat.faces]


def seen_edges(blocks: Blocks, flat: Flat) -> IntArray:
    """Edges that bound the faces that are seen, (n, 2) vertices."""
    front = np.zeros(len(blocks.vertices), dtype=bool)
    front[blocks.loops[np.isin(blocks.face_of_corner, flat.faces)]] = True
    edges = block_edges(blocks)
    return edges[front[edges].all(axis=1)]


# --- The drawing ----------------------------------------------------------------------------------------------------


def draw_flat(page: Page, axes: Any, camera: Camera, scene: PictureScene, drawing: Drawing, flat: Flat) -> None:
    """Ground, blocks, where they were, and marks, on axes in heights of the page."""
    import shapely

    blocks = scene.model.blocks
    built, now = camera.project(blocks.vertices), camera.project(scene.moved)
    hulls = [shapely.MultiPoint(camera.project(slab.points)).convex_hull for slab in scene.slabs]
    slabs = [np.array(hull.exterior.coords) for hull in hulls]
    _areas(page, axes, slabs, facecolors=SLAB, edgecolors=GROUND, hatch="////", linewidths=0, zorder=0.5)
    colours = [drawing.colours[block] for block in blocks.block_of_face[flat.faces]]
    _areas(page, axes, face_polygons(blocks, flat, now), facecolors=colours, edgecolors="none", zorder=1)
    of_soil = scene.model.soil_of_block[blocks.block_of_face[flat.faces]] >= 0
    cells = face_polygons(blocks, replace(flat, faces=flat.faces[of_soil]), now)
    look = {"edgecolors": "face", "linewidths": SEAM * page.scale, "zorder": 1}  # no paper between cells
    _areas(page, axes, cells, facecolors=[colours[row] for row in np.flatnonzero(of_soil).tolist()], **look)
    edges = bounding_edges(scene, seen_edges(blocks, flat))
    _lines(page, axes, now[edges], 1.0 if len(blocks) < MANY else 0.6, INK, zorder=2)
    moves = scene.displaced[blocks.block_of_vertex[edges[:, 0]]]
    dashes = {"linestyles": [DASHES], "alpha": 0.8, "zorder": 2.5}
    _lines(page, axes, built[edges[moves]], 0.8, GHOST, **dashes)
    for mark in drawing.marks:
        _draw_mark(page, axes, mark, camera.project(moved(mark, scene.model, scene.motion)))


def _draw_mark(page: Page, axes: Any, mark: Mark, points: FloatArray) -> None:
    """Areas, then segments, arrows, and dots where segments have no length on the page; points (n, 2)."""
    areas = [points[face] for face in mark.faces]
    look = {"edgecolors": INK, "hatch": HATCH, "linewidths": 0.6, "zorder": 3.0}
    if mark.pale:
        areas, look = _united(areas), {"edgecolors": "none", "alpha": PALE, "zorder": 0.7}
    _areas(page, axes, areas, facecolors=mark.colour, **look)
    ends = points[mark.pairs]
    steps = ends[:, 1] - ends[:, 0]
    seen = np.linalg.norm(steps, axis=1) > END_ON
    widths = np.maximum(THICK * mark.widths, FINEST)
    if mark.arrows:
        _draw_arrows(page, axes, ends[seen, 1], steps[seen], mark.colour)
    elif not len(mark.faces):
        _lines(page, axes, ends[seen], widths[seen], mark.colour, zorder=4)
    if not seen.all() and not len(mark.faces):
        sizes = (DOT * np.clip(1.2 * mark.widths[~seen], 0.5, 1.0) * page.scale) ** 2
        style = {"color": mark.colour, "edgecolors": INK, "linewidths": 0.8 * page.scale, "zorder": 6}
        axes.scatter(*ends[~seen].mean(axis=1).T, s=sizes, **style)


def _united(areas: Sequence[FloatArray]) -> list[FloatArray]:
    """Outlines of what areas, (n, 2) each, cover together: those that lie on each other are no darker."""
    import shapely

    covered = shapely.union_all([shapely.make_valid(shapely.Polygon(area)) for area in areas])
    parts = [part for part in shapely.get_parts(covered) if part.geom_type == "Polygon"]
    return [np.array(part.exterior.coords) for part in parts]


def _draw_arrows(page: Page, axes: Any, tips: FloatArray, steps: FloatArray, colour: str) -> None:
    """Arrows that end at the tips, (n, 2), having come by the steps, (n, 2)."""
    lengths = np.linalg.norm(steps, axis=1, keepdims=True)
    along = steps / np.where(lengths > 0, lengths, 1.0)
    across = np.column_stack([-along[:, 1], along[:, 0]])
    head = np.minimum(0.3 * lengths, 0.02)
    neck = tips - head * along
    _lines(page, axes, np.stack([tips - steps, neck], axis=1), 2.0, colour, zorder=7)
    heads = np.stack([tips, neck + 0.4 * head * across, neck - 0.4 * head * across], axis=1)
    _areas(page, axes, list(heads), facecolors=colour, edgecolors="none", zorder=7)


def _areas(page: Page, axes: Any, polygons: Sequence[FloatArray], **style: Any) -> None:
    if len(polygons):
        axes.add_collection(page.parts.collections.PolyCollection(polygons, **style))


def _lines(page: Page, axes: Any, ends: FloatArray, widths: float | FloatArray, colour: str, **style: Any) -> None:
    """Segments, (n, 2, 2), with widths in points on a page of the usual width."""
    if len(ends):
        widths = np.asarray(widths) * page.scale
        axes.add_collection(page.parts.collections.LineCollection(ends, linewidths=widths, colors=colour, **style))
