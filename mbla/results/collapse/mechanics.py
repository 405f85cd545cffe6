"""Resultants, reactions and work of a case, from contact forces and velocities.

With the mechanism scaled to unit power of the live load, the balance reads::

    λ + f_D·u = Σ −T·v_T  +  Σ −N v_N

The shear part goes into friction and cohesion in the ratio of what each adds to the strength, μN : c. The normal part
is that of joints that open against tensile strength or crush; it is negative where they dilate under pressure.

Signs as in :mod:`mbla.solution.solution`: contact forces act on body b along the frame and on body a against it,
compression positive.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.program.assemble import yield_limits
from mbla.questions.force import Force
from mbla.results.collapse.interface_modes import sum_by_interface
from mbla.results.collapse.ties import acting_with_ties, pulls_of_ties, tie_power
from mbla.solution.solution import Mechanics
from mbla.solution.verification.statics import contact_resultants

NO_POWER = 1e-9
"""share of the reference power up to which nothing is put in: a frictionless block that is pushed"""
TIED, SOIL = "ties to supports", "fill on faces"
"""names of what ties that are held by supports, and fill, do on the structure sideways"""
PARTS = (slice(0, 3), slice(3, 6))
"""forces and moments, velocities and rotations"""


@dataclass(frozen=True)
class Work:
    """Powers, with unit power of the live load.

    live     : load factor times the power of the live load
    dead     : of the dead load, negative where weights are lifted
    friction, cohesion, normal : (n_interfaces,) dissipated by sliding under friction, against cohesion, and by normal
                                 forces
    ties : dissipated by ties and fill, those that go slack by their prestress among them
    reference : forces times speeds of the dead load, whatever the angle between them: what powers are measured by
    """

    live: float
    dead: float
    friction: FloatArray
    cohesion: FloatArray
    normal: FloatArray
    ties: float
    reference: float

    @property
    def supplied(self) -> float:
        """Power put in, by the live load and, where it drives the mechanism, the dead load; 0 where it is rounding."""
        supplied = max(self.live, 0.0) + max(self.dead, 0.0)
        return 0.0 if supplied <= NO_POWER * self.reference else supplied

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

    live = float(mechanics.load_factor * np.sum(load_case.live_load[free] * mechanism))
    question = load_case.question
    if isinstance(question, Force):  # in which the cut opens by 1/U
        live = -question.settlement.sense * question.value(mechanics.load_factor) / question.scale
    return Work(
        live=live,
        dead=float(np.sum(load_case.dead_load[free] * mechanism)),
        friction=sum_by_interface(contacts, shear * (1.0 - share)),
        cohesion=sum_by_interface(contacts, shear * share),
        normal=sum_by_interface(contacts, power[:, 0]),
        ties=tie_power(mechanics),
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


# --- What forces say about interfaces and supports ------------------------------------------------------------------


MOST_SINGLE_SUPPORTS = 12
"""fixed blocks up to this number have their reactions listed one by one"""


def global_forces(contacts: Contacts, contact_forces: FloatArray) -> FloatArray:
    """Force of each contact point on body b in global directions, (n_points, 3) N."""
    return np.asarray(np.einsum("pi,pij->pj", contact_forces, contacts.frames))


def interface_resultants(contacts: Contacts, contact_forces: FloatArray) -> FloatArray:
    """Force on body b and moment about the centroid of each interface, (n_interfaces, 6) N and N m."""
    forces = global_forces(contacts, contact_forces)
    arms = contacts.points - contacts.centroids[contacts.interface_of_point]
    return sum_by_interface(contacts, np.hstack([forces, np.cross(arms, forces)]))


@dataclass(frozen=True)
class SupportReaction:
    """Force and moment about the origin with which one support acts on the structure, (6,) N and N m."""

    support: str
    wrench: FloatArray


def reactions_of(
    model: Model, contacts: Contacts, load_case: LoadCase, mechanics: Mechanics, *, by_group: bool = False
) -> tuple[SupportReaction, ...]:
    """Reactions of supports, what guides take, which leaves guided blocks in balance, and what ties to supports do.

    Fixed and guided blocks stand one by one where they are few, else, or ``by_group``, their groups do.
    """
    supports = support_reactions(model, contacts, mechanics.contact_forces, by_group=by_group)
    guides = _guide_reactions(model, contacts, load_case, mechanics, by_group) if len(model.guides.blocks) else ()
    return (*supports, *guides, *_tie_reactions(model, mechanics.tie_forces))


def _guide_reactions(
    model: Model, contacts: Contacts, load_case: LoadCase, mechanics: Mechanics, by_group: bool
) -> tuple[SupportReaction, ...]:
    blocks = model.guides.blocks
    acting = acting_with_ties(model, contact_resultants(model, contacts, mechanics.contact_forces), mechanics)
    taken = -(acting + load_case.dead_load + mechanics.load_factor * load_case.live_load)[blocks]
    taken[:, 3:] += np.cross(model.blocks.centroids[blocks], taken[:, :3])
    single = len(blocks) <= MOST_SINGLE_SUPPORTS and not by_group
    names = [
        f"guide of {model.body_name(block)}" if single else f"guides of {model.blocks.groups[block]}"
        for block in blocks.tolist()
    ]
    return _by_name(names, taken)


def _tie_reactions(model: Model, tie_forces: FloatArray | None) -> tuple[SupportReaction, ...]:
    """What ties and fill that supports hold do to the structure."""
    if tie_forces is None:
        return ()
    tied, pulls = pulls_of_ties(model, tie_forces)
    held = np.append(model.fixed, True)[tied]
    holders = np.where(model.ties.of_fill[model.ties.tie_of_point], SOIL, TIED)
    return _by_name(holders[held].tolist(), -pulls[held])


def support_reactions(
    model: Model, contacts: Contacts, contact_forces: FloatArray, *, by_group: bool = False
) -> tuple[SupportReaction, ...]:
    """Reactions of ground planes, then of fixed blocks; supports that touch nothing free are left out.

    contact_forces : (n_points, 3)  N, T1, T2 [N], compression positive
    by_group       : fixed blocks of one group as one, however few they are
    """
    supports, _, onto_structure = _onto_structure(model, contacts, contact_forces)
    blocks = supports < len(model.blocks)
    single = len(np.unique(supports[blocks])) <= MOST_SINGLE_SUPPORTS and not by_group
    order = np.lexsort((supports, blocks))
    names = [
        model.body_name(body) if single or body >= len(model.blocks) else f"{model.blocks.groups[body]} (fixed blocks)"
        for body in supports[order].tolist()
    ]
    return _by_name(names, onto_structure[order])


def group_reactions(model: Model, contacts: Contacts, contact_forces: FloatArray) -> tuple[SupportReaction, ...]:
    """Reactions by the group of the free blocks that supports act on, in the order in which groups are met.

    Forces of guides are not among them.

    contact_forces : (n_points, 3)  N, T1, T2 [N], compression positive
    """
    _, carried, onto_structure = _onto_structure(model, contacts, contact_forces)
    return _by_name([model.blocks.groups[block] for block in carried.tolist()], onto_structure)


def _by_name(names: Sequence[str], wrenches: FloatArray) -> tuple[SupportReaction, ...]:
    """Sums over wrenches of one name, (n, 6)."""
    sums: dict[str, FloatArray] = {}
    for name, wrench in zip(names, wrenches, strict=True):
        sums[name] = sums.get(name, np.zeros(6)) + wrench
    return tuple(SupportReaction(name, wrench) for name, wrench in sums.items())


def _onto_structure(
    model: Model, contacts: Contacts, contact_forces: FloatArray
) -> tuple[IntArray, IntArray, FloatArray]:
    """Supporting body, free block and wrench on it about the origin, (n, 6), of every interface between the two."""
    forces = global_forces(contacts, contact_forces)
    wrenches = sum_by_interface(contacts, np.hstack([forces, np.cross(contacts.points, forces)]))
    fixed = np.concatenate([model.fixed, np.ones(len(model.grounds), dtype=bool)])
    support_a, support_b = fixed[contacts.bodies].T
    one = support_a != support_b
    supports = np.where(support_a, contacts.bodies[:, 0], contacts.bodies[:, 1])[one]
    carried = np.where(support_a, contacts.bodies[:, 1], contacts.bodies[:, 0])[one]
    return supports, carried, np.where(support_a, 1.0, -1.0)[one, None] * wrenches[one]


def load_on_structure(model: Model, load_case: LoadCase, load_factor: float) -> FloatArray:
    """Dead load plus live load times the load factor on all free blocks, about the origin, (6,) N and N m."""
    load = (load_case.dead_load + load_factor * load_case.live_load)[model.free]
    moments = load[:, 3:] + np.cross(model.blocks.centroids[model.free], load[:, :3])
    return np.concatenate([load[:, :3].sum(axis=0), moments.sum(axis=0)])


def live_load_in_g(model: Model, load_case: LoadCase) -> float | None:
    """Size of a live load that is one uniform acceleration, in g; None for any other live load.

    Only then is the load factor an acceleration. A force that happens to be proportional to mass does not count.
    """
    if not load_case.live or not all(load.in_g for load in load_case.live):
        return None
    loaded = np.any(load_case.live_load[:, :3] != 0, axis=1)
    if not loaded.any():
        return None
    weights = model.weights[loaded]
    accelerations = load_case.live_load[loaded, :3] / weights[:, None]
    spread = np.abs(accelerations - accelerations[0]).max()
    size = float(np.linalg.norm(accelerations[0]))
    return size if spread <= 1e-9 * size else None
