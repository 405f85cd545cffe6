"""Glue: blocks that are one rigid body, and the model that the solver sees, whose blocks are these bodies.

Interfaces with the joint law *glued* join blocks to *solids*; blocks that glue joins to a support, directly or through
others, do not move. Every block that moves belongs to one solid, most of them alone. A solid has the faces, the volume
V and the mass of its members and their common centroid c = Σ V_b c_b / V; loads on its members act on it::

    F = Σ F_b,    M = Σ M_b + (c_b − c) × F_b

and from its motion (v, ω) about c come those of its members::

    v_b = v + ω × (c_b − c),    ω_b = ω

Contact forces of glued interfaces are not computed: they are internal forces of a rigid body. An interface of any other
law between two members of one solid carries nothing that equilibrium could determine either and is left out with them.

Guides of blocks that are glued into solids: the solid moves as its guided block does.

A way in which block b moves with (v, ω) about its own centroid c_b moves its solid with (v + ω × (c − c_b), ω) about
the centroid c of the solid. Two guided blocks of one solid agree where they belong to one guided body and both give the
solid the same motion in each way; otherwise their guides would have to be intersected, and such a deck is refused.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.contacts.gauge import gauge_way, with_gauge
from mbla.model.guides import Guides
from mbla.model.join import join_blocks
from mbla.model.model import LoadCase, Model
from mbla.model.settlement import with_reference
from mbla.model.solids.measures import connected_labels
from mbla.model.solids.ragged import numbered


@dataclass(frozen=True)
class Glue:
    """What glued interfaces make of the blocks.

    solid_of_block : (n_blocks,) numbered from 0 in the order of their first blocks; None where nothing is joined
    held           : (n_blocks,) blocks that are glued to a support and do not move
    """

    solid_of_block: IntArray | None
    held: BoolArray


def solid_sizes(solid_of_block: IntArray | None) -> IntArray:
    """How many blocks each of the solids of several blocks has, (n,)."""
    if solid_of_block is None:
        return np.zeros(0, dtype=np.int64)
    sizes = np.bincount(solid_of_block)
    return np.asarray(sizes[sizes > 1])


def glue_blocks(model: Model, bodies: IntArray) -> Glue:
    """Solids that the glued interfaces between bodies (n, 2) make."""
    n_blocks = len(model.blocks)
    if not len(bodies):
        return Glue(None, np.zeros(n_blocks, dtype=bool))
    still = np.concatenate([model.fixed, np.ones(len(model.grounds), dtype=bool)])
    node = np.append(np.where(still, n_blocks, np.arange(len(still))), n_blocks)  # all supports are one node
    part = connected_labels(node[bodies], n_blocks + 1)
    held = (part[:n_blocks] == part[n_blocks]) & ~model.fixed
    own = part.max() + 1 + np.arange(n_blocks)
    label, first = numbered(np.where(held | model.fixed, own, part[:n_blocks]))
    return Glue(None if len(first) == n_blocks else label, held)


@dataclass(frozen=True)
class Solids:
    """A model and its contacts with solids for blocks, and the way to and from the blocks.

    solid_of_block : (n_blocks,); None where every block is a solid, and model and contacts are the ones given
    arms           : (n_blocks, 3) m, from the centroid of the solid to that of the block
    gauge          : (6,) motion of the gauge of an objective, the last solid, for a live power of 1; None without one
    fitted         : (n_solids, 6) N, N m dead load of ties that are part of the contacts; None without
    """

    model: Model
    contacts: Contacts
    solid_of_block: IntArray | None
    arms: FloatArray
    gauge: FloatArray | None = None
    fitted: FloatArray | None = None

    @property
    def label(self) -> IntArray:
        """Solid of each block, (n_blocks,)."""
        return np.arange(len(self.arms)) if self.solid_of_block is None else self.solid_of_block

    def load_case(self, load_case: LoadCase) -> LoadCase:
        """Loads on the solids, about their centroids; blocks that settle are not glued."""
        settlement = load_case.settlement
        if settlement is not None:
            settlement = replace(settlement, blocks=self.label[settlement.blocks])
        tilt = load_case.tilt
        if tilt is not None:
            fixed, turning, across = (self.loads(loads) for loads in (tilt.fixed, tilt.turning, tilt.across))
            fixed = fixed if self.fitted is None else fixed + self.fitted
            tilt = replace(tilt, fixed=fixed, turning=turning, across=across)
        dead, live = self.loads(load_case.dead_load), self.loads(load_case.live_load)
        case = replace(load_case, dead_load=dead, live_load=live, settlement=settlement, tilt=tilt)
        if self.gauge is not None and settlement is not None:
            last, ways = np.array([len(self.model.blocks) - 1]), gauge_way(load_case)[None]
            on_gauge = replace(case, settlement=replace(settlement, blocks=last, motions=ways))
            case = with_reference(on_gauge, settlement.reference)
        return case if self.fitted is None else replace(case, dead_load=case.dead_load + self.fitted)

    def loads(self, loads: FloatArray) -> FloatArray:
        """Forces and moments on solids, (n_solids, 6), from those on blocks, (n_blocks, 6)."""
        moved = loads.copy()
        moved[:, 3:] += np.cross(self.arms, loads[:, :3])
        total = np.zeros((len(self.model.blocks), 6))
        np.add.at(total, self.label, moved)
        return total

    def block_motions(self, motions: FloatArray) -> FloatArray:
        """Motions of the blocks, (n_blocks, 6), from those of the solids, (n_solids, 6)."""
        of_blocks = motions[self.label]
        of_blocks[:, :3] += np.cross(of_blocks[:, 3:], self.arms)
        return of_blocks

    def solid_motions(self, motions: FloatArray, *, opens: bool = True) -> FloatArray:
        """Motions of the solids, (n_solids, 6), from that of the first block of each.

        opens : they are for a live power of 1, in which a gauge moves; else it is at rest
        """
        first = self.first_blocks
        of_solids = motions[first]
        of_solids[:, :3] -= np.cross(of_solids[:, 3:], self.arms[first])
        return of_solids if self.gauge is None else np.vstack([of_solids, opens * self.gauge])

    @property
    def first_blocks(self) -> IntArray:
        """First block of each solid, (n_solids,)."""
        return np.asarray(np.unique(self.label, return_index=True)[1])


def solids_of(model: Model, contacts: Contacts, load_case: LoadCase | None = None) -> Solids:
    """The model that the solver sees; with a gauge where the load case has an objective."""
    solids = _solids_of(model, contacts)
    if load_case is None or load_case.objective is None or load_case.settlement is None:
        return solids
    # sides are those of blocks: a solid may have some on either side, and some on none
    sided = replace(solids.contacts, cut=load_case.objective.crossed(contacts.bodies))
    gauged, cut = with_gauge(solids.model, sided, load_case, len(solids.label))
    motion = gauge_way(load_case) / load_case.settlement.unit
    return replace(solids, model=gauged, contacts=cut, solid_of_block=solids.label, gauge=motion)


def _solids_of(model: Model, contacts: Contacts) -> Solids:
    label = contacts.solid_of_block
    if label is None:
        return Solids(model, contacts, None, np.zeros((len(model.blocks), 3)))
    blocks = join_blocks(model.blocks, label)
    fixed = np.zeros(len(blocks), dtype=bool)
    fixed[label] = model.fixed  # solids of several blocks have none that is fixed
    grounds = tuple(
        ground if ground.blocks is None else replace(ground, blocks=np.unique(label[ground.blocks]))
        for ground in model.grounds
    )
    arms = model.blocks.centroids - blocks.centroids[label]
    body = np.concatenate([label, len(blocks) + np.arange(len(grounds))])
    solids = Solids(
        model=replace(
            model, blocks=blocks, fixed=fixed, grounds=grounds, guides=solid_guides(model.guides, label, arms)
        ),
        contacts=replace(contacts, bodies=body[contacts.bodies], solid_of_block=None),
        solid_of_block=label,
        arms=arms,
    )
    cases = tuple(solids.load_case(case) for case in model.load_cases)
    return replace(solids, model=replace(solids.model, load_cases=cases))


def held_model(model: Model, contacts: Contacts) -> Model:
    """The model with the blocks fixed that are glued to a support."""
    held = contacts.report.held
    if model.fixed[held].all():
        return model
    fixed = model.fixed.copy()
    fixed[held] = True
    return replace(model, fixed=fixed)


AGREE = 1e-9
"""Difference of two motions of one solid, over the largest entry, up to which they are the same but for rounding."""


def solid_guides(guides: Guides, label: IntArray, arms: FloatArray) -> Guides:
    """Guides of the solids: each guided solid by its first guided block.

    label : (n_blocks,) solid of each block
    arms  : (n_blocks, 3) from the centroid of the solid to that of the block
    """
    if not len(guides):
        return guides
    _, first = np.unique(label[guides.blocks], return_index=True)
    first = np.sort(first)
    _, bodies = np.unique(guides.bodies[first], return_inverse=True)
    motions = _about_solids(guides, arms)[first]
    return Guides(label[guides.blocks[first]], bodies.astype(np.int64), motions, guides.words)


def guides_at_odds(guides: Guides, label: IntArray, arms: FloatArray) -> tuple[int, int] | None:
    """Two guided blocks of one solid whose guides contradict each other; None where there are none.

    label : (n_blocks,) solid of each block
    arms  : (n_blocks, 3) m, from the centroid of the solid to that of the block
    """
    if not len(guides):
        return None
    _, first, row = np.unique(label[guides.blocks], return_index=True, return_inverse=True)
    motions = _about_solids(guides, arms)
    size = np.abs(motions).max(axis=(1, 2), initial=0.0)
    differs = np.abs(motions - motions[first[row]]).max(axis=(1, 2), initial=0.0) > AGREE * size
    odd = np.flatnonzero(differs | (guides.bodies != guides.bodies[first[row]]))
    if not len(odd):
        return None
    return int(guides.blocks[first[row[odd[0]]]]), int(guides.blocks[odd[0]])


def _about_solids(guides: Guides, arms: FloatArray) -> FloatArray:
    """Motions of the guided blocks about the centroids of their solids, (m, 6, 6)."""
    motions = guides.motions.copy()
    motions[:, :3] -= np.cross(motions[:, 3:], arms[guides.blocks][:, :, None], axis=1)
    return np.asarray(motions)
