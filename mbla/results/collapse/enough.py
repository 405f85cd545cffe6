"""What of a structure is enough for its load factor: the blocks that move and the interfaces on them.

Fix every block that rests in the mechanism. Forces that balance the structure balance the moving blocks too, so that
the load factor of the smaller model is no less; and the mechanism, in which nothing else moves, is one of the smaller
model with the same power, so that by the kinematic theorem it is no more. By associative flow both models have one and
the same load factor. A resting block that touches no moving one then takes no part at all and can be left out.

Without normality there are no bounds, but forces and mechanism together fit the law at every interface that is left:
the state found is one of the smaller model, whose load factors may reach further, lower ones among them, because fewer
conditions are left.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model


@dataclass(frozen=True)
class Enough:
    """The smaller model.

    moving     : (n,) blocks that move
    interfaces : (m,) on them
    bearing    : free blocks at rest that these touch; they stand for supports
    left_out   : free blocks at rest that touch nothing that moves
    """

    moving: IntArray
    interfaces: IntArray
    bearing: IntArray
    left_out: IntArray


def enough_of(model: Model, contacts: Contacts, parts: IntArray) -> Enough:
    """From the rigid part of each block, (n_blocks,), 0 at rest."""
    n_blocks = len(model.blocks)
    moves = np.append(parts > 0, np.zeros(len(model.grounds), dtype=bool))
    on_moving = moves[contacts.bodies].any(axis=1)
    touched = np.zeros(len(moves), dtype=bool)
    touched[contacts.bodies[on_moving]] = True
    rests = ~model.fixed & (parts == 0)
    return Enough(
        moving=np.flatnonzero(parts > 0),
        interfaces=np.flatnonzero(on_moving),
        bearing=np.flatnonzero(rests & touched[:n_blocks]),
        left_out=np.flatnonzero(rests & ~touched[:n_blocks]),
    )
