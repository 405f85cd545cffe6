"""What the browser gets of one load case: arrays of the structure as built, its motion, marks, colours, words.

The browser moves blocks by itself, by the screw of :func:`mbla.results.collapse.motion.moved_points`, so the data do
not grow with the number of frames. Coordinates are those of the deck less an offset where the model lies far from the
origin: graphics cards count with seven digits.
"""

from __future__ import annotations

import base64
from dataclasses import dataclass
from html import escape
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.sections.selectors import POSITIONS
from mbla.model.model import Model
from mbla.results.collapse.collapse import Collapse, collapse_of, failure_of
from mbla.results.collapse.finite_motion import finite_motion
from mbla.results.collapse.joint_planes import HingeLine
from mbla.results.collapse.motion import drawn_motion, largest_displacements, moved_vertices
from mbla.results.collapse.rigid_parts import rigid_parts
from mbla.results.listing.text import number
from mbla.results.outcome import result_of
from mbla.results.pictures.geometry import block_edges, box_of, front_axis, ground_slab
from mbla.results.results import CaseResult, Results
from mbla.results.view3d.marks import LoadArrow, Mark, block_eccentricity, force_marks, load_arrow, mechanism_marks
from mbla.results.view3d.surface import Colouring, by_group, by_part, by_value, face_triangles, triangle_normals
from mbla.solution.solution import Status

FAR = 1e3
"""distance from the origin over the size of the model from which coordinates are drawn less an offset"""
MARGIN = 0.04
"""of the largest extent, around what is drawn"""
LIGHT = np.array([0.83, -0.07, 0.95])
"""direction the light comes from: towards the eye along its first axis, to the right, up; see ``light_from``"""
DARKEST = 0.55
"""share of its colour that a face turned away from the light keeps"""
SIDES = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
SLAB = np.array([[side[0], side[i], side[i + 1]] for side in SIDES for i in (1, 2)])
"""triangles of a box whose corners have the first coordinate fastest"""
SHADES = 32


def scene_of(results: Results, case: CaseResult, view: tuple[float, float] | None = None) -> dict[str, Any]:
    """Everything that the browser needs, ready for JSON.

    view : azimuth and elevation of the eye at first, degrees; None: what suits the structure
    """
    model, contacts, blocks = results.model.of_case(case.load_case), results.contacts, results.model.blocks
    size = float(np.linalg.norm(np.ptp(blocks.vertices, axis=0)))
    offset = offset_of(blocks.vertices, size)
    motion = finite_motion(model, contacts, case)
    moved = moved_vertices(blocks, motion)
    told = _told(results, case, model) if motion.any() else None
    parts = None if told is None else told.parts
    slabs = [ground_slab(model, contacts, row, size) for row in range(len(model.grounds))]
    grounds = [slab for slab in slabs if slab is not None]
    low, high = box_of(np.vstack([moved, blocks.vertices]))
    arrow = load_arrow(model, case.load_case, low, high, 0.13 * size)
    seen = np.vstack([moved, blocks.vertices, *grounds, arrow.points])
    triangles, faces = face_triangles(blocks)
    eye = eye_of(blocks.vertices, moved, view)
    return {
        "unit": model.units.length,
        "offset": offset.tolist(),
        **_box(seen - offset),
        "eye": eye,
        "vertices": packed(blocks.vertices - offset),
        "vertexStart": packed(blocks.vertex_start),
        "triangles": packed(triangles),
        "blockOfTriangle": packed(blocks.block_of_face[faces]),
        "shades": packed(shades(triangle_normals(blocks.vertices, triangles), light_from(eye)), "u1"),
        "shadeCount": SHADES,
        "darkest": DARKEST,
        "edges": packed(block_edges(blocks)),
        "centroids": packed(blocks.centroids - offset),
        "motion": packed(motion) if motion.any() else None,
        "motionWords": motion_words(case) if motion.any() else "",
        "texts": block_texts(model, parts),
        "colourings": [_colouring(each) for each in colourings(results, case, model, motion, parts)],
        "marks": [_mark(mark, offset) for mark in marks_of(results, case, model, size, told)],
        "forceWords": force_words(case),
        "ground": _ground(grounds, offset),
        "arrow": _arrow(arrow, offset),
    }


def offset_of(vertices: FloatArray, size: float) -> FloatArray:
    """Centre of the model to the digit of its size where it lies far from the origin, else zero, (3,) m."""
    if np.abs(vertices).max() <= FAR * size:
        return np.zeros(3)
    digit = 10.0 ** np.floor(np.log10(size))
    return np.asarray(np.rint(vertices.mean(axis=0) / digit) * digit)


def light_from(eye: list[float]) -> FloatArray:
    """Unit direction of the light, (3,): from above and behind the viewer, so that the side first seen is bright."""
    ahead = np.array([eye[0], eye[1], 0.0])
    ahead /= float(np.linalg.norm(ahead)) or 1.0
    light = LIGHT[0] * ahead + LIGHT[1] * np.cross([0.0, 0.0, 1.0], ahead) + LIGHT[2] * np.array([0.0, 0.0, 1.0])
    return np.asarray(light / np.linalg.norm(light))


def shades(normals: FloatArray, light: FloatArray) -> IntArray:
    """Brightness of faces in steps from 0 to SHADES - 1, (n,)."""
    return np.asarray(np.rint((normals @ light + 1) / 2 * (SHADES - 1)).astype(np.int64))


def eye_of(vertices: FloatArray, moved: FloatArray, view: tuple[float, float] | None = None) -> list[float]:
    """Direction from which the structure is seen first: nearly the front of what is thin, else slanted, or as given."""
    axis = front_axis(np.ptp(vertices, axis=0), np.abs(moved - vertices).max(axis=0))
    if axis is None and view is not None:
        azimuth, elevation = np.deg2rad(view)
        level = np.cos(elevation)
        return [float(level * np.cos(azimuth)), float(level * np.sin(azimuth)), float(np.sin(elevation))]
    return {0: [1.6, -0.35, 0.4], 1: [0.35, -1.6, 0.4], None: [0.9, -1.6, 0.85]}[axis]


def motion_words(case: CaseResult) -> str:
    """What the motion is; where it belongs to no result, that it does not."""
    if case.solution.mechanics is None:
        known = "" if case.status is Status.NO_EQUILIBRIUM else ", NOT VERIFIED"
        return f"motion in which the dead load falls{known}"
    return f"mechanism{_reservation(case)}"


def force_words(case: CaseResult) -> str:
    """What the forces are, likewise."""
    if case.solution.mechanics is None:
        known = "" if case.status is Status.UNBOUNDED else ", NOT VERIFIED"
        return f"forces that balance the live load alone{known}" if case.solution.lock is not None else ""
    return f"forces at the load factor{_reservation(case)}"


def _reservation(case: CaseResult) -> str:
    if result_of(case) is None:
        return " of the best iterate, NO RESULT"
    return "" if case.status is Status.SOLVED else f", {case.status.value.replace('_', ' ').upper()}"


def block_texts(model: Model, parts: IntArray | None) -> list[str]:
    """What the browser says of each block: name, position, weight, part; as HTML."""
    blocks, units = model.blocks, model.units
    weights = model.weights.tolist()
    known = [name for name in POSITIONS if (blocks.labels.position(name) >= 0).any()]
    columns = [blocks.labels.position(name).tolist() for name in known]
    texts = []
    for block in range(len(blocks)):
        places = [f"{name} {column[block]}" for name, column in zip(known, columns, strict=True) if column[block] >= 0]
        member = blocks.labels.members[block]
        lines = [escape(blocks.name(block)), ", ".join([escape(member)] * bool(member) + places)]
        lines.append(f"weight {number(weights[block])} {units.force}")
        if model.fixed[block]:
            lines.append("fixed")
        elif parts is not None:
            lines.append(f"part {parts[block]}" if parts[block] else "at rest")
        texts.append("<br>".join(line for line in lines if line))
    return texts


def colourings(
    results: Results, case: CaseResult, model: Model, motion: FloatArray, parts: IntArray | None
) -> list[Colouring]:
    """The ways to colour that the case has, the first at first."""
    found = [by_group(model)]
    if parts is not None:
        farthest = largest_displacements(model.blocks, motion)
        share = farthest / (farthest.max() or 1.0)
        found = [by_part(model, parts), by_value(model, "displacement", share, "none", "largest"), *found]
    forces = forces_of(case)
    if forces is not None and len(results.contacts):
        eccentricity = block_eccentricity(model, results.contacts, forces)
        found.append(by_value(model, "eccentricity", eccentricity, "0, central", "1, at the edge"))
    return found


def marks_of(results: Results, case: CaseResult, model: Model, size: float, told: _Told | None) -> list[Mark]:
    """Marks of the mechanism and of the forces; none of what the case does not have."""
    mechanics, forces, contacts = case.solution.mechanics, forces_of(case), results.contacts
    if not len(contacts):
        return []
    found: list[Mark] = []
    if mechanics is not None and told is not None and told.collapse is not None:
        found = mechanism_marks(model, contacts, mechanics, told.collapse, told.hinge_lines)
    return found + ([] if forces is None else force_marks(model, contacts, forces, size))


@dataclass(frozen=True)
class _Told:
    """What the words tell of a motion: parts with their numbers, and hinge lines; no collapse without a mechanism."""

    parts: IntArray
    collapse: Collapse | None = None
    hinge_lines: tuple[HingeLine, ...] = ()


def _told(results: Results, case: CaseResult, model: Model) -> _Told:
    """Parts of a mechanism are the clusters of the words; those of a motion that proves no equilibrium are rigid."""
    mechanics, contacts = case.solution.mechanics, results.contacts
    if mechanics is None:
        return _Told(rigid_parts(model, contacts, drawn_motion(model, case)))
    collapse = collapse_of(model, contacts, case.load_case, mechanics)
    failure = failure_of(model, contacts, collapse, mechanics)
    return _Told(failure.clusters, collapse, failure.hinge_lines)


def forces_of(case: CaseResult) -> FloatArray | None:
    """Contact forces at the load factor; without one those that lock the structure, (n_points, 3)."""
    mechanics = case.solution.mechanics
    return case.solution.lock if mechanics is None else mechanics.contact_forces


# --- as JSON ------------------------------------------------------------------------------------------------------


def packed(values: FloatArray | IntArray, kind: str | None = None) -> dict[str, str]:
    """An array, flat, as base64 of little-endian numbers: single precision, or 32-bit integers."""
    kind = kind or ("f4" if values.dtype.kind == "f" else "i4")
    data = np.ascontiguousarray(values.ravel(), dtype=np.dtype(kind).newbyteorder("<"))
    return {"dtype": kind, "bdata": base64.b64encode(data.tobytes()).decode("ascii")}


def _box(points: FloatArray) -> dict[str, Any]:
    low, high = box_of(points)
    margin = MARGIN * float((high - low).max())
    return {"low": (low - margin).tolist(), "high": (high + margin).tolist()}


def _colouring(colouring: Colouring) -> dict[str, Any]:
    return {
        "name": colouring.name,
        "colours": colouring.colours,
        "rows": packed(colouring.rows),
        "legend": colouring.legend,
    }


def _mark(mark: Mark, offset: FloatArray) -> dict[str, Any]:
    texts = {text: row for row, text in enumerate(dict.fromkeys(mark.texts))}
    return {
        "name": mark.name,
        "colour": mark.colour,
        "width": mark.width,
        "points": packed(mark.points - offset),
        "bodies": packed(mark.bodies),
        "pairs": packed(mark.pairs),
        "texts": [escape(text) for text in texts],
        "textRows": packed(np.array([texts[text] for text in mark.texts], dtype=np.int64)),
        "inside": mark.inside,
        "dots": mark.dots,
    }


def _ground(slabs: list[FloatArray], offset: FloatArray) -> dict[str, Any] | None:
    if not slabs:
        return None
    points = np.concatenate(slabs) - offset
    triangles = np.concatenate([SLAB + 8 * row for row in range(len(slabs))])
    return {"points": packed(points), "triangles": packed(triangles)}


def _arrow(arrow: LoadArrow, offset: FloatArray) -> dict[str, Any] | None:
    """None where the live load has no direction."""
    if not len(arrow.pairs):
        return None
    points = packed(arrow.points - offset)
    return {"name": arrow.name, "points": points, "pairs": packed(arrow.pairs), "block": arrow.block}
