"""Load `pressure`: p on faces, F = -∫ p n dA with the moment -∫ (x - c) × p n dA about the centroid c of the block.

With wall friction δ the face is dragged besides, F += ∫ p tan δ d dA with the unit vector d down the slope of the face.

p is the same everywhere, or p = value + per_depth · (level - z) below a level and nothing above. Faces that cross the
level are cut there. The integrands are of second degree at most, so that the three middles of the edges of a triangle
integrate them exactly (Strang and Fix 1973, An Analysis of the Finite Element Method, table 4.1).

The pressure acts on the free parts of faces, unless all of them are asked for: not where another block lies against
them, nor on the ground, whether or not the contact of the two carries anything there.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Literal

import numpy as np
from pydantic import Field

from mbla.arrays import FloatArray, IntArray
from mbla.deck.kinds.load_key import register_load
from mbla.deck.quantities import Box, Direction, FacingAngle, Length, Stress, UnitWeight, WallFrictionAngle
from mbla.deck.section import Section, rule
from mbla.errors import Finding, KeyPath
from mbla.model.applied_load import NO_PATCHES, AppliedLoad, Patches, sum_on_blocks, wrenches_of
from mbla.model.loads.face_parts import FaceParts, face_parts
from mbla.model.loads.load_kind import Entry, LoadKind, LoadSite
from mbla.model.soil.names import is_cell
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import cut, unit
from mbla.model.solids.ragged import items_of_rows, row_means
from mbla.model.wording import counted


class PressureLoad(Section):
    """Pressure on faces: the same everywhere, or growing with depth below a level, and none above it.

    Earth pressure of soil with the unit weight γ, whose top is the `level` and carries q per area: `value` K q,
    `per_depth` K γ, `wall_friction` δ, with the coefficient K of the pressure that is normal to the wall. Coulomb's
    coefficient K_a, which is that of the whole pressure, inclined by δ, is to be multiplied by cos δ.
    """

    value: Stress = Field(
        0.0, description="pressure normal to the face, at the level if there is one; positive pushes against the face"
    )
    level: Length | None = Field(None, description="height z above which there is no pressure")
    per_depth: UnitWeight | None = Field(None, description="increase of the pressure with the depth below the level")
    wall_friction: WallFrictionAngle = Field(
        0.0,
        description="angle δ between what acts on the face and its normal, in degrees: the pressure p drags the face "
        "with p tan δ besides, straight down its slope, as soil does that settles along a wall; up where δ is negative",
    )
    normal: Direction | None = Field(None, description="outward normal of the faces; default: every face")
    within: FacingAngle = Field(10.0, description="greatest angle between the normal of a face and that, in degrees")
    box: Box | None = Field(
        None,
        description="least and greatest coordinates: faces whose centroid lies inside; of faces of soil of cells, the "
        "parts inside",
    )
    faces: Literal["free", "all"] = Field("free", description="free: exposed part of each face; all: covered parts too")


@rule(PressureLoad)
def sound_pressure(pressure: PressureLoad) -> Iterator[Finding]:
    """A depth needs a level, an angle a normal."""
    if pressure.per_depth is not None and pressure.level is None:
        yield Finding("missing-key", "needs a level from which depth is measured", "per_depth")
    if "within" in pressure.model_fields_set and pressure.normal is None:
        yield Finding("key-of-another-choice", "applies with normal only", "within")
    if not {"value", "per_depth"} & pressure.model_fields_set:
        yield Finding("missing-key", "needs a value, or a level and per_depth")


def pressure_load(entry: Entry, blocks: IntArray | None, site: LoadSite) -> AppliedLoad | None:
    """Pressure on the faces selected of blocks (n,)."""
    pressure: PressureLoad = entry.value
    here = (*entry.path, "pressure")
    chosen = np.arange(len(site.blocks)) if blocks is None else blocks
    faces = _selected_faces(pressure, chosen, site)
    soil = bool(is_cell(site.blocks)[chosen].all())
    if not len(faces):
        _refuse(
            f"no face of {'the soil' if soil else 'these blocks'} lies so: look at normal, within and box", here, site
        )
        return None
    parts = face_parts(faces, site.blocks, site.grounds, site.tolerance, pressure.faces == "free", site.overlap)
    if pressure.box is not None:
        parts = replace(parts, loops=_soil_inside(parts, faces, np.array(pressure.box), site))
    wrenches, areas = pressure_wrenches(parts, pressure, faces, site.blocks)
    if not areas.any():
        words = "other blocks or the ground cover all of these faces; faces: all loads them all the same"
        if soil and pressure.normal is not None:
            words = "no free face of the soil lies so: look at normal, within and box"
        if pressure.level is not None and (parts.covered < parts.areas).any():
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
    on_cells = NO_PATCHES if pressure.per_depth else _on_cells(parts, owner, np.flatnonzero(loaded), wrenches, site)
    return AppliedLoad(*sum_on_blocks(owner, wrenches[loaded]), words, on_cells=on_cells)


def _on_cells(parts: FaceParts, owner: IntArray, loaded: IntArray, wrenches: FloatArray, site: LoadSite) -> Patches:
    """What of the faces of cells of soil an even pressure acts on, from their one end along the plane to the other.

    owner, loaded : (n,) blocks of the faces that are loaded, and these
    """
    corners, forces, cells = [], [], []
    for soil in site.soils:
        for row in np.flatnonzero(np.isin(owner, soil.blocks)).tolist():
            points = parts.loops[parts.faces == loaded[row]].reshape(-1, 3)
            level = points @ soil.axes[0]
            first, last = points[level.argmin()], points[level.argmax()]
            corners.append([first, last, last, first])
            forces.append(wrenches[loaded[row], :3])
            cells.append(owner[row])
    shape = np.reshape(corners, (-1, 4, 3)), np.reshape(forces, (-1, 3))
    return Patches(*shape, np.array(cells, dtype=np.int64))


def _selected_faces(pressure: PressureLoad, chosen: IntArray, site: LoadSite) -> IntArray:
    blocks = site.blocks
    faces = items_of_rows(blocks.face_start, chosen)
    if pressure.normal is not None:
        cosine = math.cos(math.radians(pressure.within))
        faces = faces[blocks.face_normals[faces] @ unit(np.array(pressure.normal)) >= cosine - 1e-12]
    if pressure.box is not None:
        least, greatest = np.array(pressure.box)
        middles = row_means(blocks.vertices[blocks.loops], blocks.loop_start)[faces]
        inside = ((middles >= least) & (middles <= greatest)).all(axis=1)
        faces = faces[inside | is_cell(blocks)[blocks.block_of_face[faces]]]
    return faces


def _soil_inside(parts: FaceParts, faces: IntArray, box: FloatArray, site: LoadSite) -> FloatArray:
    """The loops of parts of faces, (n, k, 3), those of cells cut where a box ends: they are part of a mesh.

    An end of the box along which a face lies does not cut it.
    """
    blocks, loops = site.blocks, parts.loops
    owner = blocks.block_of_face[faces][parts.faces]
    of_cell = is_cell(blocks)[owner]
    normals = np.abs(blocks.face_normals[faces][parts.faces])
    for axis in range(3):
        slack = np.where(normals[:, axis] > 1.0 - LEVEL, site.tolerance * blocks.sizes[owner], 0.0)
        for end, sign in zip(box[:, axis], (1.0, -1.0), strict=True):
            inside = sign * (loops[..., axis] - end) + slack[:, None]
            loops = cut(loops, np.where(of_cell[:, None], inside, 1.0))
    return loops


def pressure_wrenches(
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
    if not site.selection.partial:
        site.refuse(Finding("load-beside-structure", words, *path))


register_load(
    LoadKind(
        name="pressure",
        section=PressureLoad,
        description="pressure on faces",
        after="line",
        takes=("follows",),
        build=pressure_load,
        mirrored=True,
    )
)
