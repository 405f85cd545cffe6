"""Files for ParaView, one for each kind of cell; without a case the model alone.

Blocks have points of their own, so that Warp By Vector on ``displacement`` (scale factor 1) shows them part. What the
arrays are, :mod:`mbla.results.vtu.arrays` says; meshio writes neither texts nor truth values, so names are numbered in
alphabetical order and flags are 0 and 1.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.geometry.meshio_files import write_mesh
from mbla.model.solids.blocks import Blocks
from mbla.results.collapse.collapse import kept
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.motion import displacements_at, motion_scale, moved_vertices
from mbla.results.collapse.thrust import points_to_draw
from mbla.results.record.scene import Scene
from mbla.results.vtu.arrays import Arrays, arrays_of


def write_blocks_vtu(path: Path, scene: Scene) -> None:
    """Blocks as cells."""
    data = arrays_of(scene, "blocks", "cells")
    _write_blocks(path, scene, scene.model.blocks.vertices, scene.displacements, data)


def write_frame_vtu(path: Path, scene: Scene, time: float) -> None:
    """Blocks at a time from 0 (as built) to 1 (the motion as drawn); ``displacement`` is what they have moved."""
    blocks = scene.model.blocks
    vertices = moved_vertices(blocks, time * scene.motion)
    _write_blocks(path, scene, vertices, vertices - blocks.vertices, arrays_of(scene, "frames", "cells"))


def _write_blocks(path: Path, scene: Scene, points: FloatArray, displacement: FloatArray, data: Arrays) -> None:
    """Blocks with their vertices at ``points`` and data on each, (n_blocks, ...)."""
    cells = block_cells(scene.model.blocks)
    cell_data = {name: [values[rows] for rows in cells.rows] for name, values in data.items()}
    write_mesh(path, points, list(cells.cells), point_data={"displacement": displacement}, cell_data=cell_data)


def write_contacts_vtu(path: Path, scene: Scene) -> None:
    """Contact points as vertices."""
    data = arrays_of(scene, "contacts", "points") | {"displacement": scene.contact_displacements}
    points = scene.contacts.points
    write_mesh(path, points, [("vertex", np.arange(len(points))[:, None])], point_data=data, cell_data={})


def write_interfaces_vtu(path: Path, scene: Scene) -> None:
    """Interfaces as polygons, by their outer boundary."""
    contacts = scene.contacts
    rows = [np.flatnonzero(contacts.outline == n) for n in np.unique(contacts.outline)]
    write_mesh(
        path,
        contacts.points,
        [("polygon", _outlines(contacts, each)) for each in rows],
        point_data={"displacement": scene.contact_displacements},
        cell_data={
            name: [values[each] for each in rows] for name, values in arrays_of(scene, "interfaces", "cells").items()
        },
    )


def _outlines(contacts: Contacts, rows: IntArray) -> Any:
    """Points of the outer boundary of interfaces that have as many of them, (n, k)."""
    return contacts.point_start[rows][:, None] + np.arange(contacts.outline[rows[0]])


def interface_displacements(scene: Scene, interfaces: IntArray, points: FloatArray) -> FloatArray:
    """Mean displacement of the two bodies of each interface at a point of it, (n, 3) m; grounds do not move.

    interfaces : (n,)
    points     : (n, 3) m
    """
    total = np.zeros_like(points)
    for side in (0, 1):
        owners = scene.contacts.bodies[interfaces, side]
        block = owners < len(scene.model.blocks)
        total[block] += displacements_at(scene.model.blocks, scene.motion, owners[block], points[block])
    return total / 2


def frame_times(frames: int) -> list[float]:
    """Evenly spaced from 0 to 1."""
    return [float(time) for time in np.linspace(0.0, 1.0, frames)]


def collection_pvd(files: Sequence[str], times: Sequence[float]) -> str:
    """The text of a PVD file that plays the frames."""
    lines = [
        '<?xml version="1.0"?>',
        '<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">',
        "  <Collection>",
        *(
            f'    <DataSet timestep="{time:.6g}" group="" part="0" file="{escape(file)}"/>'
            for file, time in zip(files, times, strict=True)
        ),
        "  </Collection>",
        "</VTKFile>",
        "",
    ]
    return "\n".join(lines)


POINT, LINE = 0, 1
"""kinds of cells"""


def has_thrust(scene: Scene) -> bool:
    """Whether any interface carries a force."""
    return scene.thrust is not None and bool(scene.thrust.carried.any())


def write_thrust_vtu(path: Path, scene: Scene) -> None:
    """Points of application as vertices, thrust lines as chains of line cells; outside a joint its edge.

    Raises ValueError for a case without forces.
    """
    thrust = scene.thrust
    if thrust is None:
        raise ValueError("a case without forces has no thrust")
    shown = np.flatnonzero(thrust.carried)
    row = np.full(len(thrust.carried), -1)
    row[shown] = np.arange(len(shown))
    points = points_to_draw(scene.contacts, thrust)[shown]
    segments, numbers = _segments(scene.lines, row)
    blocks = [("vertex", np.arange(len(shown))[:, None]), ("line", segments)]
    kinds = [np.full(len(shown), POINT, dtype=np.int8), np.full(len(segments), LINE, dtype=np.int8)]
    used = slice(None) if len(segments) else slice(1)
    write_mesh(
        path,
        points,
        blocks[used],
        point_data=arrays_of(scene, "thrust", "points", shown)
        | {"displacement": interface_displacements(scene, shown, points)},
        cell_data={"kind": kinds[used], "line": [np.full(len(shown), -1), numbers][used]},
    )


def _segments(lines: tuple[IntArray, ...], row: IntArray) -> tuple[IntArray, IntArray]:
    """Pairs of points that follow each other on a line, (n, 2), and the number of its line, (n,)."""
    if not lines:
        return np.zeros((0, 2), dtype=np.int64), np.zeros(0, dtype=np.int64)
    pairs = [np.column_stack([row[line[:-1]], row[line[1:]]]) for line in lines]
    return np.concatenate(pairs), np.repeat(np.arange(len(lines)), [len(each) for each in pairs])


def has_hinges(scene: Scene) -> bool:
    """Whether the mechanism has a hinge."""
    return scene.interfaces is not None and scene.interfaces.count(InterfaceMode.HINGE) > 0


def write_hinges_vtu(path: Path, scene: Scene) -> None:
    """Each hinge as one line cell, as long as its faces stay closed; then those about a corner as vertex cells.

    Raises ValueError for a case without a mechanism.
    """
    motion = scene.interfaces
    if motion is None or scene.mechanics is None:
        raise ValueError("a case without a mechanism has no hinges")
    hinges = np.flatnonzero(motion.modes == InterfaceMode.HINGE)
    ends = motion.hinge_ends[hinges]
    short = (ends[:, 0] == ends[:, 1]).all(axis=1)
    lines, corners = hinges[~short], hinges[short]
    points = np.concatenate([ends[~short].reshape(-1, 3), ends[short, 0]])
    owners = np.concatenate([np.repeat(lines, 2), corners])
    scale = motion_scale(scene.model, scene.mechanics.mechanism)
    turns = scale * np.einsum("ij,ij->i", motion.rotation, np.nan_to_num(motion.hinge_directions))
    data = arrays_of(scene, "hinges", "cells") | {"rotation": turns}
    rows = np.arange(len(points))
    cells = (("line", lines, rows[: 2 * len(lines)].reshape(-1, 2)), ("vertex", corners, rows[2 * len(lines) :, None]))
    groups = [(kind, which, each) for kind, which, each in cells if len(which)]
    write_mesh(
        path,
        points,
        [(kind, each) for kind, _, each in groups],
        point_data={"displacement": interface_displacements(scene, owners, points)},
        cell_data={name: [values[which] for _, which, _ in groups] for name, values in data.items()},
    )


# --- Blocks as the cells that ParaView knows -------------------------------------------------------------------------


@dataclass(frozen=True)
class BlockCells:
    """Cells for a mesh file.

    cells : pairs of cell type and connectivity; for polyhedra a list of cells, each a list of faces
    rows  : the blocks of each of these pairs, in its order
    """

    cells: tuple[tuple[str, Any], ...]
    rows: tuple[IntArray, ...]


SHAPES = {(3, 3, 3, 3): "tetra", (3, 3, 4, 4, 4): "wedge", (4, 4, 4, 4, 4, 4): "hexahedron"}
"""cell types of VTK by the numbers of corners of their faces"""


@kept
def block_cells(blocks: Blocks) -> BlockCells:
    """Cells of all blocks; connectivity counts rows of ``blocks.vertices``."""
    faces = [loop.tolist() for loop in np.split(blocks.loops, blocks.loop_start[1:-1])]
    of_block = [faces[first:last] for first, last in itertools.pairwise(blocks.face_start.tolist())]
    cells = [_cell(each) if convex else None for each, convex in zip(of_block, blocks.convex.tolist(), strict=True)]
    known = [cell for cell in cells if cell is not None]
    if len(known) < len(blocks):
        polyhedra = [[np.array(face) for face in each] for each in of_block]
        return BlockCells((("polyhedron", polyhedra),), (np.arange(len(blocks)),))
    rows = [np.array([row for row, (kind, _) in enumerate(known) if kind == each]) for each in SHAPES.values()]
    used = [(kind, own) for kind, own in zip(SHAPES.values(), rows, strict=True) if len(own)]
    return BlockCells(
        tuple((kind, np.array([known[row][1] for row in own])) for kind, own in used), tuple(own for _, own in used)
    )


def _cell(faces: list[list[int]]) -> tuple[str, list[int]] | None:
    """Type and vertices of a convex block that is a cell of VTK: its base, then what stands on each corner of that."""
    kind = SHAPES.get(tuple(sorted(map(len, faces))))
    if kind is None:
        return None
    base = next(face for face in faces if len(face) == (4 if kind == "hexahedron" else 3))
    above = {corner: set[int]() for corner in base}
    for face in faces:
        for one, other in zip(face, face[1:] + face[:1], strict=True):
            if one in above and other not in above:
                above[one].add(other)
    if any(len(each) != 1 for each in above.values()):
        return None
    base = base if kind == "wedge" else base[::-1]  # VTK wants the normal of this inwards
    top = [next(iter(above[corner])) for corner in base]
    if len(set(top)) != (1 if kind == "tetra" else len(base)):
        return None
    return kind, base + (top[:1] if kind == "tetra" else top)
