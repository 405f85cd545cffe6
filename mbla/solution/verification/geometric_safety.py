"""The geometric factor of safety: forces carry the dead load at one size of the joints, at the next it falls."""

from __future__ import annotations

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.assembly.lift import motions_of_bodies
from mbla.model.model import LoadCase
from mbla.solution.further.geometric_safety.geometric_safety import MOST, TOLERANCE, GeometricSafety, shrunk
from mbla.solution.further.geometric_safety.reference_pressure import pressed_by, unit_of_pressure
from mbla.solution.further.sensitivity.structures import LoadedAssembly
from mbla.solution.solution import Mechanics
from mbla.solution.verification.case import LoadedModel
from mbla.solution.verification.proofs import associative_bounds

APART = 1e-4
"""of the factor, relative: two further apart prove none; 2e-6 is usual, accuracy draft leaves up to 5e-5"""


def proved(assembly: Assembly, load_case: LoadCase, safety: GeometricSafety) -> bool:
    """Whether forces and mechanisms prove that the dead load stands at one end and falls at the other, next to it.

    The load factors are to be those of the forces and mechanisms too; without an end that falls, the one that stands is
    the least size that is looked for.
    """
    next_to_it = safety.most <= (1.0 + APART) * safety.factor
    if not (next_to_it or (len(safety.sizes) == 1 and safety.factor >= (1.0 - TOLERANCE) * MOST)):
        return False
    bounds = []
    for row, size in enumerate(safety.sizes):
        whole = LoadedAssembly(shrunk(assembly, float(size)), load_case)
        posed = pressed_by(whole, float(safety.pressed[row]), unit_of_pressure(whole))
        bodies = posed.assembly.glued(load_case)
        state = Mechanics(
            load_factor=float(safety.load_factors[row]),
            contact_forces=safety.forces[row],
            contact_velocities=np.zeros_like(safety.forces[row]),
            mechanism=motions_of_bodies(bodies, safety.mechanisms[row]),
            modes=np.zeros(len(assembly.contacts.points), dtype=np.int64),
        )
        case = LoadedModel(bodies.model, bodies.contacts, bodies.load_case(posed.load_case))
        bounds.append(associative_bounds(case, state))
    for own, (least, most) in zip(safety.load_factors, bounds, strict=True):
        room = TOLERANCE * abs(own)
        if not np.isfinite(own) or own < least - room or own > most + room:
            return False
    stands = bounds[0][0] >= safety.pressed[0]
    return bool(stands and (len(bounds) == 1 or bounds[1][1] < safety.pressed[1]))
