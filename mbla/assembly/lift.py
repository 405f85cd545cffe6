"""The way back from what the solver sees to blocks and ties of the deck, and the same way forth.

Glued blocks move with their body; ties are the last interfaces, of one contact point each, so that they are the last
rows of whatever belongs to interfaces or contact points (:mod:`mbla.assembly.ties`).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mbla.arrays import FloatArray
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.contacts.contacts import TieContacts


def motions_of_blocks(bodies: RigidBodies, motions: FloatArray) -> FloatArray:
    """Motions of the blocks, (n_blocks, 6), from those of the bodies, (n_bodies, 6)."""
    of_blocks = motions[bodies.label]
    of_blocks[:, :3] += np.cross(of_blocks[:, 3:], bodies.arms)
    return of_blocks


def motions_of_bodies(bodies: RigidBodies, motions: FloatArray, *, cell_moves: bool = True) -> FloatArray:
    """Motions of the bodies, (n_bodies, 6), from that of the first block of each.

    cell_moves : they are for a live power of 1, in which a load cell moves; else it is at rest
    """
    first = bodies.first_blocks
    of_bodies = motions[first]
    of_bodies[:, :3] -= np.cross(of_bodies[:, 3:], bodies.arms[first])
    cell = bodies.load_cell
    return of_bodies if cell is None else np.vstack([of_bodies, cell_moves * cell.motion])


def parting(bodies: RigidBodies, motions: FloatArray) -> float:
    """How far glued blocks move apart by motions of the blocks, (n_blocks, 6), over the largest of these."""
    lengths = np.repeat([1.0, float(bodies.model.blocks.sizes.max(initial=0.0)) or 1.0], 3)
    together = motions_of_blocks(bodies, motions_of_bodies(bodies, motions))
    apart = float(np.abs((together - motions) * lengths).max(initial=0.0))
    return apart / float(np.abs(motions * lengths).max(initial=0.0)) if apart > 0.0 else 0.0


def without_tie_rows(ties: TieContacts, values: NDArray[Any]) -> NDArray[Any]:
    """Rows of the interfaces, or contact points, that are surfaces."""
    return values[: len(values) - len(ties.rows)]


def with_tie_rows(ties: TieContacts, values: NDArray[Any], of_ties: FloatArray | None = None) -> NDArray[Any]:
    """The same with rows of the ties behind them.

    of_ties : (k, ...) their first columns; default: zero
    """
    rows = np.zeros((len(ties.rows), *values.shape[1:]), dtype=values.dtype)
    if of_ties is not None:
        rows[:, : of_ties.shape[1]] = of_ties
    return np.concatenate([values, rows])


def of_all_ties(ties: TieContacts, count: int, values: FloatArray) -> FloatArray:
    """Values of all ties of the model, (count,), from those among the contacts, (k,); nan of the others."""
    every = np.full(count, np.nan)
    every[ties.rows] = values
    return every
