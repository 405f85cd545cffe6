"""Lines through interfaces: ``STEM_CASE_thrust.vtu``, resultants and thrust lines; ``STEM_CASE_hinges.vtu``."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mbla.arrays import IntArray
from mbla.model.geometry.meshio_files import write_mesh
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.motion import motion_scale
from mbla.results.collapse.thrust import points_to_draw
from mbla.results.record.scene import Scene
from mbla.results.vtu.arrays import arrays_of
from mbla.results.vtu.vtu import interface_displacements

POINT, LINE = 0, 1
"""kinds of cells"""


def has_thrust(scene: Scene) -> bool:
    """Whether any interface carries a force."""
    return scene.thrust is not None and bool(scene.thrust.carried.any())


def write_thrust_vtu(path: Path, scene: Scene) -> None:
    """Points of application as vertices, thrust lines as chains of line cells; outside a joint its edge."""
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
    """Each hinge as one line cell, as long as its faces stay closed; then those about a corner as vertex cells."""
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
