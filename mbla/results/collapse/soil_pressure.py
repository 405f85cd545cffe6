"""What soil of cells presses with on the blocks beside, above and below it, and water in it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.interface_modes import sum_by_interface
from mbla.results.collapse.mechanics import global_forces


@dataclass(frozen=True)
class SoilPressure:
    """Of one soil on the blocks of one group.

    soil  : row in ``Model.soils``
    group : of the blocks
    force : (3,) N, on the blocks
    point : (3,) m, mean of the places where it presses by their normal forces: the centre of pressure on a plane face;
            nan where nothing presses
    water : it is that of the water in the soil, beside which joints of the soil press with effective stress
    """

    soil: int
    group: str
    force: FloatArray
    point: FloatArray
    water: bool = False


def soil_pressures(model: Model, contacts: Contacts, contact_forces: FloatArray) -> tuple[SoilPressure, ...]:
    """Soils in their order, then groups in the order in which they are met.

    contact_forces : (n_points, 3)  N, T1, T2 [N], compression positive
    """
    if not model.soils:
        return ()
    soil = np.append(model.soil_of_block, np.full(len(model.grounds), -1))
    first, second = soil[contacts.bodies].T
    on_block = ((first >= 0) != (second >= 0)) & (contacts.bodies < len(model.blocks)).all(axis=1)
    normal = np.maximum(contact_forces[:, 0], 0.0)
    forces = np.where(first >= 0, 1.0, -1.0)[:, None] * sum_by_interface(
        contacts, global_forces(contacts, contact_forces)
    )
    moments = sum_by_interface(contacts, np.column_stack([normal, normal[:, None] * contacts.points]))
    sums: dict[tuple[int, str], FloatArray] = {}
    for row in np.flatnonzero(on_block).tolist():
        a, b = contacts.bodies[row].tolist()
        key = int(max(first[row], second[row])), model.blocks.groups[b if first[row] >= 0 else a]
        sums[key] = sums.get(key, np.zeros(7)) + np.append(forces[row], moments[row])
    return tuple(
        SoilPressure(row, group, total[:3], total[4:] / (total[3] or np.nan))
        for (row, group), total in sorted(sums.items(), key=lambda item: item[0][0])
    )


def water_pressures(model: Model, load_case: LoadCase) -> tuple[SoilPressure, ...]:
    """Of the water in each soil on groups of blocks, and on soil without water; the same at rest and at collapse."""
    found, rows = [], model.soil_of_block
    for load in load_case.dead:
        if not load.of_water or not len(load.blocks):
            continue
        soil = next(row for row, mesh in enumerate(model.soils) if np.isin(load.blocks, mesh.blocks).any())
        pressed = rows[load.blocks] != soil
        blocks, wrenches = load.blocks[pressed], load.wrenches[pressed]
        groups = np.array([model.blocks.groups[block] for block in blocks.tolist()])
        for group in dict.fromkeys(groups.tolist()):
            forces, levers = wrenches[groups == group, :3], wrenches[groups == group, 6:].reshape(-1, 3, 3)
            total = forces.sum(axis=0)
            places = levers + model.blocks.centroids[blocks[groups == group], :, None] * forces[:, None]
            point = places.sum(axis=0) @ total / (total @ total or np.nan)
            found.append(SoilPressure(soil, group, total, point, water=True))
    return tuple(found)
