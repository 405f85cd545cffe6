"""What the files for ParaView show, one mesh for each kind of file; without a case of the model alone.

Blocks have points of their own, so that Warp By Vector on ``displacement`` (scale factor 1) shows them part. What the
arrays are, :mod:`mbla.results.vtu.arrays` says; meshio writes neither texts nor truth values, so names are numbered in
alphabetical order and flags are 0 and 1.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.geometry.meshio_files import write_mesh
from mbla.model.model import Model
from mbla.model.pose import Pose
from mbla.model.solids.blocks import Blocks
from mbla.results.collapse.collapse import kept
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.motion import mean_displacements, motion_scale, moved_vertices, vertex_displacements
from mbla.results.collapse.thrust import points_to_draw
from mbla.results.record.scene import Scene
from mbla.results.vtu.arrays import Arrays, arrays_of
from mbla.solution.modes.modes import Modes

POINT, LINE = 0, 1
"""kinds of cells in a file of thrust"""


@dataclass(frozen=True)
class Mesh:
    """Points, cells and values on both.

    points     : (n_points, 3) m
    cells      : types and rows of points as meshio has them, each with the rows of its cells in ``cell_data``
    point_data : by name, (n_points, ...)
    cell_data  : by name, (n_cells, ...)
    """

    points: FloatArray
    cells: list[tuple[str, Any, Any]]
    point_data: Arrays
    cell_data: Arrays

    def write(self, path: Path) -> None:
        """As a VTU file; types of cells without any are left out. FileError if it cannot be written."""
        used = [(kind, cells, rows) for kind, cells, rows in self.cells if len(cells)]
        cell_data = {name: [values[rows] for *_, rows in used] for name, values in self.cell_data.items()}
        write_mesh(path, self.points, [(kind, cells) for kind, cells, _ in used], self.point_data, cell_data)


def blocks_mesh(scene: Scene) -> Mesh:
    """Blocks as polyhedra, in their order."""
    blocks = scene.model.blocks
    data = arrays_of(scene, "blocks", "cells")
    return _of_blocks(blocks, blocks.vertices, {"displacement": scene.displacements}, data)


def frame_mesh(scene: Scene, motion: FloatArray) -> Mesh:
    """Blocks after a motion, (n_blocks, 6); ``displacement`` is what they have moved."""
    blocks = scene.model.blocks
    vertices = moved_vertices(blocks, motion)
    moved = {"displacement": vertices - blocks.vertices}
    return _of_blocks(blocks, vertices, moved, arrays_of(scene, "frames", "cells"))


def modes_mesh(scene: Scene) -> Mesh | None:
    """Blocks as polyhedra with the shape of every mode of vibration as drawn; None where there are none."""
    return None if scene.case is None else _of_modes(scene.model, scene.case.solution.further.modes)


def modes_after_mesh(scene: Scene) -> Mesh | None:
    """The same after a time history, with the blocks where it left them."""
    if scene.case is None or (peaks := scene.case.solution.further.time_history.peaks) is None:
        return None
    pose = Pose.of(peaks.ends)
    model = replace(scene.model, blocks=pose.moved(scene.model.blocks))
    return _of_modes(model, scene.case.solution.further.modes_after)


def _of_modes(model: Model, modes: Modes) -> Mesh | None:
    shapes = modes.shapes
    if not len(modes):
        return None
    data: Arrays = {
        f"mode_{number}": motion_scale(model, shape) * vertex_displacements(model.blocks, shape)
        for number, shape in enumerate(shapes, 1)
    }
    return _of_blocks(model.blocks, model.blocks.vertices, data, {})


def _of_blocks(blocks: Blocks, points: FloatArray, point_data: Arrays, cell_data: Arrays) -> Mesh:
    return Mesh(points, [("polyhedron", polyhedra(blocks), slice(None))], point_data, cell_data)


@kept
def polyhedra(blocks: Blocks) -> list[list[IntArray]]:
    """Faces of every block by rows of the vertices."""
    faces = np.split(blocks.loops, blocks.loop_start[1:-1])
    return [faces[first:last] for first, last in zip(blocks.face_start[:-1], blocks.face_start[1:], strict=True)]


def contacts_mesh(scene: Scene) -> Mesh | None:
    """Contact points as vertices; None where there are none."""
    points = scene.contacts.points
    data = arrays_of(scene, "contacts", "points") | {"displacement": scene.contact_displacements}
    return Mesh(points, [("vertex", np.arange(len(points))[:, None], slice(None))], data, {}) if len(points) else None


def interfaces_mesh(scene: Scene) -> Mesh | None:
    """Interfaces as polygons, by their outer boundary; None where there are none."""
    contacts = scene.contacts
    if not len(contacts):
        return None
    cells = []
    for corners in np.unique(contacts.outline).tolist():
        rows = np.flatnonzero(contacts.outline == corners)
        cells.append(("polygon", contacts.point_start[rows][:, None] + np.arange(corners), rows))
    moved = {"displacement": scene.contact_displacements}
    return Mesh(contacts.points, cells, moved, arrays_of(scene, "interfaces", "cells"))


def _displaced(scene: Scene, interfaces: IntArray, points: FloatArray) -> Arrays:
    """The motion as drawn of a point of each of some interfaces, (n,) and (n, 3) m."""
    bodies = scene.contacts.bodies[interfaces]
    return {"displacement": mean_displacements(scene.model.blocks, scene.motion, bodies, points)}


def thrust_mesh(scene: Scene) -> Mesh | None:
    """Points of application as vertices, thrust lines as chains of lines; outside a joint its edge; None for none."""
    thrust = scene.thrust
    if thrust is None or not thrust.carried.any():
        return None
    shown = np.flatnonzero(thrust.carried)
    row = np.cumsum(thrust.carried) - 1
    points = points_to_draw(scene.contacts, thrust)[shown]
    pieces = [np.column_stack([row[line[:-1]], row[line[1:]]]) for line in scene.lines]
    lines = np.concatenate([np.zeros((0, 2), dtype=np.int64), *pieces])
    numbers = np.repeat(np.arange(len(pieces)), [len(piece) for piece in pieces])
    count = len(shown)
    cells = [("vertex", np.arange(count)[:, None], slice(count)), ("line", lines, slice(count, None))]
    data = arrays_of(scene, "thrust", "points", shown)
    return Mesh(
        points,
        cells,
        data | _displaced(scene, shown, points),
        {
            "kind": np.repeat(np.array([POINT, LINE], dtype=np.int8), [count, len(lines)]),
            "line": np.concatenate([np.full(count, -1), numbers]),
        },
    )


def hinges_mesh(scene: Scene) -> Mesh | None:
    """Hinges as lines, as long as their faces stay closed, and those about a corner as vertices; None for none."""
    motion = scene.interfaces
    if motion is None or scene.mechanics is None or not motion.count(InterfaceMode.HINGE):
        return None
    hinges = np.flatnonzero(motion.modes == InterfaceMode.HINGE)
    ends = motion.hinge_ends[hinges]
    short = (ends[:, 0] == ends[:, 1]).all(axis=1)
    lines, corners = hinges[~short], hinges[short]
    points = np.concatenate([ends[~short].reshape(-1, 3), ends[short, 0]])
    owners = np.concatenate([np.repeat(lines, 2), corners])
    scale = motion_scale(scene.model, scene.mechanics.mechanism)
    turns = scale * np.einsum("ij,ij->i", motion.rotation, np.nan_to_num(motion.hinge_directions))
    rows = np.arange(len(points))
    cells = [("line", rows[: 2 * len(lines)].reshape(-1, 2), lines), ("vertex", rows[2 * len(lines) :, None], corners)]
    return Mesh(
        points, cells, _displaced(scene, owners, points), arrays_of(scene, "hinges", "cells") | {"rotation": turns}
    )
