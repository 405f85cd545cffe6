"""What all programs of one load case have in common, reduced or not."""

from __future__ import annotations

from dataclasses import dataclass

import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray, IntArray


@dataclass(frozen=True)
class ModelFacts:
    """Facts of the full model under a load case that its program does not say in numbers of its own.

    free     : (n_free,) the block to which each six rows of the spatial program belong
    n_blocks : blocks of the model
    areas    : (n_points,) by which contact points share stiffness (:mod:`mbla.program.stiffness_shares`)
    settling_support : a support settles: the reference of the load factor is chosen, and 0 does not show that the
               structure stands
    allowed  : (n_rows, n_rows) projector on the motions that guides allow, None where no block is guided
    brittle  : (n_points, 2) whether a point carries nothing once it has given way at its greatest force, and at its
               least; None where none does
    """

    free: IntArray
    n_blocks: int
    areas: FloatArray
    settling_support: bool = False
    allowed: sp.csr_array | None = None
    brittle: BoolArray | None = None
