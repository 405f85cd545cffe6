"""The animation of a mechanism: a PVD collection of frames in which every block turns by a finite rotation."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path

import numpy as np

from mbla.results.collapse.finite_motion import finite_motion
from mbla.results.collapse.motion import moved_vertices
from mbla.results.vtu.scene import Scene
from mbla.results.vtu.vtu import block_data, write_cells


def write_frame_vtu(path: Path, scene: Scene, time: float) -> None:
    """Blocks at a time from 0 (as built) to 1 (the motion as drawn).

    Point data: ``displacement``, what they have moved. Cell data: ``block``, ``group``, ``fixed``, ``part``, labels.
    """
    blocks = scene.model.blocks
    vertices = moved_vertices(blocks, finite_motion(scene.model, scene.contacts, scene.case, time))
    data = block_data(scene.model) | {"part": scene.parts}
    del data["weight"]
    write_cells(path, vertices, vertices - blocks.vertices, data, scene.cells)


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
