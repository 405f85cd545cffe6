"""What soil of cells presses with on the blocks beside, above and below it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.interface_modes import sum_by_interface
from mbla.results.collapse.mechanics import global_forces


@dataclass(frozen=True)
class SoilPressure:
    """Of one soil on the blocks of one group.

    soil  : row in ``Model.soils``
    group : of the blocks
    force : (3,) N, on the blocks
    point : (3,) m, mean of the contact points by their normal forces: the centre of pressure on a plane face; nan where
            nothing presses
    """

    soil: int
    group: str
    force: FloatArray
    point: FloatArray


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
