"""Files for ParaView: blocks, contact points and interfaces, one file per kind of cell; without a case the model alone.

Blocks have points of their own, so that Warp By Vector on ``displacement`` (scale factor 1) shows them part.
meshio writes neither texts nor truth values: groups are numbered in alphabetical order, flags are 0 and 1.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.deck.sections.selectors import POSITIONS
from mbla.model.geometry.meshio_files import write_mesh
from mbla.model.model import Model
from mbla.model.solids.blocks import BlockLabels
from mbla.results.collapse.mechanics import global_forces, interface_resultants
from mbla.results.collapse.thrust import point_friction_use
from mbla.results.collapse.work import work_of
from mbla.results.vtu.cells import BlockCells
from mbla.results.vtu.scene import Scene

Arrays = dict[str, np.typing.NDArray[Any]]


def write_blocks_vtu(path: Path, scene: Scene) -> None:
    """Blocks as cells.

    Point data: ``displacement``. Cell data: ``block``, ``group``, ``weight``, ``fixed``, ``guided``, ``moves``,
    ``part`` (blocks that move together; 0 at rest), ``velocity``, ``rotation`` (as drawn, m and rad), and the labels
    that items give their blocks, such as ``member`` and ``course``; with forces also ``largest_eccentricity`` and
    ``largest_friction_use`` and ``largest_torsion_use`` over the interfaces of each block (nan where none carries).
    """
    data = block_data(scene.model) | {
        "guided": _guided(scene.model),
        "moves": (scene.parts > 0).astype(np.int8),
        "part": scene.parts,
        "velocity": scene.motion[:, :3],
        "rotation": scene.motion[:, 3:],
    }
    if scene.thrust is not None and scene.torsion_use is not None:
        data["largest_eccentricity"] = _largest_at_blocks(scene, scene.thrust.eccentricity)
        data["largest_friction_use"] = _largest_at_blocks(scene, scene.thrust.friction_use)
        data["largest_torsion_use"] = _largest_at_blocks(scene, scene.torsion_use)
    write_cells(path, scene.model.blocks.vertices, scene.displacements, data, scene.cells)


def _guided(model: Model) -> np.typing.NDArray[np.int8]:
    guided = np.zeros(len(model.blocks), dtype=np.int8)
    guided[model.guides.blocks] = 1
    return guided


def _largest_at_blocks(scene: Scene, values: FloatArray) -> FloatArray:
    """Largest value over the interfaces of each block, (n_blocks,); nan where none has one."""
    largest = np.full(len(scene.model.blocks) + len(scene.model.grounds), -np.inf)
    known = ~np.isnan(values)
    for side in (0, 1):
        np.maximum.at(largest, scene.contacts.bodies[known, side], values[known])
    return np.where(np.isneginf(largest), np.nan, largest)[: len(scene.model.blocks)]


def write_cells(path: Path, points: FloatArray, displacement: FloatArray, data: Arrays, cells: BlockCells) -> None:
    """Blocks with their vertices at ``points`` and data on each, (n_blocks, ...)."""
    cell_data = {name: [values[rows] for rows in cells.rows] for name, values in data.items()}
    write_mesh(path, points, list(cells.cells), point_data={"displacement": displacement}, cell_data=cell_data)


def block_data(model: Model) -> Arrays:
    """What every block carries, (n_blocks,) each."""
    units = model.units
    return {
        "block": np.arange(len(model.blocks)),
        "group": group_numbers(model),
        "weight": model.blocks.masses * units.standard_gravity * units.force_per_mass_acceleration,
        "fixed": model.fixed.astype(np.int8),
        **_labels(model.blocks.labels),
    }


def _labels(labels: BlockLabels) -> Arrays:
    """Members as numbers in alphabetical order, 0 for none, and positions, -1 for none; those that no block has not."""
    names = sorted(set(labels.members) - {""})
    row = {name: i for i, name in enumerate(["", *names])}
    found: Arrays = {"member": np.array([row[member] for member in labels.members])} if names else {}
    return found | {name: labels.position(name) for name in POSITIONS if (labels.position(name) >= 0).any()}


def group_names(model: Model) -> list[str]:
    """Groups in the order of their numbers, as in ``model/group_names`` of the HDF5 file."""
    return sorted(set(model.blocks.groups))


def group_numbers(model: Model) -> np.typing.NDArray[np.int64]:
    """Number of the group of each block, (n_blocks,)."""
    row = {name: i for i, name in enumerate(group_names(model))}
    return np.array([row[group] for group in model.blocks.groups], dtype=np.int64)


def write_contacts_vtu(path: Path, scene: Scene) -> None:
    """Contact points as vertices; the force is the one on body b, in global directions.

    Point data: ``interface``, ``body_a``, ``body_b``, ``displacement``; with a mechanism also ``contact_force``,
    ``normal_force``, ``shear_force``, ``contact_velocity`` (b relative to a), ``opening``, ``sliding``, ``mode``
    (0 stick, 1 slide, 2 open, 3 crush), and but for the convex contact model, whose points only share out the
    resultants, ``friction_use``. Without a load factor because the structure is locked: the forces that balance the
    live load alone as ``contact_force``, ``normal_force``, ``shear_force``. With forces ``result``: 1 a result, 0 the
    best iterate.
    """
    contacts, forces, mechanics = scene.contacts, scene.forces, scene.mechanics
    owners = contacts.interface_of_point
    data: Arrays = {
        "interface": owners,
        "body_a": contacts.bodies[owners, 0],
        "body_b": contacts.bodies[owners, 1],
        "displacement": scene.contact_displacements,
    }
    if forces is not None:
        data |= {
            "contact_force": global_forces(contacts, forces),
            "normal_force": forces[:, 0],
            "shear_force": np.hypot(forces[:, 1], forces[:, 2]),
            "result": np.full(len(owners), scene.is_result, dtype=np.int8),
        }
    if mechanics is not None:
        velocities = mechanics.contact_velocities
        data |= {
            "contact_velocity": global_forces(contacts, velocities),
            "opening": velocities[:, 0],
            "sliding": np.hypot(velocities[:, 1], velocities[:, 2]),
            "mode": mechanics.modes.astype(np.int8),
        }
        if mechanics.resultants is None:
            data["friction_use"] = point_friction_use(scene.model, contacts, mechanics.contact_forces)
    vertices = np.arange(len(contacts.points))[:, None]
    write_mesh(path, contacts.points, [("vertex", vertices)], point_data=data, cell_data={})


def write_interfaces_vtu(path: Path, scene: Scene) -> None:
    """Interfaces as polygons, by their outer boundary; holes are not drawn, areas and forces count them.

    Cell data: ``interface``, ``body_a``, ``body_b``, ``area``, ``gap``, ``joint``, ``normal``; with forces (at the load
    factor, or those that lock the structure) also ``resultant_force``, ``resultant_moment`` (on body b, about the
    centroid), ``thrust_point`` (where the resultant acts), ``normal_force``, ``shear_force``, ``torsion``,
    ``eccentricity`` (0 central, 1 at the edge), ``friction_use`` (shear over what the joint allows), ``torsion_use``
    (shear and torsion over what it carries of both) and ``result`` (1 a result, 0 the best iterate); with a mechanism
    also ``mode`` (0 stick, 1 slide, 2 open, 3 hinge, 4 twist, 5 crush), ``slides`` and ``crushes`` (closed points do so
    too, whatever the mode) and ``work`` (power dissipated, that of the live load being the load factor). Point data:
    ``displacement``.
    """
    contacts = scene.contacts
    data: Arrays = {
        "interface": np.arange(len(contacts)),
        "body_a": contacts.bodies[:, 0],
        "body_b": contacts.bodies[:, 1],
        "area": contacts.areas,
        "gap": contacts.gaps,
        "joint": contacts.joints,
        "normal": contacts.normals,
        **_interface_forces(scene),
        **_interface_motion(scene),
    }
    rows = [np.flatnonzero(contacts.outline == n) for n in np.unique(contacts.outline)]
    cells = [("polygon", _outlines(contacts, each)) for each in rows]
    write_mesh(
        path,
        contacts.points,
        cells,
        point_data={"displacement": scene.contact_displacements},
        cell_data={name: [values[each] for each in rows] for name, values in data.items()},
    )


def _interface_forces(scene: Scene) -> Arrays:
    """Cell data of interfaces that follow from contact forces."""
    thrust = scene.thrust
    if thrust is None or scene.forces is None or scene.torsion_use is None:
        return {}
    return {
        "resultant_force": thrust.forces,
        "resultant_moment": interface_resultants(scene.contacts, scene.forces)[:, 3:],
        "thrust_point": thrust.points,
        "normal_force": thrust.normal_forces,
        "shear_force": thrust.shear_forces,
        "torsion": thrust.torsions,
        "eccentricity": thrust.eccentricity,
        "friction_use": thrust.friction_use,
        "torsion_use": scene.torsion_use,
        "result": np.full(len(scene.contacts), scene.is_result, dtype=np.int8),
    }


def _interface_motion(scene: Scene) -> Arrays:
    """Cell data of interfaces that follow from a mechanism."""
    case, motion, mechanics = scene.case, scene.interfaces, scene.mechanics
    if case is None or motion is None or mechanics is None:
        return {}
    return {
        "work": work_of(scene.model, scene.contacts, case.load_case, mechanics).dissipated,
        "mode": motion.modes.astype(np.int8),
        "slides": motion.slides.astype(np.int8),
        "crushes": motion.crushes.astype(np.int8),
    }


def _outlines(contacts: Contacts, rows: np.typing.NDArray[np.int64]) -> np.typing.NDArray[np.int64]:
    """Outer boundaries of interfaces with equally many corners, (n, corners)."""
    return contacts.point_start[rows][:, None] + np.arange(contacts.outline[rows[0]])
