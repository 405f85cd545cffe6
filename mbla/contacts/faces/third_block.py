"""Contacts across a third body: two faces near each other that a thinner block holds apart.

The bottom of a block on a thin foot is within the tolerance of the ground, and would be taken to rest on it. But where
two bodies lie behind the same part of one facet, only the nearer of them can touch it there: the foot fills the gap.
That gap is the thickness of a block, no rounding, so the entire common surface with the farther body is no contact.

Nor do two faces touch that face each other through their own blocks: the top of a thin plate and the bottom of the
plate below it are opposite, with a gap of minus both thicknesses.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.contacts.faces.narrow_phase import Patches, Verdicts, common_parts
from mbla.contacts.outlines.overlay import concatenate
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import meeting_boxes
from mbla.model.solids.polygons import widths
from mbla.model.solids.ragged import rows_and_items

# Difference of two gaps, relative to block size, below which they are one: some last digits of a coordinate.
_ROUNDING = 1e-13
# Share of the thickness of a block by which another may reach into it and still touch the face it came through.
_DEPTH = 0.5
# Least share of the smaller of two surfaces that they must have in common: less is neighbours whose edges cross by
# what geometry files are rounded to.
_SHARE = 0.1


@dataclass(frozen=True)
class SeparatedPairs:
    """Common surfaces within the tolerance that are no contacts.

    patches : n of them
    between : (n,) body that lies between the two
    """

    patches: Patches
    between: IntArray

    def __len__(self) -> int:
        return len(self.between)


def drop_pairs_separated_by_third_block(
    verdicts: Verdicts, blocks: Blocks, tolerance: float
) -> tuple[Verdicts, SeparatedPairs]:
    """Verdicts without faces that see each other through blocks, without contacts across a third body, and these.

    Near misses go where a contact lies on the same part of one of their facets: the top of a thin tile is near the
    bottom of the tile after next, but the tile between them fills the gap. Of contacts the third body lies behind the
    same part of a facet as the farther of the two others, and either is no thicker than the gap, or touches the facet
    on the other side of the gap as well: so does the flange of a thick block. A body that does neither has coordinates
    of its own that were rounded.
    """
    parts = (verdicts.contacts, verdicts.slivers, verdicts.near_misses)
    contacts, slivers, near_misses = (part.take(~_through(part, blocks)) for part in parts)
    every = concatenate([contacts, near_misses])
    far, closer = _behind_one_facet(every)
    judged = (far < len(contacts)) | (closer < len(contacts))
    far, closer = far[judged], closer[judged]
    wide = _share_a_surface(every, far, closer, tolerance)
    far, closer = far[wide], closer[wide]
    third = _third(every, far, closer)
    between = (far >= len(contacts)) | _thin(every, far, closer, third, blocks) | _on_both_sides(far, third)
    far, first = np.unique(far[between], return_index=True)
    held = np.isin(np.arange(len(every)), far)
    own, other = held[: len(contacts)], held[len(contacts) :]
    kept = Verdicts(contacts.take(~own), slivers, near_misses.take(~other))
    return kept, SeparatedPairs(contacts.take(own), third[between][first][far < len(contacts)])


def _third(patches: Patches, far: IntArray, closer: IntArray) -> IntArray:
    """The body of the closer patch that is none of the farther, (n,)."""
    bodies, others = patches.overlays.bodies[closer], patches.overlays.bodies[far]
    own = (bodies[:, :, None] == others[:, None, :]).any(axis=2)
    return np.asarray(np.where(own[:, 0], bodies[:, 1], bodies[:, 0]))


def _thin(patches: Patches, far: IntArray, closer: IntArray, third: IntArray, blocks: Blocks) -> BoolArray:
    """Whether the third body is no thicker than twice the difference of the gaps, (n,)."""
    gap = patches.mid_gaps * patches.overlays.sizes
    thin = np.zeros(len(far), dtype=bool)
    rows = np.flatnonzero(third < len(blocks))
    thick = _thickness(blocks, third[rows], patches.overlays.frames[far[rows], 0])
    thin[rows] = thick <= 2 * (gap[far[rows]] - gap[closer[rows]])
    return thin


def _on_both_sides(far: IntArray, third: IntArray) -> BoolArray:
    """Whether a third body is found on the facets of both sides of a gap, (n,)."""
    pairs, inverse, count = np.unique(np.stack([far, third]), axis=1, return_inverse=True, return_counts=True)
    return np.asarray(count[inverse.ravel()] > 1) if pairs.size else np.zeros(0, dtype=bool)


def _thickness(blocks: Blocks, block: IntArray, directions: FloatArray) -> FloatArray:
    """Extent (n,) m of blocks (n,) along directions (n, 3)."""
    if not len(block):
        return np.zeros(0)
    count = np.diff(blocks.vertex_start)[block]
    row, vertex = rows_and_items(blocks.vertex_start[block], count)
    arms = blocks.vertices[vertex] - blocks.vertices[blocks.vertex_start[block]][row]
    height = np.einsum("ki,ki->k", arms, directions[row])
    first = starts(count)[:-1]
    return np.asarray(np.maximum.reduceat(height, first) - np.minimum.reduceat(height, first))


def _through(patches: Patches, blocks: Blocks) -> BoolArray:
    """True where the two planes overlap by more than half the thickness of a block across them, (n,)."""
    overlays = patches.overlays
    depth = -patches.mid_gaps * overlays.sizes
    found = np.zeros(len(patches), dtype=bool)
    for side in (0, 1):
        body = overlays.bodies[:, side]
        rows = np.flatnonzero((depth > _ROUNDING * overlays.sizes) & (body < len(blocks)))
        found[rows] |= depth[rows] > _DEPTH * _thickness(blocks, body[rows], overlays.frames[rows, 0])
    return found


def _behind_one_facet(patches: Patches) -> tuple[IntArray, IntArray]:
    """Pairs of patches near each other on one facet, with different bodies behind it, the first farther away.

    Where all patches of a facet have the same gap, as they have but for thin blocks and for coordinates that were
    rounded, there is nothing to compare.
    """
    none = np.empty(0, dtype=np.int64)
    if not len(patches):
        return none, none
    overlays = patches.overlays
    # A ground is one facet.
    face = np.where(overlays.facets >= 0, overlays.facets, overlays.facets.max() + 1 + overlays.bodies)
    gap = patches.mid_gaps * overlays.sizes
    apart = _ROUNDING * overlays.sizes
    least, most = np.full(face.max() + 1, np.inf), np.full(face.max() + 1, -np.inf)
    np.minimum.at(least, face, gap[:, None])
    np.maximum.at(most, face, gap[:, None])
    rows = np.flatnonzero((most[face] - least[face] > apart[:, None]).any(axis=1))
    if not len(rows):
        return none, none
    lower, upper = _boxes(patches.take(rows))
    i, j = (rows[side] for side in meeting_boxes(lower, upper, lower, upper, np.inf))
    i, j = np.where(gap[i] > gap[j], i, j), np.where(gap[i] > gap[j], j, i)
    on_one = (face[i][:, :, None] == face[j][:, None, :]).any(axis=(1, 2))
    same = (np.sort(overlays.bodies[i], axis=1) == np.sort(overlays.bodies[j], axis=1)).all(axis=1)
    keep = on_one & ~same & (gap[i] - gap[j] > np.minimum(apart[i], apart[j]))
    return i[keep], j[keep]


def _boxes(patches: Patches) -> tuple[FloatArray, FloatArray]:
    """Least and greatest coordinates (n, 3) of the surfaces, with as much room about them as their gap."""
    overlays = patches.overlays
    local, row = shapely.get_coordinates(patches.polygons, return_index=True)
    points = np.einsum("ka,kai->ki", local, overlays.frames[row, 1:]) * overlays.sizes[row, None]
    points += overlays.origins[row]
    first = np.flatnonzero(np.diff(row, prepend=-1))
    room = (np.abs(patches.gaps) * overlays.sizes)[:, None]
    return np.minimum.reduceat(points, first) - room, np.maximum.reduceat(points, first) + room


def _share_a_surface(patches: Patches, far: IntArray, closer: IntArray, tolerance: float) -> BoolArray:
    """Whether two patches of one facet lie on the same part of it, (n,)."""
    if not len(far):
        return np.zeros(0, dtype=bool)
    common, moved = common_parts(patches, closer, far)
    share = shapely.area(common) / np.minimum(shapely.area(moved), shapely.area(patches.polygons[closer]))
    wide = (widths(common) >= tolerance * (1 - 1e-9)) | (share >= 0.5)
    return np.asarray((share >= _SHARE) & wide)
