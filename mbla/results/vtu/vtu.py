"""Files for ParaView, one for each kind of cell; without a case the model alone.

Blocks have points of their own, so that Warp By Vector on ``displacement`` (scale factor 1) shows them part. What the
arrays are, :mod:`mbla.results.vtu.arrays` says; meshio writes neither texts nor truth values, so names are numbered in
alphabetical order and flags are 0 and 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.geometry.meshio_files import write_mesh
from mbla.results.collapse.finite_motion import finite_motion
from mbla.results.collapse.motion import displacements_at, moved_vertices
from mbla.results.record.scene import Scene
from mbla.results.vtu.arrays import Arrays, arrays_of
from mbla.results.vtu.cells import block_cells


def write_blocks_vtu(path: Path, scene: Scene) -> None:
    """Blocks as cells."""
    data = arrays_of(scene, "blocks", "cells")
    _write_blocks(path, scene, scene.model.blocks.vertices, scene.displacements, data)


def write_frame_vtu(path: Path, scene: Scene, time: float) -> None:
    """Blocks at a time from 0 (as built) to 1 (the motion as drawn); ``displacement`` is what they have moved."""
    blocks = scene.model.blocks
    vertices = moved_vertices(blocks, finite_motion(scene.model, scene.contacts, scene.case, time))
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
