"""Blocks from raw polyhedra: orient, measure, refuse what is no block."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.errors import Message, Notice
from mbla.model.solids.blocks import BlockLabels, Blocks
from mbla.model.solids.defects import (
    Defect,
    Defects,
    Extents,
    coordinate_defects,
    corner_defects,
    edge_defects,
    find_extents,
    not_planar,
    planarity_defects,
    size_defects,
)
from mbla.model.solids.facets import NO_BENT_FACES, BentFaces, can_be_split, find_facets, split_faces
from mbla.model.solids.measures import (
    Edges,
    FaceGeometry,
    count_pieces,
    face_geometry,
    faces_to_turn,
    find_convex,
    find_edges,
    volumes_and_centroids,
)
from mbla.model.solids.polyhedra import Polyhedra, drop_unused_vertices, take_polyhedra, turn_faces
from mbla.model.solids.self_intersection import intersection_defects
from mbla.model.solids.shared_faces import shared_faces
from mbla.model.wording import counted, named, with_count

PLANAR = 1e-9
"""departure of a corner from the plane of its face, relative to block size, that is rounding and not reported"""


@dataclass(frozen=True)
class Labels:
    """What blocks are called and made of: ``groups`` (n,), ``densities`` (n,), ``within`` (n) the labels within their
    groups, ``strengths`` (n, 2) as blocks have them.
    """

    groups: tuple[str, ...]
    densities: FloatArray
    within: BlockLabels
    strengths: FloatArray | None = None

    @cached_property
    def group_indices(self) -> IntArray:
        """Position of each block in its group, from 0, (n,)."""
        codes = np.unique(np.array(self.groups, dtype=np.str_), return_inverse=True)[1]
        order, counts = np.argsort(codes, kind="stable"), np.bincount(codes)
        indices = np.empty(len(codes), dtype=np.int64)
        indices[order] = np.arange(len(codes)) - np.repeat(np.cumsum(counts) - counts, counts)
        return indices

    def name(self, block: int) -> str:
        """As ``Blocks.name``."""
        return f"{self.groups[block]}[{self.group_indices[block]}]"


@dataclass(frozen=True)
class BuiltBlocks:
    """Blocks, and what was found on the way.

    Where there are ``defects`` the blocks that have one carry meaningless measures. ``bent`` faces are triangles now.
    """

    blocks: Blocks
    notices: tuple[Notice, ...]
    defects: tuple[Defect, ...]
    bent: BentFaces


def build_blocks(polyhedra: Polyhedra, labels: Labels, tolerance: float) -> BuiltBlocks:
    """Blocks from polyhedra with faces in any orientation.

    tolerance : of planarity and of facets, relative to block size

    The checks follow each other, and a block that fails one is left out of the next: an open block has no volume to
    judge. Everything is done for all blocks at once.
    """
    if not len(polyhedra):
        return BuiltBlocks(_no_blocks(polyhedra, labels), (), (), NO_BENT_FACES)
    polyhedra, unused = drop_unused_vertices(polyhedra)
    defects = Defects(len(polyhedra))
    defects.add(coordinate_defects(polyhedra))
    fit = defects.sound[polyhedra.block_of_vertex, None]
    polyhedra = replace(polyhedra, vertices=np.where(fit, polyhedra.vertices, 0.0))
    extents = find_extents(polyhedra)
    defects.add(corner_defects(polyhedra, extents))
    polyhedra, turned = _oriented(polyhedra, find_edges(polyhedra), defects)
    volumes, _ = volumes_and_centroids(polyhedra)
    defects.add(size_defects(polyhedra, face_geometry(polyhedra), volumes, extents))
    turned_faces = np.bincount(polyhedra.block_of_face[turned], minlength=len(polyhedra))
    polyhedra, bent = _without_bent_faces(polyhedra, defects, np.cbrt(volumes), tolerance)
    edges, faces = find_edges(polyhedra), face_geometry(polyhedra)
    volumes, centroids = volumes_and_centroids(polyhedra)
    sizes = np.cbrt(volumes)
    convex = find_convex(polyhedra, faces, tolerance * sizes) & defects.sound
    defects.add(_self_intersections(polyhedra, np.flatnonzero(defects.sound & ~convex)))
    facets = np.arange(len(polyhedra.block_of_face))
    if not defects.found:
        facets = find_facets(polyhedra, edges, faces, _allowed(bent, tolerance * sizes))
    blocks = Blocks(
        **{each.name: getattr(polyhedra, each.name) for each in fields(Polyhedra)},
        facet_of_face=facets,
        face_normals=faces.normals,
        convex=convex,
        volumes=volumes,
        centroids=centroids,
        densities=labels.densities,
        added_masses=np.zeros(len(volumes)),
        added_mass_points=centroids,
        groups=labels.groups,
        group_indices=labels.group_indices,
        labels=labels.within,
        strengths=labels.strengths,
    )
    notices = (
        *_counted("vertices-unused", unused, "vertex", "left out, used by no face,", labels),
        *_counted("faces-turned-outwards", turned_faces, "face", "turned outwards", labels),
        *_not_quite_planar(blocks, faces, bent, extents, labels),
    )
    return BuiltBlocks(blocks, notices, tuple(sorted(defects.found, key=lambda defect: defect.block)), bent)


def _no_blocks(polyhedra: Polyhedra, labels: Labels) -> Blocks:
    """What is none yet, for soil of cells to follow."""
    return Blocks(
        **{each.name: getattr(polyhedra, each.name) for each in fields(Polyhedra)},
        facet_of_face=np.empty(0, dtype=np.int64),
        face_normals=np.empty((0, 3)),
        convex=np.empty(0, dtype=bool),
        volumes=np.empty(0),
        centroids=np.empty((0, 3)),
        densities=labels.densities,
        added_masses=np.empty(0),
        added_mass_points=np.empty((0, 3)),
        groups=(),
        group_indices=np.empty(0, dtype=np.int64),
        labels=labels.within,
    )


def _not_quite_planar(
    blocks: Blocks, faces: FaceGeometry, bent: BentFaces, extents: Extents, labels: Labels
) -> Iterator[Notice]:
    """Remarks on faces that are planar within the tolerance only, and on those that were split."""
    sizes = blocks.sizes
    limit = np.maximum(PLANAR * sizes, 8 * extents.rounding)[blocks.block_of_face]
    rough = np.flatnonzero((faces.deviations > limit) & (sizes > 0)[blocks.block_of_face])  # others are refused
    owner = blocks.block_of_face[rough]
    number, share = rough - blocks.face_start[owner], faces.deviations[rough] / sizes[owner]
    fitted = "planar only within the tolerance, each taken as the plane fitted to its corners"
    yield from _worst("faces-not-quite-planar", owner, number, share, fitted, labels)
    words = "not planar and split into triangles"
    if shared := int((bent.twins >= 0).sum()) // 2:
        words += f", {counted(shared, 'pair')} with the same corners in two blocks alike"
    yield from _worst("bent-faces-split", bent.blocks, bent.faces, bent.deviations / sizes[bent.blocks], words, labels)


def _allowed(bent: BentFaces, allowed: FloatArray) -> FloatArray:
    """Departures from the plane of a facet, (n,), no greater for a block than for those with which it shares bent
    faces: what is split for one stays so for both.
    """
    shared = bent.twins >= 0
    least = allowed.copy()
    np.minimum.at(least, bent.blocks[shared], allowed[bent.twins[shared]])
    return least


def _oriented(polyhedra: Polyhedra, edges: Edges, defects: Defects) -> tuple[Polyhedra, BoolArray]:
    """The polyhedra with faces outwards, and the faces turned for it (n_faces,); refuses what cannot be oriented."""
    defects.add(edge_defects(polyhedra, edges))
    pieces = count_pieces(polyhedra, edges)
    defects.add(
        Defect(b, Message("bad-polyhedron", f"is {pieces[b]} separate pieces: each must be a block"))
        for b in np.flatnonzero(pieces > 1).tolist()
    )
    turned, one_sided = faces_to_turn(polyhedra, edges)
    message = Message("bad-polyhedron", "is one-sided: its faces cannot all be turned outwards")
    defects.add(Defect(block, message) for block in np.flatnonzero(one_sided).tolist())
    volumes, _ = volumes_and_centroids(turn_faces(polyhedra, turned))
    turned = turned ^ (volumes < 0)[polyhedra.block_of_face]
    return turn_faces(polyhedra, turned), turned


def _without_bent_faces(
    polyhedra: Polyhedra, defects: Defects, sizes: FloatArray, tolerance: float
) -> tuple[Polyhedra, BentFaces]:
    """The polyhedra with triangles in place of faces that are not planar; refuses what cannot be split."""
    faces = face_geometry(polyhedra)
    bent = not_planar(polyhedra, faces, sizes, tolerance)
    bent = bent[defects.sound[polyhedra.block_of_face[bent]]]
    if not len(bent):
        return polyhedra, NO_BENT_FACES
    bent, twins = _with_twins(polyhedra, faces, bent, tolerance * sizes)
    convex = can_be_split(polyhedra, faces, bent)
    block = polyhedra.block_of_face[bent]
    number, departure = bent - polyhedra.face_start[block], faces.deviations[bent]
    defects.add(planarity_defects(block[~convex], number[~convex], departure[~convex], sizes, tolerance))
    sound = defects.sound[block]
    if not sound.any():
        return polyhedra, NO_BENT_FACES
    return split_faces(polyhedra, faces, bent[sound], twins[sound])


def _with_twins(
    polyhedra: Polyhedra, faces: FaceGeometry, bent: IntArray, allowed: FloatArray
) -> tuple[IntArray, IntArray]:
    """Bent faces (n,) and those of other blocks with the same corners, ascending, and that of each; -1 for none.

    A face may be bent for a small block, and planar within the tolerance for the large one that has the same.
    """
    twins = shared_faces(polyhedra, faces, bent, allowed[polyhedra.block_of_face[bent]])
    twin_of = dict(zip(bent.tolist(), twins.tolist(), strict=True))
    twin_of |= {twin: face for face, twin in twin_of.items() if twin >= 0 and twin not in twin_of}
    chosen = np.array(sorted(twin_of), dtype=np.int64)
    return chosen, np.array([twin_of[face] for face in chosen.tolist()], dtype=np.int64)


def _self_intersections(polyhedra: Polyhedra, blocks: IntArray) -> list[Defect]:
    if not len(blocks):
        return []
    chosen = take_polyhedra(polyhedra, blocks)
    found = intersection_defects(chosen, find_edges(chosen), face_geometry(chosen), find_extents(chosen))
    return [replace(defect, block=int(blocks[defect.block])) for defect in found]


def _counted(identifier: str, numbers: IntArray, noun: str, words: str, labels: Labels) -> list[Notice]:
    """``3 faces were turned outwards in 2 blocks (a[0], a[1])``, from how many things each block has, (n_blocks,)."""
    blocks = np.flatnonzero(numbers)
    words = with_count(int(numbers.sum()), noun, f"{words} in {_blocks_in_words(blocks, labels)}")
    return [Notice("notice", identifier, words)] if len(blocks) else []


def _worst(
    identifier: str, blocks: IntArray, faces: IntArray, relative: FloatArray, words: str, labels: Labels
) -> list[Notice]:
    """Words on faces, by the numbers of their blocks and in them, of which one leaves its plane most, (n,) each.

    relative : by how much of the block size
    """
    if not len(blocks):
        return []
    worst, one = int(np.argmax(relative)), len(blocks) == 1
    which = f"{counted(len(blocks), 'face')} of {_blocks_in_words(np.unique(blocks), labels)} {'is' if one else 'are'}"
    text = (
        f"{which} {words}; the worst, face {faces[worst]} of {labels.name(int(blocks[worst]))}, "
        f"leaves its plane by {relative[worst]:.2g} of the block size"
    )
    return [Notice("notice", identifier, text)]


def _blocks_in_words(blocks: IntArray, labels: Labels) -> str:
    return f"{counted(len(blocks), 'block')} ({named(blocks, labels.name)})"
