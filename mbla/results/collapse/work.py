"""Where the power of a mechanism comes from and goes to: loads, joints, each interface, joint law and group.

With the mechanism scaled to unit power of the live load, the balance reads::

    λ + f_D·u = Σ −T·v_T  +  Σ −N v_N

The shear part goes into friction and cohesion in the ratio of what each adds to the strength, μN : c. The normal part
is that of joints that open against tensile strength or crush; it is negative where they dilate under pressure.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.program.assemble import yield_limits
from mbla.solution.solution import Mechanics

NO_POWER = 1e-9
"""share of the reference power up to which nothing is put in: a frictionless block that is pushed"""
PARTS = (slice(0, 3), slice(3, 6))
"""forces and moments, velocities and rotations"""


@dataclass(frozen=True)
class Work:
    """Powers, with unit power of the live load.

    live     : load factor times the power of the live load
    dead     : of the dead load, negative where weights are lifted
    friction, cohesion, normal : (n_interfaces,) dissipated by sliding under friction, against cohesion, and by normal
                                 forces
    reference : forces times speeds of the dead load, whatever the angle between them: what powers are measured by
    """

    live: float
    dead: float
    friction: FloatArray
    cohesion: FloatArray
    normal: FloatArray
    reference: float

    @property
    def given(self) -> float:
        """Power put in, by the live load and, where it drives the mechanism, the dead load; 0 where it is rounding."""
        given = max(self.live, 0.0) + max(self.dead, 0.0)
        return 0.0 if given <= NO_POWER * self.reference else given

    @property
    def dissipated(self) -> FloatArray:
        """Power dissipated in each interface, (n_interfaces,)."""
        return self.friction + self.cohesion + self.normal


def work_of(model: Model, contacts: Contacts, load_case: LoadCase, mechanics: Mechanics) -> Work:
    """Powers of loads and joints in the mechanism."""
    free = model.free
    mechanism, forces = mechanics.mechanism[free], mechanics.contact_forces
    power = -forces * mechanics.contact_velocities
    shear = power[:, 1] + power[:, 2]
    limits = yield_limits(model, contacts)
    frictional = limits.friction * np.maximum(forces[:, 0], 0.0)
    strength = frictional + limits.cohesion
    share = np.divide(limits.cohesion, strength, out=np.zeros_like(strength), where=strength > 0)

    def by_interface(values: FloatArray) -> FloatArray:
        sums = np.bincount(contacts.interface_of_point, weights=values, minlength=len(contacts))
        return np.asarray(sums, dtype=np.float64)

    return Work(
        live=float(mechanics.load_factor * np.sum(load_case.live_load[free] * mechanism)),
        dead=float(np.sum(load_case.dead_load[free] * mechanism)),
        friction=by_interface(shear * (1.0 - share)),
        cohesion=by_interface(shear * share),
        normal=by_interface(power[:, 0]),
        reference=_largest_power(load_case.dead_load[free], mechanism),
    )


def _largest_power(loads: FloatArray, motions: FloatArray) -> float:
    """Sum of ‖F‖ ‖v‖ and ‖M‖ ‖ω‖ over blocks."""
    return float(sum(np.linalg.norm(loads[:, p], axis=1) @ np.linalg.norm(motions[:, p], axis=1) for p in PARTS))


def dissipated_by_joint(contacts: Contacts, work: Work) -> dict[str, tuple[float, float, float]]:
    """Friction, cohesion and normal part of every joint law in use."""
    n_laws = len(contacts.joint_names)
    columns = [np.bincount(contacts.joints, v, n_laws) for v in (work.friction, work.cohesion, work.normal)]
    return {
        name: (float(columns[0][row]), float(columns[1][row]), float(columns[2][row]))
        for row, name in enumerate(contacts.joint_names)
    }


def loads_by_group(model: Model, load_case: LoadCase, mechanics: Mechanics) -> dict[str, tuple[float, float]]:
    """Power of the live load times the load factor, and of the dead load, on the free blocks of every group."""
    names, row = np.unique(np.array(model.blocks.groups), return_inverse=True)
    moving = np.where(model.fixed[:, None], 0.0, mechanics.mechanism)
    live = mechanics.load_factor * (load_case.live_load * moving).sum(axis=1)
    dead = (load_case.dead_load * moving).sum(axis=1)
    sums = [np.bincount(row, weights=values, minlength=len(names)) for values in (live, dead)]
    return {str(name): (float(sums[0][i]), float(sums[1][i])) for i, name in enumerate(names)}
