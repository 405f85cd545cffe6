"""Fill above arches and vaults: columns of soil on the free upward faces of blocks, up to a top surface.

Over a piece of a face with the plan P the column has the height h(x, y) = top − face, which is linear, so that

    volume = ∫ h dA,    centroid = ∫ (x, y, z + h/2) h dA / volume    over P, with z on the face,

are integrals of the second degree, for which the middles of the edges of triangles are exact. Of a face the pieces
count that lie below the top and that no other block covers, seen from above: what lies on the face or over it is not
fill. The mass of each column moves with the block under it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, summed
from mbla.deck.sections.fill import Dispersal, Fill, Passive
from mbla.deck.units import Units
from mbla.errors import Finding, Notice
from mbla.model.selectors import BlockSelection, select_blocks
from mbla.model.soil.names import is_cell, named_with_soil
from mbla.model.solids.blocks import NO_MASSES, Blocks, PointMasses, joined_masses
from mbla.model.solids.plane import cut, unit
from mbla.model.solids.polygons import Polygons, polygons_from_loops, triangles
from mbla.model.solids.ragged import items_of_rows, row_ranges
from mbla.model.wording import counted, named
from mbla.process.late import shapely

ROUNDING = 1e-12
"""volume over that of all columns on the block below which a column is none"""
UPWARD = 1e-6
"""vertical component of the unit normal of a face, up to which it is upright and carries nothing"""


@dataclass(frozen=True)
class FillBody:
    """One fill of the deck, and the pieces of faces that it may lie on.

    point, normal : (3,) of its top plane, normal unit and upwards
    triangles     : (n, 3, 3) pieces of faces, counter-clockwise seen from above; they may reach above the top
    blocks, faces : (n,) block and face of each
    on            : (m,) blocks that it is on, whether or not they have such a face
    unit_weight   : force per volume under standard gravity
    dispersal     : how loads on it spread
    passive       : how it holds blocks sideways, None where it does not
    """

    name: str
    point: FloatArray
    normal: FloatArray
    triangles: FloatArray
    blocks: IntArray
    faces: IntArray
    on: IntArray
    unit_weight: float
    dispersal: Dispersal
    passive: Passive | None

    def tops(self, points: FloatArray) -> FloatArray:
        """Height of the top surface at points (..., 2 or 3), (...)."""
        away = points[..., :2] - self.point[:2]
        return np.asarray(self.point[2] - away @ self.normal[:2] / self.normal[2])

    def depths(self, points: FloatArray) -> FloatArray:
        """Of points (..., 3) below the top, (...); negative above it."""
        return np.asarray(self.tops(points) - points[..., 2])


@dataclass(frozen=True)
class Columns:
    """Columns of one fill, n of them.

    rows      : (n,) pieces of faces of the fill that they stand on; blocks : (n,)
    volumes   : (n,); centroids : (n, 3)
    depths    : (n, 2) least and greatest height
    areas     : (n,) of the pieces below the top, seen from above; middles : (n, 3) of these pieces
    pressed   : (n, 3) middles weighted by the height of soil above: where its vertical stress acts on them
    """

    rows: IntArray
    blocks: IntArray
    volumes: FloatArray
    centroids: FloatArray
    depths: FloatArray
    areas: FloatArray
    middles: FloatArray
    pressed: FloatArray

    def parts(self, density: float) -> PointMasses:
        """Half the mass of each a little above its centroid and half below: as heavy as it all over its mean height."""
        off = np.zeros((2, len(self.rows), 3))
        off[:, :, 2] = np.array([[1.0], [-1.0]]) * self.volumes / self.areas / math.sqrt(12.0)
        halves = np.tile(density * self.volumes / 2, 2)
        return PointMasses(np.tile(self.blocks, 2), halves, (self.centroids + off).reshape(-1, 3))


@dataclass(frozen=True)
class CarriedFill:
    """What blocks carry of all fills.

    masses : (n_blocks,) part of their added masses
    points : (n_blocks, 3) its centroid; that of the block where there is none
    words  : one of each fill, for the listing
    bodies : by name
    parts  : of it
    """

    masses: FloatArray
    points: FloatArray
    words: tuple[str, ...]
    bodies: Mapping[str, FillBody] = field(default_factory=dict)
    parts: PointMasses = NO_MASSES


def build_fill(
    sections: Mapping[str, Fill],
    densities: Mapping[str, float],
    selection: BlockSelection,
    fixed: BoolArray,
    units: Units,
    tolerance: float,
) -> CarriedFill | None:
    """All fills of the deck on its blocks; None where it has none. Refuses fill on nothing, and two fills on one face.

    sections  : fills of the deck by name
    densities : of materials by name
    fixed     : (n_blocks,) blocks that do not move
    tolerance : greatest gap of contacts, relative to block size
    """
    if not sections:
        return None
    blocks = selection.blocks
    found: dict[str, tuple[FillBody, Columns]] = {}
    for name, section in sections.items():
        chosen = select_blocks(section.on, ("fill", name, "on"), selection)
        if chosen is None:
            continue
        weight = densities[section.material] * units.standard_gravity * units.force_per_mass_acceleration
        every = np.ones(len(blocks), dtype=bool)
        body = _body(name, section, weight, chosen, blocks, every, tolerance)
        own = columns(body, blocks)
        if len(own.rows):
            _refuse_twice(body, own, found, selection)
            found[name] = body, own
        elif not selection.partial:
            without = _body(name, section, weight, chosen, blocks, ~is_cell(blocks), tolerance)
            message = "lies on nothing: no free upward face of these blocks is below its top; look at on and its top"
            if len(columns(without, blocks).rows):
                soils = named_with_soil(np.flatnonzero(is_cell(blocks)), blocks)
                message = f"lies where the cells of {soils} are: leave one of them out, or name that soil under on"
            selection.refuse(Finding("fill-on-nothing", message, "fill", name))
        if len(own.rows) and fixed[own.blocks].all() and not fixed.all():
            where = named(np.unique(own.blocks), blocks.name)
            selection.remark(
                Notice("warning", "mass-on-support", f"the fill {name} on {where} has no effect: nothing of it moves")
            )
    materials = {name: sections[name].material for name in found}
    parts = joined_masses(own.parts(densities[materials[name]]) for name, (_, own) in found.items())
    laden = parts.added_to(blocks)
    words = tuple(_in_words(sections[name], *each, units, blocks) for name, each in found.items())
    return CarriedFill(
        laden.added_masses, laden.added_mass_points, words, {name: body for name, (body, _) in found.items()}, parts
    )


def _refuse_twice(
    body: FillBody, own: Columns, others: Mapping[str, tuple[FillBody, Columns]], selection: BlockSelection
) -> None:
    """A fault where a face carries another fill already."""
    for name, (other, theirs) in others.items():
        both = np.intersect1d(body.faces[own.rows], other.faces[theirs.rows])
        if len(both):
            where = named(np.unique(selection.blocks.block_of_face[both]), selection.blocks.name)
            words = f"lies where {name} does, on {where}: give layers as one fill of their mean density"
            selection.refuse(Finding("fill-on-fill", words, "fill", body.name))


def _in_words(section: Fill, body: FillBody, own: Columns, units: Units, blocks: Blocks) -> str:
    under = np.unique(own.blocks)
    cells = is_cell(blocks)[under]
    groups = list(dict.fromkeys(blocks.groups[block] for block in under[~cells].tolist()))
    stands = [f"{counted(int((~cells).sum()), 'block')} of {', '.join(groups)}"] if groups else []
    stands += [named_with_soil(under[cells], blocks)] if cells.any() else []
    where = f"z = {section.level:.6g} {units.length}" if section.level is not None else "its sloping top"
    depths = f"{own.depths.min():.4g} to {own.depths.max():.4g} {units.length} deep"
    weight = f"weight {body.unit_weight * float(own.volumes.sum()):.6g} {units.force}"
    return f"{body.name}: {section.material} below {where}, {depths} on {' and '.join(stands)}; {weight}"


def _body(
    name: str,
    section: Fill,
    unit_weight: float,
    chosen: IntArray,
    blocks: Blocks,
    covering: BoolArray,
    tolerance: float,
) -> FillBody:
    """The fill on chosen blocks, below no block of those that may cover it, (n_blocks,)."""
    if section.surface is None:
        point, normal = np.array([0.0, 0.0, section.level]), np.array([0.0, 0.0, 1.0])
    else:
        point, normal = np.array(section.surface.point), unit(section.surface.normal)
    none = np.empty(0, np.int64)
    body = FillBody(
        name, point, normal, np.empty((0, 3, 3)), none, none, chosen, unit_weight, section.dispersal, section.passive
    )
    faces = items_of_rows(blocks.face_start, chosen)
    faces = faces[blocks.face_normals[faces, 2] > UPWARD]
    over = np.flatnonzero((blocks.face_normals[:, 2] < -UPWARD) & covering[blocks.block_of_face])
    triangles, row = _free_triangles(faces, over, body, blocks, tolerance)
    return replace(body, triangles=triangles, blocks=blocks.block_of_face[faces[row]], faces=faces[row])


def _plans(faces: IntArray, blocks: Blocks) -> Polygons:
    """Faces as polygons seen from above, (n,)."""
    corners, start = blocks.corners_of(faces)
    return polygons_from_loops(corners[:, :2], start)


def _heights(faces: IntArray, points: FloatArray, blocks: Blocks) -> FloatArray:
    """Height on the planes of faces (n,) at points (n, ..., 2), (n, ...)."""
    first, normals = blocks.vertices[blocks.loops[blocks.loop_start[faces]]], blocks.face_normals[faces]
    shape = (len(faces), *[1] * (points.ndim - 2), 2)
    away = points - first[:, :2].reshape(shape)
    slope = (normals[:, :2] / normals[:, 2:]).reshape(shape)
    return np.asarray(first[:, 2].reshape(shape[:-1]) - (away * slope).sum(axis=-1))


def _free_triangles(
    faces: IntArray, over: IntArray, body: FillBody, blocks: Blocks, tolerance: float
) -> tuple[FloatArray, IntArray]:
    """What of upward faces (n,) none of others (k,) covers below the top: triangles (m, 3, 3), their faces' rows (m,).

    A face above covers what lies under it, from contact, within the tolerance, up to the top surface.
    """
    if not len(faces):
        return np.empty((0, 3, 3)), np.empty(0, np.int64)
    plans = _plans(faces, blocks)
    areas = shapely.area(plans)
    shadows = _plans(over, blocks)
    mine, other = shapely.STRtree(shadows).query(plans, predicate="intersects")
    reach = tolerance * blocks.sizes[blocks.block_of_face[faces]]
    corners = blocks.vertices[blocks.loops, 2]
    low, high = row_ranges(corners, blocks.loop_start)
    near = high[over[other]] >= low[faces[mine]] - reach[mine]
    mine, other = mine[near], other[near]
    common = shapely.intersection(plans[mine], shadows[other])
    middles = shapely.get_coordinates(shapely.centroid(common))
    seen = shapely.area(common) > 0.0
    mine, other, middles = mine[seen], other[seen], middles[seen[~shapely.is_empty(common)]]
    above = _heights(over[other], middles, blocks)
    covers = (above >= _heights(faces[mine], middles, blocks) - reach[mine]) & (above <= body.tops(middles))
    mine, other = mine[covers], other[covers]
    covered, first = np.unique(mine, return_index=True)  # rows ascend
    for row, against in zip(covered.tolist(), np.split(shadows[other], first[1:]), strict=False):
        plans[row] = shapely.difference(plans[row], shapely.union_all(against))
    plans[shapely.area(plans) <= 2.0 * tolerance * areas] = shapely.Polygon()  # rounding of outlines
    flat, row = triangles(plans)
    return np.concatenate([flat, _heights(faces[row], flat, blocks)[..., None]], axis=2), row


def columns(body: FillBody, blocks: Blocks) -> Columns:
    """Columns of the fill on the pieces of faces that lie below its top."""
    origins = blocks.centroids[body.blocks]
    depths = body.depths(body.triangles)
    local = np.concatenate([body.triangles - origins[:, None], depths[..., None]], axis=2)
    loops = cut(local, depths)
    a, b, c = np.broadcast_arrays(loops[:, :1], loops[:, 1:-1], loops[:, 2:])
    ab, ac = (b - a)[..., :2], (c - a)[..., :2]
    areas = (ab[..., 0] * ac[..., 1] - ab[..., 1] * ac[..., 0]) / 2
    plan, volumes = areas.sum(axis=1), np.zeros(len(loops))
    moments, middles, pressed = np.zeros((3, len(loops), 3))
    for middle in ((a + b) / 2, (b + c) / 2, (c + a) / 2):
        share = areas / 3 * middle[..., 3]
        volumes += share.sum(axis=1)
        lifted = middle[..., :3] + np.array([0.0, 0.0, 0.5]) * middle[..., 3:]
        moments += (share[..., None] * lifted).sum(axis=1)
        middles += (areas[..., None] / 3 * middle[..., :3]).sum(axis=1)
        pressed += (share[..., None] * middle[..., :3]).sum(axis=1)
    kept = np.flatnonzero(volumes > ROUNDING * summed(body.blocks, volumes, len(blocks))[body.blocks])
    return Columns(
        rows=kept,
        blocks=body.blocks[kept],
        volumes=volumes[kept],
        centroids=origins[kept] + moments[kept] / volumes[kept, None],
        depths=np.stack([loops[kept, :, 3].min(axis=1), loops[kept, :, 3].max(axis=1)], axis=1),
        areas=plan[kept],
        middles=origins[kept] + middles[kept] / plan[kept, None],
        pressed=origins[kept] + pressed[kept] / volumes[kept, None],
    )
