"""``STEM_CASE_hinges.vtu``: the axes about which interfaces open, as lines along them."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mbla.model.geometry.meshio_files import write_mesh
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.motion import motion_scale
from mbla.results.vtu.points import interface_displacements
from mbla.results.vtu.scene import Scene


def has_hinges(scene: Scene) -> bool:
    """Whether the mechanism has a hinge."""
    return scene.interfaces is not None and scene.interfaces.count(InterfaceMode.HINGE) > 0


def write_hinges_vtu(path: Path, scene: Scene) -> None:
    """Each hinge as one line cell, as long as its faces stay closed; about a corner as a vertex cell, after the lines.

    Cell data: ``interface``, ``body_a``, ``body_b``, ``rotation`` (of b relative to a about the axis, as drawn),
    ``result``. Point data: ``displacement``.
    """
    motion = scene.interfaces
    if motion is None or scene.mechanics is None:
        raise ValueError("a case without a mechanism has no hinges")
    contacts = scene.contacts
    hinges = np.flatnonzero(motion.modes == InterfaceMode.HINGE)
    ends = motion.hinge_ends[hinges]
    short = (ends[:, 0] == ends[:, 1]).all(axis=1)
    lines, corners = hinges[~short], hinges[short]
    points = np.concatenate([ends[~short].reshape(-1, 3), ends[short, 0]])
    owners = np.concatenate([np.repeat(lines, 2), corners])
    scale = motion_scale(scene.model, scene.mechanics.mechanism)
    turns = scale * np.einsum("ij,ij->i", motion.rotation, np.nan_to_num(motion.hinge_directions))
    rows = np.arange(len(points))
    cells = (("line", lines, rows[: 2 * len(lines)].reshape(-1, 2)), ("vertex", corners, rows[2 * len(lines) :, None]))
    groups = [(kind, which, each) for kind, which, each in cells if len(which)]
    write_mesh(
        path,
        points,
        [(kind, each) for kind, _, each in groups],
        point_data={"displacement": interface_displacements(scene, owners, points)},
        cell_data={
            "interface": [which for _, which, _ in groups],
            "body_a": [contacts.bodies[which, 0] for _, which, _ in groups],
            "body_b": [contacts.bodies[which, 1] for _, which, _ in groups],
            "rotation": [turns[which] for _, which, _ in groups],
            "result": [np.full(len(which), scene.is_result, dtype=np.int8) for _, which, _ in groups],
        },
    )
