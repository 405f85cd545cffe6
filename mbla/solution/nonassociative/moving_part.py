"""The part of a structure that a motion moves, as a program of its own: what is far from it stays fixed.

Three quarters of the blocks of a tall wall rest in its collapse. Forces and motion of the others are found with these
alone; whether what rests carries them, one program of the whole structure says in the end. Blocks within ``RINGS``
joints of a moving one are free to move too: with none, walls of 40 and 60 courses stalled at residuals of 1e-5, with
three at 1e-6.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray
from mbla.program.program import Program
from mbla.program.reductions.restrict import ChosenPart

RINGS = 6
"""Rings of blocks around the moving ones."""

AT_REST = 1e-7
"""Velocity of a block over the largest below which it rests."""

FEW_POINTS, WORTHWHILE = 3000, 0.6
"""Contact points up to which no part is worth a program of its own, and share of them from which it is not."""


def moving_part(
    program: Program,
    velocities: FloatArray,
    *,
    rings: int | None = None,
    few: int | None = None,
    worthwhile: float | None = None,
) -> ChosenPart | None:
    """The part that velocities, (n_rows,), move; None where that is hardly smaller, or blocks are guided.

    rings, few, worthwhile : in the place of ``RINGS``, ``FEW_POINTS`` and ``WORTHWHILE``
    """
    rings, few = RINGS if rings is None else rings, FEW_POINTS if few is None else few
    worthwhile = WORTHWHILE if worthwhile is None else worthwhile
    size = 3 if program.components == 2 else 6
    if program.guided or len(velocities) % size or program.n_points <= few:
        return None
    speed = np.abs(velocities.reshape(-1, size)).max(axis=1)
    moves, pattern = speed > AT_REST * speed.max(initial=0.0), sp.csr_array(abs(program.equilibrium_matrix))
    across = sp.csr_array(pattern.T)
    points = _any(across @ np.repeat(moves, size), program.components)
    for _ in range(rings):
        moves = _any(pattern @ np.repeat(points, program.components), size)
        points = _any(across @ np.repeat(moves, size), program.components)
    if points.sum() > worthwhile * len(points):
        return None
    return ChosenPart.of(program, moves, np.flatnonzero(points))


def _any(sums: FloatArray, size: int) -> BoolArray:
    """Of which items, (n,), any of the ``size`` sums is not zero; sums (n size,)."""
    return np.asarray(sums.reshape(-1, size).any(axis=1), dtype=np.bool_)
