"""Where something moves, in words: with the load or against it, up or down, outwards, or along an axis."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.model import LoadCase, Model
from mbla.results.listing.text import vector

ALONG_AXIS = 0.995
"""cosine from which a direction is called by the axis it follows: within 6 degrees"""
VERTICAL = 0.95
"""cosine from which a direction is plainly up or down: within 18 degrees"""
LEVEL = 0.15
"""sine up to which it is level: within 9 degrees"""
TABLE_DIGITS = 2
"""of directions in tables, whose columns are narrow: within half a degree"""
WITH = 0.8
"""cosine from which a direction in plan is that of the load, or outwards: within 37 degrees"""


def direction_words(direction: FloatArray, digits: int = 3) -> str:
    """``+y`` for what nearly follows an axis, else the components, with some digits behind the point."""
    axis = int(np.argmax(np.abs(direction)))
    if abs(direction[axis]) >= ALONG_AXIS:
        return ("+" if direction[axis] > 0 else "-") + "xyz"[axis]
    return vector(np.round(direction, digits))


def way_words(model: Model, load_case: LoadCase, velocity: FloatArray, at: FloatArray) -> str:
    """``with the load and downwards``, ``downwards``, ``outwards``, ``towards +x``; empty for no motion.

    velocity, at : (3,) of a point, m
    """
    speed = float(np.linalg.norm(velocity))
    if speed == 0.0:
        return ""
    down = downwards(load_case)
    sinks = float(velocity @ down) / speed
    rises = "downwards" if sinks > 0 else "upwards"
    if abs(sinks) >= VERTICAL:
        return rises
    level = velocity / speed - sinks * down
    words = _level_words(model, load_case, level / float(np.linalg.norm(level)), at, down)
    return words if abs(sinks) <= LEVEL else f"{words} and {rises}"


def downwards(load_case: LoadCase) -> FloatArray:
    """Direction of the dead load, (3,), but for that of a support that gives way; -z where there is none."""
    loads = load_case.dead_load[:, :3]
    if load_case.settlement is not None:
        loads = np.delete(loads, load_case.settlement.blocks, axis=0)
    return _unit(loads.sum(axis=0), np.array([0.0, 0.0, -1.0]))


def _unit(vector: FloatArray, default: FloatArray) -> FloatArray:
    size = float(np.linalg.norm(vector))
    return np.asarray(vector / size) if size > 0 else default


def _level_words(model: Model, load_case: LoadCase, level: FloatArray, at: FloatArray, down: FloatArray) -> str:
    """A level direction: by the load where that has one in plan, by the middle of the structure, or by the axes."""
    if load_case.settlement is None:
        live = load_case.live_load[:, :3].sum(axis=0)
        pushes = live - (live @ down) * down
        if np.linalg.norm(pushes) > LEVEL * np.linalg.norm(live):
            along = float(level @ _unit(pushes, level))
            if abs(along) >= WITH:
                return "with the load" if along > 0 else "against the load"
    blocks = model.blocks
    middle = np.average(blocks.centroids, axis=0, weights=blocks.volumes)
    out = at - middle
    out = out - (out @ down) * down
    size = float(np.ptp(blocks.vertices, axis=0).max(initial=0.0))
    if np.linalg.norm(out) > LEVEL * size:
        along = float(level @ _unit(out, level))
        if abs(along) >= WITH:
            return "outwards" if along > 0 else "inwards"
    return f"towards {direction_words(level)}"
