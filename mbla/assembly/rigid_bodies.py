"""Glued blocks as rigid bodies: the model whose blocks are these bodies, and the way to and from the blocks.

A body has the faces, the volume V and the mass of its members and their common centroid c = Σ V_b c_b / V; loads on its
members act on it::

    F = Σ F_b,    M = Σ M_b + (c_b − c) × F_b

and from its motion (v, ω) about c come those of its members::

    v_b = v + ω × (c_b − c),    ω_b = ω

Contact forces of glued interfaces are not computed: they are internal forces of a rigid body. Interfaces of other laws
between two members of one body are left out as well, as equilibrium cannot determine their forces either.

Guides of glued blocks: the body moves as its guided block does. An admissible motion (v, ω) of block b about its own
centroid c_b is the motion (v + ω × (c − c_b), ω) of the body about its centroid c. Two guided blocks of one body agree
where they are guided as one and give the body the same admissible motions; otherwise their guides would have to be
intersected, and such a deck is refused.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.assembly.load_cell import LoadCell
from mbla.contacts.contacts import Contacts
from mbla.model.join import join_blocks
from mbla.model.model import LoadCase, Model
from mbla.model.supports.guides import Guides


@dataclass(frozen=True)
class RigidBodies:
    """A model and its contacts with rigid bodies for blocks; the model has no load cases.

    body_of_block      : (n_blocks,); None where every block is a body, and model and contacts are those of the deck
    arms               : (n_blocks, 3) m, from the centroid of the body to that of the block
    load_cell          : of an objective, the last body; None without
    tie_prestress_load : (n_bodies, 6) N, N m dead load of ties that are part of the contacts; None without
    """

    model: Model
    contacts: Contacts
    body_of_block: IntArray | None
    arms: FloatArray
    load_cell: LoadCell | None = None
    tie_prestress_load: FloatArray | None = None

    @property
    def label(self) -> IntArray:
        """Body of each block, (n_blocks,)."""
        return np.arange(len(self.arms)) if self.body_of_block is None else self.body_of_block

    @property
    def first_blocks(self) -> IntArray:
        """First block of each body but the load cell, (n,)."""
        return np.asarray(np.unique(self.label, return_index=True)[1])

    def load_case(self, load_case: LoadCase) -> LoadCase:
        """Loads on the bodies, about their centroids; blocks that settle are not glued."""
        dead, live, always = self.loads(load_case.dead_load), self.loads(load_case.live_load), self.tie_prestress_load
        question = load_case.question.on_bodies(self.label, self.loads, 0.0 if always is None else always)
        case = replace(load_case, dead_load=dead, live_load=live, question=question)
        if self.load_cell is not None:
            case = self.load_cell.loaded(case, len(self.model.blocks) - 1)
        return case if always is None else replace(case, dead_load=case.dead_load + always)

    def loads(self, loads: FloatArray) -> FloatArray:
        """Forces and moments on bodies, (n_bodies, 6), from those on blocks, (n_blocks, 6)."""
        moved = loads.copy()
        moved[:, 3:] += np.cross(self.arms, loads[:, :3])
        total = np.zeros((len(self.model.blocks), 6))
        np.add.at(total, self.label, moved)
        return total


def rigid_bodies(model: Model, contacts: Contacts) -> RigidBodies:
    """The bodies that glue makes of the blocks, and the contacts as found between them."""
    model, label = replace(model, load_cases=()), contacts.solid_of_block
    if label is None:
        return RigidBodies(model, contacts, None, np.zeros((len(model.blocks), 3)))
    blocks = join_blocks(model.blocks, label)
    fixed = np.zeros(len(blocks), dtype=bool)
    fixed[label] = model.fixed  # bodies of several blocks have none that is fixed
    grounds = tuple(
        ground if ground.blocks is None else replace(ground, blocks=np.unique(label[ground.blocks]))
        for ground in model.grounds
    )
    arms = model.blocks.centroids - blocks.centroids[label]
    guides = guides_of_bodies(model.guides, label, arms)
    body = np.concatenate([label, len(blocks) + np.arange(len(grounds))])
    return RigidBodies(
        model=replace(model, blocks=blocks, fixed=fixed, grounds=grounds, guides=guides),
        contacts=replace(contacts, bodies=body[contacts.bodies], solid_of_block=None),
        body_of_block=label,
        arms=arms,
    )


AGREE = 1e-9
"""Difference of two motions of one body, over the largest entry, up to which they are the same but for rounding."""


def guides_of_bodies(guides: Guides, label: IntArray, arms: FloatArray) -> Guides:
    """Guides of the bodies: each guided body by its first guided block.

    label : (n_blocks,) body of each block
    arms  : (n_blocks, 3) from the centroid of the body to that of the block
    """
    if not len(guides):
        return guides
    _, first = np.unique(label[guides.blocks], return_index=True)
    first = np.sort(first)
    _, bodies = np.unique(guides.bodies[first], return_inverse=True)
    motions = _about_bodies(guides, arms)[first]
    return Guides(label[guides.blocks[first]], bodies.astype(np.int64), motions, guides.words)


def guides_at_odds(guides: Guides, label: IntArray, arms: FloatArray) -> tuple[int, int] | None:
    """Two guided blocks of one body whose guides contradict each other; None where there are none.

    label : (n_blocks,) body of each block
    arms  : (n_blocks, 3) m, from the centroid of the body to that of the block
    """
    if not len(guides):
        return None
    _, first, row = np.unique(label[guides.blocks], return_index=True, return_inverse=True)
    motions = _about_bodies(guides, arms)
    size = np.abs(motions).max(axis=(1, 2), initial=0.0)
    differs = np.abs(motions - motions[first[row]]).max(axis=(1, 2), initial=0.0) > AGREE * size
    odd = np.flatnonzero(differs | (guides.bodies != guides.bodies[first[row]]))
    if not len(odd):
        return None
    return int(guides.blocks[first[row[odd[0]]]]), int(guides.blocks[odd[0]])


def _about_bodies(guides: Guides, arms: FloatArray) -> FloatArray:
    """Motions of the guided blocks about the centroids of their bodies, (m, 6, 6)."""
    motions = guides.motions.copy()
    motions[:, :3] -= np.cross(motions[:, 3:], arms[guides.blocks][:, :, None], axis=1)
    return np.asarray(motions)
