"""How a structure without equilibrium falls: the motion that proves it, told as a failure without forces.

What a contact point does follows from its velocity alone. The motion is one of associative flow, so that a point that
slides lifts by the friction coefficient; only what lifts more opens. Nothing is known of the work of the joints.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.program.assemble import yield_limits
from mbla.results.collapse.collapse import Collapse
from mbla.results.collapse.interface_modes import interface_motion
from mbla.results.collapse.rigid_parts import part_motions, rigid_parts
from mbla.results.collapse.work import Work
from mbla.solution.contact_modes import contact_modes
from mbla.solution.solution import Mechanics
from mbla.solution.verification.statics import contact_velocities


def fall_of(model: Model, contacts: Contacts, certificate: FloatArray) -> tuple[Collapse, Mechanics]:
    """The failure of a motion, (n_blocks, 6), with nan for every power, and the motion as mechanics without forces."""
    velocities = contact_velocities(model, contacts, certificate)
    none, limits = np.zeros_like(velocities), yield_limits(model, contacts)
    dry = replace(limits, cohesion=np.zeros_like(limits.cohesion), tension=np.zeros_like(limits.tension))
    modes = contact_modes(none, velocities, dry, limits.friction)
    mechanics = Mechanics(np.nan, none, velocities, certificate, modes)
    unknown = np.full(len(contacts), np.nan)
    parts = rigid_parts(model, contacts, certificate)
    return Collapse(
        interfaces=interface_motion(model, contacts, mechanics),
        parts=parts,
        motions=part_motions(model, parts, certificate),
        work=Work(np.nan, np.nan, unknown, unknown, unknown, np.nan),
    ), mechanics
