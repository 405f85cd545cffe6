"""Files for ParaView: blocks, contact points and interfaces, one file per kind of cell; without a case the model alone.

Blocks have points of their own, so that Warp By Vector on ``displacement`` (scale factor 1) shows them part.
meshio writes neither texts nor truth values: groups are numbered in alphabetical order, flags are 0 and 1.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.deck.selectors import POSITIONS
from mbla.model.geometry.meshio_files import write_mesh
from mbla.model.labels import BlockLabels
from mbla.model.model import Model
from mbla.results.collapse.interface_modes import interface_motion
from mbla.results.collapse.mechanics import global_forces, interface_resultants
from mbla.results.collapse.motion import contact_displacements, drawn_motion, vertex_displacements
from mbla.results.collapse.rigid_parts import rigid_parts
from mbla.results.collapse.work import work_of
from mbla.results.files import OutputFolder
from mbla.results.paraview.cells import BlockCells, block_cells
from mbla.results.results import CaseResult, Results

Arrays = dict[str, np.typing.NDArray[Any]]


def write_blocks_vtu(
    path: Path, model: Model, contacts: Contacts, case: CaseResult | None, cells: BlockCells | None = None
) -> None:
    """Blocks as cells.

    Point data: ``displacement``. Cell data: ``block``, ``group``, ``weight``, ``fixed``, ``moves``, ``part`` (blocks
    that move together; 0 at rest), ``velocity``, ``rotation`` (as drawn, m and rad), and the labels that items give
    their blocks, such as ``member`` and ``course``.
    """
    motion = drawn_motion(model, case)
    parts = rigid_parts(model, contacts, motion)
    data = block_data(model) | {
        "moves": (parts > 0).astype(np.int8),
        "part": parts,
        "velocity": motion[:, :3],
        "rotation": motion[:, 3:],
    }
    displacement = vertex_displacements(model.blocks, motion)
    write_cells(path, model.blocks.vertices, displacement, data, cells or block_cells(model.blocks))


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


def write_contacts_vtu(path: Path, model: Model, contacts: Contacts, case: CaseResult | None) -> None:
    """Contact points as vertices; the force is the one on body b, in global directions.

    Point data: ``interface``, ``body_a``, ``body_b``, ``displacement``; with a mechanism also ``contact_force``,
    ``normal_force``, ``shear_force``, ``contact_velocity`` (b relative to a), ``opening``, ``sliding``, ``mode``
    (0 stick, 1 slide, 2 open). Without a load factor because the structure is locked: the forces that balance the live
    load alone as ``contact_force``, ``normal_force``, ``shear_force``.
    """
    owners = contacts.interface_of_point
    data: Arrays = {
        "interface": owners,
        "body_a": contacts.bodies[owners, 0],
        "body_b": contacts.bodies[owners, 1],
        "displacement": contact_displacements(model, contacts, drawn_motion(model, case)),
    }
    forces = _shown_forces(case)
    if forces is not None:
        data |= {
            "contact_force": global_forces(contacts, forces),
            "normal_force": forces[:, 0],
            "shear_force": np.hypot(forces[:, 1], forces[:, 2]),
        }
    mechanics = None if case is None else case.solution.mechanics
    if mechanics is not None:
        velocities = mechanics.contact_velocities
        data |= {
            "contact_velocity": global_forces(contacts, velocities),
            "opening": velocities[:, 0],
            "sliding": np.hypot(velocities[:, 1], velocities[:, 2]),
            "mode": mechanics.modes,
        }
    vertices = np.arange(len(contacts.points))[:, None]
    write_mesh(path, contacts.points, [("vertex", vertices)], point_data=data, cell_data={})


def _shown_forces(case: CaseResult | None) -> FloatArray | None:
    """Contact forces at the load factor; without one those that lock the structure."""
    if case is None:
        return None
    mechanics = case.solution.mechanics
    return case.solution.lock if mechanics is None else mechanics.contact_forces


def write_interfaces_vtu(path: Path, model: Model, contacts: Contacts, case: CaseResult | None) -> None:
    """Interfaces as polygons, by their outer boundary; holes are not drawn, areas and forces count them.

    Cell data: ``interface``, ``body_a``, ``body_b``, ``area``, ``gap``, ``joint``, ``normal``; with forces (at the load
    factor, or those that lock the structure) also ``resultant_force``, ``resultant_moment`` (on body b, about the
    centroid), ``normal_force``, ``shear_force``; with a mechanism also ``mode`` (0 stick, 1 slide, 2 open, 3 hinge,
    4 twist) and ``work`` (power dissipated, that of the live load being the load factor). Point data: ``displacement``.
    """
    data: Arrays = {
        "interface": np.arange(len(contacts)),
        "body_a": contacts.bodies[:, 0],
        "body_b": contacts.bodies[:, 1],
        "area": contacts.areas,
        "gap": contacts.gaps,
        "joint": contacts.joints,
        "normal": contacts.normals,
    }
    forces = _shown_forces(case)
    if forces is not None:
        resultants = interface_resultants(contacts, forces)
        normal_force = np.einsum("ij,ij->i", resultants[:, :3], contacts.normals)
        shear = resultants[:, :3] - normal_force[:, None] * contacts.normals
        data |= {
            "resultant_force": resultants[:, :3],
            "resultant_moment": resultants[:, 3:],
            "normal_force": normal_force,
            "shear_force": np.linalg.norm(shear, axis=1),
        }
    mechanics = None if case is None else case.solution.mechanics
    if case is not None and mechanics is not None:
        data["work"] = work_of(model, contacts, case.load_case, mechanics).dissipated
        data["mode"] = interface_motion(model, contacts, mechanics).modes
    rows = [np.flatnonzero(contacts.outline == n) for n in np.unique(contacts.outline)]
    cells = [("polygon", _outlines(contacts, each)) for each in rows]
    write_mesh(
        path,
        contacts.points,
        cells,
        point_data={"displacement": contact_displacements(model, contacts, drawn_motion(model, case))},
        cell_data={name: [values[each] for each in rows] for name, values in data.items()},
    )


def _outlines(contacts: Contacts, rows: np.typing.NDArray[np.int64]) -> np.typing.NDArray[np.int64]:
    """Outer boundaries of interfaces with equally many corners, (n, corners)."""
    return contacts.point_start[rows][:, None] + np.arange(contacts.outline[rows[0]])


CONTACT_FILES: tuple[tuple[str, Callable[[Path, Model, Contacts, CaseResult | None], None]], ...] = (
    ("contacts", write_contacts_vtu),
    ("interfaces", write_interfaces_vtu),
)
"""files that exist only where there are contacts; a mesh file without a single cell is refused by its readers"""


def write_model_vtu(results: Results, out: OutputFolder) -> None:
    """``STEM_blocks.vtu`` and, where there are contacts, ``STEM_contacts.vtu`` and ``STEM_interfaces.vtu``, no case."""
    with out.writing(f"{out.stem}_blocks.vtu") as path:
        write_blocks_vtu(path, results.model, results.contacts, None)
    for kind, write in CONTACT_FILES if len(results.contacts) else ():
        with out.writing(f"{out.stem}_{kind}.vtu") as path:
            write(path, results.model, results.contacts, None)
