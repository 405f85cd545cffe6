"""What acts on each block by itself: forces on its faces and at points, and the rest of its loads, spread over it.

An interface that is pressed acts by its resultant, spread as evenly as balance allows (see
:mod:`mbla.results.demand.bearings`); another one by its contact points. Ties, loads of kind ``force`` and axles without
a width that stand on blocks of their own act at points. What balances all of these is spread evenly over the block: own
weight and inertia, pressure and lines. Blocks whose balance is not known by itself have none: those that are glued to
others, guided or fixed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, row_of_item, starts, summed
from mbla.contacts.contacts import Contacts
from mbla.model.applied_load import AppliedLoad
from mbla.model.model import LoadCase, Model
from mbla.model.ties.ties import OUTSIDE
from mbla.results.collapse.mechanics import global_forces
from mbla.results.demand.bearings import Bearings

AT_A_POINT = -1
"""stands for an interface where a force acts at a point"""


@dataclass(frozen=True)
class Actions:
    """Forces on blocks, sorted by blocks.

    start   : (n_blocks + 1,) rows of each block
    places  : (m, 3) m
    forces  : (m, 3) N on the block
    interfaces : (m,) over which they are spread about their place, or ``AT_A_POINT``
    spread  : (n_blocks, 6) N and N m about the centroid, what balances them
    """

    start: IntArray
    places: FloatArray
    forces: FloatArray
    interfaces: IntArray
    spread: FloatArray

    @property
    def owner(self) -> IntArray:
        """Block of each, (m,)."""
        return row_of_item(self.start)


def standing_alone(model: Model, contacts: Contacts) -> BoolArray:
    """Blocks that are in balance by themselves under contacts, ties and loads, (n_blocks,)."""
    alone = ~model.fixed
    alone[model.guides.blocks] = False
    if contacts.solid_of_block is not None:
        alone &= np.bincount(contacts.solid_of_block)[contacts.solid_of_block] == 1
    return np.asarray(alone)


@dataclass(frozen=True)
class Acting:
    """Forces of a load case: load factor, of contact points (n_points, 3) [N], of ties (n_ties,) [N] or None."""

    load_case: LoadCase
    load_factor: float
    contact_forces: FloatArray
    tie_forces: FloatArray | None = None


def actions_on_blocks(model: Model, contacts: Contacts, acting: Acting, bearings: Bearings) -> Actions:
    """Everything that acts on every block."""
    n_blocks, load_case = len(model.blocks), acting.load_case
    pressed = np.zeros(len(contacts), dtype=bool)
    pressed[bearings.interfaces] = True
    loose = np.flatnonzero(~pressed[contacts.interface_of_point])
    bodies, on_b = contacts.bodies[contacts.interface_of_point][loose], global_forces(contacts, acting.contact_forces)
    at = contacts.points[loose]
    parts = [(bodies[:, 0], at, -on_b[loose]), (bodies[:, 1], at, on_b[loose])]
    if acting.tie_forces is not None:
        pulls = np.nan_to_num(acting.tie_forces)[model.ties.tie_of_point, None] * model.ties.pulls
        parts.append((np.where(model.ties.bodies == OUTSIDE, n_blocks, model.ties.bodies), model.ties.places, pulls))
    parts += _point_loads(model, load_case.dead, 1.0)
    if load_case.question.multiplies:
        parts += _point_loads(model, load_case.live, acting.load_factor)
    parts.append((bearings.owner, bearings.places, bearings.forces))
    owner, places, forces = (np.concatenate(each) for each in zip(*parts, strict=True))
    interfaces = np.full(len(owner), AT_A_POINT)
    interfaces[len(owner) - len(bearings.interfaces) :] = bearings.interfaces
    counts = (owner < n_blocks) & forces.any(axis=1)
    order = np.flatnonzero(counts)[np.argsort(owner[counts], kind="stable")]
    owner, places, forces = owner[order], places[order], forces[order]
    moments = np.cross(places - model.blocks.centroids[owner], forces)
    spread = -summed(owner, np.hstack([forces, moments]), n_blocks)
    start = starts(np.bincount(owner, minlength=n_blocks).astype(np.int64))
    return Actions(start, places, forces, interfaces[order], spread)


def _point_loads(
    model: Model, loads: Sequence[AppliedLoad], factor: float
) -> list[tuple[IntArray, FloatArray, FloatArray]]:
    """Block, place and force of each load that is one force: its lever a F, times F over F·F, is its arm a."""
    found = []
    for load in loads:
        if load.at_point and len(load.blocks):
            force, lever = load.wrenches[:, :3], load.wrenches[:, 6:].reshape(-1, 3, 3)
            square = np.maximum((force**2).sum(axis=1), np.finfo(float).tiny)
            arm = np.einsum("nij,nj->ni", lever, force) / square[:, None]
            found.append((load.blocks, model.blocks.centroids[load.blocks] + arm, factor * force))
    return found
