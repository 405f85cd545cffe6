"""Narrow phase: common surfaces of opposite facets, and whether each is a contact.

Both outlines are projected onto the mean plane of the two facets and intersected; every connected part of the result
is judged by itself (tolerance ε, lengths relative to the block size of the pair):

- contact:    the gap is at most ε at every corner, and the part is at least ε wide; where blocks overlap the gap is
              negative, and at least minus the tolerance of overlaps;
- sliver:     the gap is at most ε, but the part is narrower;
- near miss:  the gap is more than ε somewhere, halfway between its extremes at most 10 ε, and the part is at least
              ε wide.

Where the part is narrow because a facet is (a finely faceted cylinder in its socket), and takes at least half of that
facet, it is no sliver but a contact. Parts narrower than a thousandth of ε are facets that share an edge, not a
surface: they are left out. What has a block in between is left out after
(:mod:`mbla.contacts.faces.third_block`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import shapely

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.faces.broad_phase import NEAR_MISS, are_opposite
from mbla.contacts.faces.common_surfaces import FacetSearch, find_common_surfaces
from mbla.contacts.faces.facets import Facets
from mbla.contacts.outlines.overlay import Overlays, Rows, gap_at, local_maps
from mbla.model.model import Ground
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.polygons import Polygons, connected_parts, intersect, map_polygons, widths

_EDGE = 1e-3
_NARROW_FACET = 0.5
_ROUNDING = 1e-12


@dataclass(frozen=True)
class Patches(Rows):
    """Connected common surfaces.

    overlays : n records, one for each patch
    polygons : (n,) in the local coordinates of the overlay (lengths relative to block size)
    widths   : (n,) relative to block size
    gaps     : (n,) greatest distance between the two planes over the patch with its sign (negative where they
               overlap), relative to block size
    mid_gaps : (n,) halfway between the extremes of that distance, relative to block size
    coverage : (n,) share of the smaller of the two facets that the patch takes
    """

    overlays: Overlays
    polygons: Polygons
    widths: FloatArray
    gaps: FloatArray
    mid_gaps: FloatArray
    coverage: FloatArray

    def __len__(self) -> int:
        return len(self.widths)


@dataclass(frozen=True)
class Verdicts:
    """Common surfaces by verdict; those of bodies that are both fixed included."""

    contacts: Patches
    slivers: Patches
    near_misses: Patches


def find_patches(
    blocks: Blocks, facets: Facets, grounds: tuple[Ground, ...], tolerance: float, overlap: float = 0.0
) -> Patches:
    """All common surfaces of blocks with blocks and with grounds, whatever their gap (within reach).

    overlap : greatest depth that counts as touching, relative to block size
    """
    tolerance = max(tolerance, overlap / NEAR_MISS)
    search = FacetSearch(NEAR_MISS * tolerance, are_opposite, _EDGE * tolerance)
    overlays, shapes, sheets = find_common_surfaces(blocks, facets, grounds, search)
    parts, row = connected_parts(shapes)
    found = _measured(overlays.take(row), parts, shapely.area(sheets.polygons))
    number = found.overlays.facets
    return replace(found, overlays=replace(found.overlays, facets=np.where(number < len(facets), number, -1)))


def judge(patches: Patches, tolerance: float, reach: float | None = None, overlap: float | None = None) -> Verdicts:
    """Sort common surfaces into contacts, slivers and near misses.

    reach   : greatest gap of near misses; default: ten tolerances
    overlap : greatest depth at which blocks touch; default: the tolerance of gaps
    """
    # Equality with the tolerance must not hang on the last digit.
    limit, depth = (each * (1 + 1e-9) + _ROUNDING for each in (tolerance, tolerance if overlap is None else overlap))
    other_gaps = 2 * patches.mid_gaps - patches.gaps
    close = (np.maximum(patches.gaps, other_gaps) <= limit) & (np.minimum(patches.gaps, other_gaps) >= -depth)
    near = ~close & (np.abs(patches.mid_gaps) <= (NEAR_MISS * limit if reach is None else reach))
    visible = patches.widths > _EDGE * tolerance
    wide = (patches.widths >= tolerance * (1 - 1e-9)) | (visible & (patches.coverage >= _NARROW_FACET))
    return Verdicts(
        contacts=patches.take(close & wide),
        slivers=patches.take(close & ~wide & visible),
        near_misses=patches.take(near & wide),
    )


def _measured(overlays: Overlays, polygons: Polygons, facet_areas: FloatArray) -> Patches:
    points, row = shapely.get_coordinates(polygons, return_index=True)
    gap = gap_at(overlays, row, points)
    first = np.flatnonzero(np.diff(row, prepend=-1))
    high = np.maximum.reduceat(gap, first) if len(first) else np.zeros(0)
    low = np.minimum.reduceat(gap, first) if len(first) else np.zeros(0)
    area_a = np.where(overlays.facets[:, 0] >= 0, facet_areas[overlays.facets[:, 0]], np.inf)  # ground has no end
    smaller = np.minimum(area_a, facet_areas[overlays.facets[:, 1]])
    return Patches(
        overlays=overlays,
        polygons=polygons,
        widths=widths(polygons),
        gaps=np.where(high >= -low, high, low),
        mid_gaps=(high + low) / 2,
        coverage=shapely.area(polygons) * overlays.sizes**2 / smaller,
    )


def common_parts(patches: Patches, one: IntArray, other: IntArray) -> tuple[Polygons, Polygons]:
    """What pairs of patches share, and the second of each as moved there; (n,) each in coordinates of the first."""
    overlays = patches.overlays
    matrices, offsets = local_maps(overlays.take(one), overlays.origins[other], overlays.frames[other])
    moved = map_polygons(patches.polygons[other], matrices * overlays.sizes[other, None, None], offsets)
    return intersect(patches.polygons[one], moved, np.zeros(len(one), dtype=bool)), moved
