"""``STEM_CASE_thrust.vtu``: resultants at their points of application, and thrust lines through them."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mbla.arrays import IntArray
from mbla.model.geometry.meshio_files import write_mesh
from mbla.results.collapse.thrust import points_to_draw
from mbla.results.vtu.points import interface_displacements
from mbla.results.vtu.scene import Scene

POINT, LINE = 0, 1
"""kinds of cells"""


def has_thrust(scene: Scene) -> bool:
    """Whether any interface carries a force."""
    return scene.thrust is not None and bool(scene.thrust.carried.any())


def write_thrust_vtu(path: Path, scene: Scene) -> None:
    """Points of application as vertices, thrust lines as chains of line cells between them; outside a joint its edge.

    Point data: ``resultant_force`` (on body b), ``normal_force``, ``shear_force``, ``torsion``, ``eccentricity``,
    ``friction_use``, ``torsion_use``, ``interface``, ``body_a``, ``body_b``, ``displacement``, ``result``. Cell data:
    ``kind`` (0 point of application, 1 thrust line) and ``line`` (number of the thrust line from 0, -1 for points).
    """
    thrust, use = scene.thrust, scene.torsion_use
    if thrust is None or use is None:
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
        point_data={
            "resultant_force": thrust.forces[shown],
            "normal_force": thrust.normal_forces[shown],
            "shear_force": thrust.shear_forces[shown],
            "torsion": thrust.torsions[shown],
            "eccentricity": thrust.eccentricity[shown],
            "friction_use": thrust.friction_use[shown],
            "torsion_use": use[shown],
            "interface": shown,
            "body_a": scene.contacts.bodies[shown, 0],
            "body_b": scene.contacts.bodies[shown, 1],
            "displacement": interface_displacements(scene, shown, points),
            "result": np.full(len(shown), scene.is_result, dtype=np.int8),
        },
        cell_data={"kind": kinds[used], "line": [np.full(len(shown), -1), numbers][used]},
    )


def _segments(lines: tuple[IntArray, ...], row: IntArray) -> tuple[IntArray, IntArray]:
    """Pairs of points that follow each other on a line, (n, 2), and the number of its line, (n,)."""
    if not lines:
        return np.zeros((0, 2), dtype=np.int64), np.zeros(0, dtype=np.int64)
    pairs = [np.column_stack([row[line[:-1]], row[line[1:]]]) for line in lines]
    return np.concatenate(pairs), np.repeat(np.arange(len(lines)), [len(each) for each in pairs])
