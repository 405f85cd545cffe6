"""Load `pressure`: p on faces, F = -∫ p n dA with the moment -∫ (x - c) × p n dA about the centroid c of the block.

With wall friction δ the face is dragged besides, F += ∫ p tan δ d dA with the unit vector d down the slope of the face.

p is the same everywhere, or p = value + per_depth · (level - z) below a level and nothing above. Faces that cross the
level are cut there. The integrands are of second degree at most, so that the three middles of the edges of a triangle
integrate them exactly (Strang and Fix 1973, An Analysis of the Finite Element Method, table 4.1).

The pressure acts on the free parts of faces, unless all of them are asked for: not where another block lies against
them, nor on the ground, whether or not the contact of the two carries anything there.

Each face is a polygon in coordinates of its own plane. The faces of other blocks that lie against it are taken away
from it; the rest is divided into triangles.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, row_of_item
from mbla.deck.sections.loads import Load, PressureLoad
from mbla.deck.text.tree import KeyPath
from mbla.errors import Finding
from mbla.model.loads.load_kind import AppliedLoad, LoadSite, sum_on_blocks, wrenches_of
from mbla.model.model import Ground
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import cut, meeting_boxes, plane_axes, unit
from mbla.model.solids.polygons import Polygons, polygons_from_loops, triangles
from mbla.model.solids.ragged import items_of_rows, row_maxima, row_means
from mbla.model.wording import counted


def pressure_load(load: Load, blocks: IntArray | None, path: KeyPath, site: LoadSite) -> AppliedLoad | None:
    """Pressure on the faces selected of blocks (n,)."""
    assert load.pressure is not None  # what makes it this kind
    pressure, here = load.pressure, (*path, "pressure")
    chosen = np.arange(len(site.blocks)) if blocks is None else blocks
    faces = _selected_faces(pressure, chosen, site.blocks)
    if not len(faces):
        _refuse("no face of these blocks lies so: look at normal, within and box", here, site)
        return None
    parts = face_parts(faces, site.blocks, site.grounds, site.tolerance, pressure.faces == "free", site.overlap)
    wrenches, areas = _integrals(parts, pressure, faces, site.blocks)
    if not areas.any():
        words = "other blocks or the ground cover all of these faces; faces: all loads them all the same"
        if (parts.covered < parts.areas).any():
            words = f"all of these faces lie above its level, z = {pressure.level:g}, or are covered by other blocks"
        _refuse(words, here, site)
        return None
    if pressure.wall_friction and _on_level_faces(wrenches, site.blocks.face_normals[faces]):
        words = (
            "a level face is among these, along which nothing points down: say with normal which faces are meant, and "
            "load level ones without wall friction"
        )
        site.refuse(Finding("friction-on-level-face", words, *here, "wall_friction"))
        return None
    words = _in_words(pressure, float(areas.sum()), int((areas > 0).sum()), site)
    share = parts.covered / parts.areas
    if partly := int(((share > 2.0 * site.tolerance) & (share < 1.0) & (areas > 0)).sum()):
        covered = f"{counted(partly, 'face')} of it {'is' if partly == 1 else 'are'} partly covered by other blocks"
        site.warn("pressure-on-part-of-face", f"{words}: {covered}; it acts on the free parts")
    loaded = areas > 0
    owner = site.blocks.block_of_face[faces[loaded]]
    return AppliedLoad(*sum_on_blocks(owner, wrenches[loaded]), words)


def _selected_faces(pressure: PressureLoad, chosen: IntArray, blocks: Blocks) -> IntArray:
    faces = items_of_rows(blocks.face_start, chosen)
    if pressure.normal is not None:
        cosine = math.cos(math.radians(pressure.within))
        faces = faces[blocks.face_normals[faces] @ unit(np.array(pressure.normal)) >= cosine - 1e-12]
    if pressure.box is not None:
        least, greatest = np.array(pressure.box)
        middles = row_means(blocks.vertices[blocks.loops], blocks.loop_start)[faces]
        faces = faces[((middles >= least) & (middles <= greatest)).all(axis=1)]
    return faces


def _integrals(
    parts: FaceParts, pressure: PressureLoad, faces: IntArray, blocks: Blocks
) -> tuple[FloatArray, FloatArray]:
    """Force, moment and levers on each face, (n_faces, 15), and its loaded area, (n_faces,)."""
    loops = parts.loops
    if pressure.level is not None:
        loops = cut(loops, pressure.level - loops[..., 2])
    # a fan of triangles over every loop
    a, b, c = np.broadcast_arrays(loops[:, :1], loops[:, 1:-1], loops[:, 2:])
    normals = blocks.face_normals[faces][parts.faces]
    areas = np.einsum("nkj,nj->nk", np.cross(b - a, c - a), normals) / 2
    centroids = blocks.centroids[blocks.block_of_face[faces]][parts.faces]
    directions = math.tan(math.radians(pressure.wall_friction)) * _down_slope(normals) - normals
    wrenches = np.zeros((len(faces), 15))
    for middle in ((a + b) / 2, (b + c) / 2, (c + a) / 2):
        push = (_pressure(pressure, middle) * areas / 3)[..., None] * directions[:, None]
        around = np.broadcast_to(centroids[:, None], middle.shape)
        own = wrenches_of(*(values.reshape(-1, 3) for values in (push, middle, around)))
        np.add.at(wrenches, parts.faces, own.reshape(*middle.shape[:2], 15).sum(axis=1))
    loaded = np.bincount(parts.faces, areas.sum(axis=1), len(faces))
    return wrenches, np.where(loaded > 1e-9 * parts.areas, loaded, 0.0)


LEVEL = 1e-6
"""horizontal component of the unit normal of a face up to which it is level and has no direction down its slope"""


def _down_slope(normals: FloatArray) -> FloatArray:
    """Unit vectors in faces that point down as steeply as the faces do, zero in level ones; both (n, 3)."""
    slopes = np.hypot(normals[:, 0], normals[:, 1])
    down = normals[:, 2:] * normals - np.array([0.0, 0.0, 1.0])
    return np.asarray(np.where(slopes > LEVEL, 1.0, 0.0)[:, None] * down / np.maximum(slopes, LEVEL)[:, None])


def _on_level_faces(wrenches: FloatArray, normals: FloatArray) -> bool:
    """Whether faces (n, 3) carry anything that are level, with more than rounding of the level of the pressure."""
    pushed = np.linalg.norm(wrenches[:, :3], axis=1)
    level = np.hypot(normals[:, 0], normals[:, 1]) <= LEVEL
    return bool((pushed[level] > 1e-9 * pushed.max()).any())


def _pressure(pressure: PressureLoad, points: FloatArray) -> FloatArray:
    """At points, (n, k) from (n, k, 3), none of them above the level."""
    depth = 0.0 if pressure.level is None else pressure.level - points[..., 2]
    return np.asarray(pressure.value + (pressure.per_depth or 0.0) * depth * np.ones(points.shape[:-1]))


def _in_words(pressure: PressureLoad, area: float, count: int, site: LoadSite) -> str:
    units = site.units
    terms = [f"{pressure.value:.6g} {units.force}/{units.length}2"] if pressure.value or not pressure.per_depth else []
    if pressure.per_depth:
        terms.append(f"{pressure.per_depth:.6g} {units.force}/{units.length}3 times depth")
    words = f"pressure {' + '.join(terms)}"
    if pressure.level is not None:
        words += f" below z = {pressure.level:.6g} {units.length}"
    if pressure.wall_friction:
        words += f", inclined {'up' if pressure.wall_friction < 0 else 'down'} by {abs(pressure.wall_friction):.6g}°"
    return f"{words}, on {counted(count, 'face')} ({area:.6g} {units.length}2)"


def _refuse(words: str, path: KeyPath, site: LoadSite) -> None:
    """A fault where nothing is loaded, and every block could be built."""
    if not site.roster.partial:
        site.refuse(Finding("load-beside-structure", words, *path))


FACING = 0.99
"""cosine of the greatest angle between two faces that lie against each other"""


@dataclass(frozen=True)
class FaceParts:
    """What is loaded of faces.

    loops : (n, 3, 3) corners of triangles on the planes of their faces, counter-clockwise seen from outside
    faces : (n,) position of the face in the list asked for
    areas : (n_faces,) area of each face; covered : (n_faces,) the part of it that other blocks and grounds cover
    """

    loops: FloatArray
    faces: IntArray
    areas: FloatArray
    covered: FloatArray


@dataclass(frozen=True)
class _Frames:
    """Plane coordinates on faces: ``origins`` (n, 3), ``axes`` (n, 2, 3), right-handed with the outward normal."""

    origins: FloatArray
    axes: FloatArray

    def polygons(self, rows: IntArray, faces: IntArray, blocks: Blocks) -> Polygons:
        """Faces (n,) as polygons, (n,), each in the plane of one of the frames."""
        corners, start = blocks.corners_of(faces)
        frame = rows[row_of_item(start)]
        return polygons_from_loops(np.einsum("nj,nij->ni", corners - self.origins[frame], self.axes[frame]), start)

    def outline(self, row: int, corners: FloatArray) -> Any:
        """A surface, corners (n, 3), as a polygon in the plane of a frame."""
        import shapely

        return shapely.Polygon((corners - self.origins[row]) @ self.axes[row].T)

    def triangles(self, polygons: Polygons) -> tuple[FloatArray, IntArray]:
        """Triangles of polygons (n,), one for each frame: corners (m, 3, 3), outwards, and their polygons (m,)."""
        flat, rows = triangles(polygons)
        return np.einsum("nki,nij->nkj", flat, self.axes[rows]) + self.origins[rows, None], rows


def face_parts(
    faces: IntArray,
    blocks: Blocks,
    grounds: tuple[Ground, ...],
    tolerance: float,
    free_only: bool,
    overlap: float = 0.0,
) -> FaceParts:
    """The faces (n,), or what of them is free.

    tolerance, overlap : of gaps and of overlaps, relative to block size, as those of contacts
    """
    import shapely

    frames = _Frames(blocks.vertices[blocks.loops[blocks.loop_start[faces]]], plane_axes(blocks.face_normals[faces]))
    polygons = frames.polygons(np.arange(len(faces)), faces, blocks)
    areas = left = np.asarray(shapely.area(polygons))
    if free_only:
        mine, others = _facing_pairs(faces, blocks, tolerance, overlap)
        groups = np.split(frames.polygons(mine, others, blocks), np.flatnonzero(np.diff(mine)) + 1)
        for row, against in zip(np.unique(mine).tolist(), groups, strict=False):
            polygons[row] = shapely.difference(polygons[row], shapely.union_all(against))
        for ground in grounds:
            on = _on_ground(faces, blocks, ground, tolerance, overlap)
            for row in np.flatnonzero(on).tolist():
                taken = polygons[row] if ground.outline is None else frames.outline(row, ground.outline)
                polygons[row] = shapely.difference(polygons[row], taken)
        left = np.asarray(shapely.area(polygons))
        left[left <= 2.0 * tolerance * areas] = 0.0  # rounding of outlines
        polygons[left == 0.0] = shapely.Polygon()
    return FaceParts(*frames.triangles(polygons), areas, areas - left)


def _on_ground(faces: IntArray, blocks: Blocks, ground: Ground, tolerance: float, overlap: float) -> BoolArray:
    """Faces that lie in the plane of a ground that carries their block, (n,)."""
    owner = blocks.block_of_face[faces]
    corners, start = blocks.corners_of(faces)
    heights = (corners - ground.point) @ ground.normal
    on = row_maxima(heights, start) <= tolerance * blocks.sizes[owner]
    on &= row_maxima(-heights, start) <= max(tolerance, overlap) * blocks.sizes[owner]
    on &= blocks.face_normals[faces] @ ground.normal <= -FACING
    return on if ground.blocks is None else np.asarray(on & np.isin(owner, ground.blocks))


def _facing_pairs(faces: IntArray, blocks: Blocks, tolerance: float, overlap: float) -> tuple[IntArray, IntArray]:
    """(position in ``faces``, face of another block that may lie against it)."""
    corners = blocks.vertices[blocks.loops]
    low, high = -row_maxima(-corners, blocks.loop_start), row_maxima(corners, blocks.loop_start)
    reach = tolerance * blocks.sizes[blocks.block_of_face]
    margin = reach[faces, None]
    mine, others = meeting_boxes(low[faces] - margin, high[faces] + margin, low, high)
    face = faces[mine]
    between = blocks.vertices[blocks.loops[blocks.loop_start[others]]]
    between = between - blocks.vertices[blocks.loops[blocks.loop_start[face]]]
    normals = blocks.face_normals[face]
    kept = blocks.block_of_face[face] != blocks.block_of_face[others]
    height = np.einsum("ij,ij->i", between, normals)
    near = 2.0 * reach[face] + reach[others]
    smaller = np.minimum(*(blocks.sizes[blocks.block_of_face[side]] for side in (face, others)))
    kept &= (height <= near) & (height >= -np.maximum(near, 1.001 * overlap * smaller))
    kept &= np.einsum("ij,ij->i", blocks.face_normals[others], normals) <= -FACING
    return mine[kept], others[kept]
