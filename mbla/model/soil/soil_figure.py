"""The load factor of a load case on a mesh of soil whose corners were moved."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class SoilFigure:
    """What the planar program of a load case gives on a mesh that was moved.

    size        : of the cells, over that which the deck asks for
    cells       : how many
    load_factor : upper one of associative flow; inf: nothing moves, -inf: dead loads alone have no equilibrium
    followed    : whether the corners were moved for this load case, or for others alone
    shown       : whether the results are those of this mesh
    """

    size: float
    cells: int
    load_factor: float
    followed: bool
    shown: bool


def scatter_of(figures: Sequence[SoilFigure]) -> float:
    """How far the load factors of several meshes are apart, over the least of them; nan of one."""
    values = np.array([figure.load_factor for figure in figures])
    if len(values) < 2 or not np.isfinite(values).all():
        return np.nan
    return float(np.ptp(values) / max(np.abs(values).min(), np.finfo(float).tiny))
