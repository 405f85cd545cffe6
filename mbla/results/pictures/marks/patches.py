"""Marks of what axles stand on: rectangles and lines on blocks, soil or fill."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.applied_load import Patches
from mbla.results.pictures.marks.marks import Mark, segments

NAME = "contact of axles"
ABOVE = 2e-3
"""of the size of the structure, by which they are drawn above what they lie on"""


def patch_mark(patches: Patches, size: float, colour: str, named: bool, towards: FloatArray | None) -> Mark:
    """Areas with their outlines; in a plane figure lines, as they are seen from its side.

    size    : of the structure, m
    named   : they are in the legend
    towards : (3,) unit, to the eye of a plane figure; None in space
    """
    corners, name = patches.corners, NAME if named else ""
    bodies, count = np.column_stack([patches.blocks] * 2), len(patches.blocks)
    if towards is not None:
        middles = (corners + np.roll(corners, -1, axis=1)) / 2  # of the sides
        ends = np.stack([middles[:, [3, 1]], middles[:, [0, 2]]], axis=1)
        seen = np.linalg.norm(np.cross(ends[:, :, 1] - ends[:, :, 0], towards), axis=2)
        return segments(name, colour, ends[np.arange(count), seen.argmax(axis=1)], bodies, [NAME] * count)
    rows = np.arange(4 * count).reshape(count, 4)
    raised = corners.reshape(-1, 3) + np.array([0.0, 0.0, ABOVE * size])
    sides = np.stack([rows, np.roll(rows, -1, axis=1)], axis=2).reshape(-1, 2)
    widths, texts = np.full(len(sides), 0.3), (NAME,) * (4 * count)
    return Mark(name, colour, raised, np.repeat(bodies, 4, axis=0), sides, widths, texts, rows, outlined=True)
