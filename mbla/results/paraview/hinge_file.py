"""``STEM_CASE_hinges.vtu``: the axes about which interfaces open, as lines across them."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.geometry.meshio_files import write_mesh
from mbla.results.collapse.interface_modes import InterfaceMode, InterfaceMotion
from mbla.results.collapse.motion import motion_scale
from mbla.results.paraview.points import interface_displacements
from mbla.results.paraview.scene import Scene


def has_hinges(scene: Scene) -> bool:
    """Whether the mechanism has a hinge."""
    return scene.interfaces is not None and scene.interfaces.count(InterfaceMode.HINGE) > 0


def write_hinges_vtu(path: Path, scene: Scene) -> None:
    """Each axis as one line cell, as long as its interface is in that direction.

    Cell data: ``interface``, ``body_a``, ``body_b``, ``rotation`` (of b relative to a about the axis, as drawn),
    ``result``. Point data: ``displacement``.
    """
    motion = scene.interfaces
    if motion is None or scene.mechanics is None:
        raise ValueError("a case without a mechanism has no hinges")
    contacts = scene.contacts
    hinges = np.flatnonzero(motion.modes == InterfaceMode.HINGE)
    middle, direction = motion.hinge_points, motion.hinge_directions
    first, last = _ends(contacts, motion)
    ends = np.stack([first[hinges], last[hinges]], axis=1)
    points = (middle[hinges][:, None, :] + ends[:, :, None] * direction[hinges][:, None, :]).reshape(-1, 3)
    scale = motion_scale(scene.model, scene.mechanics.mechanism)
    turns = scale * np.einsum("ij,ij->i", motion.rotation[hinges], direction[hinges])
    write_mesh(
        path,
        points,
        [("line", np.arange(2 * len(hinges)).reshape(-1, 2))],
        point_data={"displacement": interface_displacements(scene, np.repeat(hinges, 2), points)},
        cell_data={
            "interface": [hinges],
            "body_a": [contacts.bodies[hinges, 0]],
            "body_b": [contacts.bodies[hinges, 1]],
            "rotation": [turns],
            "result": [np.full(len(hinges), scene.is_result, dtype=np.int8)],
        },
    )


def _ends(contacts: Contacts, motion: InterfaceMotion) -> tuple[FloatArray, FloatArray]:
    """Where the axis of each hinge leaves its interface, along its direction from its point, (n_interfaces,) m each."""
    owners = contacts.interface_of_point
    rows = np.flatnonzero(motion.modes[owners] == InterfaceMode.HINGE)
    here = owners[rows]
    along = np.einsum("pi,pi->p", contacts.points[rows] - motion.hinge_points[here], motion.hinge_directions[here])
    first, last = np.full(len(contacts), np.inf), np.full(len(contacts), -np.inf)
    np.minimum.at(first, here, along)
    np.maximum.at(last, here, along)
    return first, last
