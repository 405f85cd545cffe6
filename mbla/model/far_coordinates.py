"""Blocks so far from the origin that their coordinates are too coarse to tell their shape.

A coordinate has sixteen digits, of which the distance from the origin takes its part: at 1e8 m corners lie on a grid of
1.5e-8 m. What is computed here takes differences first, so that nothing else is lost; but the corners themselves are
rounded before the program sees them. Measured on a wall of blocks of 0.4 m: the load factor changes by about ten times
the grid over the block, 1e-6 of itself where that is 1e-7.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mbla.errors import Notice
from mbla.model.defects import LARGEST_COORDINATE, find_extents
from mbla.model.polyhedra import Polyhedra

COARSE = 1e-8
"""Rounding of a coordinate, over the diagonal of the block's bounding box, from which load factors may lose digits."""


def _coarsest(polyhedra: Polyhedra) -> tuple[int, float]:
    """The block whose corners are known worst, and the rounding of its coordinates over its diagonal."""
    if not len(polyhedra.vertices) or not (np.abs(polyhedra.vertices) <= LARGEST_COORDINATE).all():
        return 0, 0.0  # told by itself
    extents = find_extents(polyhedra)
    share = np.divide(
        extents.rounding, extents.diagonals, out=np.zeros_like(extents.rounding), where=extents.diagonals > 0
    )
    share[(extents.diagonals == 0) & (extents.rounding > 0)] = 1.0
    worst = int(np.argmax(share))
    return worst, float(share[worst])


def far_fault(polyhedra: Polyhedra, tolerance: float) -> str | None:
    """What is said of a deck whose blocks are rounded by more than ``contacts.tolerance``; None where none is."""
    _, share = _coarsest(polyhedra)
    if share <= tolerance:
        return None
    return (
        f"so far from the origin coordinates are rounded by {share:.2g} of the size of a block, more than "
        f"contacts.tolerance = {tolerance:g}: move the structure to the origin"
    )


def far_notices(polyhedra: Polyhedra, name: Callable[[int], str]) -> list[Notice]:
    """A warning where coordinates are coarse enough for the load factor to lose digits."""
    block, share = _coarsest(polyhedra)
    if share <= COARSE:
        return []
    words = (
        f"{name(block)} lies so far from the origin that its coordinates are rounded by {share:.1e} of its size: the "
        f"load factor may be off by ten times that share; move the structure to the origin"
    )
    return [Notice("warning", "coordinates-coarse", words)]
