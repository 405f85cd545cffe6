"""DXF drawings (only importer of ezdxf): outlines in the drawing's x-y plane, which are x and z of the deck.

Outlines are closed polylines, circles and ellipses, and what lines, arcs and open polylines of one layer enclose
between them: every field of such a network, so that an opening drawn with lines is one, too. Blocks are inserted where
they are referenced; layers that are off or frozen are left out. Arcs become chords.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import shapely

from mbla.arrays import FloatArray, IntArray
from mbla.errors import Notice
from mbla.model.geometry.geometry import Geometry, GeometryFileError, malformed
from mbla.model.solids.defects import LARGEST_COORDINATE
from mbla.model.solids.measures import connected_labels
from mbla.model.solids.plane import signed_areas
from mbla.model.solids.polyhedra import prisms
from mbla.model.wording import with_count

CURVES = frozenset({"LWPOLYLINE", "POLYLINE", "LINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE"})
SILENT = frozenset(
    {"TEXT", "MTEXT", "DIMENSION", "HATCH", "POINT", "LEADER", "MULTILEADER", "VIEWPORT", "ATTDEF", "IMAGE"}
)
"""what a drawing has besides its outlines, not worth a remark"""
SAGITTA = 2e-4
"""distance of a chord from its arc over the size of the outline: a fifth of the usual tolerance of contacts"""
LEVEL = 1e-6
"""departure from the drawing's plane, relative to the extent of an outline, that is rounding"""
UNITS = {1: "in", 2: "ft", 4: "mm", 5: "cm", 6: "m"}
"""by $INSUNITS; others are not the deck's"""
DEEPEST = 50
"""blocks within blocks"""
MOST_INSERTED = 20_000
"""blocks inserted, each as often as it is seen: blocks of blocks could stand for more than any machine holds"""


@dataclass
class _Drawing:
    """Outlines and open lines, (n, 2) each, by layer, and what was left out."""

    outlines: list[tuple[str, FloatArray]] = field(default_factory=list)
    lines: dict[str, list[FloatArray]] = field(default_factory=dict)
    left_out: Counter[str] = field(default_factory=Counter)
    hidden: Counter[str] = field(default_factory=Counter)


def read_dxf(path: Path) -> Geometry:
    """Outlines of a drawing as prism of unit thickness, in the order of the drawing; networks of lines follow.

    Raises GeometryFileError for files that are no DXF or have no closed outline, and for outlines that do not lie in
    the x-y plane.
    """
    import ezdxf

    drawing = _Drawing()
    try:
        document = ezdxf.readfile(path)  # type: ignore[attr-defined]
        off = {layer.dxf.name.lower() for layer in document.layers if layer.is_off() or layer.is_frozen()}
        for layer, entity in _entities(document.modelspace(), None, 0, [0]):
            if layer.lower() in off:
                drawing.hidden[layer] += 1
            else:
                _add(drawing, layer, entity)
    except (GeometryFileError, MemoryError):
        raise
    except Exception as error:  # damaged files let all kinds of exceptions through, some when an entity is looked at
        if isinstance(error, OSError) and error.strerror:
            raise
        raise malformed("DXF", " ".join(str(error).split())) from error
    notices = [*_left_out(drawing), *_close_networks(drawing)]
    if not drawing.outlines:
        remarks = "; ".join(notice.message for notice in notices)
        raise GeometryFileError("geometry-without-blocks", f"has no closed outline{f': {remarks}' if remarks else ''}")
    areas = [signed_areas(outline[None])[0] for _, outline in drawing.outlines]
    outlines = [each if area > 0 else each[::-1] for (_, each), area in zip(drawing.outlines, areas, strict=True)]
    polyhedra = prisms(outlines, np.tile([0.0, 1.0], (len(outlines), 1)))  # counter-clockwise
    unit, names = UNITS.get(document.header.get("$INSUNITS", 0)), tuple(layer for layer, _ in drawing.outlines)
    return Geometry(polyhedra, tuple(notices), names, unit=unit, planar=True)


def _entities(space: Any, inserted_on: str | None, depth: int, inserted: list[int]) -> Iterator[tuple[str, Any]]:
    """Entities with their layers; inside a block layer 0 means that of its reference.

    inserted : (1,) how many blocks were inserted so far
    """
    for entity in space:
        layer = str(entity.dxf.get("layer", "0"))
        if layer == "0" and inserted_on is not None:
            layer = inserted_on
        if entity.dxftype() != "INSERT":
            yield layer, entity
            continue
        if depth >= DEEPEST:
            raise GeometryFileError("geometry-file", "has a block that contains itself")
        inserted[0] += max(entity.mcount, 1)
        if inserted[0] > MOST_INSERTED:
            raise GeometryFileError("geometry-too-large", f"inserts blocks more than {MOST_INSERTED} times")
        copies = entity.multi_insert() if entity.mcount > 1 else (entity,)
        for copy in copies:
            yield from _entities(copy.virtual_entities(), layer, depth + 1, inserted)


def _add(drawing: _Drawing, layer: str, entity: Any) -> None:
    kind = entity.dxftype()
    solid = kind == "POLYLINE" and (entity.is_poly_face_mesh or entity.is_polygon_mesh)
    if kind not in CURVES or solid:
        if kind not in SILENT:
            drawing.left_out[kind] += 1
        return
    closed, points = _flattened(entity, f"a {kind} on layer {layer}")
    if not closed and kind in ("POLYLINE", "LWPOLYLINE") and entity.is_closed:
        words = f"a {kind} on layer {layer} has no area: it is closed, and its corners lie at one place or on one line"
        raise GeometryFileError("geometry-file", words)
    if len(points) < 2:
        return
    extent = float(np.ptp(points, axis=0).max())
    if np.ptp(points[:, 2]) > LEVEL * extent:
        raise GeometryFileError(
            "geometry-not-read", f"a {kind} on layer {layer} does not lie in the drawing's x-y plane"
        )
    if closed and len(points) > 2:
        drawing.outlines.append((layer, points[:, :2]))
    else:
        drawing.lines.setdefault(layer, []).append(points[:, :2])


def _flattened(entity: Any, called: str) -> tuple[bool, FloatArray]:
    """Whether a curve is closed, and its points in the drawing's coordinates, (n, 3), the first not repeated."""
    import ezdxf.path

    path = ezdxf.path.make_path(entity)
    if not len(path):
        return False, np.empty((0, 3))
    ends = np.array([(p.x, p.y, p.z) for p in path.control_vertices()], dtype=np.float64)
    if not (np.abs(ends) <= LARGEST_COORDINATE).all():
        raise GeometryFileError(
            "geometry-file", f"{called} has a coordinate that is not finite or exceeds {LARGEST_COORDINATE:.0e}"
        )
    spans = np.sort(np.ptp(ends, axis=0))[1:]
    size = float(np.sqrt(spans[0] * spans[1])) or float(spans[1])
    points = np.array([(p.x, p.y, p.z) for p in path.flattening(SAGITTA * size)], dtype=np.float64)
    repeated = np.linalg.norm(points[1:] - points[:-1], axis=1) <= LEVEL * size
    points = points[np.concatenate([[True], ~repeated])]
    meets = bool(np.linalg.norm(points[-1] - points[0]) <= LEVEL * size)
    closed = len(points) > 3 and (path.is_closed or bool(getattr(entity, "is_closed", False)) or meets)
    return closed, points[:-1] if closed and meets else points


def _close_networks(drawing: _Drawing) -> list[Notice]:
    """Fields between lines become outlines of their layer."""
    notices = []
    for layer, lines in drawing.lines.items():
        fields, loose = enclosed_fields(lines)
        drawing.outlines += [(layer, outline) for outline in fields]
        if fields:
            words = with_count(len(fields), "field", f"taken as outlines between lines of layer {layer}")
            notices.append(Notice("notice", "drawing-fields", words))
        if loose:
            words = with_count(loose, "line", f"left out of layer {layer}: no field is enclosed")
            notices.append(Notice("warning", "drawing-lines-left-out", words))
    return notices


def _left_out(drawing: _Drawing) -> list[Notice]:
    notices = []
    if drawing.left_out:
        words = ", ".join(f"{count} of type {kind}" for kind, count in drawing.left_out.items())
        notices.append(Notice("warning", "mesh-cells-left-out", f"entities were left out: {words}; no outlines"))
    for layer, count in drawing.hidden.items():
        words = with_count(count, "outline or line", f"left out of layer {layer}, which is off or frozen")
        notices.append(Notice("warning", "drawing-layer-hidden", words))
    return notices


MEET = 1e-6
"""distance, relative to the extent of the lines, at which ends meet: drawings are kept in double precision"""
MOST_MEETINGS, SEGMENTS_AT_ONCE = 100_000, 20
"""of segments of lines, their common ends included: those of some twenty thousand stones drawn joint by joint"""


def enclosed_fields(lines: list[FloatArray]) -> tuple[list[FloatArray], int]:
    """Outlines (n, 2) of the bounded fields without other lines in them, and how many lines bound none.

    lines : (n, 2) each; they may cross and end on each other

    Fields are in order of their least corners, from the bottom, so that the order of the lines does not matter.

    Raises
    ------
    GeometryFileError
        for lines that meet each other far more often than those of a drawing
    MemoryError
        where the network does not fit in what may be written
    """
    points = _ends_joined(np.concatenate(lines), np.cumsum([len(line) for line in lines])[:-1])
    _refuse_tangle(points)
    try:
        network = shapely.unary_union([shapely.LineString(each) for each in points if np.ptp(each, axis=0).any()])
        fields, cuts, dangles, _ = shapely.polygonize_full([network])
    except shapely.GEOSException as error:
        if "bad_alloc" in str(error):
            raise MemoryError from error
        raise
    loose = sum(len(shapely.get_parts(part)) for part in (cuts, dangles))
    outlines = [np.asarray(shapely.get_coordinates(shapely.get_exterior_ring(each)))[:-1] for each in fields.geoms]
    corners = np.array([outline.min(axis=0) for outline in outlines]).reshape(-1, 2)
    return [outlines[row] for row in np.lexsort((corners[:, 0], corners[:, 1]))], int(loose)


def _refuse_tangle(lines: list[FloatArray]) -> None:
    """Refuse lines that meet more than ``MOST_MEETINGS`` times: few lines can enclose millions of fields."""
    segments = shapely.linestrings(np.concatenate([np.stack([line[:-1], line[1:]], axis=1) for line in lines]))
    tree = shapely.STRtree(segments)
    meetings = 0
    for begin in range(0, len(segments), SEGMENTS_AT_ONCE):
        meetings += tree.query(segments[begin : begin + SEGMENTS_AT_ONCE], predicate="intersects").shape[1]
        if meetings > 2 * MOST_MEETINGS + len(segments):  # each is found from both sides, and every one meets itself
            words = f"has lines that meet each other more than {MOST_MEETINGS:,} times"
            raise GeometryFileError("geometry-too-large", words)


def _ends_joined(points: FloatArray, splits: IntArray) -> list[FloatArray]:
    """Lines again, points that nearly coincide made equal."""
    from scipy.spatial import cKDTree

    reach = MEET * float(np.ptp(points, axis=0).max())
    pairs = cKDTree(points).query_pairs(reach, output_type="ndarray")
    labels = connected_labels(pairs.reshape(-1, 2).astype(np.int64), len(points))
    first = np.unique(labels, return_index=True)[1]
    return np.split(points[first[labels]], splits)
