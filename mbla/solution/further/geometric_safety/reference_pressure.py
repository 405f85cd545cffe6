"""Loads of a structure whose joints a uniform pressure, as of water, presses together."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.questions.load_factor import LOAD_FACTOR
from mbla.solution.further.sensitivity.structures import LoadedAssembly
from mbla.solution.verification.statics import contact_resultants


def unit_of_pressure(structure: LoadedAssembly) -> float:
    """Sum of the dead forces on free blocks over the area of all joints; 1 where there is neither."""
    forces = np.linalg.norm(structure.load_case.dead_load[structure.model.free, :3], axis=1).sum()
    area = structure.contacts.areas.sum()
    return float(forces / area) if forces > 0.0 and area > 0.0 else 1.0


def pressed_by(structure: LoadedAssembly, reference_pressure: float, unit: float) -> LoadedAssembly:
    """The structure under a reference pressure in all joints, in units, and a live load that takes it away."""
    contacts, case = structure.contacts, structure.load_case
    normal = np.zeros((len(contacts.points), 3))
    normal[:, 0] = unit * contacts.point_areas
    apart = contact_resultants(structure.model, contacts, normal)
    posed = replace(case, dead_load=case.dead_load - reference_pressure * apart, live_load=apart, question=LOAD_FACTOR)
    return replace(structure, load_case=posed)
