"""Surfaces of blocks as triangles, and their colours."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, row_of_item, starts
from mbla.contacts.polygons import triangulate
from mbla.model.model import Model
from mbla.model.solids.blocks import Blocks

PALETTE = ("#E69F00", "#56B4E9", "#009E73", "#F0E442", "#CC79A7", "#0072B2", "#D55E00", "#B8B8B8")
"""after Okabe and Ito; of more than these every round is paler than the one before"""
REST, FIXED, NO_VALUE = "#EDE5D4", "#9E9E9E", "#C8C8C8"
STRONGEST = {"displacement": "#1A5E9B", "eccentricity": "#B2182B"}
MOST_NAMES = 12
"""entries of a legend; the others are counted"""


@dataclass(frozen=True)
class Colouring:
    """Colour of every block.

    colours : as #RRGGBB
    rows    : (n_blocks,) rows of ``colours``
    legend  : names and colours, for the reader
    """

    name: str
    colours: tuple[str, ...]
    rows: IntArray
    legend: tuple[tuple[str, str], ...]


def by_group(model: Model) -> Colouring:
    """Groups in alphabetical order."""
    names = sorted(set(model.blocks.groups))
    row = {name: i for i, name in enumerate(names)}
    return _by_name("group", np.array([row[group] for group in model.blocks.groups]), names, palette(len(names)))


def by_part(model: Model, parts: IntArray) -> Colouring:
    """Parts that move together; what rests is pale, what is fixed grey."""
    count = int(parts.max(initial=0))
    names = ["fixed", "at rest", *(f"part {i}" for i in range(1, count + 1))]
    rows = np.where(model.fixed, 0, parts + 1)
    used = np.unique(rows)
    colours = (FIXED, REST, *palette(count))
    rows = np.searchsorted(used, rows)
    return _by_name("part", rows, [names[i] for i in used], tuple(colours[i] for i in used.tolist()))


def by_value(model: Model, name: str, values: FloatArray, low: str, high: str, steps: int = 32) -> Colouring:
    """Values from 0 to 1 in steps, (n_blocks,), nan for none; ``low`` and ``high`` name 0 and 1."""
    ramp = tuple(mixed(REST, STRONGEST[name], i / (steps - 1)) for i in range(steps))
    rows = np.rint(np.nan_to_num(np.clip(values, 0.0, 1.0)) * (steps - 1)).astype(np.int64)
    rows = np.where(np.isnan(values), steps, rows)
    rows = np.where(model.fixed & (name == "displacement"), steps + 1, rows)
    legend = [(low, ramp[0]), (high, ramp[-1])]
    legend += [("none", NO_VALUE)] if (rows == steps).any() else []
    legend += [("fixed", FIXED)] if (rows == steps + 1).any() else []
    return Colouring(name, (*ramp, NO_VALUE, FIXED), rows, tuple(legend))


def _by_name(name: str, rows: IntArray, names: Sequence[str], colours: tuple[str, ...]) -> Colouring:
    legend = list(zip(names, colours, strict=True))
    if len(legend) > MOST_NAMES:
        legend = [*legend[: MOST_NAMES - 1], (f"and {len(legend) - MOST_NAMES + 1} more", "")]
    return Colouring(name, colours, rows, tuple(legend))


def palette(count: int) -> tuple[str, ...]:
    """That many colours."""
    rounds = [1 - 0.6 ** (i // len(PALETTE)) for i in range(count)]
    return tuple(mixed(PALETTE[i % len(PALETTE)], "#FFFFFF", pale) for i, pale in enumerate(rounds))


def mixed(first: str, second: str, share: float) -> str:
    """The colour at a share of the way from the first to the second."""
    a, b = (np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)]) for colour in (first, second))
    red, green, blue = np.rint(a + share * (b - a)).astype(int).tolist()
    return f"#{red:02X}{green:02X}{blue:02X}"


# --- Faces of blocks as triangles -----------------------------------------------------------------------------------


ROUNDING = 1e-9
"""of the square of a face's size: turns smaller than this are straight"""


def face_triangles(blocks: Blocks) -> tuple[IntArray, IntArray]:
    """Corners of triangles as rows of ``vertices``, (n, 3), counter-clockwise seen from outside, and their faces, (n,).

    Sorted by faces, and so by blocks. No vertex is added. A face that no triangulation covers, as its outline crosses
    itself, is a fan about its first corner.
    """
    counts = np.diff(blocks.loop_start)
    reentrant = reentrant_faces(blocks)
    faces = np.repeat(np.arange(len(counts)), np.where(reentrant, 0, counts - 2))
    fans = _fans(blocks, faces)
    others = [_of_reentrant(blocks, face) for face in np.flatnonzero(reentrant).tolist()]
    rows = [np.full(len(each), face) for face, each in zip(np.flatnonzero(reentrant).tolist(), others, strict=True)]
    corners, owners = np.concatenate([fans, *others]), np.concatenate([faces, *rows])
    order = np.argsort(owners, kind="stable")
    return corners[order], owners[order]


def _fans(blocks: Blocks, faces: IntArray) -> IntArray:
    """Triangles about the first corner of each face, in order; a face stands there once for each of its triangles."""
    new = np.ones(len(faces), dtype=bool)
    new[1:] = faces[1:] != faces[:-1]
    first = starts(np.diff(np.append(np.flatnonzero(new), len(faces))))
    step = np.arange(len(faces)) - first[row_of_item(first)]
    begin = blocks.loop_start[faces]
    return np.column_stack([blocks.loops[begin], blocks.loops[begin + step + 1], blocks.loops[begin + step + 2]])


def reentrant_faces(blocks: Blocks) -> BoolArray:
    """Faces with a corner that turns inwards, (n_faces,)."""
    corners = blocks.vertices[blocks.loops]
    rows = np.arange(len(blocks.loops))
    following, preceding = rows + 1, rows - 1
    following[blocks.loop_start[1:] - 1] = blocks.loop_start[:-1]
    preceding[blocks.loop_start[:-1]] = blocks.loop_start[1:] - 1
    ahead, behind = corners[following] - corners, corners - corners[preceding]
    face = blocks.face_of_corner
    turns = np.einsum("ij,ij->i", np.cross(behind, ahead), blocks.face_normals[face])
    size = np.zeros(len(blocks.face_normals))
    np.maximum.at(size, face, np.square(ahead).sum(axis=1))
    reentrant = np.zeros(len(size), dtype=bool)
    reentrant[face[turns < -ROUNDING * size[face]]] = True
    return reentrant


def _of_reentrant(blocks: Blocks, face: int) -> IntArray:
    loop = blocks.loops[blocks.loop_start[face] : blocks.loop_start[face + 1]]
    normal = blocks.face_normals[face]
    along = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    points = blocks.vertices[loop] - blocks.vertices[loop[0]]
    flat = np.column_stack([points @ along, points @ np.cross(normal, along)])
    return np.asarray(loop[triangulate(flat)])


def triangle_normals(points: FloatArray, triangles: IntArray) -> FloatArray:
    """Unit normals, (n, 3); zero for triangles without area."""
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    return np.asarray(normals / np.where(lengths > 0, lengths, 1.0)[:, None])
