"""What interfaces do in the motion that shows a lack of equilibrium: as in a mechanism, but without forces.

The motion obeys normality, v_N ≥ μ s with the slip s: what a joint opens by more than sliding
lifts it is a gap.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.interface_modes import TOGETHER, InterfaceMotion, interface_motion
from mbla.solution.solution import ContactMode, Mechanics
from mbla.solution.verification.statics import contact_velocities


def falling_motion(model: Model, contacts: Contacts, certificate: FloatArray) -> InterfaceMotion:
    """Modes, relative motion and hinge axes of every interface from a motion of the blocks, (n_blocks, 6)."""
    velocities = contact_velocities(model, contacts, certificate)
    limit = TOGETHER * float(np.linalg.norm(velocities, axis=1).max(initial=0.0))
    slip = np.hypot(velocities[:, 1], velocities[:, 2])
    friction = np.array([model.joints[name].friction for name in contacts.joint_names], dtype=float)
    lift = friction[contacts.joints[contacts.interface_of_point]] * slip
    modes = np.full(len(velocities), ContactMode.STICK, dtype=np.int64)
    modes[slip > limit] = ContactMode.SLIDE
    modes[velocities[:, 0] - lift > limit] = ContactMode.OPEN
    return interface_motion(
        model, contacts, Mechanics(float("nan"), np.zeros_like(velocities), velocities, certificate, modes)
    )
