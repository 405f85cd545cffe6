"""The part of a structure that a motion moves, as a program of its own: what is far from it stays fixed.

Three quarters of the blocks of a tall wall rest in its collapse. Blocks within some joints of a moving one are free to
move too.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray
from mbla.program.program import Program
from mbla.program.reductions.restrict import ChosenPart
from mbla.solution.flow.settings import PathSettings

AT_REST = 1e-7
"""Velocity of a block over the largest below which it rests."""


def moving_part(program: Program, velocities: FloatArray, settings: PathSettings) -> ChosenPart | None:
    """The part that velocities, (n_rows,), move; None where that is hardly smaller, or blocks are guided."""
    size = 3 if program.components == 2 else 6
    if program.guided or len(velocities) % size or program.n_points <= settings.few_points:
        return None
    speed = np.abs(velocities.reshape(-1, size)).max(axis=1)
    moves, pattern = speed > AT_REST * speed.max(initial=0.0), sp.csr_array(abs(program.equilibrium_matrix))
    across = sp.csr_array(pattern.T)
    points = _any(across @ np.repeat(moves, size), program.components)
    for _ in range(settings.rings):
        moves = _any(pattern @ np.repeat(points, program.components), size)
        points = _any(across @ np.repeat(moves, size), program.components)
    if points.sum() > settings.worthwhile * len(points):
        return None
    return ChosenPart.of(program, moves, np.flatnonzero(points))


def _any(sums: FloatArray, size: int) -> BoolArray:
    """Of which items, (n,), any of the ``size`` sums is not zero; sums (n size,)."""
    return np.asarray(sums.reshape(-1, size).any(axis=1), dtype=np.bool_)
