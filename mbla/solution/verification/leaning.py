"""What modes leave out where joints are soft: weight that turns with the structure, and takes from its stiffness."""

from __future__ import annotations

import math

import numpy as np
import shapely

from mbla.model.model import LoadCase, Model
from mbla.solution.modes.modes import Modes


def left_out_share(model: Model, load_case: LoadCase, modes: Modes) -> float:
    """Share 6 s H/B² that weight takes from the stiffness against leaning; at 1 nothing is left, and it falls.

    s is the sag, H the height of what moves against the dead load, B its lesser breadth across that; 0 without a dead
    load that has a direction.
    """
    moves = model.free
    weight = load_case.dead_load[moves, :3].sum(axis=0)
    size = float(np.linalg.norm(weight))
    if not size > 0.0 or math.isnan(modes.sag):
        return 0.0
    up = -weight / size
    corners = model.blocks.vertices[np.isin(model.blocks.block_of_vertex, moves)]
    across = np.linalg.svd(up[None])[2][1:]
    outline = shapely.minimum_rotated_rectangle(shapely.MultiPoint(corners @ across.T))
    sides = np.linalg.norm(np.diff(shapely.get_coordinates(outline), axis=0), axis=1)
    return 6.0 * modes.sag * float(np.ptp(corners @ up)) / float(sides.min()) ** 2
