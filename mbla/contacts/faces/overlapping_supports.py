"""Pieces of a face that two bodies hold: a ground and what lies in its plane, a footing or another ground.

Either body alone would hold the piece with the full cohesion, tensile and compressive strength; both together would
count these strengths twice. Of two supports with one joint law the first holds the piece, blocks before grounds, and
the second only the rest of its area. With different laws, or where one of the two bodies can move, nothing says which
one holds the piece, and the deck is refused.

Blocks alone cannot hold a piece twice: they would overlap.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely

from mbla.arrays import BoolArray, IntArray
from mbla.contacts.contacts import ContactsRefused
from mbla.contacts.faces.narrow_phase import Patches, common_parts
from mbla.contacts.joints import Laws
from mbla.errors import Notice
from mbla.model.model import Model
from mbla.model.solids.polygons import (
    GRID,
    Polygons,
    connected_parts,
    union_by_row,
    widths,
)
from mbla.model.solids.ragged import rows_and_items

_ONE_FACE = 0.99
"""Cosine of the angle between two normals of common surfaces of one face."""
_APART = 2.0
"""Distance of the planes of two common surfaces of one face, in tolerances: each is within one of the face."""
_WHOLE = 1e-9
"""Relative: a width that is the tolerance up to rounding is as wide."""


def without_overlapping_supports(
    model: Model, still: BoolArray, patches: Patches, laws: Laws, rows: IntArray, tolerance: float
) -> tuple[Patches, IntArray, list[Notice]]:
    """Common surfaces without what other supports hold of them, the row that each comes from, and a notice on them.

    still : (n_blocks,) blocks that do not move
    laws  : joint laws; those of the patches are at ``rows``

    Raises ContactsRefused for a piece between bodies of which one can move, or with two joint laws.
    """
    every = np.arange(len(patches))
    later, earlier, common = _shared(patches, len(model.blocks), tolerance)
    if not len(later):
        return patches, every, []
    bodies = patches.overlays.bodies
    other = np.where(bodies[earlier, 0] == bodies[later, 1], bodies[earlier, 1], bodies[earlier, 0])
    moving = ~np.append(still, np.ones(len(model.grounds), dtype=bool))[other]
    at_odds = moving | (laws.rows[rows[later]] != laws.rows[rows[earlier]])
    if at_odds.any():
        bodies, other = bodies[later[at_odds]], other[at_odds]
        law, other_law = (laws.names[laws.rows[rows[each[at_odds][0]]]] for each in (later, earlier))
        moves = f"{model.body_name(int(other[0]))} can move"
        why = moves if law == other_law else f"by different joints, {other_law} and {law}"
        words = (
            f"{_in_words(model, bodies, other)}, {why}: leave one of them out, name the blocks that the ground carries "
            "with blocks, or leave out one of the two interfaces by the joint open in contacts.overrides"
        )
        raise ContactsRefused("supports-at-odds", words, ("supports",))
    cut = patches.polygons.copy()
    chosen, row = np.unique(later, return_inverse=True)
    order = np.argsort(row, kind="stable")
    taken = union_by_row(common[order], row[order].astype(np.int64), len(chosen))
    cut[chosen] = shapely.difference(cut[chosen], taken, grid_size=GRID)
    parts, source = connected_parts(cut)
    wide = ~np.isin(source, chosen) | (widths(parts) >= tolerance * (1 - _WHOLE))
    parts, source = parts[wide], source[wide]
    left = replace(patches.take(source), polygons=parts, widths=widths(parts))
    words = f"{_in_words(model, bodies[later], other)}: it is counted once, on {model.body_name(int(other[0]))}"
    return left, source, [Notice("notice", "supports-in-one-plane", words)]


def _shared(patches: Patches, n_blocks: int, tolerance: float) -> tuple[IntArray, IntArray, Polygons]:
    """Pairs of patches on one piece of a face, of a ground and of an earlier body, and the piece as the ground has it.

    The first of each pair is of a ground, the second of a block or of an earlier ground.
    """
    overlays, n = patches.overlays, len(patches)
    of_ground = np.flatnonzero(overlays.bodies[:, 0] >= n_blocks)
    blocks = np.concatenate([overlays.bodies[:, 0], overlays.bodies[:, 1]])
    by_block = np.argsort(blocks, kind="stable")
    ordered = blocks[by_block]
    carried = overlays.bodies[of_ground, 1]
    first = np.searchsorted(ordered, carried, side="left")
    row, item = rows_and_items(first, np.searchsorted(ordered, carried, side="right") - first)
    later, sided = of_ground[row], by_block[item]
    earlier, sign = (
        sided % n,
        np.where(sided < n, -1.0, 1.0),
    )  # normals lead from a to b: away from the block if it is a
    cosine = sign * np.einsum("ki,ki->k", overlays.frames[later, 0], overlays.frames[earlier, 0])
    away = np.einsum("ki,ki->k", overlays.origins[earlier] - overlays.origins[later], overlays.frames[later, 0])
    body = overlays.bodies[earlier, 0]
    keep = (body < n_blocks) | (body < overlays.bodies[later, 0])
    keep &= (cosine > _ONE_FACE) & (np.abs(away) <= _APART * tolerance * overlays.sizes[later])
    later, earlier = later[keep], earlier[keep]
    common, _ = common_parts(patches, later, earlier)
    wide = widths(common) >= tolerance * (1 - _WHOLE)
    return later[wide], earlier[wide], common[wide]


def _in_words(model: Model, bodies: IntArray, other: IntArray) -> str:
    """The first of such pieces; bodies (n, 2) of the ground and the block, and the other support of each, (n,)."""
    ground, block = (model.body_name(int(body)) for body in bodies[0])
    more = f" (and {len(other) - 1} more such pieces)" if len(other) > 1 else ""
    return f"{model.body_name(int(other[0]))} and {ground} hold the same piece of a face of {block}{more}"
