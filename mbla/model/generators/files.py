"""Generators of blocks from a geometry file, and from tables of their vertices and faces."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.items.files import MeshItem, TableItem
from mbla.deck.section import given
from mbla.errors import Finding, Message, Notice
from mbla.model.generators.file_supports import (
    members_of,
    placed_vertices,
    read_members,
    split_off_supports,
    taken,
)
from mbla.model.generators.generator import Generated, ItemRefused, Part, Site
from mbla.model.geometry.cells import join_cells, joinable_tetrahedra
from mbla.model.geometry.geometry import Geometry, member_name
from mbla.model.geometry.repair import repair
from mbla.model.solids.polyhedra import polyhedra_from_lists
from mbla.model.tables import Table, TableRefused, read_table
from mbla.model.wording import counted


def generate_mesh(item: MeshItem, site: Site) -> Generated:
    """Blocks in the order of the file, in the deck's units and upright; members by the names of the file.

    Raises
    ------
    ItemRefused
        for files that cannot be read, of an unknown kind, or without blocks, names that the file does not have, and
        keys that do not apply to it
    DeckError
        for files that are missing or outside the deck's folder
    """
    geometry = _cells_joined(item, _without(item, read_members(site.resolve_file(("file",), item.file), item)))
    if findings := list(_misfits(item, geometry)):
        raise ItemRefused(*findings)
    loose = _loose_cells(item, geometry)
    vertices = placed_vertices(geometry, item, site.length, item.extrude)
    placed = replace(geometry, polyhedra=replace(geometry.polyhedra, vertices=vertices))
    solid, surfaces = split_off_supports(placed, item, site.tolerance)
    blocks = repair(solid, site.tolerance, item.weld)
    if not len(blocks.polyhedra):
        words = "the file holds no blocks: its faces have no area"
        raise ItemRefused(Finding("geometry-without-blocks", words, "file"))
    members = [member_name(name) for name in blocks.names]
    remarks = (*loose, *blocks.notices, *_taken_for_granted(item, geometry, site, vertices))
    notices = tuple(replace(notice, message=f"{item.file}: {notice.message}") for notice in remarks)
    part = Part(blocks.polyhedra, member=members if any(members) else "")
    return Generated((part,), surfaces=surfaces, notices=notices)


def _without(item: MeshItem, geometry: Geometry) -> Geometry:
    """The file's content without what is left out by name."""
    if item.leave_out is None:
        return geometry
    rows = members_of(geometry, item.leave_out, "leave_out", "members has" if item.members else "the file has")
    left = np.setdiff1d(np.arange(len(geometry.polyhedra)), rows)
    if not len(left):
        raise ItemRefused(Finding("geometry-without-blocks", "leaves no block: all are left out", "leave_out"))
    return taken(geometry, left)


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


def _taken_for_granted(item: MeshItem, geometry: Geometry, site: Site, vertices: FloatArray) -> list[Notice]:
    """What the header of the file decided, with the size that follows."""
    if item.units is not None or geometry.unit is None or not len(vertices):
        return []
    x, y, z = np.ptp(vertices, axis=0)
    size = f"{x:.4g} x {y:.4g} x {z:.4g} {site.length} along x, y, z"
    words = (
        f"coordinates in {geometry.unit}, as the file has it; its blocks measure {size} in the deck; "
        "units may say otherwise"
    )
    return [Notice("notice", "mesh-placed", words)]


COLUMNS = {"vertices": ("block", "vertex", "x", "y", "z"), "faces": ("block", "face")}


def generate_table(item: TableItem, site: Site) -> Generated:
    """Blocks in the order in which the table of vertices names them first.

    Raises
    ------
    ItemRefused
        with every fault of the tables, by file and line
    DeckError
        for files that are missing or outside the deck's folder
    """
    findings: list[Finding] = []
    tables: dict[str, Table] = {}
    for key, columns in COLUMNS.items():
        with _collected(findings, key):
            file = site.resolve_file((key,), getattr(item, key))
            tables[key] = read_table(file, columns, with_rest=key == "faces")
    if findings:
        raise ItemRefused(*findings)
    blocks = _blocks(tables["vertices"], tables["faces"])
    for key, table in tables.items():
        with _collected(findings, key):
            table.check()
    if findings:
        raise ItemRefused(*findings)
    points = [np.array(list(block.points.values())) for block in blocks.values()]
    numbers = [{vertex: row for row, vertex in enumerate(block.points)} for block in blocks.values()]
    faces = [
        [[number[corner] for corner in face] for face in block.faces]
        for block, number in zip(blocks.values(), numbers, strict=True)
    ]
    members = [member_name(name) for name in blocks]
    everything = Geometry(polyhedra_from_lists(points, faces), names=tuple(blocks), cells=True)
    if item.leave_out is None:
        return Generated((Part(everything.polyhedra, member=members),))
    rows = members_of(everything, item.leave_out, "leave_out", "the tables have")
    left = taken(everything, np.setdiff1d(np.arange(len(members)), rows))
    if not len(left.polyhedra):
        raise ItemRefused(Finding("geometry-without-blocks", "leaves no block: all are left out", "leave_out"))
    return Generated((Part(left.polyhedra, member=[member_name(name) for name in left.names]),))


@contextmanager
def _collected(findings: list[Finding], key: str) -> Iterator[None]:
    try:
        yield
    except TableRefused as refused:
        findings += refused.findings(key)


@dataclass(frozen=True)
class _Block:
    """Points of a block by the names of its vertices, lines of the table that give them, and corners of its faces."""

    points: dict[str, FloatArray] = field(default_factory=dict)
    lines: dict[str, int] = field(default_factory=dict)
    faces: list[list[str]] = field(default_factory=list)


def _blocks(vertices: Table, faces: Table) -> dict[str, _Block]:
    """Blocks by name in the order of their first vertices; the tables report what is wrong."""
    blocks: dict[str, _Block] = {}
    points, names = vertices.numbers("xyz"), zip(vertices.columns["block"], vertices.columns["vertex"], strict=True)
    for row, (name, vertex) in enumerate(names):
        block = blocks.setdefault(name, _Block())
        if not name or not vertex:
            vertices.refuse(row, f"{'vertex' if name else 'block'} is empty")
        elif vertex in block.points:
            vertices.refuse(row, f"block {name} has a vertex {vertex} in line {block.lines[vertex]}")
        block.points.setdefault(vertex, points[row])
        block.lines.setdefault(vertex, vertices.lines[row])
    for row, (name, corners) in enumerate(zip(faces.columns["block"], faces.rest, strict=True)):
        missing = [corner for corner in corners if corner not in blocks.get(name, _Block()).points]
        if name not in blocks:
            faces.refuse(row, f"block {name or '(empty)'} has no vertices")
        elif missing:
            faces.refuse(row, f"block {name} has no vertex {missing[0]}")
        elif len(corners) < 3:
            faces.refuse(row, f"a face has at least three corners, this one has {len(corners)}")
        else:
            blocks[name].faces.append(corners)
    bare = next((name for name, block in blocks.items() if not block.faces), None)
    if bare is not None and not faces.faults:
        faces.faults.append(Message("table-row", f"{faces.file}: block {bare} has no faces"))
    return blocks
