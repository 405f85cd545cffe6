"""Masses that rest on blocks: they weigh and are accelerated as the blocks are, but touch nothing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray
from mbla.deck.sections.loads import AddedMass
from mbla.deck.tree import KeyPath
from mbla.errors import Finding, Notice
from mbla.model.selectors import Roster, select_blocks
from mbla.model.solids.blocks import Blocks, distance_outside
from mbla.model.wording import named, vector


def with_added_masses(masses: Sequence[AddedMass], roster: Roster, fixed: BoolArray) -> Blocks:
    """The blocks with the masses of the deck, shared in proportion to the volumes of the blocks selected.

    Each share is at the centroid of its block; that of a mass on one block is where the deck says. Refuses points
    for several blocks, and remarks on masses that do nothing or lie far off.

    fixed : (n_blocks,) blocks that do not move
    """
    blocks = roster.blocks
    total, moment = np.zeros(len(blocks)), np.zeros((len(blocks), 3))
    for number, added in enumerate(masses):
        path: KeyPath = ("masses", number)
        chosen = select_blocks(added.on, (*path, "on"), roster)
        if chosen is None:
            continue
        if added.at is not None and len(chosen) != 1:
            message = f"applies to a mass on one block, {len(chosen)} are selected: give an index, or one mass for each"
            roster.refuse(Finding("one-block-only", message, *path, "at"))
            continue
        shares = added.mass * blocks.volumes[chosen] / (blocks.volumes[chosen].sum() or 1.0)
        arms = np.zeros((len(chosen), 3)) if added.at is None else np.array([added.at]) - blocks.centroids[chosen]
        total[chosen] += shares
        moment[chosen] += shares[:, None] * arms
        if added.at is not None:
            off = distance_outside(np.array(added.at), int(chosen[0]), blocks)
            name = blocks.name(int(chosen[0]))
            words = f"the mass at {vector(added.at)} on {name} lies {off:.4g} outside that block, with which it moves"
            if off:
                roster.remark(Notice("notice", "mass-outside-block", words))
        if fixed[chosen].all() and not fixed.all():
            words = f"the mass of {added.mass:g} on {named(chosen, blocks.name)} has no effect: nothing of it moves"
            roster.remark(Notice("warning", "mass-on-support", words))
    arms = moment / np.where(total > 0.0, total, 1.0)[:, None]
    return replace(blocks, added_masses=total, added_mass_points=blocks.centroids + arms)
