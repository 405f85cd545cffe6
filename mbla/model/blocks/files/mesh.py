"""Blocks of an item `mesh`, from its file."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.section import given
from mbla.errors import Finding, Notice
from mbla.model.blocks.files.members import left_in, placed_vertices, read_members, split_off_supports
from mbla.model.blocks.generated import Generated, ItemContext, ItemPart, ItemRefused
from mbla.model.geometry.cells import join_cells, joinable_tetrahedra
from mbla.model.geometry.geometry import Geometry, member_name
from mbla.model.geometry.repair import repair
from mbla.model.wording import counted

if TYPE_CHECKING:
    from mbla.model.blocks.mesh import MeshItem


def read_mesh(item: MeshItem, context: ItemContext) -> Generated:
    """Blocks in the order of the file, in the deck's units and upright; members by the names of the file.

    Raises
    ------
    ItemRefused
        for files that cannot be read, of an unknown kind, or without blocks, names that the file does not have, and
        keys that do not apply to it
    DeckError
        for files that are missing or outside the deck's folder
    """
    geometry = read_members(context.resolve_file(("file",), item.file), item)
    if item.leave_out is not None:
        geometry = left_in(geometry, item.leave_out, "members has" if item.members else "the file has")
    geometry = _cells_joined(item, geometry)
    if findings := list(_misfits(item, geometry)):
        raise ItemRefused(*findings)
    loose = _loose_cells(item, geometry)
    vertices = placed_vertices(geometry, item, context.length, item.extrude)
    placed = replace(geometry, polyhedra=replace(geometry.polyhedra, vertices=vertices))
    solid, surfaces = split_off_supports(placed, item, context.tolerance)
    blocks = repair(solid, context.tolerance, item.weld)
    if not len(blocks.polyhedra):
        words = "the file holds no blocks: its faces have no area"
        raise ItemRefused(Finding("geometry-without-blocks", words, "file"))
    members = [member_name(name) for name in blocks.names]
    remarks = (*loose, *blocks.notices, *_taken_for_granted(item, geometry, context, vertices))
    notices = tuple(replace(notice, message=f"{item.file}: {notice.message}") for notice in remarks)
    part = ItemPart(blocks.polyhedra, member=members if any(members) else "")
    return Generated((part,), surfaces=surfaces, notices=notices)


def _cells_joined(item: MeshItem, geometry: Geometry) -> Geometry:
    """The file's content with cells joined if requested."""
    if item.join_cells and not geometry.cells:
        words = "applies to files with volume cells only: leave it out"
        raise ItemRefused(Finding("key-of-another-choice", words, "join_cells"))
    return join_cells(geometry) if item.join_cells else geometry


def _loose_cells(item: MeshItem, geometry: Geometry) -> list[Notice]:
    """A warning of tetrahedra of a finite-element mesh that became a block each."""
    sharing, joined = joinable_tetrahedra(geometry) if geometry.cells and not item.join_cells else (0, 0)
    if not sharing:
        return []
    words = (
        f"{sharing} tetrahedra share whole faces and are a block each, as of the mesh of a finite-element program; "
        f"join_cells: true makes {counted(joined, 'block')} of the {len(geometry.polyhedra)} cells"
    )
    return [Notice("warning", "cells-not-joined", words)]


def _misfits(item: MeshItem, geometry: Geometry) -> Iterator[Finding]:
    """Keys that the file has no use for, or lacks."""
    if geometry.planar and item.extrude is None:
        yield Finding("geometry-options", "is a drawing of outlines: give their thickness with extrude", "file")
    if geometry.planar and item.up is not None:
        yield Finding("key-of-another-choice", "does not apply to a drawing: its y points upwards in the deck", "up")
    if not geometry.planar and item.extrude is not None:
        yield Finding("key-of-another-choice", "applies to drawings (DXF) only: leave it out", "extrude")
    for key in given(item, ("supports", "flat_faces")) if geometry.planar else ():
        yield Finding("key-of-another-choice", "does not apply to a drawing, which has outlines of blocks only", key)


def _taken_for_granted(item: MeshItem, geometry: Geometry, context: ItemContext, vertices: FloatArray) -> list[Notice]:
    """What the header of the file decided, with the size that follows."""
    if item.units is not None or geometry.unit is None or not len(vertices):
        return []
    x, y, z = np.ptp(vertices, axis=0)
    size = f"{x:.4g} x {y:.4g} x {z:.4g} {context.length} along x, y, z"
    words = (
        f"coordinates in {geometry.unit}, as the file has it; its blocks measure {size} in the deck; "
        "units may say otherwise"
    )
    return [Notice("notice", "mesh-placed", words)]
