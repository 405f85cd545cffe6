"""Load `pressure`: p on faces, F = -∫ p n dA with the moment -∫ (x - c) × p n dA about the centroid c of the block.

p is the same everywhere, or p = value + per_depth · (level - z) below a level and nothing above. Faces that cross the
level are cut there. The integrands are of second degree at most, so that the three middles of the edges of a triangle
integrate them exactly (Strang and Fix 1973, An Analysis of the Finite Element Method, table 4.1).

The pressure acts on the free parts of faces, unless all of them are asked for: not where another block lies against
them, nor on the ground, whether or not the contact of the two carries anything there.
"""

from __future__ import annotations

import math

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.sections.loads import Load, PressureLoad
from mbla.deck.tree import KeyPath
from mbla.errors import Finding
from mbla.model.loads.free_faces import FaceParts, face_parts
from mbla.model.loads.load_kind import AppliedLoad, LoadSite, sum_on_blocks
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import cut, unit
from mbla.model.solids.ragged import items_of_rows, row_means
from mbla.model.wording import counted, vector


def pressure_load(load: Load, blocks: IntArray | None, path: KeyPath, site: LoadSite) -> AppliedLoad | None:
    """Pressure on the faces selected of blocks (n,)."""
    assert load.pressure is not None  # what makes it this kind
    pressure, here = load.pressure, (*path, "pressure")
    chosen = np.arange(len(site.blocks)) if blocks is None else blocks
    faces = _selected_faces(pressure, chosen, site.blocks)
    if not len(faces):
        if not site.roster.partial:
            site.refuse(Finding("load-beside-structure", _no_face(pressure), *here))
        return None
    parts = face_parts(faces, site.blocks, site.grounds, site.tolerance, pressure.faces == "free")
    forces, moments, areas = _integrals(parts, pressure, faces, site.blocks)
    if not areas.any():
        if not site.roster.partial:
            site.refuse(Finding("load-beside-structure", _no_area(pressure, parts), *here))
        return None
    words = _in_words(pressure, float(areas.sum()), int((areas > 0).sum()), site)
    _remark_partly(parts, areas, words, site)
    loaded = areas > 0
    owner = site.blocks.block_of_face[faces[loaded]]
    return AppliedLoad(*sum_on_blocks(owner, np.hstack([forces, moments])[loaded]), words)


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
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Force and moment on each face, (n_faces, 3), and its loaded area, (n_faces,)."""
    loops = parts.loops
    if pressure.level is not None:
        loops = cut(loops, pressure.level - loops[..., 2])
    # a fan of triangles over every loop
    a, b, c = np.broadcast_arrays(loops[:, :1], loops[:, 1:-1], loops[:, 2:])
    normals = blocks.face_normals[faces][parts.faces]
    areas = parts.signs[:, None] * np.einsum("nkj,nj->nk", np.cross(b - a, c - a), normals) / 2
    centroids = blocks.centroids[blocks.block_of_face[faces]][parts.faces]
    force, moment = np.zeros((len(faces), 3)), np.zeros((len(faces), 3))
    for middle in ((a + b) / 2, (b + c) / 2, (c + a) / 2):
        push = -(_pressure(pressure, middle) * areas / 3)[..., None] * normals[:, None]
        np.add.at(force, parts.faces, push.sum(axis=1))
        np.add.at(moment, parts.faces, np.cross(middle - centroids[:, None], push).sum(axis=1))
    loaded = np.bincount(parts.faces, areas.sum(axis=1), len(faces))
    return force, moment, np.where(loaded > 1e-9 * parts.areas, loaded, 0.0)


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
    return f"{words}, on {counted(count, 'face')} ({area:.6g} {units.length}2)"


def _no_face(pressure: PressureLoad) -> str:
    where = (
        [] if pressure.normal is None else [f"a normal within {pressure.within:g} degrees of {vector(pressure.normal)}"]
    )
    where += [] if pressure.box is None else ["a centroid in the box"]
    return f"no face of these blocks lies so: {' and '.join(where)}"


def _no_area(pressure: PressureLoad, parts: FaceParts) -> str:
    if (parts.covered >= parts.areas).all():
        return "other blocks or the ground cover all of these faces; faces: all loads them all the same"
    return f"all of these faces lie above its level, z = {pressure.level:g}, or are covered by other blocks"


def _remark_partly(parts: FaceParts, areas: FloatArray, words: str, site: LoadSite) -> None:
    share = parts.covered / parts.areas
    partly = int(((share > 2.0 * site.tolerance) & (share < 1.0) & (areas > 0)).sum())
    if partly:
        covered = f"{counted(partly, 'face')} of it {'is' if partly == 1 else 'are'} partly covered by other blocks"
        site.warn("pressure-on-part-of-face", f"{words}: {covered}; it acts on the free parts")
