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
(:mod:`mbla.contacts.third_block`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import shapely

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.broad_phase import NEAR_MISS, find_facet_pairs, find_surface_pairs, opposite
from mbla.contacts.contact_planes import outlines
from mbla.contacts.facets import Facets, with_surfaces
from mbla.contacts.outlines.overlay import Overlays, Planes, Rows, build_overlays, concatenate, gap_at, local_maps
from mbla.model.model import Ground
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.polygons import Polygons, boxes_overlap, connected_parts, intersect, map_polygons, widths

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
    sheets = with_surfaces(facets, grounds, len(blocks))
    pairs = find_facet_pairs(blocks, facets, tolerance)
    if len(sheets) > len(facets):
        pairs = np.vstack([pairs, find_surface_pairs(blocks, facets, sheets, grounds, tolerance)])
    between, first, second = _between(blocks, sheets, pairs)
    keep = np.flatnonzero(boxes_overlap(first, second, _EDGE * tolerance))
    between = between.take(keep)
    convex = sheets.convex[between.facets[:, 0]] & sheets.convex[between.facets[:, 1]]
    shapes = [intersect(first[keep], second[keep], convex)]
    overlays = [between]
    for index, ground in enumerate(grounds):
        if ground.outline is None:
            on_ground = _on_ground(blocks, facets, ground, len(blocks) + index, tolerance)
            overlays.append(on_ground)
            shapes.append(outlines(on_ground, facets, 1))
    parts, row = connected_parts(np.concatenate(shapes))
    found = _measured(concatenate(overlays).take(row), parts, shapely.area(sheets.polygons))
    number = found.overlays.facets
    return replace(found, overlays=replace(found.overlays, facets=np.where(number < len(facets), number, -1)))


def judge(patches: Patches, tolerance: float, reach: float | None = None, overlap: float | None = None) -> Verdicts:
    """Sort common surfaces into contacts, slivers and near misses.

    reach   : greatest gap of near misses, ten tolerances unless given
    overlap : greatest depth at which blocks touch, that of gaps unless given
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


def _between(blocks: Blocks, facets: Facets, pairs: IntArray) -> tuple[Overlays, Polygons, Polygons]:
    """Overlays of pairs of facets, (n, 2), those of ground surfaces among them, and both outlines of each."""
    a, b = pairs.T
    sizes = np.append(blocks.sizes, np.full(max(int(facets.blocks.max(initial=0)) + 1 - len(blocks), 0), np.inf))
    # Amid what the two bounding boxes share: near the common surface, however large one of the facets is.
    shared = (np.maximum(facets.lower[a], facets.lower[b]) + np.minimum(facets.upper[a], facets.upper[b])) / 2
    overlays = build_overlays(
        bodies=facets.blocks[pairs],
        facets=pairs,
        a=Planes(facets.origins[a], facets.normals[a]),
        b=Planes(facets.origins[b], facets.normals[b]),
        near=shared,
        sizes=sizes[facets.blocks[pairs]].min(axis=1),
    )
    return overlays, outlines(overlays, facets, 0), outlines(overlays, facets, 1)


def _on_ground(blocks: Blocks, facets: Facets, ground: Ground, body: int, tolerance: float) -> Overlays:
    """Facets that face a ground plane and come within reach of it somewhere."""
    normals = np.broadcast_to(ground.normal, (len(facets), 3))
    sizes = blocks.sizes[facets.blocks]
    height = np.abs((facets.origins - ground.point) @ ground.normal)
    cosine = facets.normals @ ground.normal
    near = height <= NEAR_MISS * tolerance * sizes + np.sqrt(np.maximum(1 - cosine**2, 0.0)) * facets.radii
    carried = np.ones(len(facets), dtype=bool) if ground.blocks is None else np.isin(facets.blocks, ground.blocks)
    chosen = np.flatnonzero(near & carried & opposite(normals, facets.normals))
    return build_overlays(
        bodies=np.stack([np.full(len(chosen), body), facets.blocks[chosen]], axis=1),
        facets=np.stack([np.full(len(chosen), -1), chosen], axis=1),
        a=Planes(np.broadcast_to(ground.point, (len(chosen), 3)), normals[chosen]),
        b=Planes(facets.origins[chosen], facets.normals[chosen]),
        near=facets.origins[chosen],
        sizes=sizes[chosen],
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
