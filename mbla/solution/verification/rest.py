"""A structure at rest under its dead load, from the displacements of its bodies, written a second time on purpose.

The displacements give the force of every joint by the law of elastic joints without history, and these must balance the
dead load::

    N = −k_N (g + v_N) between −f_t and f_c,    T = −k_T v_T, cut to c + μ N

g is the gap that a joint has without them: nothing as built.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.assembly.lift import motions_of_bodies
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.assembly.structure_at import StructureAt
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.solution.modes.modes import Modes
from mbla.solution.thresholds import SOLVED_RESIDUAL
from mbla.solution.verification.statics import (
    contact_resultants,
    contact_velocities,
    left_to_balance,
    lever_arms,
    load_sizes,
)
from mbla.solution.verification.stiffness import areas_of_stiffness
from mbla.solution.verification.strengths import point_strengths

SAG = 1e-6
"""Overlap of two blocks under the weight of one, over the size of a block, where the deck gives no stiffness."""

SAME = 1e-9
"""Difference of figures that follow from model and deck, relative, that is rounding."""

UNBALANCED = SOLVED_RESIDUAL
"""Share of the dead load of a body that joints may leave without balance."""


@dataclass(frozen=True)
class AtRest:
    """What stands: bodies, their dead load, and how far they are said to be displaced by it, (n_bodies, 6).

    gaps : (n_points,) m without that, of ties 0
    turned : (n_surfaces,) interfaces that are open by a motion without that
    """

    bodies: RigidBodies
    case: LoadCase
    settlement: FloatArray
    stiffness: FloatArray
    gaps: FloatArray
    turned: BoolArray

    @staticmethod
    def of(there: StructureAt, modes: Modes) -> AtRest:
        """As modes say; their stiffness, (n_surfaces, 2)."""
        alone = there.load_case.dead_alone
        bodies = there.assembly.of(alone)
        settlement = motions_of_bodies(bodies, modes.settlement)
        return AtRest(bodies, bodies.load_case(alone), settlement, modes.stiffness, there.gaps_with_ties, there.turned)

    @property
    def model(self) -> Model:
        """Of the bodies."""
        return self.bodies.model

    @property
    def contacts(self) -> Contacts:
        """With ties."""
        return self.bodies.contacts

    @cached_property
    def points(self) -> FloatArray:
        """Stiffness of contact points, across and along, (n_points, 2) force per length."""
        contacts = self.contacts
        surfaces = ~contacts.tie_points
        found = np.zeros((len(contacts.points), 2))
        own = self.stiffness[contacts.interface_of_point[surfaces]]
        found[surfaces] = own * areas_of_stiffness(contacts)[surfaces, None]
        found[~surfaces] = found[surfaces].mean(axis=0)
        return found

    @cached_property
    def moved(self) -> FloatArray:
        """Gap and slip of contact points, (n_points, 3) m."""
        own = contact_velocities(self.model, self.contacts, self.settlement)
        return np.asarray(own + self.gaps[:, None] * np.array([1.0, 0.0, 0.0]))

    @cached_property
    def pressed(self) -> FloatArray:
        """Normal force and tensile strength of points together, (n_points,): what is negative is open."""
        strengths = point_strengths(self.model, self.contacts)
        return np.asarray(strengths.tension - self.points[:, 0] * self.moved[:, 0])

    @cached_property
    def forces(self) -> FloatArray:
        """By the law, (n_points, 3)."""
        limits = point_strengths(self.model, self.contacts)
        normal = np.clip(-self.points[:, 0] * self.moved[:, 0], -limits.tension, limits.compression)
        shear = -self.points[:, 1:] * self.moved[:, 1:]
        most = np.maximum(limits.cohesion + limits.friction * normal, 0.0)
        size = np.maximum(np.hypot(shear[:, 0], shear[:, 1]), 1e-300)
        return np.column_stack([normal, shear * np.minimum(1.0, most / size)[:, None]])

    @property
    def unbalanced(self) -> float:
        """Greatest share of the dead load of a body that is not balanced; of one without any over the mean."""
        arms, model = lever_arms(self.model, self.contacts), self.model
        acting = contact_resultants(model, self.contacts, self.forces) + self.case.dead_load
        left = load_sizes(left_to_balance(model, acting, arms), arms)
        return float((left / self.loads)[~model.fixed].max(initial=0.0))

    @cached_property
    def loads(self) -> FloatArray:
        """Dead load of each body, the mean of those that have one where it has none, (n_bodies,)."""
        own = load_sizes(self.case.dead_load, lever_arms(self.model, self.contacts))
        free = ~self.model.fixed & (own > 0.0)
        return np.where(free, own, own[free].mean())

    @cached_property
    def lighter(self) -> FloatArray:
        """Load of the lighter of the two bodies at every contact point, (n_points,)."""
        every = np.append(np.where(self.model.fixed, np.inf, self.loads), np.full(len(self.model.grounds), np.inf))
        bodies = self.contacts.bodies[self.contacts.interface_of_point]
        return np.asarray(every[bodies].min(axis=1))


def stiffness_of_deck(there: StructureAt) -> tuple[float, FloatArray]:
    """Of joints for which the deck gives none, as built, and of every interface across and along, (n_interfaces, 2)."""
    alone = there.load_case.dead_alone
    model, solids = there.built.model.of_case(alone), there.built.glued(alone)
    weights = np.linalg.norm(alone.dead_load[~model.fixed, :3], axis=1)
    pairs, of = np.unique(solids.contacts.bodies, axis=0, return_inverse=True)
    area = float(np.bincount(of.ravel(), solids.contacts.areas, len(pairs)).mean())
    size = float(solids.model.blocks.sizes[~solids.model.fixed].mean())
    default = float(weights[weights > 0.0].mean()) / (area * SAG * size)
    contacts = there.assembly.glued(alone).contacts
    laws = [model.joints[name] for name in contacts.joint_names]
    each = [default if np.isnan(law.normal_stiffness) else law.normal_stiffness for law in laws]
    both = np.array([(own, own * law.shear_ratio) for own, law in zip(each, laws, strict=True)]).reshape(-1, 2)
    return default, both[contacts.joints]


def same(one: FloatArray | float, other: FloatArray | float) -> bool:
    """Whether figures are one but for rounding."""
    return bool(np.shape(one) == np.shape(other) and np.allclose(one, other, rtol=SAME, atol=0.0))
