"""What the browser gets of one load case: arrays of the structure as built, its motion, marks, colours, words.

The browser moves blocks straight between a few frames of :func:`mbla.results.collapse.motion.rigid_frames`. Coordinates
are those of the deck less an offset where the model lies far from the origin: graphics cards count with seven digits.
"""

from __future__ import annotations

import base64
from collections.abc import Sequence
from html import escape
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray, starts
from mbla.contacts.overlaps import triangulate_blocks
from mbla.deck.sections.selectors import POSITIONS
from mbla.model.model import Model
from mbla.model.solids.plane import plane_axes
from mbla.results.collapse.motion import largest_displacements, rigid_frames
from mbla.results.listing.places import soil_words
from mbla.results.listing.text import number
from mbla.results.pictures.camera import axes_of, view_of_case
from mbla.results.pictures.drawing import ghost_edges
from mbla.results.pictures.geometry import block_edges
from mbla.results.pictures.marks.forces import force_marks
from mbla.results.pictures.marks.joints import joint_marks
from mbla.results.pictures.marks.loads import live_marks
from mbla.results.pictures.marks.marks import Mark, moved
from mbla.results.pictures.marks.ties import tie_marks
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import FIXED_BLOCK, GROUPS, LIVE_LOAD, REST, SLOW, group_colours, rgb
from mbla.results.pictures.scene import PictureScene, bounding_edges
from mbla.results.pictures.scene import scene_of as picture_of
from mbla.results.results import CaseResult, Results

FRAMES = 4
"""steps of a motion, straight between: where it turns by half a radian they take 0.2 % of the size of blocks"""
FAR = 1e3
"""distance from the origin over the size of the model from which coordinates are drawn less an offset"""
MARGIN = 0.04
"""of the largest extent, around what is drawn"""
NO_VALUE = "#C8C8C8"
STRONGEST = {"displacement": "#1A5E9B", "eccentricity": "#B2182B"}
MOST_NAMES = 12
"""entries of a legend; the others are counted"""


def scene_of(results: Results, case: CaseResult, view: tuple[float, float] | None = None) -> dict[str, Any]:
    """Everything that ``view.js`` draws, ready for JSON: numbers, texts and packed arrays.

    view : azimuth and elevation of the eye at first, degrees; None: what suits the structure
    """
    scene = picture_of(results, case, PictureOptions(), "mechanism")
    model, blocks, moves = scene.model, scene.model.blocks, bool(scene.motion.any())
    offset = offset_of(blocks.vertices, scene.size)
    loads = live_marks(scene, case.load_case, "live load", LIVE_LOAD)
    ties = tie_marks(scene)
    marks = [*joint_marks(scene, flat=False), *force_marks(scene, proportional=True), *ties, *loads]
    reach = [points for mark in (*ties, *loads) for points in (mark.points, moved(mark, model, scene.motion))]
    seen = np.vstack([scene.moved, blocks.vertices, *(slab.points for slab in scene.slabs), *reach])
    margin = MARGIN * float(np.ptp(seen, axis=0).max())
    of_block = triangulate_blocks(blocks, np.arange(len(blocks)))
    triangles = np.concatenate([of_block[block] for block in range(len(blocks))])
    owners = np.repeat(np.arange(len(blocks)), [len(of_block[block]) for block in range(len(blocks))])
    parts, frames = rigid_frames(blocks, scene.motion, offset, FRAMES)
    eye = axes_of(*(view or view_of_case(scene)))[0]
    ground = bool(scene.slabs) and _ground(scene, offset)
    return {
        "unit": model.units.length,
        "offset": offset.tolist(),
        "low": (seen.min(axis=0) - margin - offset).tolist(),
        "high": (seen.max(axis=0) + margin - offset).tolist(),
        "eye": eye.tolist(),
        "vertices": packed(blocks.vertices - offset),
        "vertexStart": packed(blocks.vertex_start),
        "triangles": packed(triangles),
        "blockOfTriangle": packed(owners),
        "edges": packed(bounding_edges(scene, block_edges(blocks))),
        "ghost": packed(ghost_edges(scene)),
        "partOfBlock": packed(parts),
        "motion": packed(frames) if moves else None,
        "steps": FRAMES,
        "motionWords": motion_words(scene) if moves else "",
        "texts": block_texts(model, scene.clusters if moves else None),
        "colourings": colourings(scene),
        "marks": [_mark(mark, offset) for mark in marks],
        "forceWords": "" if scene.forces is None else _with_mark(scene, scene.force_words),
        "ground": ground or None,
    }


def _ground(scene: PictureScene, offset: FloatArray) -> dict[str, Any]:
    """The slabs of ground as one mesh of triangles."""
    first = starts(np.array([len(slab.points) for slab in scene.slabs], dtype=np.int64))
    rows = [slab.triangles + begin for slab, begin in zip(scene.slabs, first.tolist(), strict=False)]
    points = np.concatenate([slab.points for slab in scene.slabs])
    return {"points": packed(points - offset), "triangles": packed(np.concatenate(rows))}


def offset_of(vertices: FloatArray, size: float) -> FloatArray:
    """Centre of the model to the digit of its size where it lies far from the origin, else zero, (3,) m."""
    if np.abs(vertices).max() <= FAR * size:
        return np.zeros(3)
    digit = 10.0 ** np.floor(np.log10(size))
    return np.asarray(np.rint(vertices.mean(axis=0) / digit) * digit)


def motion_words(scene: PictureScene) -> str:
    """What the motion is; where it belongs to no result, that it does not."""
    return _with_mark(scene, "motion in which the dead load falls" if scene.mechanics is None else "mechanism")


def _with_mark(scene: PictureScene, words: str) -> str:
    mark = scene.mark_of("mechanism")
    return f"{words} ({mark})" if mark else words


def block_texts(model: Model, parts: IntArray | None) -> list[str]:
    """What the browser shows for each block: name, position, weight, part; of a cell of soil which soil; as HTML.

    parts : (n_blocks,) part of each block, 0 at rest; None without a motion
    """
    blocks, units = model.blocks, model.units
    weights = model.weights.tolist()
    known = [name for name in POSITIONS if (blocks.labels.position(name) >= 0).any()]
    columns = [blocks.labels.position(name).tolist() for name in known]
    texts, soil = [], model.soil_of_block
    for block in range(len(blocks)):
        places = [f"{name} {column[block]}" for name, column in zip(known, columns, strict=True) if column[block] >= 0]
        member = blocks.labels.members[block]
        lines = [escape(blocks.name(block)), ", ".join([escape(member)] * bool(member) + places)]
        lines.append(f"weight {number(weights[block])} {units.force}")
        if soil[block] >= 0:
            lines = [escape(soil_words(model, soil[[block]]))]
        if model.fixed[block]:
            lines.append("fixed")
        elif parts is not None:
            lines.append(f"part {parts[block]}" if parts[block] else "at rest")
        texts.append("<br>".join(line for line in lines if line))
    return texts


# --- Colours of blocks ----------------------------------------------------------------------------------------------


Colouring = dict[str, Any]
"""colours as #RRGGBB, of each block its row of these, names and colours for the legend"""


def colourings(scene: PictureScene) -> list[Colouring]:
    """The ways to colour that the case has, the first at first; groups and parts as in the pictures."""
    of_group = group_colours(scene.model.blocks.groups)
    row = {name: i for i, name in enumerate(of_group)}
    rows = np.array([row[group] for group in scene.model.blocks.groups])
    found = [_by_name("group", rows, tuple(of_group), tuple(of_group.values()))]
    if scene.motion.any():
        farthest = largest_displacements(scene.model.blocks, scene.motion)
        share = farthest / (farthest.max() or 1.0)
        found = [
            by_part(scene, np.where(scene.slow, -1, scene.clusters)),
            _by_value(scene, "displacement", share, "none", "largest"),
            *found,
        ]
    if scene.thrust is not None and len(scene.contacts):
        found.append(_by_value(scene, "eccentricity", _block_eccentricity(scene), "0, central", "1, at the edge"))
    return found


def by_part(scene: PictureScene, parts: IntArray) -> Colouring:
    """Parts that move together, (n_blocks,) from 1; what rests, 0, is pale, what is fixed grey; -1: moves less."""
    count = max(int(parts.max(initial=0)), 0)
    names = ["fixed", "moves less", "at rest", *(f"part {part + 1}" for part in range(count))]
    colours = [FIXED_BLOCK, SLOW, REST, *(GROUPS[part % len(GROUPS)] for part in range(count))]
    used, rows = np.unique(np.where(scene.model.fixed, 0, parts + 2), return_inverse=True)
    return _by_name("part", rows, [names[i] for i in used], tuple(colours[i] for i in used.tolist()))


def _by_value(scene: PictureScene, name: str, values: FloatArray, low: str, high: str, steps: int = 32) -> Colouring:
    """Values from 0 to 1 in steps, (n_blocks,), nan for none; ``low`` and ``high`` name 0 and 1."""
    ramp = tuple(mixed(REST, STRONGEST[name], i / (steps - 1)) for i in range(steps))
    rows = np.rint(np.nan_to_num(np.clip(values, 0.0, 1.0)) * (steps - 1)).astype(np.int64)
    rows = np.where(np.isnan(values), steps, rows)
    rows = np.where(scene.model.fixed & (name == "displacement"), steps + 1, rows)
    legend = [(low, ramp[0]), (high, ramp[-1])]
    legend += [("none", NO_VALUE)] if (rows == steps).any() else []
    legend += [("fixed", FIXED_BLOCK)] if (rows == steps + 1).any() else []
    return {"name": name, "colours": (*ramp, NO_VALUE, FIXED_BLOCK), "rows": packed(rows), "legend": legend}


def _by_name(name: str, rows: IntArray, names: Sequence[str], colours: tuple[str, ...]) -> Colouring:
    legend = list(zip(names, colours, strict=True))
    if len(legend) > MOST_NAMES:
        legend = [*legend[: MOST_NAMES - 1], (f"and {len(legend) - MOST_NAMES + 1} more", "")]
    return {"name": name, "colours": colours, "rows": packed(rows), "legend": legend}


def mixed(first: str, second: str, share: float) -> str:
    """The colour at a share of the way from the first to the second."""
    red, green, blue = (round(255 * (a + share * (b - a))) for a, b in zip(rgb(first), rgb(second), strict=True))
    return f"#{red:02X}{green:02X}{blue:02X}"


def _block_eccentricity(scene: PictureScene) -> FloatArray:
    """Greatest eccentricity among the interfaces of each block, (n_blocks,); nan where none carries a force."""
    greatest = np.full(len(scene.model.blocks) + len(scene.model.grounds), np.nan)
    if scene.thrust is not None:
        np.fmax.at(greatest, scene.contacts.bodies.ravel(), np.repeat(scene.thrust.eccentricity, 2))
    return greatest[: len(scene.model.blocks)]


# --- as JSON ------------------------------------------------------------------------------------------------------


def packed(values: FloatArray | IntArray) -> dict[str, str]:
    """An array of any shape, flat, as base64 of little-endian numbers: single precision, or 32-bit integers."""
    kind = "f4" if values.dtype.kind == "f" else "i4"
    data = np.ascontiguousarray(values.ravel(), dtype=np.dtype(kind).newbyteorder("<"))
    return {"dtype": kind, "bdata": base64.b64encode(data.tobytes()).decode("ascii")}


HEAD, BREADTH = 0.22, 0.08
"""of an arrow: length and half breadth of its head over its length"""


def _mark(mark: Mark, offset: FloatArray) -> dict[str, Any]:
    """Segments with the bodies that carry their points; an arrow has four barbs, which its tip's bodies carry."""
    points, bodies, pairs, texts = mark.points, mark.bodies, mark.pairs, list(mark.texts)
    if mark.arrows:
        first, last = pairs.T
        step = points[last] - points[first]
        first_side, second_side = plane_axes(step / np.linalg.norm(step, axis=1, keepdims=True)).transpose(1, 0, 2)
        lengths = np.linalg.norm(step, axis=1, keepdims=True)
        for side in (first_side, -first_side, second_side, -second_side):
            rows = len(points) + np.arange(len(last))
            points = np.vstack([points, points[last] - HEAD * step + BREADTH * lengths * side])
            bodies, pairs = np.vstack([bodies, bodies[last]]), np.vstack([pairs, np.column_stack([last, rows])])
            texts += [mark.texts[row] for row in last.tolist()]
    known = {text: row for row, text in enumerate(dict.fromkeys(texts))}
    return {
        "name": mark.name.partition(":")[0].partition(", section")[0],
        "colour": mark.colour,
        "width": 8 if mark.name == "hinge" else 5,
        "points": packed(points - offset),
        "bodies": packed(bodies),
        "pairs": packed(pairs),
        "texts": [escape(text) for text in known],
        "textRows": packed(np.array([known[text] for text in texts], dtype=np.int64)),
        "inside": mark.inside,
        "dots": mark.name == "hinge" or bool((pairs[:, 0] == pairs[:, 1]).all()),
    }
